#pragma once

#include <cstdint>
#include <vector>

#include "methods/projected_polygon.h"
#include "methods/zbuffer/pass.h"
#include "render/frame.h"

// The z-buffered machine has a frame buffer, depths and one more bit per pixel, and draws polygons and vectors pass by
// pass.

namespace burin {

/// What the frame buffer holds at a pixel. Colours are looked up when the picture is finished.
struct FramePixel {
    SurfaceId surface;  ///< the last fill that was written
    /// 0 = fill or background; else the line class from 1, and whether it is the highlight's
    /// colour.
    std::uint8_t line = 0;
    bool highlighted = false;
};

/// A z-buffered machine that draws polygons and vectors pass by pass, for a rectangle of pixels.
/// Where a pixel lies in the rectangle makes no difference to what is drawn there.
class ZBuffer {
  public:
    explicit ZBuffer(const Frame& frame);

    /// Sets far depth, background, and this bit everywhere.
    void clear(PixelRect rect, bool bit);

    /// Fills the polygon's interior.
    void fill(const ProjectedPolygon& polygon, const Pass& pass, const DepthOffset& offset = {});
    /// Draws the edges of its outline that are lines.
    void edges(const ProjectedPolygon& polygon, const Pass& pass, const DepthOffset& offset = {});
    /// Draws these edges, as far as they are selected, in the colour of highlights; compares with "less or equal" and
    /// leaves z as it is.
    void highlight(const ProjectedPolygon& polygon, const DepthOffset& offset = {});
    /// Sets the bit of all pixels in the bounding box of the polygon's interior.
    void set_bits_of_box(const ProjectedPolygon& polygon, bool bit);

    PixelRect rect() const { return rect_; }
    const FramePixel& frame(int x, int y) const { return frame_[index(x, y)]; }
    /// Stored z: steps of the integer formats, else the number itself.
    double depth(int x, int y) const { return depth_[index(x, y)]; }
    bool bit(int x, int y) const { return bits_[index(x, y)] != 0; }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y - rect_.y0) * static_cast<std::size_t>(rect_.width()) +
               static_cast<std::size_t>(x - rect_.x0);
    }
    double stored(double z) const;
    double smallest_step(double largest_z) const;
    double offset_of(const ProjectedTriangle& triangle, const DepthOffset& offset) const;
    /// Tests and writes one pixel. True if it passed.
    bool draw(std::size_t i, double z, const Pass& pass);
    void draw_edges(const ProjectedPolygon& polygon, const Pass& pass, const DepthOffset& offset, bool highlighted);

    const Frame& frame_of_scene_;
    const ZBufferSettings& settings_;
    int width_px_;
    double steps_;  // of the integer formats, else 0
    PixelRect rect_;
    std::vector<double> depth_;
    std::vector<std::uint8_t> bits_;
    std::vector<FramePixel> frame_;
    std::vector<bool> highlighted_instances_;
};

}  // namespace burin
