#include "mesh/directed_segments.h"

#include <algorithm>
#include <cstddef>

#include "base/interrupt.h"

namespace burin {
namespace {

using Ends = DirectedSegments::Ends;

/// Directions as places on a cube, whose sides are cut into squares, with opposite ones together.
class DirectionCube {
  public:
    explicit DirectionCube(int squares_along_side) : along_side_(squares_along_side) {}

    std::size_t count() const { return 3 * squares(); }
    std::size_t class_of(const glm::dvec3& way) const {
        const int axis = longest(way);
        const double size = way[axis];
        if (size == 0) return 0;  // runs along nothing
        return static_cast<std::size_t>(axis) * squares() +
               static_cast<std::size_t>(along_side_) * place(way[(axis + 1) % 3] / size) +
               place(way[(axis + 2) % 3] / size);
    }

  private:
    std::size_t squares() const {
        return static_cast<std::size_t>(along_side_) * static_cast<std::size_t>(along_side_);
    }
    static int longest(const glm::dvec3& way) {
        const glm::dvec3 size = glm::abs(way);
        return size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    }
    std::size_t place(double share) const {
        return static_cast<std::size_t>(
            std::clamp(static_cast<int>(0.5 * (share + 1) * along_side_), 0, along_side_ - 1));
    }

