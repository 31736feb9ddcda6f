#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "burin/picture.h"
#include "lines/line_drawing.h"
#include "render/frame.h"
#include "shading/ink/found_lines.h"

/// Lines as they were found, with all that drawing them takes: independent of the scene that they were found in.
struct burin_drawing {
    const burin::OutputKind kind = burin::OutputKind::drawing;
    burin::Scene scene;  ///< its settings: no meshes, no objects
    burin::Frame frame;  ///< of that scene, without surfaces
    burin::Film surfaces;
    burin::LineDrawing laid_out;             ///< of a scene without a style sheet: its lines as its look draws them
    std::optional<burin::FoundLines> found;  ///< of a scene with one: all that shading reads
    std::vector<burin::LinePiece> pieces;    ///< lines as they were found: visible ones first
    std::vector<std::uint32_t> object, material;  ///< of each piece
    int threads = 0;
    std::vector<std::string> notes;  ///< on pictures that look as the scene did

    explicit burin_drawing(burin::Film film) : surfaces(std::move(film)) {}

    /// A column that was asked for, as bytes.
    struct Column {
        std::string name;
        std::vector<std::byte> values;
    };
    std::vector<Column> columns;
};

namespace burin {

/// Draws a drawing's lines. `style`: the text of a style sheet, its name or file; nullptr: as its scene said. Throws
/// InputError, UsageError and Interrupted.
burin_picture* picture_of(const burin_drawing& drawing, const char* style, int threads);

}  // namespace burin
