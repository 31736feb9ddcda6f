#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "image/image.h"

// Lines that lie on each other on the screen are found by place, so that they share their dashes.

namespace burin {

/// CourseIndex keeps straight courses of lines on the screen by place, and finds those that another line lies on, so
/// that both share their dashes. Only what is in the picture counts.
///
/// A place of a line lies on a course if it is beside it, within the reach, and both run nearly the same way: lines
/// that merely cross do not.
class CourseIndex {
  public:
    /// A part of a line that lies on a course, as shares of the line's way.
    struct Cover {
        double begin, end;
        std::uint32_t course;
    };

    /// `reach_px`: lines as close as that lie on each other.
    CourseIndex(PixelRect picture, double reach_px);

    double reach_px() const { return reach_px_; }
    /// Overlaps and gaps shorter than that are none.
    double shortest_px() const { return 0.25 * reach_px_; }

    /// Adds a course, in pixels. Courses count from 0.
    std::uint32_t add(glm::dvec2 from, glm::dvec2 to);

    /// The parts of the way between two places that lie on courses, in their order. Where several courses are, the one
    /// added first.
    std::span<const Cover> find(glm::dvec2 from, glm::dvec2 to);

    /// The courses of which an end may be within the reach of a place, in any order, some of them more than once.
    std::span<const std::uint32_t> that_end_near(glm::dvec2 place);

  private:
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};
    struct Course {
        glm::dvec2 from, to;
    };
    struct Entry {
        std::uint32_t course, next;
    };
    /// Square cells of the picture.
    struct Grid {
        int cell_px, columns, rows;
    };
    /// The first entry of each cell.
    using Cells = std::vector<std::uint32_t>;
    Grid grid_of(int smallest_px) const;
    void add_to(Cells& cells, const Grid& grid, std::size_t cell, std::uint32_t course);
    template <typename Visit>
    void for_courses(const Cells& cells, std::size_t cell, const Visit& visit) const;
    void note_end(glm::dvec2 place, std::uint32_t course);
    template <typename Visit>
    void for_cells(const Grid& grid, glm::dvec2 from, glm::dvec2 to, double around_px, const Visit& visit) const;
    void add_overlap(const Course& way, std::uint32_t course);
    void choose_first_courses();
    void drop_short(double length_px);

    PixelRect picture_;
    double reach_px_;
    Grid ways_, ends_;
    /// Courses are kept apart by direction: few of those that cross run nearly the same way. The last ones are too
    /// short to have one.
    static constexpr int kDirections = 16;
    static int direction_of(glm::dvec2 along);
    std::array<Cells, kDirections + 1> by_direction_;  // empty: none is there
    Cells by_end_;
    std::vector<Entry> entries_;
    std::vector<Course> courses_;
    std::vector<std::uint32_t> asked_;  // by which find() each course was looked at
    std::uint32_t find_count_ = 0;
    std::vector<Cover> overlaps_, covers_;
    std::vector<std::uint32_t> near_;
};

/// Calls visit(begin, end) for the parts of [0, 1] that are not covered.
template <typename Visit>
void for_uncovered(std::span<const CourseIndex::Cover> covers, const Visit& visit) {
    double begin = 0;
    for (const CourseIndex::Cover& cover : covers) {
        if (cover.begin > begin) visit(begin, cover.begin);
        begin = cover.end;
    }
    if (begin < 1) visit(begin, 1.0);
}

}  // namespace burin
