#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/mapped_file.h"
#include "base/parallel.h"
#include "mesh/obj_pieces.h"
#include "mesh/read_mtl.h"
#include "mesh/readers.h"
#include "mesh/text_scan.h"

namespace burin {
namespace {

ObjPart parse(const std::string& path, std::string_view text, int threads, std::size_t piece_size,
              const AttributeWish& attributes) {
    if (attributes.uv || attributes.color) return parse_obj_part(path, text, true, attributes);
    const std::vector<std::string_view> pieces = cut_between_statements(text, piece_size);
    if (pieces.size() > 1) {
        if (std::optional<ObjPart> whole = parse_obj_pieces(path, pieces, threads)) return std::move(*whole);
    }
    return parse_obj_part(path, text, true);
}

void check(const std::string& path, const ObjPart& file) {
    if (file.largest_reference > static_cast<std::int64_t>(file.soup.positions.size())) {
        throw InputError({path, file.largest_reference_line},
                         "vertex " + std::to_string(file.largest_reference) + " does not exist (the file has " +
                             std::to_string(file.soup.positions.size()) + "); repair or re-export the file");
    }
    if (file.soup.positions.empty()) {
        throw InputError(path + ": no vertices found; is this an OBJ file?");
    }
    if (file.soup.polygon_ends.empty() && file.soup.marked_edges.empty()) {
        throw InputError(path +
                         ": no polygons and no lines found; burin draws the lines of surfaces, and "
                         "lines by themselves");
    }
}

PolygonSoup finished(const std::string& path, ObjPart file, OtherFiles* other_files) {
    PolygonSoup soup = std::move(file.soup);
    const bool has_objects = file.objects.names().size() > 1;
    const NameUses& objects = has_objects ? file.objects : file.groups;
    soup.polygon_object = objects.per_polygon(soup.polygon_ends.size());
    if (!soup.marked_edges.empty()) soup.marked_edge_object = objects.per_line(soup.marked_edges.size());
    soup.polygon_material = file.materials.per_polygon(soup.polygon_ends.size());
    soup.object_names = objects.names();
    soup.object_names[0] = std::filesystem::path(path).stem().string();
    const auto library = read_material_files(path, file.material_files, other_files, &soup.notes);
    const auto note = [&](std::uint64_t count, const char* what) {
        if (count > 0) soup.notes.push_back(std::string(what) + " left out: " + std::to_string(count));
    };
    note(file.points, "points");
    note(file.free_forms, "curves and surfaces of higher order");
    note(file.missing_texture_coordinates, "texture coordinates of corners that name some which do not exist");
    if (const auto& unknown = file.unknown; unknown.count > 0) {
        soup.notes.push_back(
            "lines left out that begin with a word that is not known: " + std::to_string(unknown.count) +
            "; the first one is line " + std::to_string(unknown.first) + ", '" + unknown.word + "'");
    }
    for (const std::string& name : file.materials.names()) {
        const auto found = library.find(name);
        Material material;
        if (found != library.end()) material = found->second;
        material.name = name;
        soup.materials.push_back(material);
    }
    return soup;
}

}  // namespace

PolygonSoup read_obj_text(const std::string& path, std::string_view text, int threads, std::size_t piece_size,
                          OtherFiles* other_files, const AttributeWish& attributes) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
        throw InputError(path + ": the text is UTF-16; save it as UTF-8 or ASCII");
    }
    ObjPart file = parse(path, without_byte_order_mark(text), threads, piece_size, attributes);
    check(path, file);
    return finished(path, std::move(file), other_files);
}

PolygonSoup read_obj(const std::string& path, int threads, OtherFiles* other_files, const AttributeWish& attributes) {
    const MappedFile file(path);
    const std::string_view text = file.bytes();
    const auto workers = static_cast<std::size_t>(resolve_thread_count(threads));
    // Threads pay for themselves where there is enough to read.
    const std::size_t size = std::clamp<std::size_t>(text.size() / (8 * workers), 1 << 18, 1 << 20);
    return read_obj_text(path, text, threads, workers == 1 ? text.size() : size, other_files, attributes);
}

}  // namespace burin
