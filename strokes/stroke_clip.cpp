#include "strokes/stroke_clip.h"

#include <algorithm>
#include <cmath>

#include "base/interrupt.h"

namespace burin {
namespace {

/// Calls visit(pixel, bits) for the pixels of a row that columns [begin, end) lie in, counted from the row's start.
template <typename Visit>
void for_pixels(int begin, int end, const Visit& visit) {
    constexpr int kColumns = StrokeMask::kColumns;
    for (int column = begin; column < end;) {
        const int pixel = column / kColumns, from = column % kColumns;
        const int to = std::min(end - pixel * kColumns, kColumns);
        visit(pixel, (0xFFFFFFFFu << from) & (0xFFFFFFFFu >> (kColumns - to)));
        column = (pixel + 1) * kColumns;
    }
}

/// How much nearer a surface is than a farther one, in pixels' widths (docs/conventions.md).
constexpr double kFartherPx = 2;
/// Lines that end at a boundary may end a little beyond it.
constexpr double kOvershootPx = 0.25;

/// The direction of shorter pieces, and so their sides, is left to chance. Their neighbours cover them.
constexpr double kShortestPx = 1.0 / 1024;

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// Cuts [begin, end] to where a value that runs from `at_0` at 0 to `at_1` at 1 is not negative.
bool clip(double at_0, double at_1, double& begin, double& end) {
    if (at_0 < 0 && at_1 < 0) return false;
    if (at_0 < 0) begin = std::max(begin, at_0 / (at_0 - at_1));
    if (at_1 < 0) end = std::min(end, at_0 / (at_0 - at_1));
    return begin < end;
}

double distance_to_piece(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 along = b - a;
    const double square = glm::dot(along, along);
    return glm::distance(p, square > 0 ? a + along * std::clamp(glm::dot(p - a, along) / square, 0.0, 1.0) : a);
}

}  // namespace

/// Frame has coordinates along a piece (x) and to its left as y runs down (y).
class StrokeClipper::Frame {
  public:
    explicit Frame(const ClipPiece& piece) : origin_(piece.from), length(glm::distance(piece.from, piece.to)) {
        along_ = length > 0 ? (piece.to - piece.from) / length : glm::dvec2(1, 0);  // a dot has any direction
        across_ = {along_.y, -along_.x};
    }
    glm::dvec2 to_local(glm::dvec2 p) const { return {glm::dot(p - origin_, along_), glm::dot(p - origin_, across_)}; }
    /// Local points p with dot(normal, p) >= offset.
    HalfPlane to_screen(glm::dvec2 normal, double offset) const {
        const glm::dvec2 n = along_ * normal.x + across_ * normal.y;
        return {n, offset + glm::dot(n, origin_)};
    }

  private:
    glm::dvec2 origin_, along_, across_;

