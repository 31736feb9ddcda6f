#include "kernels/place_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "image/half.h"

namespace burin {
namespace {

std::vector<const PlaceKernels*> all_place_kernels() {
    std::vector<const PlaceKernels*> all;
    for (const PlaceKernels* kernels : {&baseline_place_kernels(), avx2_place_kernels(), avx512_place_kernels()}) {
        if (kernels != nullptr) all.push_back(kernels);
    }
    return all;
}

constexpr std::size_t kMost = 64;
using Column = std::array<double, kMost + kRoomBehindPlaces>;

struct Columns {
    Column x{}, y{};
    std::array<Column, 3> position{}, normal{};
    PlaceView view(std::size_t begin, std::size_t count) {
        return {&x[begin],
                &y[begin],
                {&position[0][begin], &position[1][begin], &position[2][begin]},
                {&normal[0][begin], &normal[1][begin], &normal[2][begin]},
                count};
    }
};

/// One place after the other.
void place_slowly(const PlaceTriangle& t, Columns& columns, std::size_t i) {
    double weights[3], sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        weights[k] = t.weights[3 * k] + columns.x[i] * t.weights[3 * k + 1] + columns.y[i] * t.weights[3 * k + 2];
        if (weights[k] < 0) weights[k] = 0;
    }
    sum = weights[0] + weights[1] + weights[2];
    double scale = 1;
    if (sum > 0) {
        scale = 1 / sum;
    } else {
        std::fill(std::begin(weights), std::end(weights), 1.0 / 3);
    }
    const auto mean = [&](const double* of, std::size_t c) {
        return weights[0] * of[c] + weights[1] * of[3 + c] + weights[2] * of[6 + c];
    };
    const double n[3] = {mean(t.normals, 0), mean(t.normals, 1), mean(t.normals, 2)};
    const double length = std::max(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), 1e-300);
    for (std::size_t c = 0; c < 3; ++c) {
        columns.position[c][i] = mean(t.corners, c) * scale;
        columns.normal[c][i] = t.is_smooth ? n[c] * (1 / length) : t.normals[c];
    }
}

double cosine_slowly(const PlaceLight& light, const Columns& columns, std::size_t i) {
    double way[3];
    for (std::size_t c = 0; c < 3; ++c) way[c] = light.place[c] - (light.is_at_point ? columns.position[c][i] : 0);
    double cosine = columns.normal[0][i] * way[0] + columns.normal[1][i] * way[1] + columns.normal[2][i] * way[2];
    if (light.is_at_point) cosine /= std::max(std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]), 1e-300);
    return std::clamp(cosine, 0.0, 1.0);
}

TEST(PlaceKernels, AllSetsComputeTheBitsOfOnePlaceAfterTheOther) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-3, 5);
    std::uniform_int_distribution<std::size_t> length(1, 17);
    for (int round = 0; round < 200; ++round) {
        Columns right;
        for (std::size_t i = 0; i < kMost; ++i) right.x[i] = number(random), right.y[i] = number(random);
        std::vector<Columns> found(all_place_kernels().size(), right);
        double numbers[27];
        for (std::size_t begin = 0, end; begin < kMost; begin = end) {  // runs of places, as in a block
            end = std::min(begin + length(random), kMost);
            for (double& v : numbers) v = round % 10 == 9 ? 0 : number(random);
            const PlaceTriangle triangle{numbers, numbers + 9, numbers + 18, round % 2 == 0};
            for (std::size_t i = begin; i < end; ++i) place_slowly(triangle, right, i);
            for (std::size_t k = 0; k < found.size(); ++k)
                all_place_kernels()[k]->places(triangle, found[k].view(begin, end - begin));
        }
        const PlaceLight light{round % 3 == 0, {number(random), number(random), number(random)}};
        const double row[4] = {number(random), number(random), number(random), round % 2 == 0 ? -0.0 : 2.0};
        for (std::size_t k = 0; k < found.size(); ++k) {
            std::array<float, kMost + kRoomBehindPlaces> cosines, rows;
            all_place_kernels()[k]->cosines(light, found[k].view(0, kMost), cosines.data());
            all_place_kernels()[k]->rows(row, {right.x.data(), right.y.data(), right.position[0].data()}, kMost,
                                         rows.data());
            for (std::size_t i = 0; i < kMost; ++i) {
                for (std::size_t c = 0; c < 3; ++c) {
                    ASSERT_EQ(found[k].position[c][i], right.position[c][i]) << all_place_kernels()[k]->name;
                    ASSERT_EQ(found[k].normal[c][i], right.normal[c][i]) << all_place_kernels()[k]->name;
                }
                ASSERT_EQ(cosines[i], static_cast<float>(cosine_slowly(light, right, i)));
                ASSERT_EQ(rows[i], static_cast<float>(row[0] * right.x[i] + row[1] * right.y[i] +
                                                      row[2] * right.position[0][i] + row[3]));
            }
        }
    }
}

TEST(PlaceKernels, HalvesAreThoseOfOneNumberAfterTheOther) {
    std::vector<float> numbers = {0.0f,
                                  -0.0f,
                                  1.0f,
                                  -2.5f,
                                  65504.0f,
                                  65519.0f,
                                  1e9f,
                                  -1e9f,
                                  1e-7f,
                                  6.1e-5f,
                                  1e-40f,
                                  0.333f,
                                  std::numeric_limits<float>::infinity(),
                                  std::numeric_limits<float>::quiet_NaN()};
    std::mt19937 random(3);
    for (int i = 0; i < 1000; ++i)
        numbers.push_back(std::ldexp(static_cast<float>(random() % 4096) / 4096, static_cast<int>(random() % 50) - 30));
    const std::size_t count = numbers.size();
    numbers.resize(count + kRoomBehindHalves);
    for (const PlaceKernels* const kernels : all_place_kernels()) {
        std::vector<std::uint16_t> halves(count + kRoomBehindHalves);
        kernels->halves(numbers.data(), count, halves.data());
        for (std::size_t i = 0; i < count; ++i)
            ASSERT_EQ(halves[i], half_from_float(std::min(numbers[i], 65504.0f))) << kernels->name << numbers[i];
    }
}

}  // namespace
}  // namespace burin
