// Which frames of a job are there already.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "cli/frames/frame_renderer.h"
#include "output/whole_files.h"
#include "render/sub_frames.h"

namespace burin {
namespace {

/// Moments of a blurred frame, so many that keys of animations change what is there at some of them.
std::vector<SubFrame> moments_of_fingerprint(const std::optional<ShutterSettings>& shutter) {
    if (!shutter) return {};
    constexpr double kPerFrame = 4, kFewest = 16, kMost = 4096;
    const double count = std::clamp(std::ceil(kPerFrame * (shutter->close - shutter->open)), kFewest, kMost);
    return sub_frames(&*shutter, false, static_cast<int>(count));
}

}  // namespace

FrameFingerprint FrameRenderer::fingerprint_of(double frame) const {
    if (!fingerprints_) return {};
    SceneChange places;
    if (!plan_.is_at_rest) places = animation_.places_at(frame);
    places.frame = frame;
    std::vector<std::string> files = animation_.files_at(frame), later_files;
    std::vector<Camera> cameras;
    for (const ViewOnSheet& view : views_) cameras.push_back(view.camera);
    if (views_.empty()) {
        const Scene& scene = posed_.scene();
        const auto add_camera = [&](const SceneChange& change) {
            const bool has_own = !change.cameras.empty();
            cameras.push_back(job_camera_->at(has_own ? change.cameras : first_cameras_, scene.picture, change.frame));
        };
        const auto add_places = [&](double number) {
            SceneChange change = animation_.places_at(number);
            change.frame = number;
            places.to_world.insert(places.to_world.end(), change.to_world.begin(), change.to_world.end());
            add_camera(change);
        };
        add_camera(places);
        for (const SubFrame& sub : moments_of_fingerprint(blur_.shutter)) {
            add_places(frame + sub.time);
            for (std::string& file : animation_.files_at(frame + sub.time)) {
                if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(std::move(file));
            }
        }
        for (const double number : next_frames_of(frame)) {
            try {
                add_places(number);
                for (std::string& file : animation_.files_at(number)) later_files.push_back(std::move(file));
            } catch (const InputError&) {  // then the layer is 0
                continue;
            }
        }
    }
    return fingerprints_->of(places, cameras, files, later_files);
}

bool FrameRenderer::is_there(double frame, const FrameFingerprint& fingerprint, std::string& note) const {
    const auto is_made = [&](const std::string& path, const std::optional<WholeFile>& file,
                             const OutputOptions& output) {
        if (!file || file->is_deep != output.is_deep) {
            if (std::error_code error; std::filesystem::exists(path, error)) note = path + " is not whole";
            return false;
        }
        if (file->fingerprint != fingerprint.of(output.format)) {
            note = path + (file->fingerprint.empty() ? " has no fingerprint" : " was made from another input");
            return false;
        }
        const PictureSettings& picture = scene().picture;
        const PixelRect whole{0, 0, picture.width, picture.height};
        const PixelRect wanted = output.format == OutputFormat::exr ? crop_of(arguments_, whole.x1, whole.y1) : whole;
        if (!file->data || *file->data == wanted) return true;
        note = path + " has another part of the picture";
        return false;
    };
    for (const OutputOptions& output : outputs_of(frame, fingerprint)) {
        if (!is_made(output.path, find_whole_file(output.path, output.format), output)) return false;
    }
    if (!plan_.lines) return true;
    const std::string lines = plan_.lines->path_of(frame);
    OutputOptions first = outputs_.front();
    first.is_deep = false;
    return is_made(lines, find_whole_lines_file(lines), first);
}

}  // namespace burin
