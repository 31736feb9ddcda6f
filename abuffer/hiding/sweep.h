#pragma once

#include <cstdint>
#include <vector>

#include "kernels/tile_kernels.h"
#include "lines/whole_line.h"

namespace burin {

/// Counts the surfaces in front of a line, from one end to the other, and makes parts of it. Buffers are used again.
class HidingSweep {
  public:
    explicit HidingSweep(const TileKernels& kernels) : kernels_(kernels) {}

    /// Begins with the part [begin, end] of a line, with up to `most` triangles in front. `joins_parts`: triangles may
    /// be added in several parts, which count once, or be transparent.
    void clear(double begin, double end, std::size_t most, bool joins_parts);
    bool is_empty() const { return count_ == 0; }
    /// A triangle, by its number, is in front of the line between two shares of it. `transmission`: 0 = opaque.
    void add(std::uint32_t triangle, double begin, double end, double transmission) {
        ++count_;
        if (!joins_parts_) return add_opaque(begin, end);
        intervals_.push_back({triangle, begin, end, transmission});
        has_transparent_ = has_transparent_ || transmission > 0;
    }
    /// Adds the parts of it that something is in front of.
    void find_parts(const WholeLine& line, std::uint32_t line_number, std::vector<LinePart>& pieces);

  private:
    struct Interval {
        std::uint32_t triangle;
        double begin, end;
        double transmission;
    };
    struct Event {
        double at;
        int opaque;
    };
    void add_opaque(double begin, double end) {
        // Whether surfaces begin and end within the part would be an unpredictable branch, so there is none.
        opaque_ += begin <= begin_ ? 1 : 0;
        begins_[begin_count_] = begin;
        begin_count_ += begin <= begin_ ? 0 : 1;
        ends_[end_count_] = end;
        end_count_ += end < end_ ? 1 : 0;
    }
    void merge_intervals();
    void sort(std::vector<double>& values, std::size_t count);
    void find_events();

    const TileKernels& kernels_;
    double begin_ = 0, end_ = 1;
    std::size_t count_ = 0;
    bool joins_parts_ = false, has_transparent_ = false;
    std::vector<Interval> intervals_;  // if `joins_parts`
    int opaque_ = 0;                   // in front where the part begins
    std::size_t begin_count_ = 0, end_count_ = 0;
    std::vector<double> begins_, ends_, sorted_;  // of opaque surfaces, within the part, and room for more
    std::vector<Event> events_;
};

}  // namespace burin