  public:
    double length;
};

void StrokeClipper::reset(int x0, int y0, int width, int height) {
    x0_ = x0;
    y0_ = y0;
    width_ = width;
    height_ = height;
    behind_.resize(static_cast<std::size_t>(width * height));
}

/// Calls visit(pixel, row, bits) for the samples within all sides.
template <typename Visit>
void StrokeClipper::for_spans(std::span<const HalfPlane> sides, const Visit& visit) const {
    if (!in_sets_) return for_spans_of(sides, 0, ~0u, visit);
    for (int set = 0; set < kStrokeColumnSets; ++set)
        for_spans_of(sides, kStrokeColumnShifts[static_cast<std::size_t>(set)], columns_of_set(set), visit);
}

/// Visits the spans of some columns whose samples lie `down` rows further down.
template <typename Visit>
void StrokeClipper::for_spans_of(std::span<const HalfPlane> sides, double down, std::uint32_t columns,
                                 const Visit& visit) const {
    const double middle = 0.5 + down;  // of a row
    // Each side bounds the columns of a row, linearly in the row, or the rows.
    struct Bound {
        double column, per_row;
        bool is_low;
    };
    std::array<Bound, 4> bounds{};
    std::size_t count = 0;
    double first = first_row_, last = end_row_;  // rows in [first, last)
    const double left = x0_ + (first_column_ - 1.0) / StrokeMask::kColumns,
                 right = x0_ + (end_column_ + 1.0) / StrokeMask::kColumns;
    for (const HalfPlane& side : sides) {
        if (side.normal.x == 0) {
            const double row = (side.offset / side.normal.y - y0_) * StrokeMask::kRows - middle;
            if (side.normal.y > 0) {
                first = std::max(first, std::ceil(row));
            } else {
                last = std::min(last, std::ceil(row));  // what lies on it belongs to the other side
            }
            continue;
        }
        // The rows in which it has any of the columns, one more to either side for the shift of rows; and one more row.
        const double most = std::max(side.normal.x * left, side.normal.x * right);
        if (side.normal.y != 0) {
            const double row = ((side.offset - most) / side.normal.y - y0_) * StrokeMask::kRows - middle;
            if (side.normal.y > 0) {
                first = std::max(first, std::floor(row) - 1);
            } else {
                last = std::min(last, std::ceil(row) + 2);
            }
        } else if (most < side.offset) {
            return;
        }
        const double per_row = -side.normal.y / side.normal.x / StrokeMask::kRows * StrokeMask::kColumns;
        const double y = y0_ + middle / StrokeMask::kRows;
        const double column = ((side.offset - side.normal.y * y) / side.normal.x - x0_) * StrokeMask::kColumns - 0.5;
        bounds[count++] = {column, per_row, side.normal.x > 0};
    }
    if (!(first < last)) return;
    for (int row = static_cast<int>(first); row < last; ++row) {
        double low = first_column_, high = end_column_ - 1;  // columns in [low, high]
        const double shift = stroke_row_shift(y0_ * StrokeMask::kRows + row);
        for (std::size_t i = 0; i < count; ++i) {
            const double column = bounds[i].column + bounds[i].per_row * row - shift;
            if (bounds[i].is_low) {
                low = std::max(low, column);
            } else {
                high = std::min(high, column);
            }
        }
        if (!(low <= high)) continue;
        // Both lie within the canvas's columns: no rounding by a call.
        const auto begin = static_cast<int>(low), end = static_cast<int>(high);
        for_pixels(begin < low ? begin + 1 : begin, end + 1, [&](int pixel, std::uint32_t bits) {
            if ((bits & columns) == 0) return;
            visit(row / StrokeMask::kRows * width_ + pixel, static_cast<std::size_t>(row % StrokeMask::kRows),
                  bits & columns);
        });
    }
}

/// The parts of a boundary beside a piece and beyond either of its ends: what lies behind each, seen at
/// right angles from the piece, or from its end.
void StrokeClipper::add_shadows(const ClipPiece& boundary, const ClipPiece& piece, const Frame& frame, double radius_px,
                                StrokeSide side) {
    const glm::dvec2 p = frame.to_local(boundary.from), q = frame.to_local(boundary.to), along = q - p;
    if (glm::dot(along, along) == 0) return;
    // The surface in front lies on this side of the boundary.
    glm::dvec2 front(-along.y, along.x);
    if (!boundary.front_on_left) front = -front;
    const double length = frame.length;
    // +1 and -1: the side of the piece that is drawn; 0: both.
    const double drawn = side == StrokeSide::both ? 0 : (piece.front_on_left == (side == StrokeSide::inside) ? 1 : -1);
    const auto add = [&](double begin, double end, double nearest, glm::dvec2 seen_from, HalfPlane low, HalfPlane high,
                         HalfPlane beside) {
        const glm::dvec2 middle = p + along * (0.5 * (begin + end));
        const double depth =
            boundary.depth_from_px + (boundary.depth_to_px - boundary.depth_from_px) * 0.5 * (begin + end);
        const double share = length > 0 ? std::clamp(middle.x / length, 0.0, 1.0) : 0;
        const double own = piece.depth_from_px + (piece.depth_to_px - piece.depth_from_px) * share;
        Shadow shadow;
        glm::dvec2 beyond(-along.y, along.x);
        if (glm::dot(beyond, p - seen_from) < 0) beyond = -beyond;
        shadow.enters = glm::dot(front, beyond) > 0;
        // Beside a surface, what bounds it hides as well as what is nearer.
        const double limit = side == StrokeSide::outside ? own + kFartherPx : own - kFartherPx;
        if (shadow.enters && !(depth < limit)) return;
        shadow.distance_px = nearest;
        shadow.sides = {low, high, beside, frame.to_screen(beyond, glm::dot(beyond, p))};
        shadows_.push_back(shadow);
    };

    double begin = 0, end = 1;
    if (clip(p.x, q.x, begin, end) && clip(length - p.x, length - q.x, begin, end)) {
        for (const double sign : {1.0, -1.0}) {
            if (sign == -drawn) continue;
            double from = begin, to = end;
            if (!clip(sign * p.y, sign * q.y, from, to)) continue;
            const glm::dvec2 a = p + along * from, b = p + along * to;
            if (std::min(std::abs(a.y), std::abs(b.y)) > radius_px || a.x == b.x) continue;
            const auto [low, high] = std::minmax(a.x, b.x);
            const glm::dvec2 middle = 0.5 * (a + b);
            add(from, to, std::abs(middle.y), {middle.x, 0}, frame.to_screen({1, 0}, low),
                frame.to_screen({-1, 0}, -high), frame.to_screen({0, sign}, 0));
        }
    }
    const double back = std::min(kOvershootPx, 0.5 * length);
    for (const double sign : {-1.0, 1.0}) {  // beyond the first end, and the last one
        const double last = sign > 0 ? length : 0;
        const glm::dvec2 eye(last - sign * back, 0);
        double from = 0, to = 1;
        if (!clip(sign * (p.x - eye.x), sign * (q.x - eye.x), from, to)) continue;
        const glm::dvec2 a = p + along * from - eye, b = p + along * to - eye;
        const double turn = cross(a, b);
        if ((drawn != 0 && a.y * drawn < 0 && b.y * drawn < 0) || std::abs(turn) < 1e-9 ||
            distance_to_piece({last, 0}, a + eye, b + eye) > radius_px)
            continue;
        const double way = turn > 0 ? 1 : -1;
        const glm::dvec2 low = glm::dvec2(-a.y, a.x) * way, high = glm::dvec2(b.y, -b.x) * way;
        add(from, to, glm::length(0.5 * (a + b)) - back, eye, frame.to_screen(low, glm::dot(low, eye)),
            frame.to_screen(high, glm::dot(high, eye)), frame.to_screen({sign, 0}, sign * last));
    }
}

void StrokeClipper::apply(const Shadow& shadow, bool blocks_outside) {
    for_spans(shadow.sides, [&](int pixel, std::size_t row, std::uint32_t bits) {
        Behind& b = behind_[static_cast<std::size_t>(pixel)][row];
        if (shadow.enters) {
            b.two |= b.one & bits;
            b.one |= bits;
            return;
        }
        if (blocks_outside) b.off |= bits & ~b.one;
        b.one = (b.one & ~bits) | (b.two & bits);
        b.two &= ~bits;
    });
}

StrokeCanvas::Box StrokeClipper::pixels() const {
    const auto up = [](int samples, int per_px) { return (samples + per_px - 1) / per_px; };
    return {first_column_ / StrokeMask::kColumns, first_row_ / StrokeMask::kRows, up(end_column_, StrokeMask::kColumns),
            up(end_row_, StrokeMask::kRows)};
}

bool StrokeClipper::cut_to(const StrokeCanvas::Box& box) {
    first_row_ = std::max(first_row_, box.y0 * StrokeMask::kRows);
    end_row_ = std::min(end_row_, box.y1 * StrokeMask::kRows);
    first_column_ = std::max(first_column_, box.x0 * StrokeMask::kColumns);
    end_column_ = std::min(end_column_, box.x1 * StrokeMask::kColumns);
    return first_row_ < end_row_ && first_column_ < end_column_;
}

StrokeCanvas::Box StrokeClipper::pixels_to_add(const StrokeCanvas* onto, bool knows_behind) const {
    static constexpr StrokeMask kNothing{};
    const StrokeCanvas::Box box = pixels();
    StrokeCanvas::Box found{box.x1, box.y1, box.x0, box.y0};
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            const bool is_known = y < found.y1 && x >= found.x0 && x < found.x1;  // to change nothing
            if (is_known || !canvas_.is_touched(x, y)) continue;
            const StrokeMask &own = canvas_.at(x, y), &other = onto == nullptr ? kNothing : onto->at(x, y);
            const auto& behind = behind_[static_cast<std::size_t>(y * width_ + x)];
            std::uint32_t any = 0;
            for (std::size_t r = 0; r < own.rows.size(); ++r)
                any |= own.rows[r] & ~other.rows[r] & ~(knows_behind ? behind[r].off : 0u);
            if (any != 0)
                found = {std::min(found.x0, x), std::min(found.y0, y), std::max(found.x1, x + 1),
                         std::max(found.y1, y + 1)};
        }
    }
    return found;
}

