#include "abuffer/samples/line_tile.h"

#include <algorithm>
#include <array>
#include <bit>

#include "abuffer/screen/edge_rings.h"
#include "abuffer/screen/sampling.h"
#include "base/interrupt.h"
#include "lines/cell_tracer.h"

namespace burin {

namespace {

bool is_occluding(const LineDecision& decision) {
    return decision.reason == LineReason::turns_away || decision.reason == LineReason::ends_at_border ||
           decision.reason == LineReason::unexplained;
}

}  // namespace

LineTile::LineTile(const Frame& frame, const ScreenSurfaces& screen, const TriangleBins& bins, SurfaceTile& visible,
                   const TileKernels& kernels)
    : frame_(frame),
      screen_(screen),
      visible_(visible),
      samples_(visible.samples()),
      kernels_(kernels),
      outline_classes_(LineClassSet(LineClass::silhouette) & frame.criteria.classes),
      keeps_undrawn_(!frame.criteria.classes.empty() && !kSurfaceEnds.without(frame.criteria.classes).empty()),
      fast_(screen, frame.criteria),
      mesh_walks_(new MeshWalks),
      found_outlines_(new WalkOutlines),
      walks_(screen, kernels, fast_.walker(), *mesh_walks_),
      flush_(screen, bins, frame.criteria),
      fade_(frame.scene->lines.crease_fade()),
      merger_(kernels) {}

glm::dvec2 LineTile::position(int column, int row) const {
    return {(samples_.first_column + column + 0.5) * pitch_px_ + kSampleTrifleX,
            (samples_.first_row + row + 0.5) * pitch_px_ + kSampleTrifleY};
}

/// Whether there is a line between two samples that are not known to lie on one smooth surface.
bool LineTile::decide(const SamplePair& pair, const NeighbourSamples& neighbours, const KnownWalks& walks,
                      LineCrossing& crossing) {
    crossing = LineCrossing{};
    LineDecision decision;
    const glm::dvec2 a = position(pair.column(), pair.row());
    const glm::dvec2 b = position(pair.column() + (pair.down() ? 0 : 1), pair.row() + (pair.down() ? 1 : 0));
    if (!fast_.decide(neighbours, decision, crossing.nearness, walks)) {
        const VisiblePoint points[2] = {{a, neighbours.surfaces[0]}, {b, neighbours.surfaces[1]}};
        decision = decide_line(frame_.surfaces, points[0], points[1], frame_.criteria);
        if (!decision.classes.empty()) {
            const DepthPlane plane = frame_.surfaces.plane(neighbours.surfaces[decision.front]);
            crossing.nearness = plane.nearness(glm::mix(a, b, decision.fraction));
        }
    }
    crossing.classes = decision.classes & frame_.criteria.classes;
    crossing.opacity = fade_.opacity(crossing.classes, decision.crease_cosine);
    if (crossing.opacity == 0) crossing.classes = {};
    crossing.occludes = is_occluding(decision);
    if (crossing.classes.empty() && !(keeps_undrawn_ && crossing.occludes)) return false;
    if (!crossing.classes.has(LineClass::mark)) {
        const float nearness[2] = {samples_.nearness[first_of(pair)], samples_.nearness[second_of(pair)]};
        if (flush_.covers(neighbours, {pair.column(), pair.row()}, nearness, decision.edge.half_edge)) return false;
    }
    crossing.pixel = glm::mix(a, b, std::clamp(decision.fraction, 0.0, 1.0));
    crossing.towards_front = decision.front == 0 ? a - b : b - a;
    if (decision.edge.half_edge != kNoHalfEdge) {
        set_edge(decision.edge, crossing);
    } else {
        if (decision.reason == LineReason::passes_through) {
            const DepthPlane p = frame_.surfaces.plane(neighbours.surfaces[0]);
            const DepthPlane q = frame_.surfaces.plane(neighbours.surfaces[1]);
            crossing.along = {q.per_y - p.per_y, p.per_x - q.per_x};
        }
        // The background is beside a surface where no edge of it is found: views too narrow for numbers.
        const auto number = [this](SurfaceId id) { return id.is_background() ? ~0u : screen_.number_of(id); };
        crossing.line = LineId::of_surfaces(number(neighbours.surfaces[0]), number(neighbours.surfaces[1]));
    }
    return true;
}

void LineTile::set_edge(SurfaceEdge edge, LineCrossing& crossing) const {
    const HalfEdge h = edge.half_edge;
    const std::uint32_t instance = edge.surface.instance;
    const ScreenMesh& mesh = screen_.mesh(instance);
    crossing.line = LineId::of_edge(instance, least_on_edge(mesh, h, mesh.partners[h]));
    const std::uint32_t first = h - h % 3;
    const ScreenVertex& from = mesh.vertices[mesh.corners[h]];
    const ScreenVertex& to = mesh.vertices[mesh.corners[first + (h - first + 1) % 3]];
    const bool is_on_screen = from.x != ScreenVertex::kOffScreen && to.x != ScreenVertex::kOffScreen;
    crossing.edge_ends[0] = is_on_screen ? glm::dvec2(from.x, from.y) / double{kSubpixelsPerPixel} : glm::dvec2(0.0);
    crossing.edge_ends[1] = is_on_screen ? glm::dvec2(to.x, to.y) / double{kSubpixelsPerPixel} : glm::dvec2(0.0);
    crossing.along = crossing.edge_ends[1] - crossing.edge_ends[0];
}

/// Finds the pairs between which a line may lie, and which of them are known to be of one smooth surface.
void LineTile::find_pairs() {
    pairs_.resize(2 * static_cast<std::size_t>(samples_.columns) * static_cast<std::size_t>(samples_.rows) +
                  kRoomBehindPairs);
    const SampleView tile = visible_.view();
    pair_count_ = kernels_.walk.find_pairs(tile, pairs_.data());
    is_smooth_.assign(pair_count_, 0);
    const auto first_id = [&](std::size_t i) { return samples_.ids[first_of(pairs_[i])]; };
    const bool has_one_mesh = screen_.surfaces().instances.size() == 1;
    // Pairs are taken mesh by mesh.
    for (std::size_t begin = 0; begin < pair_count_;) {
        if (first_id(begin) == SampleTile::kBackground) {
            ++begin;
            continue;
        }
        const ScreenMesh& mesh = screen_.mesh(screen_.surface_of(first_id(begin) >> 1).instance);
        const auto is_of_another = [&](std::uint32_t id) {
            return id != SampleTile::kBackground && (id >> 1) - mesh.first_number >= mesh.triangle_count;
        };
        std::size_t end = has_one_mesh ? pair_count_ : begin + 1;
        while (end < pair_count_ && !is_of_another(first_id(end))) ++end;
        if (mesh.sharp != nullptr && mesh.triangle_count <= kMostToWalk) {
            kernels_.walk.find_smooth(tile, mesh, fast_.smooth_limits(), pairs_.data() + begin, end - begin,
                                      is_smooth_.data() + begin);
        }
        begin = end;
    }
}

void LineTile::find_neighbours(std::span<const SamplePair> pairs) {
    const std::int32_t pitch = kSubpixelsPerPixel / samples_.samples_per_pixel;
    if (neighbours_.size() < pairs.size()) neighbours_.resize(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const SamplePair& pair = pairs[i];
        NeighbourSamples& n = neighbours_[i];
        n.x = (samples_.first_column + pair.column()) * pitch + pitch / 2;
        n.y = (samples_.first_row + pair.row()) * pitch + pitch / 2;
        n.pitch = pitch;
        n.down = pair.down();
        n.surfaces[0] = visible_.surface_at(first_of(pair));
        n.surfaces[1] = visible_.surface_at(second_of(pair));
    }
}

void LineTile::find_crossings() {
    find_pairs();
    crossing_count_ = 0;
    std::size_t asked = 0;
    for (std::size_t i = 0; i < pair_count_; ++i) {
        pairs_[asked] = pairs_[i];
        asked += is_smooth_[i] != 0 ? 0 : 1;
    }
    if (!outline_classes_.empty()) asked = find_outlines(asked);
    for (std::size_t begin = 0; begin < asked; begin += WalksAhead::kMostPairs) {
        decide_all({pairs_.data() + begin, std::min(asked - begin, WalksAhead::kMostPairs)});
    }
}

/// Finds the crossings of outlines before the background, which most lines are, mesh by mesh. Returns how many of the
/// pairs that are asked are left.
std::size_t LineTile::find_outlines(std::size_t asked) {
    if (outlines_.size() < asked) outlines_.resize(2 * asked);
    std::size_t count = 0, left = 0;
    for (std::size_t i = 0; i < asked; ++i) {  // without branches: which ones are is unpredictable
        const SamplePair pair = pairs_[i];
        const std::uint32_t first = samples_.ids[first_of(pair)], second = samples_.ids[second_of(pair)];
        const bool has_first = first != SampleTile::kBackground,
                   is_outline = has_first != (second != SampleTile::kBackground);
        outlines_[count] = {pair, has_first ? first : second, has_first ? 0u : 1u, 0};
        count += is_outline ? 1 : 0;
        pairs_[left] = pair;
        left += is_outline ? 0 : 1;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const SurfaceId surface = screen_.surface_of(outlines_[i].triangle >> 1);
        outlines_[i].instance = surface.instance;
        outlines_[i].triangle = surface.triangle;
    }
    const std::span<OutlinePair> outlines(outlines_.data(), count);
    const auto is_of_other = [&](const OutlinePair& o) { return o.instance != outlines[0].instance; };
    if (std::any_of(outlines.begin(), outlines.end(), is_of_other)) {
        std::stable_sort(outlines.begin(), outlines.end(),
                         [](const OutlinePair& a, const OutlinePair& b) { return a.instance < b.instance; });
    }
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
        while (end < count && end - begin < MeshWalks::kMost && outlines[end].instance == outlines[begin].instance)
            ++end;
        cross_outlines(outlines.subspan(begin, end - begin), left);
    }
    return left;
}

