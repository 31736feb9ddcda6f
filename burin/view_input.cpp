#include "burin/view_input.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "burin/scene_state.h"
#include "mesh/text_scan.h"
#include "render/layer_names.h"

namespace burin {
namespace {

constexpr int kLargestSide = 65535;
constexpr int kMostThreads = 1024;
constexpr int kLastFrame = 1000000000;

std::string number_text(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", number);
    return text;
}

PixelRect checked_crop(const int32_t (&crop)[4], int width, int height) {
    const auto [x0, y0, x1, y1] = crop;
    if (x0 == 0 && y0 == 0 && x1 == 0 && y1 == 0) return {0, 0, width, height};
    if (!(0 <= x0 && x0 < x1 && x1 <= width && 0 <= y0 && y0 < y1 && y1 <= height)) {
        throw UsageError("view.crop: must lie within the picture of " + std::to_string(width) + "x" +
                         std::to_string(height) + " pixels, with x0 < x1 and y0 < y1");
    }
    return {x0, y0, x1, y1};
}

/// Throws UsageError unless a matrix turns and moves only, as far as single precision can tell.
void check_is_rigid(const glm::dmat4& m) {
    constexpr double kTolerance = 1e-4;
    double off = 0;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k <= i; ++k) {
            const double product = glm::dot(glm::dvec3(m[i]), glm::dvec3(m[k]));
            off = std::max(off, std::abs(product - (i == k ? 1 : 0)));
        }
    }
    if (!(off <= kTolerance)) {
        throw UsageError(
            "view.camera_to_world: must not scale or skew; its columns x, y, z must have length 1 and be "
            "at right angles");
    }
    if (!(glm::determinant(glm::dmat3(m)) > 0)) {
        throw UsageError("view.camera_to_world: is a mirror; x, y and z must be right-handed");
    }
}

CameraSettings camera_of_matrix(const burin_view& view) {
    CameraSettings camera;
    camera.name = "view";
    camera.to_world = object_matrix(view.camera_to_world, "view.camera_to_world");
    check_is_rigid(*camera.to_world);
    if (!(view.ortho_height >= 0 && view.ortho_height <= 1e30)) {
        throw UsageError("view.ortho_height: must be from 0 to 1e30, got " + number_text(view.ortho_height));
    }
    if (!(view.fov_deg >= 0 && view.fov_deg < 180)) {
        throw UsageError("view.fov_deg: must be from 0, for 35, to less than 180, got " + number_text(view.fov_deg));
    }
    if (view.fov_deg > 0 && view.ortho_height > 0)
        throw UsageError("view.fov_deg and view.ortho_height: give one of them, and 0 for the other");
    camera.orthographic = view.ortho_height > 0;
    if (camera.orthographic) camera.height = view.ortho_height;
    if (view.fov_deg > 0) camera.fov_deg = view.fov_deg;
    for (int i = 0; i < 2; ++i) {
        if (!(std::abs(view.shift[i]) <= 100)) {
            throw UsageError("view.shift: must be from -100 to 100, got " + number_text(view.shift[i]));
        }
        camera.shift[i] = view.shift[i];
    }
    return camera;
}

CameraSettings camera_of_scene(const burin_view& view, const std::vector<CameraSettings>& cameras) {
    if (!(view.shift[0] == 0 && view.shift[1] == 0)) {
        throw UsageError(
            "view.shift: is for a view with camera_to_world; set that of the scene's camera by burin_set()");
    }
    if (view.fov_deg != 0 || view.ortho_height != 0) {
        throw UsageError(
            "view.fov_deg and view.ortho_height are for a view with camera_to_world; set those of the "
            "scene's cameras by burin_set()");
    }
    if (view.camera == nullptr) return cameras.front();
    const auto named = std::find_if(cameras.begin(), cameras.end(),
                                    [&](const CameraSettings& camera) { return camera.name == view.camera; });
    if (named == cameras.end()) throw UsageError("view.camera: there is no camera '" + printable(view.camera) + "'");
    return *named;
}

}  // namespace

ViewInput checked_view(const burin_view& view, const PictureSettings& picture,
                       const std::vector<CameraSettings>& cameras) {
    if (view.pixel_aspect != 0 && !(view.pixel_aspect >= kLeastPixelAspect && view.pixel_aspect <= kMostPixelAspect)) {
        throw UsageError("view.pixel_aspect: must be from 0.1 to 10, or 0, got " + number_text(view.pixel_aspect));
    }
    if (view.frame > kLastFrame || view.frame < -kLastFrame) {
        throw UsageError("view.frame: must be from -1000000000 to 1000000000, got " + std::to_string(view.frame));
    }
    ViewInput input;
    if (view.frame != 0) input.frame = view.frame;
    const bool takes_size = view.width == 0 && view.height == 0;
    input.width = takes_size ? picture.width : view.width;
    input.height = takes_size ? picture.height : view.height;
    if (input.width < 1 || input.width > kLargestSide || input.height < 1 || input.height > kLargestSide) {
        throw UsageError("view.width and view.height: must be from 1 to 65535, got " + std::to_string(view.width) +
                         " and " + std::to_string(view.height));
    }
    input.crop = checked_crop(view.crop, input.width, input.height);
    if (view.samples != 0 && view.samples != 2 && view.samples != 4 && view.samples != 8) {
        throw UsageError("view.samples: must be 2, 4 or 8, or 0, got " + std::to_string(view.samples));
    }
    if (view.samples != 0) input.samples = view.samples;
    const bool has_matrix = !is_unset(view.camera_to_world);
    if (has_matrix && view.camera != nullptr) throw UsageError("view.camera: cannot stand beside camera_to_world");
    input.camera = has_matrix ? camera_of_matrix(view) : camera_of_scene(view, cameras);
    if (view.pixel_aspect != 0) input.camera.pixel_aspect = view.pixel_aspect;
    return input;
}

OptionsInput checked_options(const burin_options& options) {
    if (options.threads < 0 || options.threads > kMostThreads) {
        throw UsageError("options.threads: must be from 0 to 1024, got " + std::to_string(options.threads));
    }
    OptionsInput input;
    input.threads = options.threads;
    input.memory_bytes = options.memory_bytes;
    if (options.layers != nullptr) {
        input.layers = with_layer_option([&] { return layers_named(options.layers); });
    }
    input.progress = options.progress;
    input.user = options.user;
    input.finds_all = options.find_all != 0;
    input.for_paths = options.for_paths != 0 || input.finds_all;
    return input;
}

}  // namespace burin
