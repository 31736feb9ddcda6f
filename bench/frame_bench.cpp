// Times frames of the production A-buffer against Embree's primary rays, in one process and
// interleaved, by the CPU time of the process. Prints JSON.
//
//   frame_bench MODEL WIDTH HEIGHT RUNS
//
// E is the time of Embree 3 for one primary ray per pixel with rtcIntersect8 on one thread, without
// building its tree. The camera fits the model to 95 % of the frame.
#include <embree3/rtcore.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "base/json_writer.h"
#include "methods/abuffer/abuffer.h"
#include "scene/scene_description.h"

namespace {

using namespace burin;

double cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

class EmbreeView {
  public:
    explicit EmbreeView(const Frame& frame) : frame_(frame) {
        device_ = rtcNewDevice("threads=1");
        scene_ = rtcNewScene(device_);
        for (std::uint32_t i = 0; i < frame.surfaces.instances.size(); ++i) {
            const Mesh& mesh = *frame.surfaces.instances[i].mesh;
            if (mesh.triangles.empty()) continue;
            RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
            auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                  12, mesh.positions.size()));
            for (std::uint32_t k = 0; k < mesh.positions.size(); ++k) {
                const glm::dvec3 p = frame.surfaces.view_position(i, k);
                for (int c = 0; c < 3; ++c) v[3 * k + static_cast<std::uint32_t>(c)] = static_cast<float>(p[c]);
            }
            auto* t = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
                g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
            for (std::size_t k = 0; k < mesh.triangles.size(); ++k) std::copy_n(mesh.triangles[k].data(), 3, t + 3 * k);
            rtcCommitGeometry(g);
            rtcAttachGeometry(scene_, g);
            rtcReleaseGeometry(g);
        }
        rtcCommitScene(scene_);
    }
    ~EmbreeView() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    std::size_t trace() const {
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

  private:
    const Frame& frame_;
    RTCDevice device_;
    RTCScene scene_;
};

double at(std::vector<double> v, double quantile) {
    std::sort(v.begin(), v.end());
    return v[static_cast<std::size_t>(quantile * static_cast<double>(v.size() - 1) + 0.5)];
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 5) {
        std::fputs("usage: frame_bench MODEL WIDTH HEIGHT RUNS\n", stderr);
        return 2;
    }
    const int width = std::atoi(argv[2]), height = std::atoi(argv[3]), runs = std::atoi(argv[4]);
    Scene scene = load_scene(bare_model_scene(argv[1], {}));
    CameraSettings settings = scene.cameras.front();
    settings.fov_deg = 35;
    settings.fit = 0.95;
    const Camera camera = resolve_camera(settings, scene_points(scene), static_cast<double>(width) / height);
    const PixelRect all{0, 0, width, height};
    prepare_for_abuffer(scene, 1);
    const Frame frame = make_frame(scene, camera, width, height, all);
    const EmbreeView embree(frame);

    struct Case {
        const char* name;
        std::function<void()> run;
        std::vector<double> times;
    };
    // Lines and fill; and what an EXR gets unless asked otherwise.
    const LayerSet lines_and_fill{.depth = false, .normal = false, .ids = false};
    Film picture(all, all, lines_and_fill, frame.criteria.classes), layers(all, all, LayerSet{}, frame.criteria.classes);
    const auto frame_with = [&](int samples, Film& film) {
        return [&, samples] {
            scene.abuffer.samples_per_pixel = samples;
            RunOptions options;
            options.threads = 1;
            render_abuffer(frame, options, film);
        };
    };
    std::size_t hits = 0;
    std::vector<Case> cases = {{"E", [&] { hits = embree.trace(); }, {}},
                               {"samples_2", frame_with(2, picture), {}},
                               {"samples_4", frame_with(4, picture), {}},
                               {"samples_2_all_layers", frame_with(2, layers), {}},
                               {"samples_4_all_layers", frame_with(4, layers), {}}};
    for (int i = 0; i <= runs; ++i) {
        for (Case& c : cases) {
            const double start = cpu_seconds();
            c.run();
            if (i > 0) c.times.push_back(cpu_seconds() - start);
        }
    }
    JsonWriter json;
    json.begin_object().key("triangles").value(frame.surfaces.triangle_count());
    json.key("covered_pixels").value(static_cast<std::uint64_t>(hits));
    for (const Case& c : cases) {
        json.key(c.name).begin_object();
        json.key("median_s").value(at(c.times, 0.5)).key("min_s").value(at(c.times, 0));
        json.key("noise").value((at(c.times, 0.9) - at(c.times, 0.1)) / at(c.times, 0.5));
        json.key("median_per_E").value(at(c.times, 0.5) / at(cases[0].times, 0.5));
        json.key("min_per_E").value(at(c.times, 0) / at(cases[0].times, 0)).end_object();
    }
    json.end_object();
    std::fputs(json.text().c_str(), stdout);
}