/// Crosses the outlines of pairs of one mesh, at most MeshWalks::kMost. Pairs where there is another line, or none, are
/// added to those that are asked.
void LineTile::cross_outlines(std::span<const OutlinePair> pairs, std::size_t& asked) {
    const std::uint32_t instance = pairs[0].instance;
    const ScreenMesh& mesh = screen_.mesh(instance);
    std::array<std::uint8_t, MeshWalks::kMost> is_settled{};
    if (mesh.sharp != nullptr && mesh.triangle_count <= kMostToWalk) {
        const std::int32_t pitch = kSubpixelsPerPixel / samples_.samples_per_pixel;
        MeshWalks& walks = *mesh_walks_;
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const SamplePair pair = pairs[i].pair;
            const std::int32_t x = (samples_.first_column + pair.column()) * pitch + pitch / 2,
                               y = (samples_.first_row + pair.row()) * pitch + pitch / 2;
            const bool down = pair.down();
            walks.triangle[i] = pairs[i].triangle;
            __builtin_prefetch(mesh.sharp + walks.triangle[i]);
            walks.across[i] = down ? x : y;
            walks.origin[i] = (down ? y : x) + (pairs[i].from == 1 ? pitch : 0);
            walks.down[i] = down ? ~0u : 0u;
            walks.backwards[i] = pairs[i].from == 1 ? ~0u : 0u;
        }
        kernels_.walk.over_mesh(mesh, fast_.walker().limits(pitch), walks, pairs.size());
        WalkOutlines& found = *found_outlines_;
        kernels_.walk.find_outlines(mesh, walks, pitch, screen_.surfaces().farthest_nearness, found);
        for (std::size_t i = 0; i < found.count; ++i) {
            const OutlinePair& outline = pairs[found.walk[i]];
            is_settled[found.walk[i]] = 1;
            LineCrossing& crossing = next_crossing();
            const SamplePair& pair = outline.pair;
            const glm::dvec2 a = position(pair.column(), pair.row());
            const glm::dvec2 b = position(pair.column() + (pair.down() ? 0 : 1), pair.row() + (pair.down() ? 1 : 0));
            crossing.pixel = glm::mix(a, b, std::clamp(found.fraction[i], 0.0, 1.0));
            crossing.towards_front = outline.from == 0 ? a - b : b - a;
            crossing.classes = outline_classes_;
            crossing.occludes = true;
            crossing.opacity = 255;
            crossing.nearness = found.nearness[i];
            crossing.line = LineId::of_edge(instance, least_on_edge(mesh, found.exit[i], found.partner[i]));
            crossing.edge_ends[0] = glm::dvec2(found.from_x[i], found.from_y[i]) / double{kSubpixelsPerPixel};
            crossing.edge_ends[1] = glm::dvec2(found.to_x[i], found.to_y[i]) / double{kSubpixelsPerPixel};
            crossing.along = crossing.edge_ends[1] - crossing.edge_ends[0];
            add_crossing(pair);
        }
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs_[asked] = pairs[i].pair;
        asked += is_settled[i] != 0 ? 0 : 1;
    }
}

