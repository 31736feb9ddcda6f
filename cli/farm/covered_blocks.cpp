#include "cli/farm/covered_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "base/interrupt.h"
#include "render/film.h"

namespace burin {
namespace {

/// The blocks of a picture, which triangles are put into.
class Blocks {
  public:
    explicit Blocks(PixelRect area)
        : area_(area),
          columns_((area.width() + Film::kBlockColumns - 1) / Film::kBlockColumns),
          rows_((area.height() + Film::kBandRows - 1) / Film::kBandRows),
          has_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false) {}

    /// The number of the block that a place in pixels lies in, or kOutside.
    std::int32_t number_of(glm::dvec2 place) const {
        const int column = at((place.x - area_.x0) / Film::kBlockColumns, columns_), row = row_at(place.y);
        return column < 0 || row < 0 || column >= columns_ || row >= rows_ ? kOutside : row * columns_ + column;
    }
    static constexpr std::int32_t kOutside = -1;
    void put(std::int32_t number) { has_[static_cast<std::size_t>(number)] = true; }

    /// Corners in pixels.
    void put(const std::array<glm::dvec2, 4>& corners, std::size_t count) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t i = 0; i < count; ++i) {
            low = std::min(low, corners[i].y);
            high = std::max(high, corners[i].y);
        }
        const int first = row_at(low), last = row_at(high);
        for (int row = std::max(first, 0); row <= std::min(last, rows_ - 1); ++row) put(corners, count, row);
    }

    CoveredBlocks covered() const {
        CoveredBlocks covered;
        for (int row = 0; row < rows_; ++row) {
            const auto begin = has_.begin() + std::ptrdiff_t{row} * columns_;
            constexpr std::uint64_t kPixels = std::uint64_t{Film::kBandRows} * Film::kBlockColumns;
            const std::uint64_t pixels =
                kPixels * static_cast<std::uint64_t>(std::count(begin, begin + columns_, true));
            covered.pixels += pixels;
            covered.band_pixels = std::max(covered.band_pixels, pixels);
        }
        return covered;
    }

  private:
    int row_at(double y) const { return at((y - area_.y0) / Film::kBandRows, rows_); }
    static int at(double place, int count) {
        return static_cast<int>(std::clamp(std::floor(place), -1.0, static_cast<double>(count)));
    }

    /// What of a polygon lies in one row of blocks.
    void put(const std::array<glm::dvec2, 4>& corners, std::size_t count, int row) {
        const double top = area_.y0 + static_cast<double>(row) * Film::kBandRows, bottom = top + Film::kBandRows;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec2 a = corners[i], b = corners[(i + 1) % count];
            const double dy = b.y - a.y;
            double from = 0, to = 1;
            if (dy != 0) {
                from = std::clamp(((dy > 0 ? top : bottom) - a.y) / dy, 0.0, 1.0);
                to = std::clamp(((dy > 0 ? bottom : top) - a.y) / dy, 0.0, 1.0);
            }
            if (std::max(a.y, b.y) < top || std::min(a.y, b.y) > bottom) continue;
            for (const double t : {from, to}) {
                low = std::min(low, a.x + t * (b.x - a.x));
                high = std::max(high, a.x + t * (b.x - a.x));
            }
        }
        const int first = at((low - area_.x0) / Film::kBlockColumns, columns_),
                  last = at((high - area_.x0) / Film::kBlockColumns, columns_);
        for (int column = std::max(first, 0); column <= std::min(last, columns_ - 1); ++column)
            has_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column)] = true;
    }

    PixelRect area_;
    int columns_, rows_;
    std::vector<bool> has_;
};

}  // namespace

CoveredBlocks covered_blocks(const Frame& frame) {
    constexpr std::size_t kTrianglesAtOnce = 1 << 16;
    Blocks blocks(frame.crop);
    const glm::dmat4 to_view = frame.camera.to_view();
    // What is nearer to the eye is left out: it would be cut off far beyond the picture's sides.
    constexpr double kNear = 0x1p-20;
    std::vector<glm::dvec3> places;
    std::vector<std::int32_t> numbers;  // of each place's block
    for (const SceneObject& object : frame.scene->objects) {
        throw_if_interrupted();
        const Mesh& mesh = frame.scene->meshes[object.mesh];
        const glm::dmat4 object_to_view = to_view * object.to_world;
        places.resize(mesh.positions.size());
        double farthest = 0;
        for (std::uint32_t v = 0; v < places.size(); ++v) {
            places[v] = glm::dvec3(object_to_view * glm::dvec4(mesh.position(v), 1.0));
            farthest = std::max(farthest, -places[v].z);
        }
        const Projection projection = frame.camera.projection(frame.width, frame.height, kNear * farthest);
        const double near_z = projection.orthographic ? std::numeric_limits<double>::infinity() : -kNear * farthest;
        if (!projection.orthographic && !(farthest > 0)) continue;
        numbers.assign(places.size(), Blocks::kOutside);
        for (std::size_t v = 0; v < places.size(); ++v) {
            if (places[v].z <= near_z) numbers[v] = blocks.number_of(projection.to_pixel(places[v]));
        }
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            if (t % kTrianglesAtOnce == 0) throw_if_interrupted();
            const auto& triangle = mesh.triangles[t];
            const std::int32_t number = numbers[triangle[0]];
            if (number != Blocks::kOutside && number == numbers[triangle[1]] &&
                number == numbers[triangle[2]]) {  // mostly
                blocks.put(number);
                continue;
            }
            std::array<glm::dvec2, 4> corners;
            std::size_t count = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 &a = places[triangle[k]], &b = places[triangle[(k + 1) % 3]];
                if (a.z <= near_z) corners[count++] = projection.to_pixel(a);
                if ((a.z <= near_z) == (b.z <= near_z)) continue;
                corners[count++] = projection.to_pixel(glm::mix(a, b, (near_z - a.z) / (b.z - a.z)));
            }
            if (count > 0) blocks.put(corners, count);
        }
    }
    return blocks.covered();
}

}  // namespace burin
