#include "methods/zbuffer/zbuffer.h"

#include <algorithm>
#include <cmath>

#include "methods/zbuffer/fill_raster.h"
#include "methods/zbuffer/vector_generator.h"
#include "scene/object_names.h"

namespace burin {
namespace {

bool compare(DepthTest test, double z, double stored) {
    switch (test) {
        case DepthTest::never:
            return false;
        case DepthTest::less:
            return z < stored;
        case DepthTest::less_equal:
            return z <= stored;
        case DepthTest::always:
            return true;
    }
    return false;
}

bool compare(BitTest test, bool reference, bool stored) {
    return test == BitTest::always || (test == BitTest::equal) == (reference == stored);
}

}  // namespace

ZBuffer::ZBuffer(const Frame& frame)
    : frame_of_scene_(frame),
      settings_(frame.scene->zbuffer),
      width_px_(aliased_width_px(frame.scene->lines.style.width_px)),
      steps_(settings_.depth_bits <= 24 ? std::exp2(settings_.depth_bits) - 1 : 0) {
    const ObjectNames highlighted(settings_.highlight_objects);
    for (const SceneObject& object : frame.scene->objects)
        highlighted_instances_.push_back(highlighted.mean(object.name));
}

void ZBuffer::clear(PixelRect rect, bool bit) {
    rect_ = rect;
    const auto count = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
    depth_.assign(count, stored(1));
    bits_.assign(count, bit ? 1 : 0);
    frame_.assign(count, FramePixel{});
}

double ZBuffer::stored(double z) const {
    z = std::clamp(z, 0.0, 1.0);
    if (steps_ > 0) return std::floor(z * steps_ + 0.5);
    return settings_.depth_bits == 32 ? static_cast<double>(static_cast<float>(z)) : z;
}

double ZBuffer::smallest_step(double largest_z) const {
    if (steps_ > 0) return 1 / steps_;
    const int mantissa_bits = settings_.depth_bits == 32 ? 23 : 52;
    return std::ldexp(1.0, std::ilogb(std::max(largest_z, 1e-30)) - mantissa_bits);
}

double ZBuffer::offset_of(const ProjectedTriangle& triangle, const DepthOffset& offset) const {
    double amount = offset.constant;
    if (offset.factor != 0 || offset.units != 0) {
        const ZPlane plane(triangle);
        const double largest = std::max(std::abs(plane.low), std::abs(plane.high));
        amount += offset.factor * plane.slope() + offset.units * smallest_step(largest);
    }
    return offset.sign * std::min(amount, offset.limit);
}

inline bool ZBuffer::draw(std::size_t i, double z, const Pass& pass) {
    const auto apply = [&](BitOp op) {
        if (op == BitOp::replace) bits_[i] = pass.reference ? 1 : 0;
    };
    if (!compare(pass.bit_test, pass.reference, bits_[i] != 0)) {
        apply(pass.on_bit_fail);
        return false;
    }
    const double value = stored(z);
    const bool forced = pass.bit_passes_depth && bits_[i] != 0;
    if (!forced && !compare(pass.depth_test, value, depth_[i])) {
        apply(pass.on_depth_fail);
        return false;
    }
    apply(pass.on_pass);
    if (pass.writes_depth) depth_[i] = value;
    return true;
}

void ZBuffer::fill(const ProjectedPolygon& polygon, const Pass& pass, const DepthOffset& offset) {
    for (const ProjectedTriangle& triangle : polygon.triangles) {
        const double added = offset_of(triangle, offset);
        for_each_fragment(triangle, rect_, [&](int x, int y, double z) {
            const std::size_t i = index(x, y);
            if (draw(i, z + added, pass) && pass.writes_frame) frame_[i] = {triangle.surface, 0, false};
        });
    }
}

void ZBuffer::edges(const ProjectedPolygon& polygon, const Pass& pass, const DepthOffset& offset) {
    draw_edges(polygon, pass, offset, false);
}

void ZBuffer::highlight(const ProjectedPolygon& polygon, const DepthOffset& offset) {
    const Pass pass{.depth_test = DepthTest::less_equal, .writes_depth = false};
    draw_edges(polygon, pass, offset, true);
}

void ZBuffer::draw_edges(const ProjectedPolygon& polygon, const Pass& pass, const DepthOffset& offset,
                         bool highlighted) {
    for (const ProjectedEdge& edge : polygon.edges) {
        if (edge.classes.empty()) continue;
        const LineClass drawn = *edge.classes.first();
        if (highlighted && !settings_.highlight_classes.has(drawn) && !highlighted_instances_[polygon.instance]) {
            continue;
        }
        const auto beside =
            std::find_if(polygon.triangles.begin(), polygon.triangles.end(),
                         [&](const ProjectedTriangle& t) { return t.surface.triangle == edge.half_edge / 3; });
        const double added = beside == polygon.triangles.end() ? 0 : offset_of(*beside, offset);
        const bool turned = !settings_.canonical_edges && !edge.runs_with_outline;
        const auto line = static_cast<std::uint8_t>(1 + static_cast<int>(drawn));
        for_each_vector_pixel(turned ? edge.to : edge.from, turned ? edge.from : edge.to, width_px_, rect_,
                              [&](int x, int y, double z) {
                                  const std::size_t i = index(x, y);
                                  if (!draw(i, z + added, pass) || !pass.writes_frame) return;
                                  frame_[i].line = line;
                                  frame_[i].highlighted = highlighted;
                              });
    }
}

void ZBuffer::set_bits_of_box(const ProjectedPolygon& polygon, bool bit) {
    if (polygon.is_empty()) return;
    glm::dvec2 low = polygon.triangles[0].corners[0].pixel, high = low;
    for (const ProjectedTriangle& triangle : polygon.triangles) {
        for (const ProjectedCorner& corner : triangle.corners) {
            low = glm::min(low, corner.pixel);
            high = glm::max(high, corner.pixel);
        }
    }
    const auto held = [](double position, int lowest, int highest) {
        return static_cast<int>(std::clamp(position, double(lowest), double(highest)));
    };
    const int x0 = held(std::floor(low.x), rect_.x0, rect_.x1);
    const int x1 = held(std::floor(high.x) + 1, rect_.x0, rect_.x1);
    const int y0 = held(std::floor(low.y), rect_.y0, rect_.y1);
    const int y1 = held(std::floor(high.y) + 1, rect_.y0, rect_.y1);
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) bits_[index(x, y)] = bit ? 1 : 0;
    }
}

}  // namespace burin
