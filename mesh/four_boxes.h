#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <limits>

// A tree asks which of four boxes are near something, two at a time.

namespace burin {

/// Two numbers, as a vector that every processor has.
using TwoDoubles [[gnu::vector_size(16)]] = double;
inline TwoDoubles two_of(double v) { return TwoDoubles{v, v}; }

/// Four boxes. One of which nothing was set is infinitely far from all places.
struct FourBoxes {
    static constexpr std::size_t kCount = 4;
    using Numbers = std::array<float, kCount>;
    using AreNear = std::array<bool, kCount>;
    struct Box {
        glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};
    };

    alignas(16) std::array<Numbers, 3> low = filled(std::numeric_limits<float>::infinity());
    alignas(16) std::array<Numbers, 3> high = filled(-std::numeric_limits<float>::infinity());

    void set(std::size_t k, const Box& box) {
        for (int axis = 0; axis < 3; ++axis) {
            low[static_cast<std::size_t>(axis)][k] = box.low[axis];
            high[static_cast<std::size_t>(axis)][k] = box.high[axis];
        }
    }

    /// Coordinates of the boxes `k` and k + 1.
    TwoDoubles two_of_low(std::size_t axis, std::size_t k) const { return two_of(low[axis], k); }
    TwoDoubles two_of_high(std::size_t axis, std::size_t k) const { return two_of(high[axis], k); }

  private:
    static TwoDoubles two_of(const Numbers& numbers, std::size_t k) {
        return TwoDoubles{static_cast<double>(numbers[k]), static_cast<double>(numbers[k + 1])};
    }
    static constexpr std::array<Numbers, 3> filled(float value) {
        const Numbers all{value, value, value, value};
        return {all, all, all};
    }
};

/// How far boxes are from a place.
class DistanceToBoxes {
  public:
    explicit DistanceToBoxes(const glm::dvec3& place) : place_(place) {}

    std::array<double, FourBoxes::kCount> squares(const FourBoxes& boxes) const {
        std::array<double, FourBoxes::kCount> squares;
        for (std::size_t k = 0; k < FourBoxes::kCount; k += 2) {
            TwoDoubles sum = two_of(0);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const int i = static_cast<int>(axis);
                const TwoDoubles before = boxes.two_of_low(axis, k) - place_[i],
                                 behind = place_[i] - boxes.two_of_high(axis, k);
                const TwoDoubles beyond = before > behind ? before : behind, outside = beyond > 0 ? beyond : two_of(0);
                sum += outside * outside;
            }
            squares[k] = sum[0];
            squares[k + 1] = sum[1];
        }
        return squares;
    }

  private:
    glm::dvec3 place_;
};

}  // namespace burin
