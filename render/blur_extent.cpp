#include "render/blur_extent.h"

#include <algorithm>
#include <cmath>

namespace burin {
namespace {

/// Of larger meshes each second vertex will do, or each third.
constexpr std::size_t kMostVertices = 1 << 15;

/// A rectangle of the screen, and what lies behind it.
class Sight {
  public:
    /// Sees a picture of `size` pixels, and around it a margin of `margin` times its width and height.
    Sight(const Projection& projection, glm::dvec2 size, double margin)
        : p_(projection), low_(-margin * size), high_((1 + margin) * size) {}

    bool has(const glm::dvec3& view) const {
        return std::all_of(std::begin(kSides), std::end(kSides), [&](int side) { return inside(view, side) >= 0; });
    }
    /// Cuts the way from a to b, given by shares of it. Returns whether anything is left.
    bool cut(const glm::dvec3& a, const glm::dvec3& b, double& from, double& to) const {
        for (const int side : kSides) {
            const double at_a = inside(a, side), at_b = inside(b, side);
            if (at_a < 0 && at_b < 0) return false;
            if (at_a < 0) from = std::max(from, at_a / (at_a - at_b));
            if (at_b < 0) to = std::min(to, at_a / (at_a - at_b));
        }
        return from < to;
    }

  private:
    static constexpr int kSides[] = {0, 1, 2, 3, 4};
    /// Is not negative on the inner side.
    double inside(const glm::dvec3& v, int side) const {
        const double w = p_.orthographic ? 1.0 : -v.z;
        const glm::dvec2 focal = p_.focal_xy_px();
        switch (side) {
            case 0:
                return -v.z - p_.near_distance;
            case 1:
                return (p_.center_px.x - low_.x) * w + focal.x * v.x;
            case 2:
                return (high_.x - p_.center_px.x) * w - focal.x * v.x;
            case 3:
                return (p_.center_px.y - low_.y) * w - focal.y * v.y;
            default:
                return (high_.y - p_.center_px.y) * w + focal.y * v.y;
        }
    }

    const Projection& p_;
    glm::dvec2 low_, high_;
};

/// How near to the eye places count, as a part of how far objects are from it.
constexpr double kNear = 0x1p-20;

Projection projection_of(const Scene& scene, const Camera& camera, int width, int height) {
    double farthest = 0;
    for (const SceneObject& object : scene.objects)
        farthest = std::max(farthest, glm::distance(glm::dvec3(object.to_world[3]), camera.eye()));
    return camera.projection(width, height, kNear * std::max(farthest, 1e-300));
}

}  // namespace

void BlurExtent::choose_places(const Scene& scene, const Camera& camera) {
    const Projection projection = projection_of(scene, camera, width_, height_);
    const glm::dvec2 size(width_, height_);
    const Sight picture(projection, size, 0), around(projection, size, 1);
    const glm::dmat4 to_view = camera.to_view();
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const Mesh& mesh = scene.meshes[scene.objects[i].mesh];
        const glm::dmat4 object_to_view = to_view * scene.objects[i].to_world;
        const auto view = [&](std::uint32_t v) {
            return glm::dvec3(object_to_view * glm::dvec4(mesh.position(v), 1.0));
        };
        const std::size_t count = mesh.positions.size(), stride = count / kMostVertices + 1;
        bool is_seen = false;
        for (std::size_t v = 0; v < count; v += stride) {
            const auto number = static_cast<std::uint32_t>(v);
            places_.push_back({i, number, number, 0, false});
            is_seen = is_seen || picture.has(view(number));
        }
        if (is_seen) continue;
        const auto enter = [&](std::uint32_t a, std::uint32_t b) {
            double from = 0, to = 1;
            if (!around.cut(view(a), view(b), from, to)) return;
            for (const double share : {from, 0.5 * (from + to), to}) places_.push_back({i, a, b, share, true});
        };
        for (const auto& triangle : mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) enter(triangle[k], triangle[(k + 1) % 3]);
        }
        for (const auto& edge : mesh.loose_edges) enter(edge[0], edge[1]);
    }
    tracks_.resize(places_.size());
}

void BlurExtent::add(const Scene& scene, const Camera& camera) {
    if (tracks_.empty()) choose_places(scene, camera);
    const Projection projection = projection_of(scene, camera, width_, height_);
    const glm::dvec2 size(width_, height_);
    const Sight picture(projection, size, 0), around(projection, size, 1);
    const glm::dmat4 to_view = camera.to_view();
    circle_px_ = 0;
    glm::dmat4 object_to_view(1.0);
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const Place& place = places_[i];
        const SceneObject& object = scene.objects[place.object];
        const Mesh& mesh = scene.meshes[object.mesh];
        if (i == 0 || place.object != places_[i - 1].object) object_to_view = to_view * object.to_world;
        const glm::dvec3 position = place.is_on_edge
                                        ? glm::mix(mesh.position(place.a), mesh.position(place.b), place.share)
                                        : mesh.position(place.a);
        const glm::dvec3 view(object_to_view * glm::dvec4(position, 1.0));
        const bool is_in_front = -view.z > projection.near_distance;
        const bool is_seen = (place.is_on_edge ? around : picture).has(view);
        Track& track = tracks_[i];
        const glm::dvec2 pixel = is_in_front ? projection.to_pixel(view) : glm::dvec2(0.0);
        if (is_in_front && track.was_in_front && (is_seen || track.was_seen))
            track.way_px += glm::distance(pixel, track.before);
        if (is_seen && camera.lens_radius > 0) {
            const double focal = std::max(projection.focal_xy_px().x, projection.focal_px);
            const double radius = camera.lens_radius * focal * std::abs(1 / -view.z - 1 / camera.focus);
            circle_px_ = std::max(circle_px_, 2 * radius);
        }
        track = {pixel, is_in_front, is_seen, track.way_px};
    }
}

double BlurExtent::way_px() const {
    double longest = 0;
    for (const Track& track : tracks_) longest = std::max(longest, track.way_px);
    return longest;
}

}  // namespace burin
