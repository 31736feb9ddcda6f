#include "output/exr_attributes.h"

#include <array>
#include <charconv>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <numeric>
#include <string>

#include "base/version.h"

#include "base/version.h"

namespace burin {
namespace {

std::string text_of(double value) {
    std::array<char, 32> digits{};
    // As many digits as a float has: what cannot matter must not make files differ.
    constexpr int kDigits = 9;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value == 0 ? 0.0 : value,
                                   std::chars_format::general, kDigits)
                         .ptr;
    return {digits.data(), end};
}

std::string text_of(const glm::dvec3& v) {
    return "[" + text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z) + "]";
}

/// The camera as a scene file has it, of the whole picture.
std::string text_of(const Camera& camera, double height, double pixel_aspect) {
    const glm::dvec3 eye = camera.eye(), up(camera.to_world[1]), back(camera.to_world[2]);
    std::string text = "eye = " + text_of(eye) + ", target = " + text_of(eye - back) + ", up = " + text_of(up);
    if (pixel_aspect != 1) text += ", pixel_aspect = " + text_of(pixel_aspect);
    if (camera.orthographic) return "projection = \"orthographic\", " + text + ", height = " + text_of(height);
    return "projection = \"perspective\", " + text + ", fov = " + text_of(glm::degrees(2 * std::atan(height / 2)));
}

/// glm keeps columns of matrices for column vectors one after the other: these are the rows for row vectors.
ExrMatrix for_row_vectors(const glm::dmat4& m) {
    ExrMatrix rows;
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<float>(glm::value_ptr(m)[i]);
    return rows;
}

/// Camera space, left-handed, to 0..1 over the display window, y down.
glm::dmat4 camera_to_ndc(const Projection& p, double width, double height) {
    glm::dmat4 m(0.0);
    m[0][0] = p.focal_xy_px().x / width;
    m[1][1] = -p.focal_px / height;
    glm::dvec4& middle = p.orthographic ? m[3] : m[2];
    middle.x = p.center_px.x / width;
    middle.y = p.center_px.y / height;
    m[2].z = 1;
    (p.orthographic ? m[3] : m[2]).w = 1;
    return m;
}

}  // namespace

ExrRational rational_of(double frames_per_second) {
    const auto fraction = [](double numerator, double denominator) {
        constexpr double kMost = std::numeric_limits<std::int32_t>::max();
        if (!(numerator >= 0 && numerator <= kMost)) return ExrRational{0, 0};
        const auto n = static_cast<std::int32_t>(numerator);
        const auto d = static_cast<std::uint32_t>(denominator);
        const auto common = std::gcd(static_cast<std::uint32_t>(n), d);
        return ExrRational{static_cast<std::int32_t>(static_cast<std::uint32_t>(n) / common), d / common};
    };
    // Films run at whole numbers of frames, television at 1000/1001 of one.
    const double slowed = std::round(frames_per_second * 1.001);
    if (frames_per_second != std::round(frames_per_second) && std::abs(slowed / 1.001 - frames_per_second) < 0.002)
        return {static_cast<std::int32_t>(slowed) * 1000, 1001};
    return fraction(std::round(frames_per_second * 1000), 1000);
}

ExrOptions exr_options_of(const Frame& frame, std::optional<int> image_counter, bool has_camera) {
    ExrOptions exr;
    exr.attributes.push_back({"software", kProgramVersion});
    exr.attributes.push_back({"framesPerSecond", rational_of(frame.scene->frame.fps)});
    if (image_counter) exr.attributes.push_back({"imageCounter", static_cast<std::int32_t>(*image_counter)});
    if (!has_camera) return exr;
    const Camera& camera = frame.camera;
    const Projection& p = frame.surfaces.projection;
    exr.attributes.push_back({"burin/camera", text_of(camera, frame.height / p.focal_px, p.pixel_aspect)});
    const double width = frame.width, height = frame.height;
    const glm::dvec2 focal = p.focal_xy_px();
    exr.pixel_aspect = static_cast<float>(p.pixel_aspect);
    exr.screen_window_width = static_cast<float>(width / focal.x);
    const glm::dvec2 middle = (glm::dvec2(width, height) * 0.5 - p.center_px) / focal;
    exr.screen_window_center = {static_cast<float>(middle.x), static_cast<float>(0 - middle.y)};
    glm::dmat4 to_left_handed(1.0);
    to_left_handed[2].z = -1;
    const glm::dmat4 to_camera = to_left_handed * camera.to_view();
    exr.attributes.push_back({"worldToCamera", for_row_vectors(to_camera)});
    exr.attributes.push_back({"worldToNDC", for_row_vectors(camera_to_ndc(p, width, height) * to_camera)});
    return exr;
}

}  // namespace burin
