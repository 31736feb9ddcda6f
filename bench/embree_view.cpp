#include "bench/embree_view.h"

#include <algorithm>

namespace burin::bench {

EmbreeView::EmbreeView(const Frame& frame) : frame_(frame) {
    device_ = rtcNewDevice("threads=1");
    scene_ = rtcNewScene(device_);
    for (std::uint32_t i = 0; i < frame.surfaces.instances.size(); ++i) {
        const Mesh& mesh = *frame.surfaces.instances[i].mesh;
        if (mesh.triangles.empty()) continue;
        RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* v = static_cast<float*>(
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size()));
        for (std::uint32_t k = 0; k < mesh.positions.size(); ++k) {
            const glm::dvec3 p = frame.surfaces.view_position(i, k);
            for (int c = 0; c < 3; ++c) v[3 * k + static_cast<std::uint32_t>(c)] = static_cast<float>(p[c]);
        }
        auto* t = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
        for (std::size_t k = 0; k < mesh.triangles.size(); ++k) std::copy_n(mesh.triangles[k].data(), 3, t + 3 * k);
        rtcCommitGeometry(g);
        rtcAttachGeometry(scene_, g);
        rtcReleaseGeometry(g);
    }
    rtcCommitScene(scene_);
}

EmbreeView::~EmbreeView() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

std::size_t EmbreeView::trace() const {
    const Projection& p = frame_.surfaces.projection;
    std::size_t hits = 0;
    alignas(32) const int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
    for (int y = 0; y < frame_.height; y += 2) {
        for (int x = 0; x < frame_.width; x += 4) {
            alignas(32) RTCRayHit8 r;
            for (int k = 0; k < 8; ++k) {
                glm::dvec3 origin, direction;
                p.view_ray({x + k % 4 + 0.5, y + k / 4 + 0.5}, origin, direction);
                r.ray.org_x[k] = static_cast<float>(origin.x);
                r.ray.org_y[k] = static_cast<float>(origin.y);
                r.ray.org_z[k] = static_cast<float>(origin.z);
                r.ray.dir_x[k] = static_cast<float>(direction.x);
                r.ray.dir_y[k] = static_cast<float>(direction.y);
                r.ray.dir_z[k] = -1;
                r.ray.tnear[k] = 0;
                r.ray.tfar[k] = 1e30f;
                r.ray.mask[k] = 0xFFFFFFFFu;
                r.ray.flags[k] = 0;
                r.ray.time[k] = 0;
                r.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
                r.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
            }
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
            rtcIntersect8(valid, scene_, &context, &r);
            for (int k = 0; k < 8; ++k) hits += r.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID;
        }
    }
    return hits;
}

}  // namespace burin::bench
