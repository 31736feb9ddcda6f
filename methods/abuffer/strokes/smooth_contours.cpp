#include "methods/abuffer/strokes/smooth_contours.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "abuffer/projection.h"
#include "base/parallel.h"

namespace burin {
namespace {

/// Folds are moved point by point, this far apart.
constexpr double kStepPx = 0.25;
/// From one piece of a contour to another that does not touch it, or to the mesh, a line goes on over at
/// most this.
constexpr double kWidestGapPx = 3;
/// Neighbouring folds come to the same place but for rounding; chains of lines need equal bits.
constexpr double kGridPerPx = 4096;

glm::dvec2 rounded(glm::dvec2 p) { return glm::round(p * kGridPerPx) / kGridPerPx; }

bool is_less(const glm::vec3& a, const glm::vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

}  // namespace

SmoothContours::SmoothContours(const SurfaceSet& surfaces, double cos_crease_angle, int threads)
    : surfaces_(surfaces) {
    std::map<const Mesh*, std::size_t> numbers;
    std::vector<const Mesh*> meshes;
    for (const SurfaceInstance& instance : surfaces.instances) {
        if (numbers.try_emplace(instance.mesh, meshes.size()).second) meshes.push_back(instance.mesh);
    }
    meshes_.resize(meshes.size());
    parallel_for(meshes.size(), threads, [&](std::size_t i, int) { meshes_[i] = make_smooth(*meshes[i], cos_crease_angle); });
    for (const SurfaceInstance& instance : surfaces.instances) smooth_of_.push_back(&meshes_[numbers[instance.mesh]]);
}

std::optional<SurfaceEdge> SmoothContours::fold_of(const LineSegment& segment) const {
    if (segment.drawn_as != LineClass::silhouette || segment.line_key >> 63 != 0) return std::nullopt;
    const auto instance = static_cast<std::uint32_t>(segment.line_key >> 32);
    const auto h = static_cast<HalfEdge>(segment.line_key & 0xFFFFFFFFu);
    if (smooth_of_[instance]->is_sharp(h)) return std::nullopt;
    return SurfaceEdge{{instance, h / 3}, h};
}

std::optional<SmoothContours::Piece> SmoothContours::piece_in(SurfaceId s) const {
    const SurfaceInstance& instance = surfaces_.instance_of(s);
    const Mesh& mesh = *instance.mesh;
    const auto& t = mesh.triangles[s.triangle];
    const Projection& projection = surfaces_.projection;
    std::array<glm::dvec3, 3> view;
    std::array<double, 3> facing;
    for (std::size_t k = 0; k < 3; ++k) {
        view[k] = surfaces_.view_position(s.instance, t[k]);
        if (!needs_no_clipping(projection, view[k])) return std::nullopt;
        const glm::vec3& own = smooth_of_[s.instance]->normals[3 * s.triangle + k];
        if (own == glm::vec3(0.0f)) return std::nullopt;
        const glm::dvec3 normal = instance.normal_to_view * glm::dvec3(own);
        const glm::dvec3 ray = projection.orthographic ? glm::dvec3(0, 0, -1) : view[k] / glm::length(view[k]);
        facing[k] = glm::dot(normal, ray) / std::max(glm::length(normal), 1e-300);
    }
    Piece piece;
    int found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        std::size_t a = k, b = (k + 1) % 3;
        if ((facing[a] >= 0) == (facing[b] >= 0)) continue;
        // In one order, so that both triangles at the edge come to the same bits.
        if (is_less(mesh.positions[t[b]], mesh.positions[t[a]])) std::swap(a, b);
        const double share = facing[a] / (facing[a] - facing[b]);
        piece.ends[found++] = rounded(projection.to_pixel(glm::mix(view[a], view[b], share)));
    }
    if (found != 2 || piece.ends[0] == piece.ends[1]) return std::nullopt;
    if (std::tie(piece.ends[1].x, piece.ends[1].y) < std::tie(piece.ends[0].x, piece.ends[0].y)) {
        std::swap(piece.ends[0], piece.ends[1]);
    }
    return piece;
}

/// On the triangles that have a vertex in common with one at the fold's ends.
void SmoothContours::find_pieces(SurfaceEdge fold, std::vector<Piece>& pieces) const {
    const std::uint32_t instance = fold.surface.instance;
    const Mesh& mesh = *surfaces_.instances[instance].mesh;
    const SmoothMesh& smooth = *smooth_of_[instance];
    std::vector<std::uint32_t> ring, triangles;
    const auto add_around = [&](HalfEdge corner, std::vector<std::uint32_t>& list) {
        visit_smooth_corners(mesh, smooth, corner, [&](HalfEdge h) { list.push_back(h / 3); });
    };
    const auto make_unique = [](std::vector<std::uint32_t>& list) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    const HalfEdge h = fold.half_edge;
    add_around(h, ring);
    add_around(h - h % 3 + (h + 1) % 3, ring);
    make_unique(ring);
    for (const std::uint32_t t : ring) {
        for (HalfEdge k = 0; k < 3; ++k) add_around(3 * t + k, triangles);
    }
    make_unique(triangles);
    pieces.clear();
    for (const std::uint32_t t : triangles) {
        if (const auto piece = piece_in({instance, t})) pieces.push_back(*piece);
    }
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
        return std::tie(a.ends[0].x, a.ends[0].y, a.ends[1].x, a.ends[1].y) <
               std::tie(b.ends[0].x, b.ends[0].y, b.ends[1].x, b.ends[1].y);
    });
    for (Piece& piece : pieces) {
        for (int k = 0; k < 2; ++k) {
            piece.goes_on[k] = std::any_of(pieces.begin(), pieces.end(), [&](const Piece& other) {
                return &other != &piece && (other.ends[0] == piece.ends[k] || other.ends[1] == piece.ends[k]);
            });
        }
    }
}

