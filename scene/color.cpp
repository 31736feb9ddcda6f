#include "scene/color.h"

#include <charconv>
#include <string>

#include "image/image_io.h"

namespace burin {

std::optional<glm::vec3> color_from_hex(std::string_view text) {
    if (text.empty() || text[0] != '#') return std::nullopt;
    std::string digits(text.substr(1));
    if (digits.size() == 3) {
        digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
    }
    if (digits.size() != 6) return std::nullopt;
    glm::vec3 color;
    for (int c = 0; c < 3; ++c) {
        unsigned value = 0;
        const char* const from = digits.data() + 2 * c;
        if (std::from_chars(from, from + 2, value, 16).ptr != from + 2) return std::nullopt;
        color[c] = linear_from_srgb(static_cast<float>(value) / 255.0f);
    }
    return color;
}

}  // namespace burin