    int along_side_;
};

/// Axes of which the first is a given one.
glm::dmat3 axes_with(const glm::dvec3& first) {
    const glm::dvec3 size = glm::abs(first);
    glm::dvec3 other(0.0);
    other[size.x <= size.y && size.x <= size.z ? 0 : (size.y <= size.z ? 1 : 2)] = 1;
    const glm::dvec3 second = glm::normalize(glm::cross(first, other));
    return {first, second, glm::cross(first, second)};
}

/// Axes along which boxes around segments of a class are thin: in the middle of their directions, and across those
/// where they spread the most, and the least. In a pile of sheets the last one is the way through the pile.
glm::dmat3 axes_of(std::span<const Ends> segments, std::span<const std::uint32_t> numbers) {
    std::vector<glm::dvec3> directions;
    glm::dvec3 sum(0.0);
    for (const std::uint32_t i : numbers) {
        const glm::dvec3 way = segments[i].b - segments[i].a;
        const double length = glm::length(way);
        if (!(length > 0)) continue;
        directions.push_back((glm::dot(way, sum) < 0 ? -1 : 1) / length * way);
        sum += directions.back();
    }
    if (directions.empty()) return glm::dmat3(1.0);
    const glm::dmat3 axes = axes_with(glm::normalize(sum));
    double uu = 0, uv = 0, vv = 0;
    for (const glm::dvec3& d : directions) {
        const double u = glm::dot(d, axes[1]), v = glm::dot(d, axes[2]);
        uu += u * u;
        uv += u * v;
        vv += v * v;
    }
    constexpr double kNoSpread = 1e-20;  // by rounding only
    if (uu + vv <= kNoSpread * static_cast<double>(directions.size())) return axes;
    const double angle = 0.5 * std::atan2(2 * uv, uu - vv), c = std::cos(angle), s = std::sin(angle);
    return {axes[0], c * axes[1] + s * axes[2], c * axes[2] - s * axes[1]};
}

/// How far a turned segment's box reaches beside the segment: the middle one of its extents.
double width_of_box(const Ends& s) {
    const glm::dvec3 size = glm::abs(s.b - s.a);
    return std::max(std::min(size.x, size.y), std::min(std::max(size.x, size.y), size.z));
}

/// The box around a piece of a turned segment. It is larger by what turning may have rounded.
SegmentPiece piece_of(const Ends& s, int k, int count, std::uint32_t number) {
    constexpr double kOfTurning = 1e-14;
    const glm::dvec3 from = glm::mix(s.a, s.b, static_cast<double>(k) / count),
                     to = glm::mix(s.a, s.b, static_cast<double>(k + 1) / count);
    const glm::dvec3 farthest = glm::max(glm::abs(from), glm::abs(to));
    const double around = kOfTurning * std::max({farthest.x, farthest.y, farthest.z});
    return piece_around(glm::min(from, to) - around, glm::max(from, to) + around, number);
}

/// The least cosine of the angle between the middle of a class and what may run along one of its directions.
double least_cosine_beside(double least_cosine) {
    constexpr double kOfAngles = 1e-6;
    const double sine = std::sqrt(std::max(1 - least_cosine * least_cosine, 0.0));
    const double sine_of_parallel = std::sqrt(1 - DirectedSegments::kCosParallel * DirectedSegments::kCosParallel);
    return DirectedSegments::kCosParallel * least_cosine - sine_of_parallel * sine - kOfAngles;
}

/// Numbers of segments by the class of their direction, without empty classes.
std::vector<std::vector<std::uint32_t>> by_direction(std::span<const Ends> segments) {
    // In a class there are so many segments that looking for it is worth it; and classes are no more than it takes: of
    // directions all over space, dozens run along an edge, and each has a tree to be looked at.
    constexpr double kPerSquare = 6;
    constexpr int kMostAlongSide = 8;
    constexpr std::size_t kMostClasses = 64;
    const auto wanted = static_cast<int>(std::cbrt(static_cast<double>(segments.size())) / kPerSquare);
    for (int along_side = std::clamp(wanted, 1, kMostAlongSide);; along_side /= 2) {
        const DirectionCube cube(along_side);
        std::vector<std::vector<std::uint32_t>> numbers(cube.count());
        for (std::uint32_t i = 0; i < segments.size(); ++i)
            numbers[cube.class_of(segments[i].b - segments[i].a)].push_back(i);
        std::erase_if(numbers, [](const auto& of_class) { return of_class.empty(); });
        if (numbers.size() <= kMostClasses || along_side == 1) return numbers;
    }
}

}  // namespace

DirectedSegments::DirectedSegments(std::span<const Ends> segments) {
    constexpr std::size_t kMostPerSegment = 16, kMostMore = std::size_t{1} << 20;
    const std::size_t most_more = std::min((kMostPerSegment - 1) * segments.size(), kMostMore);
    const std::vector<std::vector<std::uint32_t>> numbers = by_direction(segments);
    double width = 0;
    for (const std::vector<std::uint32_t>& of_class : numbers) {
        throw_if_interrupted();
        const glm::dmat3 turn = glm::transpose(axes_of(segments, of_class));
        classes_.push_back({turn, 0, {}});
        for (const std::uint32_t i : of_class) width += width_of_box({turn * segments[i].a, turn * segments[i].b});
    }
    // Pieces are cut so that their boxes are about equally wide.
    const double pieces_per_unit = width > 0 ? static_cast<double>(most_more) / width : 0;
    std::vector<SegmentPiece> pieces;
    for (std::size_t c = 0; c < classes_.size(); ++c) {
        throw_if_interrupted();
        const glm::dmat3& turn = classes_[c].turn;
        double least_cosine = 1;
        pieces.clear();
        for (const std::uint32_t i : numbers[c]) {
            const Ends turned{turn * segments[i].a, turn * segments[i].b};
            const glm::dvec3 way = turned.b - turned.a;
            const double length = glm::length(way);
            if (length > 0) least_cosine = std::min(least_cosine, std::abs(way.x) / length);
            const auto count = 1 + static_cast<int>(width_of_box(turned) * pieces_per_unit);
            for (int k = 0; k < count; ++k) pieces.push_back(piece_of(turned, k, count, i));
        }
        classes_[c].least_cosine = least_cosine_beside(least_cosine);
        classes_[c].tree = SegmentTree(pieces, SegmentTree::Cut::across_thin_boxes);
    }
}

}  // namespace burin
