#include "mesh/repeated_edges.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/interrupt.h"

namespace burin {
namespace {

/// Fewer corners, without spikes, do not suffice to pass an edge twice.
constexpr std::size_t kFewestCorners = 6;

bool has_repeated(std::span<const std::uint32_t> corners, const std::vector<std::uint32_t>& welded,
                  std::vector<std::uint32_t>& sorted) {
    sorted.clear();
    for (const std::uint32_t v : corners) sorted.push_back(welded[v]);
    constexpr std::size_t kFew = 32;
    if (sorted.size() > kFew) {
        std::sort(sorted.begin(), sorted.end());
        return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    }
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        if (std::find(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(i), sorted[i]) !=
            sorted.begin() + static_cast<std::ptrdiff_t>(i))
            return true;
    }
    return false;
}

/// The pieces of a polygon, one after the other, each free of spikes.
class Pieces {
  public:
    /// Walks along the polygon and takes out what lies between the first and the second time that
    /// an edge is passed.
    void cut(std::span<const std::uint32_t> polygon) {
        corners_.clear();
        ends_.clear();
        edges_.clear();
        path_.assign(1, polygon[0]);
        for (std::size_t i = 1; i <= polygon.size(); ++i) {
            const std::uint32_t next = polygon[i % polygon.size()];
            const auto [known, is_new] = edges_.try_emplace(key(path_.back(), next), path_.size() - 1);
            if (!is_new) {
                const std::size_t first = known->second;  // of the path's corners, from where it passes the edge
                add({path_.begin() + static_cast<std::ptrdiff_t>(first), path_.end() - 1});
                for (std::size_t k = first + 1; k + 1 < path_.size(); ++k) edges_.erase(key(path_[k], path_[k + 1]));
                path_.resize(first + 1);
            }
            path_.push_back(next);
        }
        add({path_.begin(), path_.end() - 1});
    }
    std::size_t count() const { return ends_.size(); }
    std::span<const std::uint32_t> piece(std::size_t i) const {
        const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
        return {corners_.data() + begin, ends_[i] - begin};
    }

  private:
    static std::uint64_t key(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32 | to; }
    void add(std::vector<std::uint32_t> piece) {
        remove_spikes(piece);
        corners_.insert(corners_.end(), piece.begin(), piece.end());
        ends_.push_back(corners_.size());
    }

    std::vector<std::uint32_t> path_;
    std::unordered_map<std::uint64_t, std::size_t> edges_;  // of the path: where each begins
    std::vector<std::uint32_t> corners_;
    std::vector<std::size_t> ends_;
};

/// Notes which corners of polygon i the corners of a piece of it are.
void add_origins(const PolygonSoup& soup, std::size_t i, std::span<const std::uint32_t> piece,
                 const std::vector<std::uint32_t>& welded, std::vector<CornerOrigin>& origins) {
    const std::span<const std::uint32_t> polygon = soup.polygon(i);
    const auto first = static_cast<std::uint32_t>(polygon.data() - soup.corners.data());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> corners;  // welded vertex, corner
    for (std::uint32_t k = 0; k < polygon.size(); ++k) corners.emplace_back(welded[polygon[k]], first + k);
    const bool is_whole = piece.data() == polygon.data();
    if (!is_whole) std::sort(corners.begin(), corners.end());
    for (std::size_t k = 0; k < piece.size(); ++k) {
        const std::uint32_t corner =
            is_whole ? corners[k].second
                     : std::lower_bound(corners.begin(), corners.end(), std::pair(welded[piece[k]], 0u))->second;
        origins.push_back({corner, corner, 0});
    }
}

}  // namespace

void remove_spikes(std::vector<std::uint32_t>& corners) {
    std::size_t end = 0;
    for (const std::uint32_t v : corners) {
        if (end > 0 && corners[end - 1] == v) continue;
        if (end > 1 && corners[end - 2] == v) {
            --end;  // there and back
        } else {
            corners[end++] = v;
        }
    }
    // Repetitions and spikes go where the end meets the start, too.
    std::size_t first = 0;
    while (end - first > 1) {
        if (corners[first] == corners[end - 1] || corners[first + 1] == corners[end - 1]) {
            first += corners[first] != corners[end - 1];
            --end;
        } else if (corners[first] == corners[end - 2]) {
            --end;
        } else {
            break;
        }
    }
    corners.resize(end);
    corners.erase(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first));
}

std::vector<CutPolygons> cut_at_repeated_edges(PolygonSoup& soup, const std::vector<std::uint32_t>& welded) {
    std::vector<CutPolygons> cut;
    PolygonSoup result;  // its polygons, from the first one on that is cut
    std::vector<std::uint32_t> corners, sorted;
    std::vector<CornerOrigin> origins;  // of the result's corners, if anybody asks
    Pieces pieces;
    const auto add = [&](std::span<const std::uint32_t> polygon, std::size_t i) {
        result.add_polygon(polygon);
        if (!soup.polygon_object.empty()) result.polygon_object.push_back(soup.polygon_object[i]);
        if (!soup.polygon_material.empty()) result.polygon_material.push_back(soup.polygon_material[i]);
        if (!soup.attributes.empty()) add_origins(soup, i, polygon, welded, origins);
    };
    for (std::size_t i = 0; i < soup.polygon_ends.size(); ++i) {
        if ((i & 0xFFFF) == 0) throw_if_interrupted();
        const std::span<const std::uint32_t> polygon = soup.polygon(i);
        bool may_repeat = polygon.size() >= kFewestCorners && has_repeated(polygon, welded, sorted);
        if (may_repeat) {
            corners.clear();
            for (const std::uint32_t v : polygon) corners.push_back(welded[v]);
            remove_spikes(corners);
            may_repeat = corners.size() >= kFewestCorners;
        }
        if (may_repeat) pieces.cut(corners);
        const bool is_cut = may_repeat && pieces.count() > 1;
        if (is_cut && cut.empty()) {
            cut.resize(std::max<std::size_t>(1, soup.object_names.size()));
            for (std::size_t before = 0; before < i; ++before) add(soup.polygon(before), before);
        }
        if (cut.empty()) continue;
        if (!is_cut) {
            add(polygon, i);
            continue;
        }
        CutPolygons& of_object = cut[soup.object_of(i)];
        of_object.polygons += 1;
        of_object.pieces += pieces.count();
        of_object.triangles += polygon.size() - 2;
        for (std::size_t k = 0; k < pieces.count(); ++k) {
            add(pieces.piece(k), i);
            of_object.piece_triangles += std::max<std::size_t>(2, pieces.piece(k).size()) - 2;
        }
    }
    if (cut.empty()) return cut;
    soup.corners = std::move(result.corners);
    soup.polygon_ends = std::move(result.polygon_ends);
    soup.polygon_object = std::move(result.polygon_object);
    soup.polygon_material = std::move(result.polygon_material);
    if (!soup.attributes.empty()) move_rows(origins, soup.attributes);
    return cut;
}

}  // namespace burin
