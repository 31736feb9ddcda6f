#include <array>
#include <cstddef>

#include "mesh/shapes.h"

namespace burin {
namespace {

/// Newell's teapot has three symmetric parts: a quarter of the round body (mirrored in X and Y) and
/// half of the handle and the spout (mirrored in Y). Z is up in this data.
struct Patch {
    bool is_quarter;                      ///< mirrored in X and Y, else in Y alone
    std::array<std::uint8_t, 16> points;  ///< numbers into kControlPoints, four rows of four
};

// clang-format off
constexpr Patch kPatches[] = {
    {true,  {102, 103, 104, 105,   4,   5,   6,   7,   8,   9,  10,  11,  12,  13,  14,  15}},  // rim
    {true,  { 12,  13,  14,  15,  16,  17,  18,  19,  20,  21,  22,  23,  24,  25,  26,  27}},  // body
    {true,  { 24,  25,  26,  27,  29,  30,  31,  32,  33,  34,  35,  36,  37,  38,  39,  40}},
    {true,  { 96,  96,  96,  96,  97,  98,  99, 100, 101, 101, 101, 101,   0,   1,   2,   3}},  // lid
    {true,  {  0,   1,   2,   3, 106, 107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 117}},
    {true,  {118, 118, 118, 118, 124, 122, 119, 121, 123, 126, 125, 120,  40,  39,  38,  37}},  // bottom
    {false, { 41,  42,  43,  44,  45,  46,  47,  48,  49,  50,  51,  52,  53,  54,  55,  56}},  // handle
    {false, { 53,  54,  55,  56,  57,  58,  59,  60,  61,  62,  63,  64,  28,  65,  66,  67}},
    {false, { 68,  69,  70,  71,  72,  73,  74,  75,  76,  77,  78,  79,  80,  81,  82,  83}},  // spout
    {false, { 80,  81,  82,  83,  84,  85,  86,  87,  88,  89,  90,  91,  92,  93,  94,  95}},
};

constexpr double kControlPoints[127][3] = {
    {0.2, 0, 2.7}, {0.2, -0.112, 2.7}, {0.112, -0.2, 2.7}, {0, -0.2, 2.7},
    {1.3375, 0, 2.53125}, {1.3375, -0.749, 2.53125}, {0.749, -1.3375, 2.53125}, {0, -1.3375, 2.53125},
    {1.4375, 0, 2.53125}, {1.4375, -0.805, 2.53125}, {0.805, -1.4375, 2.53125}, {0, -1.4375, 2.53125},
    {1.5, 0, 2.4}, {1.5, -0.84, 2.4}, {0.84, -1.5, 2.4}, {0, -1.5, 2.4},
    {1.75, 0, 1.875}, {1.75, -0.98, 1.875}, {0.98, -1.75, 1.875}, {0, -1.75, 1.875},
    {2, 0, 1.35}, {2, -1.12, 1.35}, {1.12, -2, 1.35}, {0, -2, 1.35},
    {2, 0, 0.9}, {2, -1.12, 0.9}, {1.12, -2, 0.9}, {0, -2, 0.9},
    {-2, 0, 0.9},
    {2, 0, 0.45}, {2, -1.12, 0.45}, {1.12, -2, 0.45}, {0, -2, 0.45},
    {1.5, 0, 0.225}, {1.5, -0.84, 0.225}, {0.84, -1.5, 0.225}, {0, -1.5, 0.225},
    {1.5, 0, 0.15}, {1.5, -0.84, 0.15}, {0.84, -1.5, 0.15}, {0, -1.5, 0.15},
    {-1.6, 0, 2.025}, {-1.6, -0.3, 2.025}, {-1.5, -0.3, 2.25}, {-1.5, 0, 2.25},
    {-2.3, 0, 2.025}, {-2.3, -0.3, 2.025}, {-2.5, -0.3, 2.25}, {-2.5, 0, 2.25},
    {-2.7, 0, 2.025}, {-2.7, -0.3, 2.025}, {-3, -0.3, 2.25}, {-3, 0, 2.25},
    {-2.7, 0, 1.8}, {-2.7, -0.3, 1.8}, {-3, -0.3, 1.8}, {-3, 0, 1.8},
    {-2.7, 0, 1.575}, {-2.7, -0.3, 1.575}, {-3, -0.3, 1.35}, {-3, 0, 1.35},
    {-2.5, 0, 1.125}, {-2.5, -0.3, 1.125}, {-2.65, -0.3, 0.9375}, {-2.65, 0, 0.9375},
    {-2, -0.3, 0.9}, {-1.9, -0.3, 0.6}, {-1.9, 0, 0.6},
    {1.7, 0, 1.425}, {1.7, -0.66, 1.425}, {1.7, -0.66, 0.6}, {1.7, 0, 0.6},
    {2.6, 0, 1.425}, {2.6, -0.66, 1.425}, {3.1, -0.66, 0.825}, {3.1, 0, 0.825},
    {2.3, 0, 2.1}, {2.3, -0.25, 2.1}, {2.4, -0.25, 2.025}, {2.4, 0, 2.025},
    {2.7, 0, 2.4}, {2.7, -0.25, 2.4}, {3.3, -0.25, 2.4}, {3.3, 0, 2.4},
    {2.8, 0, 2.475}, {2.8, -0.25, 2.475}, {3.525, -0.25, 2.49375}, {3.525, 0, 2.49375},
    {2.9, 0, 2.475}, {2.9, -0.15, 2.475}, {3.45, -0.15, 2.5125}, {3.45, 0, 2.5125},
    {2.8, 0, 2.4}, {2.8, -0.15, 2.4}, {3.2, -0.15, 2.4}, {3.2, 0, 2.4},
    {0, 0, 3.15}, {0.8, 0, 3.15}, {0.8, -0.45, 3.15}, {0.45, -0.8, 3.15}, {0, -0.8, 3.15}, {0, 0, 2.85},
    {1.4, 0, 2.4}, {1.4, -0.784, 2.4}, {0.784, -1.4, 2.4}, {0, -1.4, 2.4},
    {0.4, 0, 2.55}, {0.4, -0.224, 2.55}, {0.224, -0.4, 2.55}, {0, -0.4, 2.55},
    {1.3, 0, 2.55}, {1.3, -0.728, 2.55}, {0.728, -1.3, 2.55}, {0, -1.3, 2.55},
    {1.3, 0, 2.4}, {1.3, -0.728, 2.4}, {0.728, -1.3, 2.4}, {0, -1.3, 2.4},
    {0, 0, 0}, {1.425, -0.798, 0}, {1.5, 0, 0.075}, {1.425, 0, 0}, {0.798, -1.425, 0},
    {0, -1.5, 0.075}, {0, -1.425, 0}, {1.5, -0.84, 0.075}, {0.84, -1.5, 0.075},
};
// clang-format on

/// Cubic Bernstein weights at i / n. Both ends of a curve get mirrored weights to the bit.
std::array<double, 4> bernstein(int i, int n) {
    const double u = static_cast<double>(i) / n;
    const double v = static_cast<double>(n - i) / n;
    return {v * v * v, 3 * (u * (v * v)), 3 * (v * (u * u)), u * u * u};
}

/// A sum that does not depend on the direction in which a shared boundary is walked.
glm::dvec3 symmetric_sum(const std::array<glm::dvec3, 4>& p, const std::array<double, 4>& w) {
    return (w[0] * p[0] + w[3] * p[3]) + (w[1] * p[1] + w[2] * p[2]);
}

void add_patch(const Patch& patch, bool mirror_x, bool mirror_y, int n, PolygonSoup& soup) {
    std::array<std::array<glm::dvec3, 4>, 4> control;
    for (std::size_t i = 0; i < 16; ++i) {
        const double* const c = kControlPoints[patch.points[i]];
        // Z up becomes Y up: (x, y, z) -> (x, z, -y).
        control[i / 4][i % 4] = {mirror_x ? -c[0] : c[0], c[2], mirror_y ? c[1] : -c[1]};
    }
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (int r = 0; r <= n; ++r) {
        for (int c = 0; c <= n; ++c) {
            std::array<glm::dvec3, 4> along;
            for (std::size_t k = 0; k < 4; ++k) along[k] = symmetric_sum(control[k], bernstein(c, n));
            soup.positions.push_back(symmetric_sum(along, bernstein(r, n)));
        }
    }
    const bool turned = mirror_x != mirror_y;  // one reflection turns the winding
    const auto row = static_cast<std::uint32_t>(n + 1);
    for (std::uint32_t r = 0; r + 1 < row; ++r) {
        for (std::uint32_t c = 0; c + 1 < row; ++c) {
            const std::uint32_t a = first + r * row + c;
            const std::uint32_t quad[4] = {a, turned ? a + row : a + 1, a + row + 1, turned ? a + 1 : a + row};
            soup.add_polygon(quad);
        }
    }
}

}  // namespace

PolygonSoup make_teapot(int tessellation) {
    PolygonSoup soup;
    soup.object_names = {"teapot"};
    soup.materials = {Material{}};
    for (const Patch& patch : kPatches) {
        for (const bool mirror_y : {false, true}) {
            add_patch(patch, false, mirror_y, tessellation, soup);
            if (patch.is_quarter) add_patch(patch, true, mirror_y, tessellation, soup);
        }
    }
    return soup;
}

}  // namespace burin
