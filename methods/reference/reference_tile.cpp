#include "methods/reference/reference_tile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/vectors.h"
#include "shading/surface_shader.h"

namespace burin {
namespace {

constexpr double kHalfDiagonal = 0.70710678118654752;
constexpr int kLeastCells = 16;
/// Curves are simplified by less than their own exactness.
constexpr double kStraightPx = 1.0 / 2048;

StrokeBand band_of(const LineStyle& style, bool has_front) {
    const double half = 0.5 * style.width_px;
    if (!has_front || style.side == StrokeSide::both) return {-half, half};
    return style.side == StrokeSide::inside ? StrokeBand{0, half} : StrokeBand{-half, 0};
}

}  // namespace

ReferenceTile::ReferenceTile(const Frame& frame, const RayGeometry& geometry, const EmbreeScene& rays,
                             const ReferenceLines& lines, const ReferenceLooseEdges& loose,
                             const ShadedSurfaces* shaded)
    : frame_(frame),
      geometry_(geometry),
      rays_(rays),
      lines_(lines),
      loose_(loose),
      per_pixel_(frame.scene->reference.samples),
      cells_per_pixel_(std::max(per_pixel_, kLeastCells)),
      width_px_(frame.scene->lines.style.width_px),
      margin_(margin_px(frame)) {
    if (shaded != nullptr) shader_.emplace(*shaded);
}

int ReferenceTile::margin_px(const Frame& frame) {
    return static_cast<int>(std::ceil(0.5 * frame.scene->lines.style.width_px)) + 1;
}

glm::dvec2 ReferenceTile::sample_position(int row, int column) const {
    return {rect_.x0 - margin_ + (column + 0.5) / per_pixel_, rect_.y0 - margin_ + (row + 0.5) / per_pixel_};
}

void ReferenceTile::cast(PixelRect rect) {
    rect_ = rect;
    rows_ = (rect.height() + 2 * margin_) * per_pixel_;
    columns_ = (rect.width() + 2 * margin_) * per_pixel_;
    samples_.resize(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_));
    for (int row = 0; row < rows_; ++row) {
        const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_);
        rays_.cast_row(sample_position(row, 0), 1.0 / per_pixel_,
                       std::span(samples_).subspan(first, static_cast<std::size_t>(columns_)));
    }
}

BoundaryCurves::Node ReferenceTile::crossing(BoundaryCurves& curves, int row_a, int column_a, int row_b,
                                             int column_b) const {
    const Facet a = sample(row_a, column_a), b = sample(row_b, column_b);
    if (a == b) return BoundaryCurves::kNone;
    const SeenPoint seen_a{sample_position(row_a, column_a), a}, seen_b{sample_position(row_b, column_b), b};
    const auto line = lines_.between(seen_a, seen_b);
    if (!line) return BoundaryCurves::kNone;
    SideCrossing crossing;
    crossing.at = glm::mix(seen_a.pixel, seen_b.pixel, line->fraction);
    crossing.front = line->front == 0 ? seen_a.pixel : seen_b.pixel;
    crossing.depth_px = line->depth_px;
    crossing.occludes = line->occludes;
    const auto first = (line->classes & frame_.criteria.classes).first();
    crossing.line_class = first ? static_cast<std::uint8_t>(*first) : kUndrawn;
    return curves.add_crossing(crossing);
}

