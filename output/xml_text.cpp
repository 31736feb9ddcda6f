#include "output/xml_text.h"

#include "output/utf8.h"

namespace burin {
std::string xml_text(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const Utf8Character c = first_character(text);
        if (c.code == '&') {
            out += "&amp;";
        } else if (c.code == '<') {
            out += "&lt;";
        } else if (c.code == '>') {
            out += "&gt;";
        } else if (c.code == '"') {
            out += "&quot;";
        } else if (c.code == '\n' || c.code == '\r' || c.code == '\t') {
            out += c.code == '\n' ? "&#10;" : c.code == '\r' ? "&#13;" : "&#9;";
        } else if (c.code < 0x20 || c.code == 0x7F || c.code == 0xFFFE || c.code == 0xFFFF) {
            out += "\xEF\xBF\xBD";
        } else {
            out += text.substr(0, c.bytes);
        }
        text.remove_prefix(c.bytes);
    }
    return out;
}

}  // namespace burin
