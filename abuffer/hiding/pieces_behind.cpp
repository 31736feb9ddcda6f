#include "abuffer/hiding/pieces_behind.h"

namespace burin {

std::vector<LinePiece> pieces_behind(std::span<const WholeLine> lines, std::span<const LinePart> parts,
                                     const DrawingNeeds& needs, double farthest_nearness) {
    std::vector<LinePiece> pieces;
    pieces.reserve(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        constexpr std::size_t kAhead = 16;
        if (i + kAhead < parts.size()) prefetch(lines[parts[i + kAhead].line]);
        const LinePart& part = parts[i];
        if (part.transmission == 0 || part.invisibility > needs.most_invisibility) continue;
        const WholeLine& line = lines[part.line];
        LinePiece piece;
        piece.from = to_pixels(line.at(part.begin));
        piece.to = to_pixels(line.at(part.end));
        piece.line = line.id;
        piece.nearness_from = static_cast<float>(farthest_nearness + line.nearness_at(part.begin));
        piece.nearness_to = static_cast<float>(farthest_nearness + line.nearness_at(part.end));
        piece.classes = line.classes;
        piece.drawn_as = line.drawn_as;
        piece.opacity = line.opacity;
        piece.transmission = part.transmission;
        piece.invisibility = part.invisibility;
        if (!needs.tells_invisibility && !pieces.empty() && goes_on_alike(pieces.back(), piece)) {
            extend(pieces.back(), piece);
        } else {
            pieces.push_back(piece);
        }
    }
    return pieces;
}

}  // namespace burin
