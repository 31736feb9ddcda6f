#include "lines/shared_dashes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/vectors.h"

namespace burin {
namespace {

constexpr double kFinestReachPx = 0.25;
/// The cosine of the angle at which one course goes on straight from another, at least.
constexpr double kStraight = 0.99;

/// A straight way that is made longer piece by piece, for as long as all of them stay within a reach of it.
class StraightWay {
  public:
    StraightWay(glm::dvec2 from, glm::dvec2 to, double reach_px)
        : from_(from), along_(to - from), reach_px_(reach_px), length_(glm::length(along_)) {
        if (length_ > 0) along_ /= length_;
        narrow(length_, 0);
    }
    glm::dvec2 direction() const { return along_; }
    /// Goes on to a place, if it can; returns whether it did.
    bool go_on(glm::dvec2 to) {
        const double along = glm::dot(to - from_, along_), across = cross(along_, to - from_);
        if (!fits(along, across)) return false;
        length_ = along;
        narrow(along, across);
        return true;
    }
    bool could_go_on(glm::dvec2 to) const { return fits(glm::dot(to - from_, along_), cross(along_, to - from_)); }

  private:
    bool fits(double along, double across) const {
        return along > length_ && across >= low_ * along && across <= high_ * along;
    }
    void narrow(double along, double across) {
        if (!(along > 0)) return;
        low_ = std::max(low_, (across - reach_px_) / along);
        high_ = std::min(high_, (across + reach_px_) / along);
    }

