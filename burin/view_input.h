#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/progress.h"
#include "burin/burin.h"
#include "image/image.h"
#include "render/method.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace burin {

/// What a burin_view asks for, checked. What is not said comes from the scene.
struct ViewInput {
    int width = 0, height = 0;
    PixelRect crop;
    std::optional<int> samples;
    CameraSettings camera;
    std::optional<int> frame;
};

/// `cameras`: those of the scene, at least one. Throws UsageError.
ViewInput checked_view(const burin_view& view, const PictureSettings& picture,
                       const std::vector<CameraSettings>& cameras);

/// What burin_options ask for, checked.
struct OptionsInput {
    int threads = 0;
    std::uint64_t memory_bytes = 0;
    std::optional<LayerSet> layers;
    int (*progress)(double, void*) = nullptr;
    void* user = nullptr;
    bool for_paths = false, finds_all = false;
};

/// Runs what looks at layers. What it throws names the option.
template <typename Work>
auto with_layer_option(const Work& work) {
    try {
        return work();
    } catch (const UsageError& error) {
        throw UsageError("options.layers: " + std::string(error.what()));
    }
}

/// Throws UsageError.
OptionsInput checked_options(const burin_options& options);

}  // namespace burin
