#include "cli/frames/fingerprint.h"

#include <algorithm>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/mapped_file.h"
#include "base/version.h"
#include "cli/frames/depth_fit.h"

namespace burin {
namespace {

void add(const glm::dmat4& matrix, ContentHash& hash) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) hash.add(matrix[column][row]);
    }
}

void add_content(const std::string& path, ContentHash& hash) {
    throw_if_interrupted();
    const MappedFile file(path);
    hash.add(file.bytes());
}

}  // namespace

Fingerprints::Fingerprints(const Arguments& a, const LoadedInput& input) : arguments_(a) {
    of_all_.add(kProgramVersion).add(input.hash).add(a.picture_options);
    of_all_.add(input.scene.frame.fps);
    if (!a.method.empty() && a.method != "abuffer") {  // what fit_depth_ranges() fits to
        for (const double frame : frames_to_fit(input.frame_range, input.turntable)) of_all_.add(frame);
    }
    for (const SceneObject& object : input.scene.objects) add(object.to_world, of_all_);
    std::vector<std::string> files = input.files;
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    for (const std::string& file : files) add_content(file, of_all_);
}

FrameFingerprint Fingerprints::of(const SceneChange& places, const std::vector<Camera>& cameras,
                                  const std::vector<std::string>& files,
                                  const std::vector<std::string>& later_files) const {
    ContentHash hash = of_all_;
    hash.add(places.frame);
    for (const glm::dmat4& to_world : places.to_world) add(to_world, hash);
    for (const Camera& camera : cameras) {
        add(camera.to_world, hash);
        hash.add(camera.orthographic ? -camera.height : camera.fov_deg);
        for (const glm::dvec2& two : {camera.area.low, camera.area.high, camera.shift}) hash.add(two.x).add(two.y);
        if (camera.pixel_aspect != 1) hash.add(camera.pixel_aspect);
        if (camera.lens_radius > 0) hash.add(camera.lens_radius).add(camera.focus);
    }
    for (const std::string& file : files) add_content(file, hash);
    for (const std::string& file : later_files) {
        try {
            add_content(file, hash);
        } catch (const InputError&) {
            hash.add("cannot be read");
        }
    }
    const std::string of_exr = hash.text();
    if (arguments_.crop) {
        for (const int side : *arguments_.crop) hash.add(static_cast<std::uint64_t>(side));
    }
    return {of_exr, hash.text()};
}

}  // namespace burin
