#include "abuffer/picture_slices.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <string>

#include "abuffer/hidden_pass.h"
#include "abuffer/screen/sampling.h"
#include "abuffer/slice_costs.h"
#include "base/error.h"
#include "base/limit_error.h"
#include "base/parallel.h"
#include "lines/whole_line.h"

namespace burin {
namespace {

/// Instances with this many vertices together are shown at a time to take a look at them, even if each has fewer.
constexpr std::size_t kGroupVertices = 1 << 14;
/// Room for the buffers of one thread, and for all that is small.
constexpr std::uint64_t kBytesPerThread = 4 << 20, kBytesForTheRest = 4 << 20;

std::uint64_t vertex_bytes(const Frame& frame, std::uint32_t instance) {
    return frame.surfaces.instances[instance].mesh->positions.size() * sizeof(ScreenVertex);
}

std::vector<std::vector<std::uint32_t>> group_instances(const Frame& frame) {
    const auto& instances = frame.surfaces.instances;
    std::size_t most = kGroupVertices;
    for (const SurfaceInstance& i : instances) most = std::max(most, i.mesh->positions.size());
    std::vector<std::vector<std::uint32_t>> groups;
    std::size_t count = most;
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        count += instances[i].mesh->positions.size();
        if (count > most || groups.empty()) {
            groups.emplace_back();
            count = instances[i].mesh->positions.size();
        }
        groups.back().push_back(i);
    }
    return groups;
}

/// The bytes of what stays as long as the picture is rendered.
std::uint64_t lasting_bytes(const Frame& frame, const PixelTiles& tiles, int threads) {
    std::uint64_t bytes = kBytesForTheRest + kBytesPerThread * static_cast<std::uint64_t>(threads);
    std::set<const Mesh*> meshes;
    for (const SurfaceInstance& i : frame.surfaces.instances) {
        bytes += 2 * i.mesh->triangles.size();                                // facing, and which edges may be lines
        if (meshes.insert(i.mesh).second) bytes += i.mesh->triangles.size();  // edges that are sharp
    }
    return bytes + tiles.count() * 64;
}

/// The most that the edges along which dashes run may take. All are needed at once, with where they stand along their
/// chains and which of them lie on each other.
std::uint64_t feature_bytes(const Frame& frame, const ScreenSurfaces& screen) {
    constexpr std::uint64_t kBytes = sizeof(WholeLine) + 384;
    std::uint64_t sides = 0;
    for (std::uint32_t i = 0; i < frame.surfaces.instances.size(); ++i) {
        const std::size_t count = frame.surfaces.instances[i].mesh->triangles.size();
        const std::uint8_t* const sharp = screen.sharp_edges(i);
        sides += 2 * frame.surfaces.instances[i].mesh->loose_edges.size();
        for (std::size_t t = 0; t < count; ++t)
            sides += sharp == nullptr ? 3u : static_cast<unsigned>(std::popcount(sharp[t] & 7u));
    }
    return sides * kBytes;
}

/// Rows of one kind of tiles, with the memory that they take.
struct Rows {
    std::vector<std::uint64_t> bytes;   // of what touches them, without vertices
    std::vector<TileRows> of_instance;  // empty where it is not in the picture
};

TileRows rows_of(const PixelTiles& tiles, const InstanceExtent& extent, const PixelRect& picture, int tile_px) {
    const bool is_seen = extent.low.x <= picture.x1 && extent.low.y <= picture.y1 && extent.high.x >= picture.x0 &&
                         extent.high.y >= picture.y0;
    if (!is_seen) return {};
    // There is a pixel more on either side, for tiles also get the samples next to them.
    const auto row_at = [&](double y) {
        const double row = std::floor((y - tiles.rect().y0) / tile_px);
        return static_cast<int>(std::clamp(row, 0.0, static_cast<double>(tiles.rows().end - 1)));
    };
    return {row_at(extent.low.y - 2), row_at(extent.high.y + 2) + 1};
}

std::vector<std::uint32_t> instances_in(const Rows& rows, TileRows of) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < rows.of_instance.size(); ++i) {
        if (rows.of_instance[i].begin < of.end && rows.of_instance[i].end > of.begin) found.push_back(i);
    }
    return found;
}

