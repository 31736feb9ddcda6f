#include "tests/support/random.h"

#include <cmath>
#include <numbers>

namespace burin::test {

Random::Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 0x853C49E6748FEA9Bu) { bits(); }

std::uint32_t Random::bits() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005u + 1442695040888963407u;
    const auto shifted = static_cast<std::uint32_t>((old >> 18 ^ old) >> 27);
    const auto turn = static_cast<std::uint32_t>(old >> 59);
    return shifted >> turn | shifted << (-turn & 31u);
}

int Random::integer(int low, int high) {
    const auto range = static_cast<std::uint64_t>(high - low + 1);
    return low + static_cast<int>(std::uint64_t{bits()} * range >> 32);
}

double Random::real(double low, double high) { return low + (high - low) * (bits() * 0x1p-32); }

glm::dvec3 Random::in_box(double half_size) {
    const double x = real(-half_size, half_size), y = real(-half_size, half_size);
    return {x, y, real(-half_size, half_size)};
}

glm::dvec3 Random::direction() {
    const double z = real(-1, 1);
    const double angle = real(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace burin::test
