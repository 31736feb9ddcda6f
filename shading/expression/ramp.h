#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// A ramp is a curve through stops.

namespace burin {

struct RampStop {
    float at;
    std::array<float, 3> value;  ///< a colour, linear RGB, or a number in the first one
};

enum class RampBetween : std::uint8_t {
    linear,
    smooth,  ///< level at each stop
    step,    ///< a stop's value up to the next one
    curve,   ///< monotone between stops (Fritsch and Carlson 1980)
};
enum class RampOutside : std::uint8_t { hold, repeat, mirror };

struct Ramp {
    std::vector<RampStop> stops;
    bool is_color = false;
    RampBetween between = RampBetween::linear;
    RampOutside outside = RampOutside::hold;
};

constexpr std::size_t kMostRampStops = 64;

/// Why a ramp cannot be: stops that are missing, do not ascend, are too many or too large.
std::optional<std::string> fault_of_ramp(const Ramp& ramp);

/// The table of ExpressionOperation::ramp for a component. The ramp must have no fault.
std::vector<float> ramp_table(const Ramp& ramp, std::size_t component);

}  // namespace burin
