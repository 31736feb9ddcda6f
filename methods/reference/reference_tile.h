#pragma once

#include <optional>
#include <span>
#include <vector>

#include "methods/reference/boundary_curves.h"
#include "methods/reference/distance_field.h"
#include "methods/reference/embree_scene.h"
#include "methods/reference/reference_lines.h"
#include "methods/reference/reference_loose.h"
#include "render/film.h"
#include "render/frame.h"
#include "shading/surface/fragment_shader.h"

// A tile is drawn by rays, from what is visible to the coverage of strokes.

namespace burin {

/// Method `reference` for a rectangle of pixels.
class ReferenceTile {
  public:
    /// `shaded`: of a shading that varies over surfaces, else nullptr.
    ReferenceTile(const Frame& frame, const RayGeometry& geometry, const EmbreeScene& rays, const ReferenceLines& lines,
                  const ReferenceLooseEdges& loose, const ShadedSurfaces* shaded);

    /// Pixels around a tile whose lines can reach into it.
    static int margin_px(const Frame& frame);

    /// Step 1: the facets at all samples of the rectangle and its margin.
    void cast(PixelRect rect);
    /// Step 2: the boundary curves between them, and loose edges.
    void find_curves();
    std::span<const BoundarySegment> segments() const { return segments_; }
    /// Step 3, for the pixels of the rectangle that are in the frame's crop.
    void shade(Film& film);

  private:
    /// A segment near the pixel at work.
    struct Stroke {
        std::uint32_t segment = 0;
        double distance = 0;  // from the pixel's centre
    };

    Facet sample(int row, int column) const {
        return samples_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(column)];
    }
    glm::dvec2 sample_position(int row, int column) const;
    BoundaryCurves::Node crossing(BoundaryCurves& curves, int row_a, int column_a, int row_b, int column_b) const;
    PixelResult shade_pixel(const SegmentGrid& grid, int x, int y);
    void draw_strokes(const SegmentGrid& grid, glm::ivec2 pixel);
    void draw_class(std::span<const Stroke> strokes, std::uint8_t line_class, double nearest_to_center,
                    bool may_be_hidden, glm::ivec2 pixel);
    bool is_hidden(const BoundarySegment& line, const NearestPoint& on_line, glm::dvec2 from,
                   std::span<const Stroke> strokes) const;
    glm::vec4 color_of(Facet facet, glm::dvec2 at) const;
    /// Shades the samples of a pixel whose first one has this row and column.
    void shade_samples(int row0, int column0);
    void fill_center(PixelResult& result, glm::dvec2 center) const;

    const Frame& frame_;
    const RayGeometry& geometry_;
    const EmbreeScene& rays_;
    const ReferenceLines& lines_;
    const ReferenceLooseEdges& loose_;
    int per_pixel_;        // samples per pixel and axis
    int cells_per_pixel_;  // the same for coverage
    double width_px_;
    PixelRect rect_{};
    int margin_ = 0, rows_ = 0, columns_ = 0;
    std::vector<Facet> samples_;
    std::vector<BoundarySegment> segments_;
    // What is known of the pixel at work: shares per cell and class, and which segments are near.
    std::vector<double> cell_total_, cell_class_;
    std::array<double, kLineClassCount> class_sum_{};
    std::vector<Stroke> strokes_;
    std::optional<FragmentShader> shader_;
    std::vector<SurfaceFragment> fragments_;  // samples of the pixel at work that have a surface
    FragmentColors colors_;                   // of these
};

}  // namespace burin