/// Cuts rows into as few slices as fit into `cap_bytes`; `least_bytes` becomes what the largest row takes.
std::vector<PictureSlice> cut(const Frame& frame, const Rows& rows, std::uint64_t cap_bytes,
                              std::uint64_t& least_bytes) {
    const auto count = static_cast<int>(rows.bytes.size());
    // Vertices of instances that begin in a row, and of those that touch it.
    std::vector<std::uint64_t> begin(rows.bytes.size(), 0), touch(rows.bytes.size(), 0);
    for (std::uint32_t i = 0; i < rows.of_instance.size(); ++i) {
        const TileRows r = rows.of_instance[i];
        if (r.begin == r.end) continue;
        begin[static_cast<std::size_t>(r.begin)] += vertex_bytes(frame, i);
        for (int row = r.begin; row < r.end; ++row) touch[static_cast<std::size_t>(row)] += vertex_bytes(frame, i);
    }
    std::vector<PictureSlice> pieces;
    for (int row = 0; row < count;) {
        auto at = static_cast<std::size_t>(row);
        PictureSlice piece{{row, row + 1}, {}};
        std::uint64_t bytes = touch[at] + rows.bytes[at];
        least_bytes = std::max(least_bytes, bytes);
        for (++row, ++at; row < count; ++row, ++at) {
            least_bytes = std::max(least_bytes, touch[at] + rows.bytes[at]);
            bytes += begin[at] + rows.bytes[at];
            if (bytes > cap_bytes) break;
            piece.rows.end = row + 1;
        }
        piece.instances = instances_in(rows, piece.rows);
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

}  // namespace

SlicePlan plan_slices(const Frame& frame, ScreenSurfaces& screen, const PixelTiles& tiles, std::uint64_t cap_bytes,
                      int threads) {
    SlicePlan plan;
    plan.groups = group_instances(frame);
    const bool has_layers = frame.needs.behind();
    const PixelTiles layer_tiles = HiddenPass::tiles_of(frame);
    const PixelRect a = tiles.rect(), b = layer_tiles.rect();
    const PixelRect picture{std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
    const std::size_t instance_count = frame.surfaces.instances.size();
    Rows visible, layers;
    visible.of_instance.resize(instance_count);
    layers.of_instance.resize(instance_count);
    SliceCosts costs(tiles, has_layers ? &layer_tiles : nullptr, samples_per_pixel_of(frame),
                     frame.scene->abuffer.draws_fine_lines(), threads);
    std::uint64_t least = 0;
    for (const std::vector<std::uint32_t>& group : plan.groups) {
        screen.show(group, threads);
        costs.add(screen);
        parallel_for(group.size(), threads, [&](std::size_t i, int) {
            const InstanceExtent extent = SliceCosts::extent_of(screen, group[i]);
            visible.of_instance[group[i]] = rows_of(tiles, extent, picture, tiles.tile_px());
            if (has_layers) layers.of_instance[group[i]] = rows_of(layer_tiles, extent, picture, layer_tiles.tile_px());
        });
        std::uint64_t bytes = 0;
        for (const std::uint32_t i : group) bytes += vertex_bytes(frame, i);
        least = std::max(least, bytes);
    }
    // Lines are kept to the end of a slice, or of the picture where other lines have to be found first.
    std::uint64_t lasting = lasting_bytes(frame, tiles, threads);
    if (frame.needs.whole_lines) lasting += feature_bytes(frame, screen);
    lasting += (costs.largest_layer_tile() + costs.largest_fine_tile()) * static_cast<std::uint64_t>(threads);
    const auto split = [&](const RowCosts& rows, bool keeps_lines) {
        std::vector<std::uint64_t> bytes = rows.bins;
        for (std::size_t i = 0; i < bytes.size(); ++i) (keeps_lines ? lasting : bytes[i]) += rows.lines[i];
        return bytes;
    };
    visible.bytes = split(costs.visible(), has_layers || frame.needs.whole_picture);
    layers.bytes = split(costs.layers(), frame.needs.whole_picture_behind);
    const std::uint64_t left = cap_bytes > lasting ? cap_bytes - lasting : 0;
    plan.visible = cut(frame, visible, left, least);
    plan.layers = cut(frame, layers, left, least);
    plan.least_bytes = least + lasting;
    if (plan.least_bytes > cap_bytes) {
        const std::uint64_t least_mb = (plan.least_bytes + (1 << 20) - 1) >> 20;
        throw LimitError("this picture", least_mb, "use fewer threads");
    }
    return plan;
}

}  // namespace burin
