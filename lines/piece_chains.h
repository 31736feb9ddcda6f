#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "lines/end_links.h"
#include "lines/line_piece.h"

namespace burin {

/// How pieces are linked where more than two meet, or none meet exactly.
struct PieceLinking {
    double apart_px = 0;  ///< ends that are no farther apart than this are at one place
    /// Where more than two meet: two pieces that run to one place and back are a loop of their own, and of the others
    /// that are left the straightest pairs of one class belong together. And chains of one class go on in each other
    /// that end less than a pixel apart and run on straight: where several lines lie between two samples, pieces of one
    /// may be missing, in one frame and not in the next.
    bool goes_straight = false;
};

/// PieceChains links pieces that follow each other on the screen, over tiles and over edges of the mesh: pieces whose
/// ends are at one place, to the bit unless PieceLinking says otherwise. Where more than two meet, those of one line
/// belong together, else those of one class if they are two; the others end there.
class PieceChains {
  public:
    struct Chain {
        std::vector<std::uint32_t> ends;  ///< by which each piece is entered: 2i is the beginning of piece i
        bool is_closed = false;
    };

    /// The pieces, which have lengths, must stay.
    explicit PieceChains(std::vector<const LinePiece*> pieces, const PieceLinking& linking = {});

    const LinePiece& piece(std::uint32_t end) const { return *pieces_[end / 2]; }
    double length(std::uint32_t end) const { return glm::distance(piece(end).from, piece(end).to); }

    /// All chains, in the order of where they begin: at the end that is higher on the screen (of two level ones, the
    /// left one). A closed one begins at its highest point and runs clockwise. This depends on nothing but where the
    /// pieces are.
    std::vector<Chain> all() const;

  private:
    glm::dvec2 place(std::uint32_t end) const { return end % 2 == 0 ? pieces_[end / 2]->from : pieces_[end / 2]->to; }
    void link();
    std::vector<std::uint32_t> find_nodes();
    void link_node(std::vector<std::uint32_t> ends);
    void link_straightest(const std::vector<std::uint32_t>& ends);
    template <typename Key>
    void link_pairs(const std::vector<std::uint32_t>& ends, const Key& key);
    void bridge_gaps();
    void put_in_order(Chain& chain) const;

    std::vector<const LinePiece*> pieces_;
    PieceLinking linking_;
    std::vector<std::uint32_t> nodes_;  // of each end: the first end, in their order, at its place
    EndLinks links_;
};

}  // namespace burin