StrokeClipper::Extent StrokeClipper::extent_of(const ClipPiece& boundary) {
    if (!boundary.occludes) return {};
    return {glm::min(boundary.from, boundary.to), glm::max(boundary.from, boundary.to),
            std::min(boundary.depth_from_px, boundary.depth_to_px), boundary.cuts_below, boundary.drawn_width_px};
}

void StrokeClipper::set_boundaries(std::span<const ClipPiece* const> boundaries) {
    boundaries_ = boundaries;
    ends_.clear();
    extents_.clear();
    for (const ClipPiece* b : boundaries) {
        ends_.push_back({b->from, b->to});
        extents_.push_back(extent_of(*b));
    }
    cells_.set(ends_, glm::dvec2(x0_, y0_) + 0.5 * glm::dvec2(width_, height_));
    asked_.assign(boundaries.size(), 0);
    stroke_count_ = 0;
}

StrokeClipper::Reach::Reach(const ClipPiece& piece, double radius_px, StrokeSide side)
    : low(glm::min(piece.from, piece.to) - radius_px),
      high(glm::max(piece.from, piece.to) + radius_px),
      depth_px(std::max(piece.depth_from_px, piece.depth_to_px) - kFartherPx),
      rank(piece.rank),
      width_px(piece.width_px),
      has_side(side != StrokeSide::both),
      is_cut_by_all(piece.is_cut_by_all) {}

