#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "burin/picture.h"
#include "lines/line_drawing.h"
#include "render/frame.h"

/// Lines as they were found, with all that drawing them takes: independent of the scene that they were found in.
struct burin_drawing {
    const burin::OutputKind kind = burin::OutputKind::drawing;
    burin::Scene scene;  ///< its settings: no meshes, no objects
    burin::Frame frame;  ///< of that scene, without surfaces
    burin::Film surfaces;
    burin::LineDrawing inked;                     ///< lines as the scene's look draws them
    std::vector<burin::LinePiece> pieces;         ///< lines as they were found: visible ones first
    std::vector<std::uint32_t> object, material;  ///< of each piece
    int threads = 0;

    explicit burin_drawing(burin::Film film) : surfaces(std::move(film)) {}

    /// A column that was asked for, as bytes.
    struct Column {
        std::string name;
        std::vector<std::byte> values;
    };
    std::vector<Column> columns;
};

namespace burin {

/// Draws a drawing's lines as its scene says. Throws InputError and Interrupted.
burin_picture* picture_of(const burin_drawing& drawing, int threads);

}  // namespace burin
