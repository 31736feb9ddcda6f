#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/frame.h"

namespace burin {

/// BlurExtent measures how far a scene is blurred on the screen. It is shown the scene at several times in turn, and
/// follows vertices; of objects that have none in the picture, places where their edges enter it.
class BlurExtent {
  public:
    /// Of a picture of this size.
    BlurExtent(int width, int height) : width_(width), height_(height) {}

    /// The scene at the next time. Its objects are the same each time, and their meshes have the same triangles.
    void add(const Scene& scene, const Camera& camera);
    /// The longest way of a place in the picture, in pixels.
    double way_px() const;
    /// The diameter of the largest circle of confusion where the scene was last, in pixels.
    double circle_px() const { return circle_px_; }

  private:
    /// A place on an edge, or a vertex, which is an edge from itself to itself.
    struct Place {
        std::uint32_t object, a, b;
        double share;
        bool is_on_edge;
    };
    struct Track {
        glm::dvec2 before{0.0};
        bool was_in_front = false, was_seen = false;
        double way_px = 0;
    };
    void choose_places(const Scene& scene, const Camera& camera);

    int width_, height_;
    std::vector<Place> places_;
    std::vector<Track> tracks_;
    double circle_px_ = 0;
};

}  // namespace burin
