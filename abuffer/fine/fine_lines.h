#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "abuffer/edges/edge_lines.h"
#include "abuffer/fine/fine_blocks.h"
#include "abuffer/fine/known_borders.h"
#include "lines/line_piece.h"
#include "render/frame.h"

// Candidates of lines that samples miss become pieces, where nothing is in front of them.

namespace burin {

/// The lines that samples miss: features thinner than a sample, and meshes with several triangles to a
/// sample. Of parts of edges, those that are lines are clipped against all triangles in front of them. Tile by
/// tile; buffers are used again.
class FineLines {
  public:
    /// `region`: of `bins`, which must have kept thin triangles. `draws_each`: also edges behind others on the same
    /// line of the picture, which dashes and smooth contours need. `known_borders`: shared by the threads of a pass.
    FineLines(const Frame& frame, const ScreenSurfaces& screen, const TriangleBins& bins, const TileKernels& kernels,
              PixelRect region, bool draws_each, KnownBorders& known_borders);
    ~FineLines();

    /// Adds what is visible of the parts that are lines, all of one tile.
    void find(std::size_t tile, std::span<const FinePart> parts, std::vector<LinePiece>& pieces);

  private:
    class BlockClipper;
    void find_candidates(std::span<const FinePart> parts, bool walls);
    std::span<const WholeLine> lines_of(std::uint32_t instance, HalfEdge h, bool walls);
    void note_heaps(std::size_t tile, std::span<const FinePart> parts);
    bool is_in_heap(const FinePart& part) const;
    bool is_heap(std::size_t block) const;
    bool has_loose(std::size_t block) const;
    bool is_loose(const FineEdge& edge) const {
        return edge.half_edge >= 3 * screen_.mesh(edge.instance).triangle_count;
    }
    bool is_left_to_samples(std::size_t block, glm::ivec2 corner) const;
    void find_in_block(std::size_t block, std::vector<LinePiece>& pieces);

    const ScreenSurfaces& screen_;
    const TriangleBins& bins_;
    bool draws_each_;
    SampleBlocks grid_;
    EdgeLineFinder finder_;
    FineBlocks blocks_;
    std::unique_ptr<BlockClipper> clipper_;
    std::vector<FineCandidate> candidates_;
    std::vector<WholeLine> lines_;
    std::vector<glm::ivec2> heaps_;  // blocks of a tile
    KnownBorders& known_borders_;
};

}  // namespace burin
