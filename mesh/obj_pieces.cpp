#include "mesh/obj_pieces.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/huge_pages.h"
#include "base/parallel.h"

namespace burin {
namespace {

struct Counts {
    std::size_t vertices = 0, corners = 0, polygons = 0, lines = 0;

    void add(const PolygonSoup& soup) {
        vertices += soup.positions.size();
        corners += soup.corners.size();
        polygons += soup.polygon_ends.size();
        lines += soup.marked_edges.size();
    }
};

/// Whether the parts refer to nothing but vertices that are there, and are not too many together.
bool fit_together(const std::vector<ObjPart>& parts) {
    Counts counts;
    std::int64_t largest_reference = 0;
    for (const ObjPart& part : parts) {
        if (part.least_counted_back < -static_cast<std::int64_t>(counts.vertices)) return false;
        largest_reference = std::max(largest_reference, part.largest_reference);
        counts.add(part.soup);
    }
    return counts.vertices <= ObjPart::kMostVertices && counts.corners <= PolygonSoup::kMaxCorners &&
           largest_reference <= static_cast<std::int64_t>(counts.vertices);
}

/// Gives vertices that are counted backwards their numbers in the file.
void resolve_counted_back(PolygonSoup& soup, std::size_t first_vertex) {
    const std::uint32_t offset = static_cast<std::uint32_t>(first_vertex) - ObjPart::kFirstOfPiece;
    const auto resolve = [&](std::uint32_t& vertex) {
        if (vertex >= ObjPart::kFirstOfPiece - ObjPart::kMostVertices) vertex += offset;
    };
    for (std::uint32_t& vertex : soup.corners) resolve(vertex);
    for (auto& edge : soup.marked_edges) std::for_each(edge.begin(), edge.end(), resolve);
}

void append(ObjPart& whole, ObjPart part) {
    Counts before;
    before.add(whole.soup);
    if (part.least_counted_back != ObjPart::kNone) resolve_counted_back(part.soup, before.vertices);
    for (std::uint32_t& end : part.soup.polygon_ends) end += static_cast<std::uint32_t>(before.corners);
    const auto add = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
    add(whole.soup.positions, part.soup.positions);
    add(whole.soup.corners, part.soup.corners);
    add(whole.soup.polygon_ends, part.soup.polygon_ends);
    add(whole.soup.marked_edges, part.soup.marked_edges);
    add(whole.material_files, part.material_files);
    whole.points += part.points;
    whole.free_forms += part.free_forms;
    if (whole.unknown.count == 0 && part.unknown.count > 0) {
        whole.unknown = {0, whole.line_count + part.unknown.first, part.unknown.word};
    }
    whole.unknown.count += part.unknown.count;
    whole.line_count += part.line_count;
    const NameUses::Place first{before.polygons, before.lines};
    whole.objects.append(part.objects, first);
    whole.groups.append(part.groups, first);
    whole.materials.append(part.materials, first);
}

}  // namespace

std::optional<ObjPart> parse_obj_pieces(const std::string& path, std::span<const std::string_view> pieces,
                                        int threads) {
    std::vector<ObjPart> parts(pieces.size());
    try {
        parallel_for(pieces.size(), threads,
                     [&](std::size_t i, int) { parts[i] = parse_obj_part(path, pieces[i], false); });
    } catch (const InputError&) {
        return std::nullopt;
    }
    if (!fit_together(parts)) return std::nullopt;
    Counts all;
    for (const ObjPart& part : parts) all.add(part.soup);
    std::optional<ObjPart> whole(std::in_place);
    reserve_large(whole->soup.positions, all.vertices);
    reserve_large(whole->soup.corners, all.corners);
    reserve_large(whole->soup.polygon_ends, all.polygons);
    for (ObjPart& part : parts) append(*whole, std::exchange(part, {}));  // and free it
    return whole;
}

}  // namespace burin
