#include "scene/surfaces_toml.h"

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "scene/sheet_values.h"
#include "shading/surface/surface_recipe.h"

namespace burin {
namespace {

using Rule = SheetValueRule;

constexpr std::size_t kMostLights = 16;
constexpr auto kShadingNames =
    std::to_array<std::string_view>({"paper", "lambert", "none", "flat", "toon", "gooch", "hatch"});

/// A key of [surfaces] that some shadings alone read.
struct OwnKey {
    std::string_view name;
    std::initializer_list<SurfaceShading> shadings;
};

class SurfacesReader {
  public:
    explicit SurfacesReader(TomlReader& table) : table_(table) {}

    SurfaceStyle read() {
        SurfaceStyle style;
        const auto shading = table_.choice("shading", {kShadingNames.begin(), kShadingNames.end()});
        if (shading) style.shading = static_cast<SurfaceShading>(*shading);
        if (table_.has("color")) {
            if (shading) table_.fail("color", "takes the place of shading; remove one of the two");
            style.shading = SurfaceShading::expression;
        }
        check_owners(style.shading);
        const bool has_paper = table_.has("paper");
        style.paper_color = table_.color("paper").value_or(glm::vec3(1.0f));
        if (has_paper && varies(style.shading) && style.shading != SurfaceShading::hatch)
            table_.fail("paper", "is not read with this shading");
        if (varies(style.shading)) style.recipe = std::make_shared<SurfaceRecipe>(read_recipe(style));
        table_.finish();
        return style;
    }

  private:
    /// A key that the shading does not read would have no effect: it is an error.
    void check_owners(SurfaceShading shading) const {
        using S = SurfaceShading;
        static const OwnKey kKeys[] = {
            {"normals", {S::toon, S::gooch, S::hatch, S::expression}},
            {"shadows", {S::toon, S::gooch, S::hatch}},
            {"tones", {S::toon}},
            {"softness", {S::toon}},
            {"detail", {S::toon}},
            {"cool", {S::gooch}},
            {"warm", {S::gooch}},
            {"tone", {S::hatch}},
            {"ink", {S::hatch}},
            {"ground", {S::hatch}},
            {"spacing", {S::hatch}},
            {"space", {S::hatch}},
            {"angle", {S::hatch}},
            {"axis", {S::hatch}},
            {"levels", {S::hatch}},
        };
        for (const OwnKey& key : kKeys) {
            bool is_read = false;
            std::string owners;
            for (const S owner : key.shadings) {
                is_read = is_read || owner == shading;
                if (owner == S::expression) continue;
                owners += (owners.empty() ? "\"" : ", \"") +
                          std::string(kShadingNames[static_cast<std::size_t>(owner)]) + "\"";
            }
            if (key.name == "normals") owners += ", or a color";
            if (!is_read && table_.has(key.name)) table_.fail(key.name, "is read with shading = " + owners + " only");
        }
    }

    SurfaceRecipe read_recipe(const SurfaceStyle& style) {
        SurfaceRecipe recipe;
        recipe.where = table_.position();
        recipe.has_smooth_normals = table_.choice("normals", {"flat", "smooth"}) == 1u;
        recipe.has_shadows = table_.boolean("shadows").value_or(false);
        if (style.shading == SurfaceShading::expression)
            recipe.color = values_.value(table_, "color", {Rule::Of::color});
        if (style.shading == SurfaceShading::toon) read_toon(recipe);
        if (style.shading == SurfaceShading::gooch) {
            recipe.cool = table_.color("cool").value_or(recipe.cool);
            recipe.warm = table_.color("warm").value_or(recipe.warm);
        }
        if (style.shading == SurfaceShading::hatch) read_hatch(style, recipe);
        return recipe;
    }

    static Ramp read_tones(TomlReader& table) {
        if (!table.is_table("tones"))
            table.fail("tones", "must be a table, such as { stops = [[0, 0.4], [0.3, 1]], between = \"step\" }");
        TomlReader tones = *table.table("tones");
        if (tones.has("over")) tones.fail("over", "tones always go over the light of a place; remove this");
        if (tones.has("outside"))
            tones.fail("outside", "in front of the first stop and behind the last one tones stay");
        SheetUnit unit = SheetUnit::px;
        const bool has_between = tones.has("between");
        Ramp ramp = SheetValueReader::ramp(tones, {Rule::Of::number_or_color, 0, 65504}, unit);
        if (unit != SheetUnit::px) tones.fail("stops", "tones have no unit");
        if (!has_between) ramp.between = RampBetween::step;
        tones.finish();
        return ramp;
    }