SmoothContours::Foot SmoothContours::nearest(const std::vector<Piece>& pieces, glm::dvec2 pixel) {
    Foot best;
    double least = 1e300;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const glm::dvec2 a = pieces[i].ends[0], along = pieces[i].ends[1] - a;
        const double share = std::clamp(glm::dot(pixel - a, along) / glm::dot(along, along), 0.0, 1.0);
        const glm::dvec2 foot = rounded(a + along * share);
        const double square = glm::dot(pixel - foot, pixel - foot);
        if (!(square < least)) continue;
        least = square;
        const bool is_beside = (share > 0 || pieces[i].goes_on[0]) && (share < 1 || pieces[i].goes_on[1]);
        best = is_beside ? Foot{foot, i} : Foot{pixel, kNoPiece};
    }
    return best;
}

std::optional<glm::dvec2> SmoothContours::common_end(const std::vector<Piece>& pieces, std::size_t a, std::size_t b) {
    if (a == kNoPiece || b == kNoPiece) return std::nullopt;
    for (const glm::dvec2& p : pieces[a].ends) {
        if (p == pieces[b].ends[0] || p == pieces[b].ends[1]) return p;
    }
    return std::nullopt;
}

void SmoothContours::add_moved(const LineSegment& fold, const std::vector<Piece>& pieces,
                               std::vector<LineSegment>& moved) {
    const auto add = [&](glm::dvec2 from, glm::dvec2 to) {
        if (from == to) return;
        moved.push_back(fold);
        moved.back().from = from;
        moved.back().to = to;
    };
    const int steps = std::max(1, static_cast<int>(std::ceil(glm::distance(fold.from, fold.to) / kStepPx)));
    Foot begin = nearest(pieces, fold.from), last = begin;
    for (int i = 1; i <= steps; ++i) {
        const Foot foot = nearest(pieces, i == steps ? fold.to : glm::mix(fold.from, fold.to, double(i) / steps));
        if (foot.piece != last.piece) {
            if (const auto corner = common_end(pieces, last.piece, foot.piece)) {
                add(begin.pixel, *corner);
                begin.pixel = *corner;
            } else {
                add(begin.pixel, last.pixel);
                begin.pixel = foot.pixel;
                if (glm::distance(last.pixel, foot.pixel) <= kWidestGapPx) add(last.pixel, foot.pixel);
            }
            begin.piece = foot.piece;
        }
        last = foot;
    }
    add(begin.pixel, last.pixel);
}

void SmoothContours::move(std::vector<LineSegment>& segments) const {
    std::vector<LineSegment> moved;
    std::vector<Piece> pieces;
    std::uint64_t key = ~std::uint64_t{0};  // whose pieces those are
    for (const LineSegment& s : segments) {
        const auto fold = fold_of(s);
        if (fold && s.line_key != key) {
            find_pieces(*fold, pieces);
            key = s.line_key;
        }
        if (fold && !pieces.empty()) {
            add_moved(s, pieces, moved);
        } else {
            moved.push_back(s);
        }
    }
    segments.swap(moved);
}

}  // namespace burin