void ReferenceTile::find_curves() {
    using Node = BoundaryCurves::Node;
    BoundaryCurves curves;
    const auto n = static_cast<std::size_t>(columns_);
    // Crossings to the right of the samples of a row and of the one above, and between the two rows.
    std::vector<Node> across_above(n, BoundaryCurves::kNone), across(n, BoundaryCurves::kNone),
        down(n, BoundaryCurves::kNone);
    for (int row = 0; row < rows_; ++row) {
        std::swap(across_above, across);
        for (int column = 0; column < columns_; ++column) {
            const auto c = static_cast<std::size_t>(column);
            across[c] = column + 1 < columns_ ? crossing(curves, row, column, row, column + 1) : BoundaryCurves::kNone;
            if (row > 0) down[c] = crossing(curves, row - 1, column, row, column);
        }
        if (row == 0) continue;
        for (int column = 0; column + 1 < columns_; ++column) {
            const auto c = static_cast<std::size_t>(column);
            const std::array<Node, 4> sides{across_above[c], down[c + 1], across[c], down[c]};
            if (sides == std::array<Node, 4>{BoundaryCurves::kNone, BoundaryCurves::kNone, BoundaryCurves::kNone,
                                             BoundaryCurves::kNone})
                continue;
            const glm::dvec2 middle = 0.5 * (sample_position(row - 1, column) + sample_position(row, column + 1));
            curves.add_cell(sides, middle, sample(row - 1, column) == sample(row, column + 1),
                            sample(row - 1, column + 1) == sample(row, column));
        }
    }
    segments_ = curves.segments(kStraightPx, 1.0 / per_pixel_);
    loose_.add_visible({rect_.x0 - margin_, rect_.y0 - margin_}, {rect_.x1 + margin_, rect_.y1 + margin_},
                       1.0 / per_pixel_, segments_);
}

void ReferenceTile::shade(Film& film) {
    const SegmentGrid grid({rect_.x0 - margin_, rect_.y0 - margin_}, {rect_.x1 + margin_, rect_.y1 + margin_},
                           segments_);
    const PixelRect& crop = frame_.crop;
    for (int y = std::max(rect_.y0, crop.y0); y < std::min(rect_.y1, crop.y1); ++y) {
        for (int x = std::max(rect_.x0, crop.x0); x < std::min(rect_.x1, crop.x1); ++x) {
            film.put(x, y, shade_pixel(grid, x, y));
        }
    }
}

PixelResult ReferenceTile::shade_pixel(const SegmentGrid& grid, int x, int y) {
    draw_strokes(grid, {x, y});
    PixelResult result;
    const double per_cell = 1.0 / (cells_per_pixel_ * cells_per_pixel_);
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        const double coverage = std::min(class_sum_[c] * per_cell, 1.0);
        result.coverage[c] = static_cast<float>(coverage);
        result.lines += glm::vec4(frame_.scene->lines.style.color_of(static_cast<LineClass>(c)), 1.0f) *
                        static_cast<float>(coverage);
    }

    // Each sample's share that is not drawn over keeps the colour of its surface.
    const glm::dvec2 center(x + 0.5, y + 0.5);
    const double per_sample = 1.0 / (per_pixel_ * per_pixel_);
    const int row0 = (y - rect_.y0 + margin_) * per_pixel_, column0 = (x - rect_.x0 + margin_) * per_pixel_;
    glm::dvec4 surface(0.0), seen(0.0);
    Facet last;
    glm::dvec4 color(0.0);
    if (shader_) shade_samples(row0, column0);
    std::size_t next_color = 0;
    for (int row = 0; row < per_pixel_; ++row) {
        for (int column = 0; column < per_pixel_; ++column) {
            const Facet facet = sample(row0 + row, column0 + column);
            if (facet.is_background()) continue;
            if (shader_) {
                color = glm::dvec4(colors_[next_color++], 1.0);
            } else if (facet != last) {
                color = glm::dvec4(color_of(facet, center));
            }
            last = facet;
            const int cell_row = row * cells_per_pixel_ / per_pixel_,
                      cell_column = column * cells_per_pixel_ / per_pixel_;
            surface += color;
            seen += color * (1 - cell_total_[static_cast<std::size_t>(cell_row * cells_per_pixel_ + cell_column)]);
        }
    }
    result.surface = glm::vec4(surface * per_sample);
    result.beauty = result.lines + glm::vec4(seen * per_sample);
    fill_center(result, center);
    return result;
}

