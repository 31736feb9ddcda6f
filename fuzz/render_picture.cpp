// Draws its input, an OBJ. The camera, the method and the look of the picture follow from a hash of
// the bytes, so one input always gives one picture. The method abuffer draws it a second time, with
// other tiles and threads, and must come to the same bytes.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "fuzz/scratch_folder.h"
#include "methods/method_table.h"
#include "render/film.h"
#include "render/frame.h"
#include "scene/scene_description.h"

namespace {

using namespace burin;

constexpr int kWidth = 64, kHeight = 48;

/// Takes small numbers out of a hash (FNV-1a) of the input.
class Choices {
  public:
    Choices(const std::uint8_t* data, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) state_ = (state_ ^ data[i]) * 0x100000001b3u;
    }
    /// In [0, count).
    int below(int count) {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<int>((state_ >> 33) % static_cast<std::uint64_t>(count));
    }
    bool one_in(int count) { return below(count) == 0; }
    double between(double low, double high) { return low + (high - low) * below(1 << 20) / (1 << 20); }

  private:
    std::uint64_t state_ = 0xcbf29ce484222325u;
};

/// A new choice is the last of all, behind those of the camera and the method: else all others of the seeds change.
void choose_look(Choices& choices, Scene& scene) {
    LineSettings& lines = scene.lines;
    if (choices.one_in(3)) lines.classes = LineClassSet::all();
    if (choices.one_in(4)) lines.contours = Contours::smooth;
    if (choices.one_in(4)) lines.crease_fade_deg = 20;
    lines.style.width_px = choices.one_in(8) ? choices.between(8, 200) : choices.between(0.2, 4);
    if (choices.one_in(4)) lines.style.dash_px = {choices.between(0.001, 8), choices.between(0.001, 8)};
    if (choices.one_in(2)) lines.style.hidden.style = choices.one_in(2) ? HiddenStyle::solid : HiddenStyle::dashed;
    scene.abuffer.samples = choices.one_in(2) ? 2 : 4;
    if (choices.one_in(6)) {
        for (Material& material : scene.materials) material.opacity = 0.5f;
    }
}

Camera choose_camera(Choices& choices, const Scene& scene) {
    CameraSettings settings = scene.cameras.front();
    settings.orthographic = choices.one_in(2);
    if (choices.one_in(3)) {  // along an axis, as technical drawings are
        glm::dvec3 axis(0);
        axis[choices.below(3)] = choices.one_in(2) ? 1 : -1;
        settings.direction = axis;
        if (axis.y != 0) settings.up = glm::dvec3(0, 0, 1);
    } else {
        settings.direction = glm::dvec3(choices.between(-1, 1), choices.between(-1, 1), choices.between(0.1, 1));
    }
    return resolve_camera(settings, scene_points(scene), static_cast<double>(kWidth) / kHeight);
}

Film draw(const Frame& frame, const Method& method, const RunOptions& options) {
    LayerSet all{true, true, true, true, true, true, true};
    all.lines_hidden = frame.scene->lines.style.hidden.style != HiddenStyle::none;
    Film film({0, 0, kWidth, kHeight}, frame.crop, all, frame.criteria.classes);
    method.render(frame, options, film);
    return film;
}

bool are_equal(const Image& a, const Image& b) {
    for (const Channel& channel : a.channels()) {
        const Channel* const other = b.find(channel.name);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const double u = a.value(channel, x, y), v = b.value(*other, x, y);
                if (u != v && !(u != u && v != v)) return false;
            }
        }
    }
    return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const burin::fuzz::ScratchFolder folder;
    const std::string path = folder.write("input.obj", {data, size});
    Choices choices(data, size);
    try {
        Scene scene = load_scene(bare_model_scene(path, {}));
        choose_look(choices, scene);
        const Camera camera = choose_camera(choices, scene);
        const Frame frame = make_frame(scene, camera, kWidth, kHeight, {0, 0, kWidth, kHeight});
        const bool is_default = !choices.one_in(8);
        const Method& method =
            is_default ? methods().front()
                       : methods()[static_cast<std::size_t>(choices.below(static_cast<int>(methods().size())))];
        RunOptions options;
        options.threads = 1;
        const Film film = draw(frame, method, options);
        if (is_default && choices.one_in(4)) {
            options.threads = 3;
            options.tile_samples = 32;
            if (!are_equal(film.image(), draw(frame, method, options).image())) {
                std::fputs("threads and tiles changed the picture\n", stderr);
                std::abort();
            }
        }
    } catch (const InputError&) {
    }
    return 0;
}
