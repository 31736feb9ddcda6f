#include "burin/drawn_style.h"

#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "scene/sheet_library.h"
#include "scene/sheet_toml.h"
#include "shading/ink/found_needs.h"
#include "shading/ink/ink_lines.h"
#include "shading/sheet/compiled_sheet.h"

namespace burin {
namespace {

constexpr const char* kFindForIt = "; give the style to burin_set_style() before burin_find_lines()";

SheetContext context_of(const burin_drawing& drawing) {
    const FoundLines& lines = *drawing.found;
    SheetContext context;
    for (const ObjectOfLines& object : lines.objects) context.objects.push_back(object.name);
    context.materials = lines.materials;
    context.width_px = lines.width_px;
    context.height_px = lines.height_px;
    context.px_per_mm = drawing.scene.picture.dpi / 25.4;
    context.frame = lines.frame;
    context.fps = drawing.scene.frame.fps;
    context.shaders = drawing.scene.line_shaders.get();
    return context;
}

/// What decides where lines are must be as it was when they were found.
void check_was_found(const StyleSheet& sheet, const CompiledSheet& compiled, const burin_drawing& drawing) {
    if (const std::string missing = missing_for(sheet, compiled.needs(), *drawing.found); !missing.empty())
        throw UsageError("style: the drawing lacks what the style sheet needs: " + missing + kFindForIt);
}

}  // namespace

InkedLines inked_lines_of(const burin_drawing& drawing, const char* style, int threads, std::vector<std::string>& notes,
                          const InkWishes& wishes) {
    if (!drawing.found)
        throw UsageError(std::string("style: the drawing's lines were found without a style sheet") + kFindForIt);
    threads = resolve_thread_count(threads);
    InkedLines inked;
    inked.filter = drawing.scene.lines.style.filter;
    const PixelFilter filter = inked.filter;
    if (style == nullptr) {
        inked = ink_lines(*drawing.found, *drawing.frame.sheet, threads, notes, wishes);
        inked.filter = filter;
        return inked;
    }
    const NamedSheetText text = sheet_text_of(style);
    const StyleSheet sheet = read_sheet_text(text.text, text.name);
    const CompiledSheet compiled(sheet, context_of(drawing));
    check_was_found(sheet, compiled, drawing);
    if (sheet.light == drawing.found->light) {
        inked = ink_lines(*drawing.found, compiled, threads, notes, wishes);
    } else {
        FoundLines lit = *drawing.found;
        lit.light = sheet.light;
        inked = ink_lines(lit, compiled, threads, notes, wishes);
    }
    inked.filter = sheet.filter.value_or(filter);
    return inked;
}

}  // namespace burin
