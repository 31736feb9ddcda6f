#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace burin::test {

/// A small generator whose sequence is the same everywhere (PCG32, O'Neill 2014). Tests seed it with
/// the number of the trial, so that a failing trial can be run alone.
class Random {
  public:
    explicit Random(std::uint64_t seed);
    std::uint32_t bits();
    std::uint64_t bits64() { return std::uint64_t{bits()} << 32 | bits(); }
    /// Uniform in [low, high].
    int integer(int low, int high);
    /// Uniform in [low, high).
    double real(double low, double high);
    glm::dvec3 in_box(double half_size);
    /// Uniform on the unit sphere.
    glm::dvec3 direction();

  private:
    std::uint64_t state_;
};

}  // namespace burin::test