    void read_toon(SurfaceRecipe& recipe) {
        recipe.tones = table_.has("tones") ? read_tones(table_) : default_tones();
        if (table_.has("softness"))
            recipe.softness = values_.value(table_, "softness", {Rule::Of::length, 0, 4096, false, true});
        check_no_world(recipe.softness);
        if (auto detail = table_.table("detail")) {
            SurfaceRecipe::Detail made;
            if (!detail->has("over")) detail->fail("needs over = \"...\": how much of its tones there is, 0 to 1");
            made.over.kind = StyleValue::Kind::expression;
            made.over.source = values_.expression(*detail, "over");
            if (!detail->has("tones")) detail->fail("needs tones");
            made.tones = read_tones(*detail);
            detail->finish();
            recipe.detail = std::move(made);
        }
    }

    void read_hatch(const SurfaceStyle& style, SurfaceRecipe& recipe) {
        if (table_.has("tone")) {
            if (recipe.has_shadows)
                table_.fail("shadows",
                            "cannot stand beside a tone; let the tone read lit, as in \"=0.2 + 0.8*light*lit\"");
            recipe.tone = values_.value(table_, "tone", {Rule::Of::number, 0, 1});
        } else {
            recipe.tone.kind = StyleValue::Kind::expression;
            recipe.tone.source.text = recipe.has_shadows ? "0.15 + 0.85 * light * lit" : "0.15 + 0.85 * light";
        }
        recipe.ground = StyleValue::of_color({style.paper_color.r, style.paper_color.g, style.paper_color.b});
        if (table_.has("ground")) recipe.ground = values_.value(table_, "ground", {Rule::Of::color});
        if (table_.has("ink")) recipe.ink = values_.value(table_, "ink", {Rule::Of::color});
        if (table_.has("spacing"))
            recipe.spacing = values_.value(table_, "spacing", {Rule::Of::length, 0, 4096, false, true});
        check_no_world(recipe.spacing);
        recipe.space = static_cast<HatchSpace>(table_.choice("space", {"screen", "object", "uv"}).value_or(0));
        const bool is_on_object = recipe.space == HatchSpace::object;
        if (is_on_object && table_.has("angle"))
            table_.fail("angle", "is of lines on the screen or on textures; give an axis instead");
        if (!is_on_object && table_.has("axis")) table_.fail("axis", "is of lines on objects; add space = \"object\"");
        recipe.angle_deg = table_.number("angle", {-360, 360}).value_or(recipe.angle_deg);
        recipe.axis = table_.vector("axis").value_or(recipe.axis);
        if (!(glm::length(recipe.axis) > 1e-12 && glm::length(recipe.axis) <= 1e30))
            table_.fail("axis", "must be a direction, such as [0, 1, 0]");
        recipe.levels = table_.integer("levels", 1, 4).value_or(recipe.levels);
    }

    static void check_no_world(const StyleValue& value) {
        if (value.unit == SheetUnit::world) value.source.fail("takes no world units: it is a length on the screen");
    }

    TomlReader& table_;
    SheetValueReader values_;
};

}  // namespace

SurfaceStyle read_surfaces(TomlReader& table) { return SurfacesReader(table).read(); }

std::vector<SceneLight> read_lights(TomlReader& root) {
    std::vector<SceneLight> lights;
    for (TomlReader& t : root.tables("light")) {
        SceneLight light;
        const auto direction = t.vector("direction"), position = t.vector("position");
        if (direction && position) t.fail("position", "cannot stand beside a direction; remove one");
        if (!direction && !position) t.fail("needs a direction, which points to the light, or a position");
        light.is_at_point = position.has_value();
        light.place = position ? *position : *direction;
        if (!(glm::length(light.place) <= 1e30)) t.fail(position ? "position" : "direction", "is too far away");
        if (direction && !(glm::length(*direction) > 1e-12))
            t.fail("direction", "must not be 0; it points to the light, such as [-1, 1, 1]");
        if (direction) light.place = glm::normalize(*direction);
        light.is_in_camera = t.choice("space", {"world", "camera"}) == 1u;
        t.finish();
        if (lights.size() == kMostLights) t.fail("there are more than " + std::to_string(kMostLights) + " lights");
        lights.push_back(light);
    }
    return lights;
}

}  // namespace burin
