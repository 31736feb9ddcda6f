#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

// Places on surfaces that are shaded pixel by pixel, many at a time.

namespace burin {

/// A triangle as ShadedTriangle has it: of each corner, three numbers.
struct PlaceTriangle {
    const double* weights;  ///< before division, on the screen: of[0] + x of[1] + y of[2]
    const double* corners;
    const double* normals;
    bool is_smooth;  ///< else the first corner's normal is that of all places
};

/// Places, number by number. Loops write up to kRoomBehindPlaces numbers behind the last one.
struct PlaceView {
    const double *x, *y;  ///< in pixels
    double* position[3];
    double* normal[3];
    std::size_t count;
};
constexpr std::size_t kRoomBehindPlaces = 8;

/// What places have of one light.
struct PlaceLight {
    bool is_at_point;
    double place[3];  ///< its position, or the unit vector towards it
};

/// The loops for one set of vector instructions. All sets compute the same bits, those of ShadedTriangle::at() and of
/// ViewLight::cosine().
struct PlaceKernels {
    std::string_view name;
    void (*places)(const PlaceTriangle& triangle, const PlaceView& places);
    /// The cosine between a normal and the way to a light, 0 to 1. Reads the places, and writes `to`, as places() does.
    void (*cosines)(const PlaceLight& light, const PlaceView& places, float* to);
    /// row[0] x + row[1] y + row[2] z + row[3] of columns x, y, z.
    void (*rows)(const double (&row)[4], const double* const (&columns)[3], std::size_t count, float* to);
    /// Half precision, to the nearest, at most 65504, as Film::to_half() has it. Room behind it as of places().
    void (*halves)(const float* from, std::size_t count, std::uint16_t* to);
};
/// halves() writes so many numbers at once.
constexpr std::size_t kRoomBehindHalves = 16;

const PlaceKernels& baseline_place_kernels();
/// nullptr where this build or this machine has none.
const PlaceKernels* avx2_place_kernels();
const PlaceKernels* avx512_place_kernels();
/// The fastest ones that this machine has and allowed_instruction_set() permits.
const PlaceKernels& best_place_kernels();

}  // namespace burin
