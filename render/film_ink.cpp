#include "image/half.h"
#include "render/film.h"

// Ink that is put channel by channel: of style sheets, and of lines behind transparent surfaces.

namespace burin {

void Film::draw_over_beauty(int x, int y, const InkOver& ink) {
    note_drawn(x, y);
    const auto [planes, i] = place_of(x, y);
    if (planes.beauty[0] == nullptr) return;
    const float bare = 1.0f - float_from_half(planes.beauty[3][i]);
    for (int c = 0; c < 3; ++c) {
        const float before = float_from_half(planes.beauty[c][i]);
        planes.beauty[c][i] = to_half(before * ink.through[c] + ink.color[c] + bare * ink.tint[c]);
    }
    planes.beauty[3][i] = to_half(1.0f - bare * ink.left);
}

void Film::put_lines(int x, int y, const LineInk& lines) {
    note_drawn(x, y);
    const auto [planes, i] = place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        if (planes.lines[c] != nullptr) planes.lines[c][i] = lines.half_color[c];
    }
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        if (planes.coverage[c] != nullptr) planes.coverage[c][i] = lines.coverage[c];
    }
}

void Film::put_hidden(int x, int y, const glm::vec4& color) {
    note_drawn(x, y);
    const auto [planes, i] = place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        if (planes.lines_hidden[c] != nullptr) planes.lines_hidden[c][i] = to_half(color[static_cast<int>(c)]);
    }
}

void Film::put_line_set(int x, int y, std::size_t set, const glm::vec4& color) {
    note_drawn(x, y);
    const auto [planes, i] = place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) planes.line_sets[set].of[c][i] = to_half(color[static_cast<int>(c)]);
}

void Film::add_lines(int x, int y, const LinePixel& lines) {
    note_drawn(x, y);
    const auto [planes, i] = place_of(x, y);
    const auto add = [i = i](std::uint16_t* plane, float value) {
        if (plane != nullptr) plane[i] = to_half(float_from_half(plane[i]) + value);
    };
    for (std::size_t c = 0; c < 4; ++c) add(planes.lines[c], lines.color[static_cast<int>(c)]);
    for (std::size_t c = 0; c < kLineClassCount; ++c) add(planes.coverage[c], lines.coverage[c]);
}

}  // namespace burin
