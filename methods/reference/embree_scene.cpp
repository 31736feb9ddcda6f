#include "methods/reference/embree_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/interrupt.h"

namespace burin {

struct EmbreeScene::Handles {
    // One thread builds: the tree, and with it the choice among coincident triangles, is the same
    // in every run.
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = nullptr;

    Handles() {
        if (device == nullptr) {
            if (rtcGetDeviceError(nullptr) == RTC_ERROR_OUT_OF_MEMORY) throw InputError("not enough memory for rays");
            throw InputError("Embree cannot start on this machine");
        }
        scene = rtcNewScene(device);
        rtcSetSceneFlags(scene,
                         static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    }
    ~Handles() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
};

namespace {

/// Embree's single precision must not over- or underflow: the scene is scaled by a power of two, which
/// loses nothing, so that it reaches about 1 unit from the eye.
double unit_scale(const RayGeometry& geometry) {
    double reach = 0;
    for (std::uint32_t object = 0; object < geometry.object_count(); ++object) {
        for (std::uint32_t v = 0; v < geometry.mesh(object).positions.size(); ++v) {
            const glm::dvec3 p = glm::abs(geometry.position(object, v));
            reach = std::max({reach, p.x, p.y, p.z});
        }
    }
    return reach > 0 ? std::exp2(-std::ceil(std::log2(reach))) : 1;
}

void attach_object(RTCDevice device, RTCScene scene, const RayGeometry& geometry, double scale, std::uint32_t object) {
    const Mesh& mesh = geometry.mesh(object);
    const RTCGeometry g = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const positions =
        static_cast<float*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                    std::max<std::size_t>(mesh.positions.size(), 1)));
    auto* const corners = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                                std::max<std::size_t>(mesh.triangles.size(), 1)));
    if (positions == nullptr || corners == nullptr) throw InputError("not enough memory for rays");
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::dvec3 p = geometry.position(object, v) * scale;
        for (int k = 0; k < 3; ++k) positions[3 * v + static_cast<unsigned>(k)] = static_cast<float>(p[k]);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::copy(mesh.triangles[t].begin(), mesh.triangles[t].end(), corners + 3 * t);
    }
    rtcCommitGeometry(g);
    rtcAttachGeometryByID(scene, g, object);
    rtcReleaseGeometry(g);
}

RTCRayHit ray_through(const RayGeometry& geometry, double scale, glm::dvec2 pixel) {
    glm::dvec3 origin, direction;
    geometry.projection().view_ray(pixel, origin, direction);
    origin *= scale;
    RTCRayHit ray{};
    ray.ray.org_x = static_cast<float>(origin.x);
    ray.ray.org_y = static_cast<float>(origin.y);
    ray.ray.org_z = static_cast<float>(origin.z);
    ray.ray.dir_x = static_cast<float>(direction.x);
    ray.ray.dir_y = static_cast<float>(direction.y);
    ray.ray.dir_z = static_cast<float>(direction.z);
    ray.ray.tnear = static_cast<float>(geometry.projection().near_distance * scale);
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = 0xFFFFFFFFu;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return ray;
}

/// Collects the first of all facets that a short ray meets and that coincide with the nearest one.
struct FirstFacet {
    RTCIntersectContext context;  // first: Embree hands out a pointer to it
    Facet facet, nearest;
    const RayGeometry* geometry;
    glm::dvec2 pixel;
    double error;  // of distances

    bool coincides(Facet other) const { return geometry->are_one_around(other, nearest, pixel, 2 * error); }
};

void keep_first(const RTCFilterFunctionNArguments* arguments) {
    auto* const first = reinterpret_cast<FirstFacet*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] != -1) continue;
        const Facet facet{RTCHitN_geomID(arguments->hit, arguments->N, i),
                          RTCHitN_primID(arguments->hit, arguments->N, i)};
        if (facet < first->facet && first->coincides(facet)) first->facet = facet;
        arguments->valid[i] = 0;  // go on
    }
}

}  // namespace

EmbreeScene::EmbreeScene(const RayGeometry& geometry)
    : geometry_(geometry), scale_(unit_scale(geometry)), handles_(std::make_unique<Handles>()) {
    for (std::uint32_t object = 0; object < geometry.object_count(); ++object) {
        throw_if_interrupted();
        if (geometry.mesh(object).triangles.empty()) continue;
        attach_object(handles_->device, handles_->scene, geometry, scale_, object);
    }
    rtcCommitScene(handles_->scene);
    if (rtcGetDeviceError(handles_->device) != RTC_ERROR_NONE) {
        throw InputError("not enough memory for rays");
    }
}

EmbreeScene::~EmbreeScene() = default;

void EmbreeScene::cast_row(glm::dvec2 first, double step, std::span<Facet> hits) const {
    constexpr std::size_t kPacket = 8;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    RTCRayHit8 packet{};
    alignas(32) int valid[kPacket];
    for (std::size_t begin = 0; begin < hits.size(); begin += kPacket) {
        const std::size_t count = std::min(kPacket, hits.size() - begin);
        for (std::size_t i = 0; i < kPacket; ++i) {
            valid[i] = i < count ? -1 : 0;
            const double x = first.x + step * static_cast<double>(begin + i);
            const RTCRayHit ray = ray_through(geometry_, scale_, {x, first.y});
            packet.ray.org_x[i] = ray.ray.org_x;
            packet.ray.org_y[i] = ray.ray.org_y;
            packet.ray.org_z[i] = ray.ray.org_z;
            packet.ray.dir_x[i] = ray.ray.dir_x;
            packet.ray.dir_y[i] = ray.ray.dir_y;
            packet.ray.dir_z[i] = ray.ray.dir_z;
            packet.ray.tnear[i] = ray.ray.tnear;
            packet.ray.tfar[i] = ray.ray.tfar;
            packet.ray.mask[i] = ray.ray.mask;
            packet.ray.time[i] = 0;
            packet.ray.flags[i] = 0;
            packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
            packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect8(valid, handles_->scene, &context, &packet);
        for (std::size_t i = 0; i < count; ++i) {
            const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
            hits[begin + i] = hit ? Facet{packet.hit.geomID[i], packet.hit.primID[i]} : Facet{};
        }
    }
}

Facet EmbreeScene::cast(glm::dvec2 pixel) const {
    RTCRayHit ray = ray_through(geometry_, scale_, pixel);
    RTCRayHit again = ray;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(handles_->scene, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};

    // Two surfaces coincide when rounding of their coordinates could make either the nearer one.
    const glm::vec3 normal(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
    const glm::vec3 direction(ray.ray.dir_x, ray.ray.dir_y, ray.ray.dir_z);
    const float across = std::abs(glm::dot(normal, direction)) / std::max(glm::length(normal), 1e-30f);
    const double distance = static_cast<double>(ray.ray.tfar);
    const double error = 2 * geometry_.coordinate_error() / std::max(static_cast<double>(across), 1e-9);
    const double pixel_size = geometry_.projection().pixel_size(distance / scale_);
    const double reach = std::min(error, pixel_size) * scale_ + 4e-7 * std::abs(distance);
    const Facet nearest{ray.hit.geomID, ray.hit.primID};
    FirstFacet first{{}, nearest, nearest, &geometry_, pixel, error};
    rtcInitIntersectContext(&first.context);
    first.context.filter = keep_first;
    again.ray.tnear = std::max(again.ray.tnear, static_cast<float>(distance - reach));
    again.ray.tfar = static_cast<float>(distance + reach);
    rtcIntersect1(handles_->scene, &first.context, &again);
    return first.facet;
}

}  // namespace burin
