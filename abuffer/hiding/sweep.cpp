#include "abuffer/hiding/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burin {
namespace {

/// Shorter parts of lines belong to the part before. Pixels.
constexpr double kShortestSweptPx = 1.0 / 32;
/// Kernels read this many values behind the last one.
constexpr std::size_t kReadMore = 3;

}  // namespace

void HidingSweep::clear(double begin, double end, std::size_t most, bool joins_parts) {
    begin_ = begin;
    end_ = end;
    count_ = begin_count_ = end_count_ = 0;
    opaque_ = 0;
    joins_parts_ = joins_parts;
    has_transparent_ = false;
    intervals_.clear();
    for (auto* list : {&begins_, &ends_, &sorted_}) {
        if (list->size() < most + 1 + kReadMore) list->resize(2 * most + 1 + kReadMore);
    }
}

/// Joins what the parts of a clipped triangle hide: they count once. They are taken in order, for shares of light are
/// multiplied.
void HidingSweep::merge_intervals() {
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
void HidingSweep::sort(std::vector<double>& values, std::size_t count) {
    constexpr std::size_t kFew = 64;
    if (count < 2) return;
    if (count > kFew) return std::sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
    kernels_.sort.few(values.data(), count, sorted_.data());
    values.swap(sorted_);
}

/// Lists in order where surfaces begin and end within the part.
void HidingSweep::find_events() {
    events_.clear();
    for (const Interval& i : intervals_) {
        if (i.transmission == 0) {
            add_opaque(i.begin, i.end);
            continue;
        }
        if (i.begin > begin_) events_.push_back({i.begin, 0});
        if (i.end < end_) events_.push_back({i.end, 0});
    }
    const bool has_others = !events_.empty();
    sort(begins_, begin_count_);
    sort(ends_, end_count_);
    begins_[begin_count_] = ends_[end_count_] = std::numeric_limits<double>::infinity();
    const double *next_begin = begins_.data(), *next_end = ends_.data(), *const last_end = next_end + end_count_;
    for (std::size_t left = begin_count_ + end_count_; left > 0; --left) {
        const bool is_begin = next_end == last_end || *next_begin <= *next_end;
        events_.push_back(is_begin ? Event{*next_begin++, 1} : Event{*next_end++, -1});
    }
    if (has_others)
        std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
}

void HidingSweep::find_parts(const WholeLine& line, std::uint32_t line_number, std::vector<LinePart>& pieces) {
    if (joins_parts_) merge_intervals();
    find_events();
    int opaque = opaque_;
    const double begin = begin_, end = end_;
    const double shortest = std::min(kShortestSweptPx / line.length_px(), 0.5 * (end - begin));
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
        LinePart piece;
        piece.line = line_number;
        piece.begin = start;
        piece.end = to;
        piece.invisibility = static_cast<std::uint8_t>(std::min(opaque, 255));
        if (is_behind_glass) piece.transmission = static_cast<std::uint8_t>(std::lround(255 * transmission));
        const double from = start;
        start = to;
        if (piece.invisibility == 0 && !is_behind_glass) return;
        LinePart* const last = pieces.size() > first_piece ? &pieces.back() : nullptr;
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
