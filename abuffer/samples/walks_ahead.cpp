#include "abuffer/samples/walks_ahead.h"

#include <algorithm>

namespace burin {

WalksAhead::WalksAhead(const ScreenSurfaces& screen, const TileKernels& kernels, FastWalker& walker,
                       MeshWalks& mesh_walks)
    : screen_(screen),
      kernels_(kernels),
      walker_(walker),
      mesh_walks_(mesh_walks),
      known_(kMostPairs),
      walks_(2 * kMostPairs),
      steps_(2 * kMostPairs * (MeshWalks::kMostSteps + 1)) {}

void WalksAhead::walk(std::span<const NeighbourSamples> pairs) {
    pairs_ = pairs;
    walk_count_ = step_count_ = 0;
    asked_.clear();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        known_[i] = {};
        ask(i, pairs[i].surfaces[0].is_background() ? 1 : 0);
    }
    walk_asked();
    asked_.clear();
    // The walks in the other direction are asked for where these do not settle it.
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const SurfaceId* const surfaces = pairs[i].surfaces;
        if (surfaces[0].is_background() || surfaces[1].is_background()) continue;
        const FastWalk* const first = known_[i][0];
        const bool settles = first != nullptr && first->end == FastWalk::arrived &&
                             SurfaceId{surfaces[0].instance, first->triangle} == surfaces[1];
        if (!settles) ask(i, 1);
    }
    walk_asked();
}

void WalksAhead::ask(std::size_t pair, std::size_t from) {
    const std::uint32_t instance = pairs_[pair].surfaces[from].instance;
    const ScreenMesh& mesh = screen_.mesh(instance);
    if (mesh.sharp == nullptr || mesh.triangle_count > kMostToWalk) return;
    asked_.push_back({instance, static_cast<std::uint32_t>(pair), static_cast<std::uint32_t>(from)});
}

/// Walks are taken mesh by mesh.
void WalksAhead::walk_asked() {
    const auto is_of_other = [this](const Asked& a) { return a.instance != asked_[0].instance; };
    if (std::any_of(asked_.begin(), asked_.end(), is_of_other)) {
        std::stable_sort(asked_.begin(), asked_.end(),
                         [](const Asked& a, const Asked& b) { return a.instance < b.instance; });
    }
    MeshWalks& walks = mesh_walks_;
    for (std::size_t begin = 0, end = 0; begin < asked_.size(); begin = end) {
        const ScreenMesh& mesh = screen_.mesh(asked_[begin].instance);
        while (end < asked_.size() && asked_[end].instance == asked_[begin].instance) {
            const Asked& a = asked_[end];
            const NeighbourSamples& pair = pairs_[a.pair];
            const std::size_t i = end - begin;
            walks.triangle[i] = pair.surfaces[a.from].triangle;
            __builtin_prefetch(mesh.sharp + walks.triangle[i]);
            walks.across[i] = pair.down ? pair.x : pair.y;
            walks.origin[i] = (pair.down ? pair.y : pair.x) + (a.from == 1 ? pair.pitch : 0);
            walks.down[i] = pair.down ? ~0u : 0u;
            walks.backwards[i] = a.from == 1 ? ~0u : 0u;
            ++end;
        }
        kernels_.walk.over_mesh(mesh, walker_.limits(pairs_[0].pitch), walks, end - begin);
        for (std::size_t i = 0; i < walks.ended_count; ++i) note_end(i, asked_[begin + walks.ended[i]]);
    }
}

void WalksAhead::note_end(std::size_t ended, const Asked& asked) {
    const MeshWalks& walks = mesh_walks_;
    FastWalk& walk = walks_[walk_count_++];
    known_[asked.pair][asked.from] = &walk;
    const std::uint32_t end = walks.end_step[ended];
    walk.end = (walks.how[ended] & MeshWalks::kFolds) != 0 ? FastWalk::fold : FastWalk::arrived;
    walk.half_edge = walks.exit[end];
    walk.triangle = walk.half_edge / 3;
    walk.fraction = walks.left[end];
    walk.crossed = {};
    walk.crease_cosine = 1;
    const SurfaceId other = pairs_[asked.pair].surfaces[1 - asked.from];
    const bool is_through = walk.end == FastWalk::arrived && SurfaceId{asked.instance, walk.triangle} == other;
    // Nobody asks for other steps.
    if (other.is_background() || (is_through && (walks.how[ended] & MeshWalks::kMayCrossLines) == 0)) return;
    walk.step_count = 0;
    for (std::uint32_t step = walks.last_step[ended]; step != MeshWalks::kNoStep; step = walks.previous[step])
        ++walk.step_count;
    FastWalk::Step* const steps = &steps_[step_count_];
    step_count_ += static_cast<std::size_t>(walk.step_count);
    int at = walk.step_count;
    for (std::uint32_t step = walks.last_step[ended]; step != MeshWalks::kNoStep; step = walks.previous[step]) {
        const std::uint32_t exit = walks.exit[step];
        steps[--at] = {exit / 3, exit, 0, walks.left[step]};
    }
    for (int k = 1; k < walk.step_count; ++k) steps[k].entered = steps[k - 1].left;
    steps[0].entered = FastWalk::kBefore;
    walk.steps = steps;
    if (is_through) walker_.note_lines(pairs_[asked.pair], asked.from == 1, walk);
}

}  // namespace burin
