#include "burin/drawing.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>

#include "base/parallel.h"
#include "burin/drawn_style.h"
#include "burin/failure.h"
#include "burin/running.h"
#include "mesh/text_scan.h"
#include "methods/abuffer.h"
#include "strokes/ink_printer.h"
#include "view/surface_numbers.h"

namespace burin {
namespace {

/// Shorter pieces are left out of the columns: where a vertex lies exactly between samples, finding leaves a dot of an
/// edge that is no line, such as a diagonal within a polygon.
constexpr double kShortestPx = 1.0 / 1024;

void add_pieces(const LineDrawing::Lists& lists, burin_drawing& drawing) {
    for (const std::span<const LinePiece> list : lists) {
        std::copy_if(list.begin(), list.end(), std::back_inserter(drawing.pieces), [](const LinePiece& piece) {
            return piece.is_drawn && glm::distance(piece.from, piece.to) >= kShortestPx;
        });
    }
}

/// Which object and material each piece's line belongs to: those of its edge's first triangle, or of the first one of
/// two that pass through each other. A loose edge has no material.
void find_owners(const SurfaceSet& surfaces, burin_drawing& drawing) {
    const SurfaceNumbers numbers(surfaces);
    for (const LinePiece& piece : drawing.pieces) {
        const LineId line = piece.line;
        const SurfaceId surface =
            line.is_edge() ? SurfaceId{line.instance(), line.half_edge() / 3} : numbers.of(line.lower_surface());
        const bool is_loose = line.is_edge() && surfaces.instances[line.instance()].mesh->is_loose(line.half_edge());
        drawing.object.push_back(surfaces.object_id(surface));
        drawing.material.push_back(is_loose ? 0 : surfaces.material_id(surface));
    }
}

/// What drawing needs of a frame when its meshes are gone.
void keep_frame(const SceneForFrame& from, burin_drawing& drawing) {
    drawing.scene.materials = from.scene().materials;
    drawing.scene.picture = from.scene().picture;
    drawing.scene.frame = from.scene().frame;
    drawing.scene.lines = from.scene().lines;
    drawing.scene.sheet = from.scene().sheet;
    drawing.scene.line_shaders = from.scene().line_shaders;
    drawing.scene.surfaces = from.scene().surfaces;
    drawing.scene.abuffer = from.scene().abuffer;
    drawing.frame = from.frame();
    drawing.frame.scene = &drawing.scene;
    drawing.frame.prepared = nullptr;
    drawing.frame.surfaces.instances.clear();
}

/// The columns of a drawing: name, type, and how a piece's value is written.
struct ColumnKind {
    std::string_view name;
    int type;
    std::size_t bytes;
    std::function<void(const burin_drawing&, std::size_t piece, std::byte* to)> write;
};

template <typename Value, typename Get>
ColumnKind column_kind(std::string_view name, int type, const Get& get) {
    return {name, type, sizeof(Value), [get](const burin_drawing& drawing, std::size_t i, std::byte* to) {
                const Value value = get(drawing, i);
                std::memcpy(to, &value, sizeof value);
            }};
}

template <typename Value, typename Get>
ColumnKind of_piece(std::string_view name, int type, const Get& get) {
    return column_kind<Value>(name, type,
                              [get](const burin_drawing& d, std::size_t i) -> Value { return get(d.pieces[i]); });
}

const std::vector<ColumnKind>& column_kinds() {
    static const std::vector<ColumnKind> kinds = {
        of_piece<double>("x0", BURIN_DOUBLE, [](const LinePiece& p) { return p.from.x; }),
        of_piece<double>("y0", BURIN_DOUBLE, [](const LinePiece& p) { return p.from.y; }),
        of_piece<double>("x1", BURIN_DOUBLE, [](const LinePiece& p) { return p.to.x; }),
        of_piece<double>("y1", BURIN_DOUBLE, [](const LinePiece& p) { return p.to.y; }),
        of_piece<float>("nearness0", BURIN_FLOAT, [](const LinePiece& p) { return p.nearness_from; }),
        of_piece<float>("nearness1", BURIN_FLOAT, [](const LinePiece& p) { return p.nearness_to; }),
        of_piece<std::uint64_t>("line", BURIN_UINT64, [](const LinePiece& p) { return p.line.bits; }),
        column_kind<std::uint32_t>("object", BURIN_UINT32,
                                   [](const burin_drawing& d, std::size_t i) { return d.object[i]; }),
        column_kind<std::uint32_t>("material", BURIN_UINT32,
                                   [](const burin_drawing& d, std::size_t i) { return d.material[i]; }),
        of_piece<std::uint16_t>("classes", BURIN_UINT16, [](const LinePiece& p) { return p.classes.bits; }),
        of_piece<std::uint8_t>("invisibility", BURIN_UINT8, [](const LinePiece& p) { return p.invisibility; }),
    };
    return kinds;
}

/// Throws UsageError for what is no drawing.
template <typename Drawing>
Drawing& checked_drawing(Drawing* given) {
    if (required(given, "drawing").kind != OutputKind::drawing) {
        throw UsageError("drawing: this is no drawing of burin_find_lines()");
    }
    return *given;
}

const ColumnKind& column_named(std::string_view name) {
    const auto& kinds = column_kinds();
    const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const ColumnKind& k) { return k.name == name; });
    if (found != kinds.end()) return *found;
    std::string known;
    for (const ColumnKind& k : kinds) known += " " + std::string(k.name);
    throw UsageError("unknown column '" + printable(name) + "'; known are" + known);
}

}  // namespace