/// Fills cell_total_ and class_sum_ with the shares that lines cover.
void ReferenceTile::draw_strokes(const SegmentGrid& grid, glm::ivec2 pixel) {
    const auto cells = static_cast<std::size_t>(cells_per_pixel_ * cells_per_pixel_);
    cell_total_.assign(cells, 0.0);
    class_sum_.fill(0);
    strokes_.clear();
    const glm::dvec2 center = glm::dvec2(pixel) + 0.5;
    const double reach = 0.5 * width_px_ + kHalfDiagonal * (1 + 1.0 / cells_per_pixel_);
    std::array<double, kLineClassCount> nearest{};
    nearest.fill(reach + 1);
    std::uint8_t lowest_occluder = 0;
    grid.near(center, reach, [&](std::uint32_t number) {
        const BoundarySegment& s = segments_[number];
        const double distance = nearest_point(s, center).distance;
        if (distance > reach) return;
        strokes_.push_back({number, distance});
        if (s.line_class != kUndrawn) nearest[s.line_class] = std::min(nearest[s.line_class], distance);
        if (s.front_side != 0) lowest_occluder = std::max(lowest_occluder, s.line_class);
    });
    const auto first = std::find_if(nearest.begin(), nearest.end(), [&](double d) { return d <= reach; });
    if (first == nearest.end()) return;
    // Deep inside of a stroke all is clear.
    const auto first_class = static_cast<std::uint8_t>(first - nearest.begin());
    const bool whole = frame_.scene->lines.style.side == StrokeSide::both &&
                       *first + kHalfDiagonal * (1 + 1.0 / cells_per_pixel_) <= 0.5 * width_px_;
    if (whole && lowest_occluder <= first_class) {
        cell_total_.assign(cells, 1.0);
        class_sum_[first_class] = static_cast<double>(cells);
        return;
    }
    std::sort(strokes_.begin(), strokes_.end(), [](const Stroke& a, const Stroke& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.segment < b.segment;
    });
    strokes_.erase(std::unique(strokes_.begin(), strokes_.end(),
                               [](const Stroke& a, const Stroke& b) { return a.segment == b.segment; }),
                   strokes_.end());
    // Where a surface hides a part of a stroke, its boundary is nearer than the stroke's line. If that
    // boundary is drawn on both sides and its class comes first, it covers the place by itself.
    const bool covers_itself = frame_.scene->lines.style.side == StrokeSide::both;
    for (std::uint8_t c = 0; c < kLineClassCount; ++c) {
        if (nearest[c] <= reach) draw_class(strokes_, c, nearest[c], lowest_occluder > c || !covers_itself, pixel);
    }
}

void ReferenceTile::draw_class(std::span<const Stroke> strokes, std::uint8_t line_class, double nearest_to_center,
                               bool may_be_hidden, glm::ivec2 pixel) {
    const LineStyle& style = frame_.scene->lines.style;
    const double size = 1.0 / cells_per_pixel_;
    const double half = 0.5 * width_px_;
    // No cell's nearest segment is farther from the centre than this.
    const double farthest =
        may_be_hidden ? std::numeric_limits<double>::infinity() : nearest_to_center + 2 * kHalfDiagonal;
    for (int row = 0; row < cells_per_pixel_; ++row) {
        for (int column = 0; column < cells_per_pixel_; ++column) {
            double& total = cell_total_[static_cast<std::size_t>(row * cells_per_pixel_ + column)];
            if (total >= 1) continue;
            const glm::dvec2 p = glm::dvec2(pixel) + (glm::dvec2(column, row) + 0.5) * size;
            double nearest = half + size;
            double share = 0;
            for (const Stroke& stroke : strokes) {
                if (stroke.distance > farthest || stroke.distance - kHalfDiagonal > nearest) break;
                const BoundarySegment& s = segments_[stroke.segment];
                if (s.line_class != line_class) continue;
                const NearestPoint n = nearest_point(s, p);
                if (n.distance >= nearest) continue;
                if (may_be_hidden && is_hidden(s, n, p, strokes)) continue;
                nearest = n.distance;
                // Signed distance, positive in front.
                const glm::dvec2 along = glm::normalize(s.b - s.a);
                const double side = s.front_side >= 0 ? 1 : -1;
                const double off = cross(along, p - s.a) * side;
                const bool beside = n.along > 0 && n.along < 1;
                glm::dvec2 normal = glm::dvec2(-along.y, along.x) * side;
                if (!beside && n.distance > 1e-9) normal = (p - n.at) / (off < 0 ? -n.distance : n.distance);
                const double signed_distance = off < 0 ? -n.distance : n.distance;
                share = stroke_share(band_of(style, s.front_side != 0), signed_distance, normal, size);
            }
            if (share <= total) continue;
            class_sum_[line_class] += share - total;
            total = share;
        }
    }
}

