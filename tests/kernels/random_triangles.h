#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "abuffer/samples/sample_tile.h"
#include "kernels/tile_kernels.h"
#include "tests/support/random.h"
#include "view/scan_convert.h"

/// Random triangles around a tile, and what kernels do with them, done slowly.
namespace burin::test {

/// Triangles around a tile, of all sizes and orders of corners.
struct Triangles {
    explicit Triangles(std::uint64_t seed, int samples_per_pixel, int first_column, int first_row) {
        Random random(seed);
        const int pitch = kSubpixelsPerPixel / samples_per_pixel;
        for (int i = 0; i < 301; ++i) {
            const int x = first_column * pitch + random.integer(-3 * pitch, 130 * pitch);
            const int y = first_row * pitch + random.integer(-3 * pitch, 130 * pitch);
            const int size = std::min(1 << random.integer(3, 12), kLargestSmallTriangle / 2 - 256);
            for (int k = 0; k < 3; ++k) {
                corners.push_back(static_cast<std::uint32_t>(vertices.size()));
                // Every fourth triangle has corners exactly on samples.
                const int mask = i % 4 == 0 ? ~(pitch - 1) : ~0;
                const int shift = i % 4 == 0 ? pitch / 2 : 0;
                vertices.push_back({((x + random.integer(-size, size)) & mask) + shift,
                                    ((y + random.integer(-size, size)) & mask) + shift,
                                    static_cast<float>(random.integer(0, 40)) * 0.125f});
            }
        }
        facing.resize(count());
        mesh.vertices = vertices.data();
        mesh.corners = corners.data();
        mesh.first_number = 1000;
        mesh.facing = facing.data();
        line_edges.assign(facing.size(), 7);
        mesh.line_edges = line_edges.data();
    }
    std::uint32_t count() const { return static_cast<std::uint32_t>(corners.size() / 3); }
    const ScreenVertex& corner(std::uint32_t t, std::uint32_t k) const { return vertices[corners[3 * t + k]]; }
    std::int64_t area(std::uint32_t t) const { return doubled_area(corner(t, 0), corner(t, 1), corner(t, 2)); }

    std::vector<ScreenVertex> vertices;
    std::vector<std::uint32_t> corners;
    std::vector<std::uint8_t> facing, line_edges;
    ScreenMesh mesh;
};

inline SampleView view_of(SampleTile& tile) {
    return {tile.nearness.data(),
            tile.ids.data(),
            tile.first_column,
            tile.first_row,
            tile.columns,
            tile.rows,
            tile.stride,
            tile.samples_per_pixel,
            0.0f,
            0.0f,
            nullptr,
            nullptr,
            0};
}

/// One triangle after the other, one sample after the other: ScanConverter says which ones.
inline void draw_slowly(const Triangles& triangles, std::uint32_t t, SampleTile& tile) {
    ScreenPolygon polygon;
    polygon.count = 3;
    const ScreenVertex v[3] = {triangles.corner(t, 0), triangles.corner(t, 1), triangles.corner(t, 2)};
    for (std::size_t k = 0; k < 3; ++k) polygon.corners[k] = {v[k].x, v[k].y};
    const double area = static_cast<double>(triangles.area(t));
    const double qa = static_cast<double>(v[0].nearness), qb = static_cast<double>(v[1].nearness) - qa;
    const double qc = static_cast<double>(v[2].nearness) - qa;
    const auto per_x = static_cast<float>((qb * (v[2].y - v[0].y) - qc * (v[1].y - v[0].y)) * (1.0 / area));
    const auto per_y = static_cast<float>((qc * (v[1].x - v[0].x) - qb * (v[2].x - v[0].x)) * (1.0 / area));
    const auto [low, high] = std::minmax({v[0].nearness, v[1].nearness, v[2].nearness});
    const ScanConverter scan(polygon, tile.samples_per_pixel);
    const int pitch = kSubpixelsPerPixel / tile.samples_per_pixel;
    for (int row = tile.first_row; row < tile.first_row + tile.rows; ++row) {
        if (row < scan.first_row() || row >= scan.end_row()) continue;
        const SampleSpan span = scan.span(row);
        for (int column = tile.first_column; column < tile.first_column + tile.columns; ++column) {
            if (column < span.begin || column >= span.end) continue;
            const int x = column * pitch + pitch / 2 - v[0].x, y = row * pitch + pitch / 2 - v[0].y;
            const float across = static_cast<float>(x) * per_x + v[0].nearness;
            const float nearness = std::clamp(across + static_cast<float>(y) * per_y, low, high);
            const std::uint32_t id = (triangles.mesh.first_number + t) << 1;
            const std::size_t i = tile.index(column, row);
            if (nearness < tile.nearness[i] || (nearness == tile.nearness[i] && id > tile.ids[i])) continue;
            tile.nearness[i] = nearness;
            tile.ids[i] = id;
        }
    }
}

/// A triangle with the blocks of the samples in its box.
inline TileTriangle in_tile(const Triangles& triangles, std::uint32_t t, const SampleTile& tile) {
    const int pitch = kSubpixelsPerPixel / tile.samples_per_pixel;
    const ScreenVertex v[3] = {triangles.corner(t, 0), triangles.corner(t, 1), triangles.corner(t, 2)};
    const auto block = [](double sample, int first, int last) {
        return static_cast<std::uint32_t>(std::clamp(static_cast<int>(sample) - first, 0, last) / kBlockSamples);
    };
    // Sample n lies at n + 1/2 pitches.
    const auto from = [pitch](int at) { return std::ceil(static_cast<double>(at) / pitch - 0.5); };
    const auto to = [pitch](int at) { return std::floor(static_cast<double>(at) / pitch - 0.5); };
    const auto [x0, x1] = std::minmax({v[0].x, v[1].x, v[2].x});
    const auto [y0, y1] = std::minmax({v[0].y, v[1].y, v[2].y});
    return {t, std::max({v[0].nearness, v[1].nearness, v[2].nearness}),
            TileTriangle::pack(block(from(x0), tile.first_column, tile.columns - 1),
                               block(to(x1), tile.first_column, tile.columns - 1),
                               block(from(y0), tile.first_row, tile.rows - 1),
                               block(to(y1), tile.first_row, tile.rows - 1))};
}

}  // namespace burin::test
