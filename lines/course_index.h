#pragma once

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

    /// The courses that may come within the reach of a place, in any order, some of them more than once.
    std::span<const std::uint32_t> around(glm::dvec2 place);

  private:
    static constexpr std::uint32_t kNone = ~std::uint32_t{0};
    struct Course {
        glm::dvec2 from, to;
    };
    struct Entry {
        std::uint32_t course, next;
    };
    template <typename Visit>
    void for_cells(glm::dvec2 from, glm::dvec2 to, double around_px, const Visit& visit) const;
    void add_overlap(const Course& way, std::uint32_t course);
    void choose_first_courses();
    void drop_short(double length_px);

    PixelRect picture_;
    double reach_px_;
    int cell_px_;
    int columns_, rows_;
    std::vector<std::uint32_t> first_;  // entry of each cell
    std::vector<Entry> entries_;
    std::vector<Course> courses_;
    std::vector<std::uint32_t> asked_;  // by which find() each course was looked at
    std::uint32_t find_count_ = 0;
    std::vector<Cover> overlaps_, covers_;
    std::vector<std::uint32_t> around_;
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
