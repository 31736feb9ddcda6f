#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lines/line_class.h"
#include "scene/camera.h"
#include "shading/line_style.h"

// What a page asks for comes as small TOML texts, which are checked here: nothing of them is trusted.

namespace burin {

constexpr int kLargestViewSide = 4096;
constexpr std::size_t kMostMessageBytes = 64 * 1024;
constexpr int kMostReachPx = 64;
constexpr std::size_t kMostParameters = 256;

/// From where, and how large.
struct View {
    int width = 0, height = 0;  ///< pixels
    glm::dvec3 eye{0.0}, target{0.0}, up{0.0};
    double fov_deg = 35;                   ///< perspective
    std::optional<double> height_of_view;  ///< orthographic: full visible height in world units

    /// As settings of a camera, which has nothing else.
    CameraSettings camera() const;
};

/// How lines look and which there are, as far as a page changes it.
struct Look {
    LineClassSet classes = kDefaultLineClasses;
    double crease_angle_deg = 40;
    double width_px = 1;
    HiddenStyle hidden = HiddenStyle::none;
    std::string shading;  ///< of surfaces, as scenes name it; empty: as the scene has it
    std::string style;    ///< name of a style sheet; empty: none
    std::string sheet;    ///< text of the sheet, where it is not the one of that name
    std::vector<std::pair<std::string, std::string>> parameters;  ///< of the sheet, that have other values

    bool has_sheet() const { return !style.empty() || !sheet.empty(); }
    bool operator==(const Look&) const = default;
};

struct ViewMessage {
    enum class Kind : std::uint8_t {
        draw,     ///< a picture of `view`
        look,     ///< from now on lines look like `look`
        home,     ///< the scene's own view, for a picture of this size
        fit,      ///< a view in the direction of `view` that the scene fills
        explain,  ///< why the line nearest to pixel `x`, `y` of `view` is there, at most `reach_px` away
        save,     ///< a file of `view`
        command,  ///< the command line that draws `view`
    };
    enum class Format : std::uint8_t { png, svg, toml };

    Kind kind = Kind::draw;
    std::int64_t number = 0;  ///< the answer has it
    View view;
    bool is_full = false;  ///< of a draw: in full quality
    Look look;
    int x = 0, y = 0, reach_px = 0;
    Format format = Format::png;
};

/// Reads a message. Throws InputError that begins with "message".
ViewMessage read_view_message(std::string_view text);

}  // namespace burin