bool StrokeClipper::may_cut(const ClipPiece& piece, double radius_px, StrokeSide side) {
    if (side != StrokeSide::both) return true;
    const Reach reach(piece, radius_px, side);
    const Frame frame(piece);
    bool may = false;
    cells_.for_ring(cells_.cells_of({reach.low, reach.high}), 0, [&](std::uint32_t i) {
        if (may || !reach.has(extents_[i])) return;
        shadows_.clear();
        add_shadows(*boundaries_[i], piece, frame, radius_px, side);
        may = std::any_of(shadows_.begin(), shadows_.end(), [](const Shadow& s) { return s.enters; });
    });
    return may;
}

/// Whether a boundary may lie on a straight way from the nearest point of a piece to the stroke's rows and columns.
bool StrokeClipper::is_between(const ClipPiece& boundary, const Frame& frame) const {
    constexpr double kBesidePx = 1;  // samples are shifted, and ways begin a little before the end of a piece
    const StrokeCanvas::Box box = pixels();
    const glm::dvec2 low(x0_ + box.x0, y0_ + box.y0), high(x0_ + box.x1, y0_ + box.y1);
    glm::dvec2 first = frame.to_local(low), last = first;
    for (const glm::dvec2 corner : {glm::dvec2(high.x, low.y), glm::dvec2(low.x, high.y), high}) {
        first = glm::min(first, frame.to_local(corner));
        last = glm::max(last, frame.to_local(corner));
    }
    first = glm::min(first, glm::dvec2(std::clamp(first.x, 0.0, frame.length), 0.0)) - kBesidePx;
    last = glm::max(last, glm::dvec2(std::clamp(last.x, 0.0, frame.length), 0.0)) + kBesidePx;
    const glm::dvec2 p = frame.to_local(boundary.from), q = frame.to_local(boundary.to);
    const glm::dvec2 b_low = glm::min(p, q), b_high = glm::max(p, q);
    return b_low.x <= last.x && b_low.y <= last.y && b_high.x >= first.x && b_high.y >= first.y;
}