/// The place of the next crossing, which is not kept before add_crossing().
LineCrossing& LineTile::next_crossing() {
    if (crossings_.size() == crossing_count_) {
        crossings_.resize(2 * crossings_.size() + WalksAhead::kMostPairs);
        crossing_places_.resize(crossings_.size());
    }
    return crossings_[crossing_count_];
}

void LineTile::add_crossing(const SamplePair& pair) {
    crossing_places_[crossing_count_] = pair;
    crossing_between(pair) = static_cast<std::uint32_t>(++crossing_count_);
}

void LineTile::decide_all(std::span<const SamplePair> pairs) {
    throw_if_interrupted();
    find_neighbours(pairs);
    walks_.walk({neighbours_.data(), pairs.size()});
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (decide(pairs[i], neighbours_[i], walks_.known(i), next_crossing())) add_crossing(pairs[i]);
    }
}

void LineTile::find_lines(std::size_t tile, std::vector<LinePiece>& pieces) {
    flush_.set_tile(tile);
    pitch_px_ = 1.0 / samples_.samples_per_pixel;  // exact
    const std::size_t size = 2 * samples_.ids.size();
    if (between_.size() < size) between_.assign(size, 0);
    find_crossings();
    pieces_.clear();
    trace_cells(pieces_);
    merger_.merge(pieces_, pieces);
    for (const SamplePair& place : std::span(crossing_places_).first(crossing_count_)) crossing_between(place) = 0;
}

