#pragma once

#include <span>
#include <vector>

#include "abuffer/screen_boxes.h"
#include "methods/abuffer/contacts.h"
#include "methods/abuffer/intersecting_pairs.h"
#include "methods/abuffer/intersection_lines.h"
#include "methods/abuffer/layer_bins.h"
#include "methods/abuffer/layer_cells.h"
#include "methods/abuffer/layer_line.h"
#include "methods/abuffer/layer_triangle.h"
#include "render/frame.h"

namespace burin {

/// All layers of surfaces in one tile, found by place: the tile is cut into square cells, and each has
/// a list of the triangles that touch it. Buffers are used again from tile to tile.
class LayerTile {
  public:
    /// `finds_pairs`: find_intersections() is wanted, too.
    LayerTile(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels, const LayerBins& bins,
              const PixelTiles& grid, bool finds_pairs);

    void fill(std::size_t tile);

    /// Adds the lines in which triangles of this tile pass through each other.
    void find_intersections(const IntersectionTest& may_intersect, const IntersectionLines& intersections,
                            std::vector<LayerLine>& lines);

    /// Adds the parts of a line within the tile that something is in front of.
    void find_pieces(const LayerLine& line, std::uint32_t line_number, std::vector<LayerPiece>& pieces);

    /// How many pairs of cell and triangle were kept so far.
    std::uint64_t fragment_count() const { return fragment_count_; }

  private:
    /// Where a triangle is in front of a line.
    struct Interval {
        std::uint32_t triangle;  // its number
        double begin, end;
        double transmission;
    };
    /// Of a line, with its ends as LayerLine has them.
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
    struct Event {
        double at;
        int opaque;
    };
    /// Vertices, numbered through over all instances.
    using Corners = std::array<std::uint32_t, 3>;
    /// The plane of a triangle, with all changes multiplied by twice the triangle's area on the screen.
    struct SidePlane {
        double x = 0, y = 0, nearness = 0, per_x = 0, per_y = 0, per_nearness = 0;
        double slack = 0;  ///< what snapping does, multiplied likewise
        bool is_on_screen = false;
    };
    struct PairEntry {  // of an entry, for finding pairs
        float lowest;
        Corners vertices;
    };
    static constexpr std::uint32_t kNotSetUp = 0xFFFFFFFFu;

    void add_clipped(SurfaceId s, std::uint32_t number);
    void add(const CrossedTriangle& triangle, std::uint32_t set_up);
    const LayerTriangle& triangle(std::uint32_t i) {
        if (set_up_[i] == kNotSetUp) set_up(i);
        return triangles_[set_up_[i]];
    }
    void set_up(std::uint32_t i);
    double transmission_of(SurfaceId s) const;
    std::span<const std::uint32_t> touching(std::size_t begin, std::size_t end, const ScreenBox& box, float least_x0,
                                            float least_y0);
    void hide(const LayerLine& line, std::span<const std::uint32_t> near, const PartInTile& part);
    void hide(const LayerLine& line, std::uint32_t i, const HiddenPart& hidden);
    void find_contacts(const LayerLine& line, const PartInTile& part);
    void drop_contacts(std::size_t first, std::vector<LayerPiece>& pieces);
    void find_pairs_in_cell(int column, int row);
    SidePlane side_plane(const Corners& corners) const;
    bool is_on_one_side(const SidePlane& plane, const Corners& corners) const;
    void merge_intervals();
    void sort(std::vector<double>& values);
    int find_events(double begin, double end);
    void sweep(const LayerLine& line, std::uint32_t number, double begin, double end,
               std::vector<LayerPiece>& pieces);

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    Contacts contacts_;
    const TileKernels& kernels_;
    const LayerBins& bins_;
    const PixelTiles& grid_;
    bool has_transparent_, finds_pairs_;
    PixelRect rect_;
    LayerCells cells_;  // its entries are the triangles of the tile
    LayerCells pair_cells_;                // of the same triangles, where pairs are wanted
    std::vector<PairEntry> pair_entries_;  // likewise
    // What it takes to clip with an entry is set up when first needed.
    std::vector<std::uint32_t> set_up_;   // per entry: which of triangles_, or kNotSetUp
    bool has_clipped_ = false;  // triangles in several parts
    std::vector<LayerTriangle> triangles_;
    ScreenBoxes cell_boxes_;               // of the cells' triangles, where pairs are wanted
    std::vector<Corners> cell_vertices_;   // likewise
    std::vector<std::uint32_t> found_;  // by a kernel
    std::vector<std::array<std::uint32_t, 2>> pairs_;  // of entries
    std::vector<std::uint32_t> near_;          // entries that a line may cross
    std::vector<const TrianglePlane*> planes_;  // theirs
    std::vector<HiddenPart> parts_;
    std::vector<Interval> intervals_;
    std::vector<Contact> contacts_of_line_;
    std::vector<double> begins_, ends_, sorted_;  // of opaque intervals
    std::vector<Event> events_;
    double line_slack_ = 0, certain_slack_ = 0;  // of the line that is looked at
    std::uint64_t fragment_count_ = 0;
};

}  // namespace burin