    glm::dvec2 from_, along_;
    double reach_px_, length_;
    double low_ = -std::numeric_limits<double>::infinity(), high_ = std::numeric_limits<double>::infinity();
};

/// The piece with its ends in the order of their chain.
DashPiece forwards(const DashPiece& p) {
    return p.at_from <= p.at_to ? p : DashPiece{p.to, p.from, p.at_to, p.at_from};
}

}  // namespace

double SharedDashes::reach_of_pen_px(double width_px) { return kFinestReachPx * std::max(1.0, width_px); }

double SharedDashes::Course::at(glm::dvec2 place) const {
    const glm::dvec2 along = to - from;
    return at_from + (at_to - at_from) * (glm::dot(place - from, along) / glm::dot(along, along));
}

void SharedDashes::add_stretches(std::span<const DashPiece> pieces, std::size_t begin, std::size_t end) {
    while (begin < end) {
        Stretch stretch{begin, begin + 1, forwards(pieces[begin])};
        StraightWay way(stretch.way.from, stretch.way.to, index_.shortest_px());
        while (stretch.end < end) {
            const DashPiece next = forwards(pieces[stretch.end]);
            if (next.from != stretch.way.to || !way.go_on(next.to)) break;
            stretch.way.to = next.to;
            stretch.way.at_to = next.at_to;
            ++stretch.end;
        }
        begin = stretch.end;
        stretches_.push_back(stretch);
    }
}

/// Finds on which courses a stretch lies; the rest of it makes courses of its own.
void SharedDashes::lay(Stretch& stretch) {
    const DashPiece& way = stretch.way;
    const double length = glm::distance(way.from, way.to), shortest = 4 * index_.reach_px();
    stretch.first_cover = stretch.end_cover = covers_.size();
    const std::span<const CourseIndex::Cover> found = index_.find(way.from, way.to);
    if (found.empty() && length < shortest) return;
    const auto lay_own = [&](double begin, double end) {
        Course own{glm::mix(way.from, way.to, begin), glm::mix(way.from, way.to, end),
                   std::lerp(way.at_from, way.at_to, begin), std::lerp(way.at_from, way.at_to, end)};
        own.is_shared = !found.empty();
        courses_.push_back(own);
        covers_.push_back({begin, end, index_.add(own.from, own.to)});
    };
    double begin = 0;
    for (const CourseIndex::Cover& cover : found) {
        courses_[cover.course].is_shared = true;
        const bool has_gap = (cover.begin - begin) * length >= shortest;
        if (has_gap) lay_own(begin, cover.begin);
        if (!has_gap && begin > 0) covers_.back().end = cover.begin;
        covers_.push_back({has_gap || begin > 0 ? cover.begin : 0.0, cover.end, cover.course});
        begin = cover.end;
    }
    if (found.empty() || (1 - begin) * length >= shortest) {
        lay_own(begin, 1);
    } else {
        covers_.back().end = 1;
    }
    stretch.end_cover = covers_.size();
}

/// Adds courses that go on straight from the end of a run.
void SharedDashes::extend(std::vector<Member>& run) {
    const auto end_of = [&](const Member& m, bool is_far) {
        const Course& c = courses_[m.course];
        return m.is_backwards != is_far ? c.to : c.from;
    };
    StraightWay way(end_of(run.front(), false), end_of(run.back(), true), index_.reach_px());
    for (;;) {
        const glm::dvec2 end = end_of(run.back(), true);
        Member next{~std::uint32_t{0}, false};
        for (const std::uint32_t course : index_.that_end_near(end)) {
            if (course >= next.course || is_in_run_[course]) continue;
            for (const bool is_backwards : {false, true}) {
                const Member m{course, is_backwards};
                const glm::dvec2 near = end_of(m, false), far = end_of(m, true);
                const bool is_straight = glm::dot(far - near, way.direction()) >= kStraight * glm::distance(near, far);
                if (is_straight && glm::distance(near, end) <= index_.reach_px() && way.could_go_on(far)) next = m;
            }
        }
        if (next.course >= courses_.size()) return;
        run.push_back(next);
        is_in_run_[next.course] = true;
        if (courses_[next.course].is_settled || !way.go_on(end_of(next, true))) return;
    }
}

/// The dashes of the first course of a straight run go on along all of it.
void SharedDashes::run_on(std::uint32_t first) {
    std::vector<Member> run{{first, false}};
    is_in_run_[first] = true;
    extend(run);
    std::reverse(run.begin(), run.end());
    for (Member& m : run) m.is_backwards = !m.is_backwards;
    extend(run);
    std::size_t giver = 0;
    for (std::size_t i = 0; i < run.size(); ++i) {
        const bool is_settled = courses_[run[i].course].is_settled,
                   was_settled = courses_[run[giver].course].is_settled;
        if (is_settled != was_settled ? is_settled : run[i].course < run[giver].course) giver = i;
    }
    const auto take_over = [&](std::size_t from, std::size_t i) {
        const Course& given = courses_[run[from].course];
        Course& own = courses_[run[i].course];
        if (own.is_settled) return;
        const double at_from = given.at(own.from), at_to = given.at(own.to);
        own.at_from = at_from;
        own.at_to = at_to;
    };
    for (std::size_t i = giver + 1; i < run.size(); ++i) take_over(i - 1, i);
    for (std::size_t i = giver; i-- > 0;) take_over(i + 1, i);
    for (const Member& m : run) {
        courses_[m.course].is_settled = true;
        is_in_run_[m.course] = false;
    }
}

bool SharedDashes::has_own_dashes(const Stretch& stretch) const {
    if (stretch.first_cover == stretch.end_cover) return true;
    const Course& course = courses_[covers_[stretch.first_cover].course];
    const DashPiece& way = stretch.way;
    return stretch.end_cover - stretch.first_cover == 1 && course.from == way.from && course.to == way.to &&
           course.at_from == way.at_from && course.at_to == way.at_to;
}

void SharedDashes::add_parts(const Stretch& stretch, DashPlaces& places) const {
    const bool is_own = has_own_dashes(stretch);
    const glm::dvec2 along = stretch.way.to - stretch.way.from;
    const auto share_of = [&](glm::dvec2 place) {
        return glm::dot(place - stretch.way.from, along) / glm::dot(along, along);
    };
    for (std::size_t p = stretch.begin; p < stretch.end; ++p) {
        const DashPiece& piece = places.pieces_[p];
        if (!is_own) {
            const double a = share_of(piece.from), b = share_of(piece.to);
            for (std::size_t i = stretch.first_cover; i < stretch.end_cover; ++i) {
                const Cover& cover = covers_[i];
                // The ends of pieces may be a little beyond those of their stretch.
                const double begin = std::max(std::min(a, b), i == stretch.first_cover ? std::min(a, b) : cover.begin);
                const double end = std::min(std::max(a, b), i + 1 == stretch.end_cover ? std::max(a, b) : cover.end);
                if (!(begin < end)) continue;
                const double s = (begin - a) / (b - a), t = (end - a) / (b - a);
                DashPart part{std::min(s, t), std::max(s, t)};
                part.at_begin = courses_[cover.course].at(glm::mix(piece.from, piece.to, part.begin));
                part.at_end = courses_[cover.course].at(glm::mix(piece.from, piece.to, part.end));
                places.parts_.push_back(part);
            }
        }
        places.end_.push_back(places.parts_.size());
    }
}

DashPlaces SharedDashes::lay_out(std::vector<DashPiece> pieces, std::span<const std::size_t> chain_ends) {
    const std::size_t given = courses_.size();
    stretches_.clear();
    covers_.clear();
    std::size_t begin = 0;
    for (const std::size_t end : chain_ends) {
        add_stretches(pieces, begin, end);
        begin = end;
    }
    for (Stretch& stretch : stretches_) lay(stretch);
    is_in_run_.assign(courses_.size(), false);
    for (std::size_t i = given; i < courses_.size(); ++i) {
        if (courses_[i].is_shared && !courses_[i].is_settled) run_on(static_cast<std::uint32_t>(i));
    }
    for (std::size_t i = given; i < courses_.size(); ++i) courses_[i].is_settled = true;
    DashPlaces places;
    places.pieces_ = std::move(pieces);
    for (const Stretch& stretch : stretches_) add_parts(stretch, places);
    return places;
}

}  // namespace burin