void LineTile::trace_cells(std::vector<LinePiece>& pieces) {
    const auto stride = static_cast<std::size_t>(samples_.stride);
    const bool has_bridges = !completes_lines(frame_);
    const int block_shift = std::countr_zero(static_cast<unsigned>(kMergeBlockPx * samples_.samples_per_pixel));
    const auto block_of = [block_shift](int sample) {
        return static_cast<std::uint32_t>(sample >> block_shift) & 0xFFFFu;
    };
    // Each cell is traced when its first crossing is met, in the order upper, left, right, lower side.
    const auto trace = [&](int column, int row, std::uint32_t from) {
        if (column < 0 || row < 0 || column + 1 >= samples_.columns || row + 1 >= samples_.rows) return;
        const std::uint32_t* const own =
            &between_[2 * (static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column))];
        const std::uint32_t sides[4] = {own[0], own[1], own[3], own[2 * stride]};
        std::uint32_t numbers[5];  // without branches: which sides have any is unpredictable
        std::size_t count = 0;
        for (const std::uint32_t side : sides) {
            numbers[count] = side;
            count += side != 0 ? 1 : 0;
        }
        if (numbers[0] != from) return;  // another crossing traces this cell
        std::array<const LineCrossing*, 4> found;
        for (std::size_t k = 0; k < count; ++k) found[k] = &crossings_[numbers[k] - 1];
        const glm::dvec2 low((samples_.first_column + column + 0.5) * pitch_px_,
                             (samples_.first_row + row + 0.5) * pitch_px_);
        std::size_t fresh = pieces.size();
        trace_cell({found.data(), count}, low, low + pitch_px_, has_bridges, pieces);
        const std::uint32_t block = block_of(samples_.first_row + row) << 16 | block_of(samples_.first_column + column);
        for (; fresh < pieces.size(); ++fresh) pieces[fresh].block = block;
    };
    const std::span places = std::span(crossing_places_).first(crossing_count_);
    std::uint32_t number = 0;
    for (const SamplePair& place : places) {
        ++number;
        constexpr std::ptrdiff_t kAhead = 8;
        if (places.data() + places.size() - &place > kAhead) {
            const std::uint32_t* const ahead = &crossing_between(*(&place + kAhead));
            __builtin_prefetch(ahead);
            __builtin_prefetch(ahead + 2 * stride);
            __builtin_prefetch(ahead - 2 * stride);
        }
        trace(place.column() - (place.down() ? 1 : 0), place.row() - (place.down() ? 0 : 1), number);
        trace(place.column(), place.row(), number);
    }
}

}  // namespace burin