/// Whether what is visible at `from` lies in front of the line, so that its stroke must not cover it:
/// on the way to the line, the surface at `from` ends, nearer to the eye than the line is. Surfaces in
/// front of that one, on the way, are passed (as in Appel's quantitative invisibility, 1967).
bool ReferenceTile::is_hidden(const BoundarySegment& line, const NearestPoint& on_line, glm::dvec2 from,
                              std::span<const Stroke> strokes) const {
    const glm::dvec2 way = on_line.at - from;
    const double length = glm::length(way);
    if (length == 0) return false;
    // A little beyond the line's end, which lies on the boundary that hides the rest of it.
    const double close = 1.0 / (per_pixel_ * length);
    const double beyond = 1 + close;
    struct Step {
        double t;
        bool down;  // from a surface to what is behind it
        double depth_px;
    };
    constexpr std::size_t kMaxSteps = 64;
    std::array<Step, kMaxSteps> steps{};
    std::size_t count = 0;
    for (const Stroke& stroke : strokes) {
        const BoundarySegment& s = segments_[stroke.segment];
        if (s.front_side == 0) continue;
        const glm::dvec2 d = s.b - s.a;
        const double from_side = cross(d, from - s.a), to_side = cross(d, from + way * beyond - s.a);
        if ((from_side >= 0) == (to_side >= 0)) continue;
        const double side_a = cross(way, s.a - from), side_b = cross(way, s.b - from);
        if ((side_a >= 0) == (side_b >= 0)) continue;
        const double t = from_side / (from_side - to_side), u = side_a / (side_a - side_b);
        const bool down = (from_side >= 0) == (s.front_side > 0);
        if (!down && t > 1 - close) continue;  // on to the surface that the line belongs to
        if (count == kMaxSteps) return false;
        steps[count++] = {t, down, s.depth_a + (s.depth_b - s.depth_a) * u};
    }
    std::sort(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Step& a, const Step& b) { return a.t < b.t; });
    const double line_depth = line.depth_a + (line.depth_b - line.depth_a) * on_line.along;
    int level = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (!steps[i].down) {
            ++level;
        } else if (level > 0) {
            --level;
        } else if (steps[i].depth_px < line_depth - 2) {  // conventions: a farther surface
            return true;
        }
    }
    return false;
}

void ReferenceTile::shade_samples(int row0, int column0) {
    fragments_.clear();
    for (int row = row0; row < row0 + per_pixel_; ++row) {
        for (int column = column0; column < column0 + per_pixel_; ++column) {
            const Facet facet = sample(row, column);
            if (facet.is_background()) continue;
            fragments_.push_back(
                {{facet.object, facet.triangle}, sample_position(row, column), 1, PixelSamples::place_alone()});
        }
    }
    shader_->shade(fragments_, colors_);
}

glm::vec4 ReferenceTile::color_of(Facet facet, glm::dvec2 at) const {
    glm::dvec3 origin, ray;
    geometry_.projection().view_ray(at, origin, ray);
    return surface_color(frame_.scene->surfaces, frame_.scene->materials[geometry_.material(facet)],
                         geometry_.polygon_normal(facet), -glm::normalize(ray));
}

void ReferenceTile::fill_center(PixelResult& result, glm::dvec2 center) const {
    result.distance = std::numeric_limits<float>::infinity();
    const Facet facet = rays_.cast(center);
    if (facet.is_background()) return;
    const glm::dmat3 view_to_world(frame_.camera.to_world);
    result.distance = static_cast<float>(geometry_.distance(facet, center));
    result.normal = glm::vec3(view_to_world * geometry_.normal_towards_eye(facet, center));
    result.object_id = geometry_.object_id(facet);
    result.material_id = geometry_.material(facet) + 1;
    result.polygon_id = geometry_.polygon_id(facet);
}

}  // namespace burin
