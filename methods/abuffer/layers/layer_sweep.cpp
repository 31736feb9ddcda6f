#include "methods/abuffer/layers/layer_sweep.h"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

/// Shorter parts of lines belong to the part before. Pixels.
constexpr double kShortestPiecePx = 1.0 / 32;

}  // namespace

/// Joins what the parts of a clipped triangle hide, which is one layer. In order, for shares of light are multiplied.
void LayerSweep::merge_intervals() {
    std::sort(intervals_.begin(), intervals_.end(), [](const Interval& a, const Interval& b) {
        return a.triangle != b.triangle ? a.triangle < b.triangle : a.begin < b.begin;
    });
    std::size_t count = 1;
    for (const Interval& i : intervals_) {
        Interval& last = intervals_[count - 1];
        if (i.triangle != last.triangle || i.begin > last.end) {
            intervals_[count++] = i;
        } else {
            last.end = std::max(last.end, i.end);
        }
    }
    intervals_.resize(count);
}

/// Puts numbers in order.
void LayerSweep::sort(std::vector<double>& values) {
    constexpr std::size_t kFew = 64, kReadMore = 3;
    const std::size_t count = values.size();
    if (count < 2) return;
    if (count > kFew) return std::sort(values.begin(), values.end());
    values.resize(count + kReadMore);
    sorted_.resize(count);
    kernels_.sort_few(values.data(), count, sorted_.data());
    values.swap(sorted_);
}

/// Where layers begin and end between the ends of a line, in order. Returns how many opaque ones are in front where it begins.
int LayerSweep::find_events(double begin, double end) {
    events_.clear();
    begins_.clear();
    ends_.clear();
    int opaque = 0;
    for (const Interval& i : intervals_) {
        const bool is_opaque = i.transmission == 0;
        if (!is_opaque) {
            if (i.begin > begin) events_.push_back({i.begin, 0});
            if (i.end < end) events_.push_back({i.end, 0});
            continue;
        }
        if (i.begin <= begin) {
            ++opaque;
        } else {
            begins_.push_back(i.begin);
        }
        if (i.end < end) ends_.push_back(i.end);
    }
    const bool has_transparent = !events_.empty();
    sort(begins_);
    sort(ends_);
    auto next_end = ends_.begin();
    for (const double at : begins_) {
        for (; next_end != ends_.end() && *next_end < at; ++next_end) events_.push_back({*next_end, -1});
        events_.push_back({at, 1});
    }
    for (; next_end != ends_.end(); ++next_end) events_.push_back({*next_end, -1});
    if (has_transparent) std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
    return opaque;
}

void LayerSweep::find_pieces(const LayerLine& line, std::uint32_t line_number, double begin, double end, bool has_parts,
                             std::vector<LayerPiece>& pieces) {
    if (has_parts || has_transparent_) merge_intervals();
    int opaque = find_events(begin, end);
    const double shortest = std::min(kShortestPiecePx / line.length_px(), 0.5 * (end - begin));
    double start = begin;
    const std::size_t first_piece = pieces.size();
    const auto emit = [&](double to) {
        double transmission = 1;
        bool is_behind_glass = false;  // visible lines end there, however clear it is
        if (has_transparent_) {
            const double middle = 0.5 * (start + to);
            for (const Interval& i : intervals_) {
                if (!(i.transmission > 0 && i.begin < middle && middle < i.end)) continue;
                transmission *= i.transmission;
                is_behind_glass = true;
            }
        }
        LayerPiece piece;
        piece.line = line_number;
        piece.begin = start;
        piece.end = to;
        piece.invisibility = static_cast<std::uint8_t>(std::min(opaque, 255));
        if (is_behind_glass) piece.transmission = static_cast<std::uint8_t>(std::lround(255 * transmission));
        const double from = start;
        start = to;
        if (piece.invisibility == 0 && !is_behind_glass) return;
        LayerPiece* const last = pieces.size() > first_piece ? &pieces.back() : nullptr;
        if (last != nullptr && last->end == from && last->invisibility == piece.invisibility &&
            last->transmission == piece.transmission) {
            last->end = to;
        } else {
            pieces.push_back(piece);
        }
    };
    for (const Event& e : events_) {
        if (end - e.at < shortest) break;  // what is left is too short to differ
        if (e.at - start >= shortest) emit(e.at);
        opaque += e.opaque;
    }
    emit(end);
}

}  // namespace burin
