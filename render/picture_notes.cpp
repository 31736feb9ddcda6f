#include "render/picture_notes.h"

namespace burin {

std::string note_on_missing_marks(const Frame& frame) {
    if (frame.scene->lines.classes.has(LineClass::mark)) return {};
    std::uint64_t count = 0;
    for (const SurfaceInstance& instance : frame.surfaces.instances) count += instance.mesh->loose_edges.size();
    if (count == 0) return {};
    return std::string(frame.scene->sheet ? "no set of the style sheet draws the class mark"
                                          : "the class mark is not drawn") +
           ", and so " + (count == 1 ? "1 line" : std::to_string(count) + " lines") + " of the input " +
           (count == 1 ? "is" : "are") + " missing";
}

std::string note_on_missing_blur(bool has_shutter, const Camera& camera, const std::string& who) {
    if (!has_shutter && camera.lens_radius == 0) return {};
    return who + " draws one moment with all in focus; " +
           (!has_shutter              ? "lens_radius of the camera changes"
            : camera.lens_radius == 0 ? "[shutter] changes"
                                      : "[shutter] and lens_radius of the camera change") +
           " nothing";
}

std::string note_on_unread_keys(const std::vector<std::string>& keys) {
    if (keys.empty()) return {};
    std::string names;
    for (const std::string& key : keys) names += (names.empty() ? "lines." : ", lines.") + key;
    return "the style sheet says which lines are drawn and how; " + names + " change" + (keys.size() == 1 ? "s" : "") +
           " nothing";
}

}  // namespace burin
