// Reads its input as a message of a page. Anything must end in a message whose numbers are within their bounds, or in
// an InputError.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "web/view_message.h"

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

void check_view(const burin::ViewMessage& message) {
    const burin::View& view = message.view;
    require(view.width >= 1 && view.width <= burin::kLargestViewSide);
    require(view.height >= 1 && view.height <= burin::kLargestViewSide);
    require(view.fov_deg > 0 && view.fov_deg < 180);
    require(!view.height_of_view || (*view.height_of_view > 0 && *view.height_of_view <= 1e30));
    for (const glm::dvec3& v : {view.eye, view.target, view.up}) {
        for (int i = 0; i < 3; ++i) require(std::isfinite(v[i]));
    }
    require(message.x >= 0 && message.x < view.width && message.y >= 0 && message.y < view.height);
}

void check_look(const burin::Look& look) {
    require(look.width_px > 0 && look.width_px <= 1024);
    require(look.crease_angle_deg >= 0 && look.crease_angle_deg <= 180);
    require(look.parameters.size() <= burin::kMostParameters);
    require(look.sheet.size() <= burin::kMostMessageBytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const burin::ViewMessage message = burin::read_view_message(text);
        require(message.number >= 0);
        message.kind == burin::ViewMessage::Kind::look ? check_look(message.look) : check_view(message);
    } catch (const burin::InputError& error) {
        const std::string_view what = error.what();
        require(what.starts_with("message") && what.find('\n') == std::string_view::npos);
    }
    return 0;
}
