#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/polygon_soup.h"

namespace burin::test {

/// Several soups as one object.
inline PolygonSoup joined(const std::vector<PolygonSoup>& soups) {
    PolygonSoup all;
    for (const PolygonSoup& soup : soups) {
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), soup.positions.begin(), soup.positions.end());
        for (std::size_t i = 0; i < soup.polygon_count(); ++i) {
            std::vector<std::uint32_t> corners(soup.polygon(i).begin(), soup.polygon(i).end());
            for (std::uint32_t& corner : corners) corner += first;
            all.add_polygon(corners);
        }
    }
    return all;
}

/// A closed body between two rings of equally many corners, the first ring first.
inline PolygonSoup between_rings(std::vector<glm::dvec3> rings) {
    PolygonSoup soup;
    const auto n = static_cast<std::uint32_t>(rings.size() / 2);
    soup.positions = std::move(rings);
    std::vector<std::uint32_t> front, back;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        soup.add_polygon(std::vector<std::uint32_t>{i, j, n + j, n + i});
        front.push_back(n + i);
        back.push_back(n - 1 - i);
    }
    soup.add_polygon(front);
    soup.add_polygon(back);
    return soup;
}

}  // namespace burin::test
