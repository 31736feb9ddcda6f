#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lines/course_index.h"

// Chains of pieces become dashes, and lines that lie on each other get the same ones
// (docs/decisions/0020-one-dashed-line.md).

namespace burin {

/// A straight piece of a line that is drawn in dashes, in pixels, and where its ends stand along its chain.
struct DashPiece {
    glm::dvec2 from{0.0}, to{0.0};
    double at_from = 0, at_to = 0;
};

/// A part of a piece, as shares of its way, and where its ends stand along the chain whose dashes it has.
struct DashPart {
    double begin = 0, end = 1;
    double at_begin = 0, at_end = 0;
};

/// DashPlaces says for each piece where its dashes are.
class DashPlaces {
  public:
    /// Calls visit(part) for the parts of a piece.
    template <typename Visit>
    void for_parts(std::size_t piece, const Visit& visit) const {
        if (end_[piece] == end_[piece + 1]) {
            visit(DashPart{0, 1, pieces_[piece].at_from, pieces_[piece].at_to});
        } else {
            for (std::size_t i = end_[piece]; i < end_[piece + 1]; ++i) visit(parts_[i]);
        }
    }

  private:
    friend class SharedDashes;
    std::vector<DashPiece> pieces_;
    std::vector<DashPart> parts_;  // of pieces that share dashes with others
    std::vector<std::size_t> end_{0};
};

/// SharedDashes gives lines that lie on each other on the screen the same dashes: what looks like one line is one
/// dashed line.
///
/// Chains come one after the other, and what lies on an earlier one's course takes over its dashes there. Where such a
/// course ends and other ones go on straight, the dashes run on along them, too. A chain of which no part lies on
/// another one keeps its own dashes to the bit, unless it goes on straight from one that does not.
class SharedDashes {
  public:
    /// `reach_px`: lines as close as that lie on each other.
    SharedDashes(PixelRect picture, double reach_px) : index_(picture, reach_px) {}
    /// The reach for a pen of a width: a quarter of it, where two lines cannot be told apart, and not less than a
    /// quarter of a pixel.
    static double reach_of_pen_px(double width_px);

    /// Lays out the dashes of chains of pieces, in the order of precedence: piece i of a chain ends where piece i + 1
    /// begins, each either way round. `chain_ends`: how many pieces there are up to the end of each chain. Chains of
    /// earlier calls come first and keep the dashes that they have.
    DashPlaces lay_out(std::vector<DashPiece> pieces, std::span<const std::size_t> chain_ends);

  private:
    /// A straight part of a line, and where its ends stand. No two lie on each other.
    struct Course {
        glm::dvec2 from, to;
        double at_from, at_to;
        bool is_shared = false;   // another line lies on it, or its own one lies on others elsewhere
        bool is_settled = false;  // it keeps the dashes that it has

        /// Where a place beside the course, or beyond it, stands along it.
        double at(glm::dvec2 place) const;
    };
    /// Pieces of a chain that are straight together.
    struct Stretch {
        std::size_t begin, end;  // pieces
        DashPiece way;
        std::size_t first_cover = 0, end_cover = 0;
    };
    struct Cover {
        double begin, end;
        std::uint32_t course;
    };
    struct Member {
        std::uint32_t course;
        bool is_backwards;
    };

    void add_stretches(std::span<const DashPiece> pieces, std::size_t begin, std::size_t end);
    void lay(Stretch& stretch);
    void run_on(std::uint32_t first);
    void extend(std::vector<Member>& run);
    void add_parts(const Stretch& stretch, DashPlaces& places) const;
    bool has_own_dashes(const Stretch& stretch) const;

    CourseIndex index_;
    std::vector<Course> courses_;  // numbered as in the index
    std::vector<bool> is_in_run_;
    std::vector<Stretch> stretches_;
    std::vector<Cover> covers_;
};

}  // namespace burin
