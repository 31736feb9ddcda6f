#pragma once

#include <cstdint>
#include <vector>

#include "abuffer/tile_kernels.h"
#include "methods/abuffer/layers/layer_line.h"

namespace burin {

/// The layers in front of a line, counted from one end to the other. Buffers are used again.
class LayerSweep {
  public:
    explicit LayerSweep(const TileKernels& kernels) : kernels_(kernels) {}

    void clear() {
        intervals_.clear();
        has_transparent_ = false;
    }
    bool is_empty() const { return intervals_.empty(); }
    /// A triangle, by its number, is in front of the line between two shares of it. `transmission`: 0 = opaque.
    void add(std::uint32_t triangle, double begin, double end, double transmission) {
        intervals_.emplace_back(triangle, begin, end, transmission);
        has_transparent_ = has_transparent_ || transmission > 0;
    }
    /// Adds the pieces of the part [begin, end] of a line that something is in front of. `has_parts`: triangles may have been
    /// added in several parts, which are one layer.
    void find_pieces(const LayerLine& line, std::uint32_t line_number, double begin, double end, bool has_parts,
                     std::vector<LayerPiece>& pieces);

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
    void merge_intervals();
    void sort(std::vector<double>& values);
    int find_events(double begin, double end);

    const TileKernels& kernels_;
    bool has_transparent_ = false;
    std::vector<Interval> intervals_;
    std::vector<double> begins_, ends_, sorted_;  // of opaque intervals
    std::vector<Event> events_;
};

}  // namespace burin
