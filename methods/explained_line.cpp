#include "methods/explained_line.h"

namespace burin {

LineTeller::LineTeller(const Frame& frame) : frame_(frame) {}

LineClass LineTeller::class_of(const LinePiece& piece) const {
    return frame_.sheet->class_of(piece.classes).value_or(piece.drawn_as);
}

ExplainedSide LineTeller::side_of(std::uint32_t object, std::uint32_t material) const {
    return {object, material, object == 0 ? "" : frame_.scene->objects[object - 1].name,
            material == 0 ? "" : frame_.scene->materials[material - 1].name};
}

ExplainedLine LineTeller::told(const LinePiece& piece, const LineSides& sides) const {
    ExplainedLine line;
    line.drawn_as = class_of(piece);
    line.classes = piece.classes;
    line.is_edge = piece.line.is_edge();
    line.dihedral_deg = static_cast<double>(sides.dihedral_deg);
    line.crease_from_deg = frame_.scene->lines.crease_fade().from_deg;
    line.front = side_of(sides.front_object, sides.front_material);
    line.other = side_of(sides.other_object, sides.other_material);
    line.other_is_behind = sides.is_beyond;
    line.invisibility = piece.invisibility;
    return line;
}

std::string LineTeller::refusal(const CompiledSet& set, const LinePiece& piece, const LineSides& sides) const {
    const LineClass c = class_of(piece);
    if (!set.is_enabled) return "it is not enabled";
    if (!set.classes.has(c)) return "class " + std::string(name_of(c)) + " is not in its classes";
    if (piece.invisibility < set.qi[0] || piece.invisibility > set.qi[1])
        return "qi " + std::to_string(piece.invisibility) + " is not in its range";
    const auto has = [](const std::vector<bool>& taken, std::uint32_t number) {
        return number < taken.size() && taken[number];
    };
    if (set.has_object_globs && !has(set.objects, sides.front_object) && !has(set.objects, sides.other_object))
        return "no object fits its objects";
    if (set.has_material_globs && !has(set.materials, sides.front_material) &&
        !has(set.materials, sides.other_material))
        return "no material fits its materials";
    return "its select is false";
}

}  // namespace burin
