#include "scene/parameter_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "image/image_io.h"
#include "shading/sheet/sheet_symbols.h"

namespace burin {

std::string text_of_parameter(const SheetParameter& parameter) {
    const StyleValue& value = parameter.value;
    if (value.kind == StyleValue::Kind::color) {
        char text[16];
        int parts[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const float encoded = srgb_from_linear(std::clamp(value.color[k], 0.0f, 1.0f));
            parts[k] = static_cast<int>(std::lround(encoded * 255.0f));
        }
        std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(parts[0]),
                      static_cast<unsigned>(parts[1]), static_cast<unsigned>(parts[2]));
        return text;
    }
    return text_of(value.number) + suffix_of(value.unit);
}

}  // namespace burin