/// Adds the shadows of the boundaries that are `ring` cells away.
void StrokeClipper::find_shadows(int ring, const ClipPiece& piece, const Frame& frame, double radius_px,
                                 StrokeSide side) {
    const Reach reach(piece, radius_px, side);
    cells_.for_ring(cells_.cells_of({piece.from, piece.to}), ring, [&](std::uint32_t i) {
        if (asked_[i] == stroke_count_) return;
        asked_[i] = stroke_count_;
        ++comparison_count_;
        if (!reach.has(extents_[i])) return;
        const ClipPiece& boundary = *boundaries_[i];
        if (&boundary == &piece || (!cells_.is_one() && !is_between(boundary, frame))) return;
        add_shadows(boundary, piece, frame, radius_px, side);
    });
}

/// Passes the boundaries on the ways from a piece, the nearest ones first, until nothing of the stroke is left: then it
/// is false.
bool StrokeClipper::pass_boundaries(const ClipPiece& piece, const Frame& frame, double radius_px, StrokeSide side,
                                    const StrokeCanvas* onto) {
    // Beyond its own surface a stroke on the inside is cut off for good, mostly by the first boundaries.
    constexpr std::size_t kLookEvery = 6;
    const bool is_inside = side == StrokeSide::inside;
    const auto is_nearer = [](const Shadow& a, const Shadow& b) {
        return a.distance_px != b.distance_px ? a.distance_px < b.distance_px : a.enters > b.enters;
    };
    const BoundaryCells::Box middle = cells_.cells_of({piece.from, piece.to});
    bool is_behind = is_inside;  // before that, there is nothing to come out from
    std::size_t passed = 0;
    for (int ring = 0;; ++ring) {
        throw_if_interrupted();
        if (ring > 0 || !cells_.is_one()) find_shadows(ring, piece, frame, radius_px, side);
        // Shadows that are not found yet are not nearer than this. A way may begin a little before the end of the
        // piece.
        const double known_px = BoundaryCells::distance_px(ring) - 2 * kOvershootPx;
        const bool is_last = known_px > radius_px || cells_.is_beyond(middle, ring + 1);
        std::sort(shadows_.begin() + static_cast<std::ptrdiff_t>(passed), shadows_.end(), is_nearer);
        for (; passed < shadows_.size() && (is_last || shadows_[passed].distance_px < known_px); ++passed) {
            is_behind = is_behind || shadows_[passed].enters;
            if (is_behind) apply(shadows_[passed], is_inside);
            if (is_inside && passed % kLookEvery == kLookEvery - 1 && !cut_to(pixels_to_add(onto, true))) return false;
        }
        if (is_last) return true;
    }
}

void StrokeClipper::draw(const ClipPiece& piece, double radius_px, StrokeSide side, StrokeCanvas& onto) {
    draw_with(piece, radius_px, side, onto,
              [&](StrokeCanvas& canvas) { canvas.draw(piece.from, piece.to, radius_px); });
}

void StrokeClipper::draw(const ClipPiece& piece, const PenCone& cone, StrokeSide side, StrokeCanvas& onto) {
    draw_with(piece, std::max(cone.radius_from, cone.radius_to), side, onto,
              [&](StrokeCanvas& canvas) { canvas.draw(cone); });
}

void StrokeClipper::list(const ClipPiece& piece, const PenCone& cone, StrokeSide side, std::vector<CutPixel>& pixels) {
    const auto draw_pen = [&](StrokeCanvas& canvas) { canvas.draw(cone); };
    const auto add = [&](int column, int row, const StrokeMask& mask) { pixels.push_back({column, row, mask}); };
    switch (cut(piece, std::max(cone.radius_from, cone.radius_to), side, nullptr, draw_pen)) {
        case Cut::nothing_is_left:
            return;
        case Cut::is_whole:
            canvas_.reset(x0_, y0_, width_, height_);
            draw_pen(canvas_);
            canvas_.for_touched([&](int column, int row) { add(column, row, canvas_.at(column, row)); });
            return;
        case Cut::is_cut:
            for_left(add);
            return;
    }
}

template <typename DrawPen>
void StrokeClipper::draw_with(const ClipPiece& piece, double radius_px, StrokeSide side, StrokeCanvas& onto,
                              const DrawPen& draw_pen) {
    switch (cut(piece, radius_px, side, &onto, draw_pen)) {
        case Cut::nothing_is_left:
            return;
        case Cut::is_whole:
            draw_pen(onto);
            return;
        case Cut::is_cut:
            for_left([&](int column, int row, const StrokeMask& mask) { onto.add(column, row, mask); });
            return;
    }
}

