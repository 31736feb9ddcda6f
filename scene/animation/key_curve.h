#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace burin {

/// How a value goes from one key to the next.
enum class Interpolation : std::uint8_t {
    smooth,  ///< cubic, without a bend at the keys
    linear,
    step,  ///< it stays until the next key
};

/// A value that is given at some frames, and held before the first and behind the last of them. T: a number or a
/// vector.
template <typename T>
class KeyCurve {
  public:
    /// Frames ascend.
    void add(double frame, const T& value) {
        frames_.push_back(frame);
        values_.push_back(value);
    }
    bool empty() const { return frames_.empty(); }
    /// Whether there are two keys whose values are not the same.
    bool moves() const {
        return std::any_of(values_.begin(), values_.end(), [&](const T& value) { return value != values_.front(); });
    }

    /// The value at a frame; there must be a key. At the frame of a key it is exactly the key's.
    T at(double frame, Interpolation interpolation) const {
        const auto next = std::upper_bound(frames_.begin(), frames_.end(), frame);
        if (next == frames_.begin()) return values_.front();
        if (next == frames_.end()) return values_.back();
        const auto k = static_cast<std::size_t>(next - frames_.begin()) - 1;
        const double length = frames_[k + 1] - frames_[k], u = (frame - frames_[k]) / length;
        if (interpolation == Interpolation::step || u == 0) return values_[k];
        if (interpolation == Interpolation::linear) return values_[k] + (values_[k + 1] - values_[k]) * u;
        const double v = 1 - u;  // Hermite's cubic
        return values_[k] * ((1 + 2 * u) * v * v) + tangent(k) * (length * u * v * v) +
               values_[k + 1] * (u * u * (3 - 2 * u)) - tangent(k + 1) * (length * u * u * v);
    }

  private:
    /// Per frame; the chord of the neighbours, one-sided at the ends.
    T tangent(std::size_t k) const {
        const std::size_t from = k == 0 ? 0 : k - 1, to = std::min(k + 1, frames_.size() - 1);
        return (values_[to] - values_[from]) / (frames_[to] - frames_[from]);
    }

    std::vector<double> frames_;
    std::vector<T> values_;
};

}  // namespace burin
