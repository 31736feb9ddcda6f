#pragma once

#include <string>
#include <string_view>

#include "mesh/polygon_soup.h"
#include "mesh/text_scan.h"

namespace burin {

/// Notes that something of the file is left out, or with `strict` throws it as an InputError. `place` is for the error;
/// the note names the line itself.
inline void note_left_out(PolygonSoup& soup, const SourcePosition& place, const std::string& what, bool strict) {
    if (strict) throw InputError(place, what + "; repair or re-export the file, or leave out --strict");
    soup.notes.push_back(what);
}

/// Lines behind the last element that the file counts, without empty ones and comments.
struct SurplusLines {
    std::size_t count = 0;
    std::size_t first = 0;  ///< its number in the file
};
/// `lines_before`: that end in front of `text`.
inline SurplusLines surplus_lines(std::string_view text, std::size_t lines_before) {
    SurplusLines surplus;
    LineReader lines(text);
    for (std::string_view line; lines.next(line);) {
        const std::string word = lower_case(LineScanner(line).word());
        if (word.empty() || word.front() == '#' || word == "comment") continue;
        if (surplus.count++ == 0) surplus.first = lines_before + lines.line_number();
    }
    return surplus;
}
inline void note_surplus(PolygonSoup& soup, const std::string& path, const SurplusLines& lines,
                         const char* last_element, bool strict) {
    if (lines.count == 0) return;
    note_left_out(soup, {path, lines.first},
                  "lines behind " + std::string(last_element) + " left out: " + std::to_string(lines.count) +
                      "; the first one is line " + std::to_string(lines.first),
                  strict);
}

/// The same for bytes, unless all are blanks.
inline void note_surplus(PolygonSoup& soup, const std::string& path, std::string_view bytes, const char* last_element,
                         bool strict) {
    if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) return;
    note_left_out(soup, {path},
                  "bytes behind " + std::string(last_element) + " left out: " + std::to_string(bytes.size()), strict);
}

}  // namespace burin
