#pragma once

#include <span>
#include <vector>

#include "abuffer/edges/intersecting_pairs.h"
#include "abuffer/edges/intersection_lines.h"
#include "abuffer/edges/occluder.h"
#include "abuffer/hiding/contacts.h"
#include "abuffer/hiding/occluder_bins.h"
#include "abuffer/hiding/occluder_cells.h"
#include "abuffer/hiding/occluder_pairs.h"
#include "abuffer/hiding/sweep.h"
#include "lines/whole_line.h"
#include "render/frame.h"

namespace burin {

/// Has all triangles of one tile by place, seen or not, and finds what is in front of lines: the tile is cut into
/// square cells, and each has a list of the triangles that touch it. Buffers are used again from tile to tile.
class HidingTile {
  public:
    /// `finds_pairs`: find_intersections() is wanted, too.
    HidingTile(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels, const OccluderBins& bins,
               const PixelTiles& grid, bool finds_pairs);

    void fill(std::size_t tile);

    /// Adds the lines in which triangles of this tile pass through each other.
    void find_intersections(const IntersectionTest& may_intersect, const IntersectionLines& intersections,
                            std::vector<WholeLine>& lines);

    /// Adds the parts of a line within the tile that something is in front of.
    void find_parts(const WholeLine& line, std::uint32_t line_number, std::vector<LinePart>& pieces);

    /// How many pairs of cell and triangle were kept so far.
    std::uint64_t fragment_count() const { return fragment_count_; }

  private:
    /// A part of a line, with its ends as WholeLine has them.
    struct PartInTile {
        double begin, end;
        glm::dvec2 from, to;
        double nearness_from, nearness_to;
    };
    struct Contact {  // of a part of a line with an entry's triangle
        double begin, end;
        std::uint32_t entry;
        bool makes_line;
    };
    static constexpr std::uint32_t kNotSetUp = 0xFFFFFFFFu;

    void add_clipped(SurfaceId s, std::uint32_t number);
    /// Triangles of one instance by their numbers, all on the screen.
    void add(std::uint32_t instance, std::span<const std::uint32_t> numbers);
    const Occluder& triangle(std::uint32_t i) {
        if (set_up_[i] == kNotSetUp) set_up(i);
        return triangles_[set_up_[i]];
    }
    void set_up(std::uint32_t i);
    double transmission_of(SurfaceId s) const;
    void hide(const WholeLine& line, std::span<const std::uint32_t> near, const PartInTile& part);
    void hide(const WholeLine& line, std::uint32_t i, const Occluder& t, const HiddenPart& hidden);
    void find_contacts(const WholeLine& line, const PartInTile& part);
    void drop_contacts(const WholeLine& line, std::size_t first, std::vector<LinePart>& pieces);

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    Contacts contacts_;
    const TileKernels& kernels_;
    const OccluderBins& bins_;
    const PixelTiles& grid_;
    bool has_transparent_, finds_pairs_;
    PixelRect rect_;
    OccluderCells cells_;  // its entries are the triangles of the tile
    OccluderPairs pairs_;  // of the same entries, where pairs are wanted
    HidingSweep sweep_;
    // What it takes to clip with an entry is set up when first needed.
    std::vector<std::uint32_t> set_up_;  // per entry: which of triangles_, or kNotSetUp
    bool has_clipped_ = false;           // triangles in several parts
    std::vector<Occluder> triangles_;
    std::vector<std::uint32_t> near_;           // entries that a line may cross
    std::vector<const TrianglePlane*> planes_;  // theirs
    std::vector<HiddenPart> parts_;
    std::vector<Contact> contacts_of_line_;
    double line_slack_ = 0, certain_slack_ = 0;  // of the line that is looked at
    std::uint64_t fragment_count_ = 0;
};

}  // namespace burin
