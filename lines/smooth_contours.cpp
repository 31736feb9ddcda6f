#include "lines/smooth_contours.h"

#include <algorithm>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "lines/contour_joints.h"
#include "view/screen_polygon.h"

namespace burin {
namespace {

/// A contour that comes no nearer to an edge than this part of the longest edge of its triangles belongs to something
/// else; of its own length, if the outline stays where it is at both ends.
constexpr double kFarthestPart = 0.25;
constexpr double kLongestJointsPart = 0.5;

/// Whether a surface is not smooth all around the vertex of a corner.
bool is_at_sharp_edge(const Mesh& mesh, const SmoothMesh& smooth, HalfEdge corner) {
    bool is_sharp = false;
    visit_smooth_corners(mesh, smooth, corner, [&](HalfEdge h) {
        is_sharp = is_sharp || smooth.is_sharp(h) || smooth.is_sharp(h - h % 3 + (h + 2) % 3);
    });
    return is_sharp;
}

void add_pieces(const LinePiece& line, const std::vector<glm::dvec2>& points, std::vector<LinePiece>& to) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i - 1] == points[i]) continue;
        to.push_back(line);
        to.back().from = points[i - 1];
        to.back().to = points[i];
    }
}

}  // namespace

SmoothContours::SmoothContours(const SurfaceSet& surfaces, double cos_crease_angle, int threads) : surfaces_(surfaces) {
    std::map<const Mesh*, std::size_t> numbers;
    std::vector<const Mesh*> meshes;
    for (const SurfaceInstance& instance : surfaces.instances) {
        if (numbers.try_emplace(instance.mesh, meshes.size()).second) meshes.push_back(instance.mesh);
    }
    meshes_.resize(meshes.size());
    parallel_for(meshes.size(), threads,
                 [&](std::size_t i, int) { meshes_[i] = make_smooth(*meshes[i], cos_crease_angle); });
    for (const SurfaceInstance& instance : surfaces.instances) smooth_of_.push_back(&meshes_[numbers[instance.mesh]]);
}

bool SmoothContours::is_fold(const LinePiece& piece) const {
    if (piece.drawn_as != LineClass::silhouette || !piece.line.is_edge()) return false;
    return !smooth_of_[piece.line.instance()]->is_sharp(piece.line.half_edge());
}

FoldMap SmoothContours::map_of(LineId edge) const {
    const std::uint32_t instance = edge.instance();
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const Projection& projection = surfaces_.projection;
    const HalfEdge h = edge.half_edge();
    glm::dvec2 ends[2];
    double longest = 0;
    for (const HalfEdge side : {h, mesh.next_on_edge[h]}) {
        const auto& t = mesh.triangles[side / 3];
        glm::dvec2 corners[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 view = surfaces_.view_position(instance, t[k]);
            if (!needs_no_clipping(projection, view)) return {};
            corners[k] = projection.to_pixel(view);
        }
        for (std::size_t k = 0; k < 3; ++k)
            longest = std::max(longest, glm::distance(corners[k], corners[(k + 1) % 3]));
        ends[0] = corners[side % 3];
        ends[1] = corners[(side + 1) % 3];
    }
    // The ends are put in one order, whichever triangle comes first.
    if (std::tie(ends[1].x, ends[1].y) < std::tie(ends[0].x, ends[0].y)) std::swap(ends[0], ends[1]);
    const SmoothMesh& smooth = *smooth_of_[instance];
    const bool stays_at_ends =
        is_at_sharp_edge(mesh, smooth, h) && is_at_sharp_edge(mesh, smooth, h - h % 3 + (h + 1) % 3);
    const double farthest_px = kFarthestPart * (stays_at_ends ? glm::distance(ends[0], ends[1]) : longest);
    return {ends[0], ends[1], ContourFinder(surfaces_, instance, smooth).chains_around(h), farthest_px};
}

void SmoothContours::move(std::vector<std::vector<LinePiece>>& lists, int threads) const {
    std::vector<LineId> folds;
    for (const auto& list : lists) {
        for (const LinePiece& s : list) {
            if (is_fold(s)) folds.push_back(s.line);
        }
    }
    std::sort(folds.begin(), folds.end());
    folds.erase(std::unique(folds.begin(), folds.end()), folds.end());
    std::vector<FoldMap> maps(folds.size());
    constexpr std::size_t kChunk = 64;
    parallel_for((folds.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk, int) {
        for (std::size_t i = chunk * kChunk; i < std::min(folds.size(), (chunk + 1) * kChunk); ++i)
            maps[i] = map_of(folds[i]);
    });

    const auto number_of = [&](LineId fold) {
        return static_cast<std::size_t>(std::lower_bound(folds.begin(), folds.end(), fold) - folds.begin());
    };
    const auto moved_line = [&](const LinePiece& s) {
        MovedLine line{&s, {s.from, s.to}};
        if (!is_fold(s)) return line;
        const FoldMap& map = maps[number_of(s.line)];
        line.is_moved = map.is_moved();
        if (line.is_moved) line.points = map.moved(s.from, s.to);
        return line;
    };
    std::vector<MovedLine> lines;  // where surfaces end
    const auto join = [&] {
        lines.clear();
        for (const auto& list : lists) {
            for (const LinePiece& s : list) {
                if (s.occludes && s.from != s.to) lines.push_back(moved_line(s));
            }
        }
        return find_joints(lines);
    };
    Joints joints = join();
    // What would be joined by longer lines than half of what is seen of it is better left where it is.
    std::vector<double> seen(folds.size(), 0), joined(folds.size(), 0);
    for (const MovedLine& line : lines) {
        if (line.is_moved) seen[number_of(line.given->line)] += glm::distance(line.given->from, line.given->to);
    }
    for (const LinePiece& s : joints.pieces) {
        if (is_fold(s)) joined[number_of(s.line)] += glm::distance(s.from, s.to);
    }
    for (std::size_t i = 0; i < folds.size(); ++i) {
        if (joined[i] > kLongestJointsPart * seen[i]) maps[i] = {};
    }
    joints = join();
    for (const LeadIn& lead : joints.to_lines_that_stay)
        maps[number_of(lines[lead.line].given->line)].lead_to_end(lead.place);
    if (!joints.to_lines_that_stay.empty()) joints = join();

    std::vector<LinePiece> moved;
    for (auto& list : lists) {
        moved.clear();
        for (const LinePiece& s : list) add_pieces(s, moved_line(s).points, moved);
        list = moved;
    }
    lists.push_back(std::move(joints.pieces));
}

void SmoothContours::move(std::vector<LinePiece>& pieces) const {
    std::vector<LinePiece> moved;
    for (const LinePiece& s : pieces) {
        const FoldMap map = is_fold(s) ? map_of(s.line) : FoldMap();
        if (map.is_moved()) {
            add_pieces(s, map.moved(s.from, s.to), moved);
        } else {
            moved.push_back(s);
        }
    }
    pieces.swap(moved);
}

}  // namespace burin