burin_picture* picture_of(const burin_drawing& drawing, const char* style, int threads) {
    Film film = drawing.surfaces.copy();
    std::vector<std::string> notes;
    if (style == nullptr) notes = drawing.notes;
    if (style == nullptr && !drawing.found) {
        draw_lines(drawing.frame, drawing.laid_out, {threads}, film);
    } else {
        draw_ink(drawing.frame, inked_lines_of(drawing, style, threads, notes), resolve_thread_count(threads), film);
        film.end_picture();
    }
    return new burin_picture(drawing.frame, std::move(film), threads, std::move(notes));
}

}  // namespace burin

using namespace burin;

burin_drawing* burin_find_lines(burin_scene* scene, const burin_view* view, const burin_options* options) {
    return guarded_pointer([&] {
        const FrameCall call(scene, view, options);
        Frame frame = call.ready().frame();
        const bool has_sheet = frame.sheet != nullptr;
        if (!has_sheet) frame.needs.tells_invisibility = true;  // for the column; a sheet has its own needs
        const int threads = call.given().threads;
        auto drawing = std::make_unique<burin_drawing>(film_of(frame, call.given()));
        if (drawing->surfaces.mattes() != nullptr || drawing->surfaces.layers().motion)
            throw UsageError("options.layers: crypto, line and motion are layers of burin_render()");
        Film& film = drawing->surfaces;
        LineDrawing found = call.draw(film, [&] { return find_drawing(frame, call.run(), film); });
        add_pieces(found.visible(), *drawing);
        add_pieces(found.behind(), *drawing);
        find_owners(frame.surfaces, *drawing);
        if (has_sheet) {
            drawing->found = lines_for_sheet(std::move(found), frame, resolve_thread_count(threads));
        } else {
            drawing->laid_out = laid_out_if_needed(std::move(found), frame, threads);
        }
        keep_frame(call.ready(), *drawing);
        drawing->threads = threads;
        drawing->notes = call.ready().notes();
        return drawing.release();
    });
}

void burin_drawing_free(burin_drawing* drawing) { delete drawing; }

burin_picture* burin_draw(const burin_drawing* drawing, const char* style, const burin_options* options) {
    return guarded_pointer([&] {
        const burin_drawing& from = checked_drawing(drawing);
        const OptionsInput given = checked_options(read_struct_or_default(options, "options"));
        if (given.layers) throw UsageError("options.layers: a drawing has the layers of its burin_find_lines()");
        return picture_of(from, style, given.threads);
    });
}

const void* burin_column(burin_drawing* drawing, const char* name, int32_t* type, uint64_t* count) {
    return guarded_pointer([&]() -> const void* {
        burin_drawing& of = checked_drawing(drawing);
        const ColumnKind& kind = column_named(&required(name, "name"));
        if (type != nullptr) *type = kind.type;
        if (count != nullptr) *count = of.pieces.size();
        auto column = std::find_if(of.columns.begin(), of.columns.end(),
                                   [&](const burin_drawing::Column& c) { return c.name == kind.name; });
        if (column == of.columns.end()) {
            burin_drawing::Column made{std::string(kind.name), {}};
            made.values.resize(std::max<std::size_t>(kind.bytes * of.pieces.size(), 1));
            for (std::size_t i = 0; i < of.pieces.size(); ++i) kind.write(of, i, &made.values[kind.bytes * i]);
            column = of.columns.insert(of.columns.end(), std::move(made));
        }
        return column->values.data();
    });
}