/// Finds what is left of a stroke, where there is nothing yet of `onto`, if that is given: see for_left().
template <typename DrawPen>
StrokeClipper::Cut StrokeClipper::cut(const ClipPiece& piece, double radius_px, StrokeSide side, StrokeCanvas* onto,
                                      const DrawPen& draw_pen) {
    if (!piece.occludes) side = StrokeSide::both;  // it has no front
    const auto to_samples = [](double px, int per_px, int size_px) {
        return std::clamp(px * per_px, 0.0, static_cast<double>(size_px) * per_px);
    };
    const glm::dvec2 origin(x0_, y0_);
    const glm::dvec2 low = glm::min(piece.from, piece.to) - radius_px - origin;
    const glm::dvec2 high = glm::max(piece.from, piece.to) + radius_px - origin;
    first_row_ = static_cast<int>(std::floor(to_samples(low.y, StrokeMask::kRows, height_)));
    end_row_ = static_cast<int>(std::ceil(to_samples(high.y, StrokeMask::kRows, height_)));
    first_column_ = static_cast<int>(std::floor(to_samples(low.x, StrokeMask::kColumns, width_)));
    end_column_ = static_cast<int>(std::ceil(to_samples(high.x, StrokeMask::kColumns, width_)));
    if (first_row_ >= end_row_ || first_column_ >= end_column_) return Cut::nothing_is_left;
    if (onto != nullptr && !cut_to(onto->open_part(pixels()))) return Cut::nothing_is_left;
    if (side != StrokeSide::both && glm::distance(piece.from, piece.to) < kShortestPx) return Cut::nothing_is_left;
    const Frame frame(piece);
    shadows_.clear();
    ++stroke_count_;
    if (cells_.is_one()) {
        find_shadows(0, piece, frame, radius_px, side);
        // Before a surface is entered there is none to come out of.
        const bool enters = std::any_of(shadows_.begin(), shadows_.end(), [](const Shadow& s) { return s.enters; });
        if (!enters && side == StrokeSide::both) return Cut::is_whole;
    }
    canvas_.reset(x0_, y0_, width_, height_);
    draw_pen(canvas_);
    if (!cut_to(pixels_to_add(onto, false))) return Cut::nothing_is_left;
    // All that cuts a stroke is sampled as it is itself: what else lies around it depends on the crop.
    in_sets_ = is_level(piece.to.x - piece.from.x, piece.to.y - piece.from.y);
    const StrokeCanvas::Box box = pixels();
    for (int y = box.y0; y < box.y1; ++y) {
        std::fill_n(behind_.begin() + y * width_ + box.x0, box.x1 - box.x0, std::array<Behind, StrokeMask::kRows>{});
    }
    if (side != StrokeSide::both) {
        const double drawn = piece.front_on_left == (side == StrokeSide::inside) ? 1 : -1;
        const HalfPlane other = frame.to_screen({0, -drawn}, 0);
        for_spans(std::span(&other, 1), [&](int pixel, std::size_t row, std::uint32_t bits) {
            behind_[static_cast<std::size_t>(pixel)][row].off |= bits;
        });
        if (!cut_to(pixels_to_add(onto, true))) return Cut::nothing_is_left;
    }
    return pass_boundaries(piece, frame, radius_px, side, onto) ? Cut::is_cut : Cut::nothing_is_left;
}

/// Calls use(column, row, mask) for what cut() has left.
template <typename Use>
void StrokeClipper::for_left(const Use& use) const {
    const StrokeCanvas::Box left = pixels();
    for (int y = left.y0; y < left.y1; ++y) {
        for (int x = left.x0; x < left.x1; ++x) {
            if (!canvas_.is_touched(x, y)) continue;
            StrokeMask mask = canvas_.at(x, y);
            const auto& behind = behind_[static_cast<std::size_t>(y * width_ + x)];
            std::uint32_t any = 0;
            for (std::size_t r = 0; r < mask.rows.size(); ++r) any |= mask.rows[r] &= ~(behind[r].one | behind[r].off);
            if (any != 0) use(x, y, mask);
        }
    }
}

}  // namespace burin
