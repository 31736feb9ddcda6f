#include "scene/style_toml.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "shading/expression/error.h"
#include "shading/expression/unknown_word.h"

namespace burin {
namespace {

using Rule = SheetValueRule;
using Of = SheetValueRule::Of;

constexpr Rule kWidth{Of::length, 0, 4096};
constexpr Rule kOpacity{Of::number, 0, 1};
constexpr Rule kColor{Of::color};
constexpr Rule kWay{Of::length, -4096, 4096};  // offset, overshoot
constexpr Rule kLength{Of::length, 0, 65535};
constexpr Rule kPositiveLength{Of::length, 0, 65535, true};
constexpr Rule kPhase{Of::length, -65535, 65535};
constexpr Rule kHalo{Of::length, 0, 1024};
constexpr Rule kAmplitude{Of::length, 0, 4096};
constexpr Rule kSmooth{Of::length, 0, 1024, false, true};

/// Reads the keys of styles, one after the other.
class StyleReader {
  public:
    StyleReader(TomlReader& table, SheetValueReader& values, SheetStyle& style)
        : t_(table), values_(values), style_(style) {}

    void read() {
        if (t_.has("texture")) t_.fail("texture", "is not in this version");
        read_value("width", kWidth, style_.width);
        read_value("opacity", kOpacity, style_.opacity);
        read_value("color", kColor, style_.color);
        read_value("offset", kWay, style_.offset);
        read_taper();
        read_dash();
        read_value("dash_phase", kPhase, style_.dash_phase);
        read_value("overshoot", kWay, style_.overshoot);
        read_wobble();
        read_value("halo", kHalo, style_.halo);
        read_pair("halo_depth", style_.halo_depth, false);
        read_pair("min_length", style_.min_length, true);
        read_value("smooth", kSmooth, style_.smooth);
        if (style_.smooth.unit == SheetUnit::world) t_.fail("smooth", "takes no world units; use px, mm, pt or %");
        if (t_.node("shader") != nullptr) {
            style_.shader = SheetValueReader::word(t_, "shader");
            if (style_.shader->text == "none") style_.shader.reset();
        }
        read_settings();
        t_.finish();
    }

  private:
    void read_value(const char* key, const Rule& rule, StyleValue& value) {
        if (t_.node(key) != nullptr) value = values_.value(t_, key, rule);
    }

    /// Whether a key has the word that stands for nothing.
    bool is_word(const char* key, const char* word) { return t_.is_text(key) && t_.text(key) == word; }

    void read_taper() {
        if (t_.node("taper") == nullptr) return;
        if (is_word("taper", "none")) return style_.taper.reset();
        TomlReader taper = *t_.table("taper");
        StyleTaper made;
        if (taper.node("start") != nullptr) made.start = values_.value(taper, "start", kLength);
        if (taper.node("end") != nullptr) made.end = values_.value(taper, "end", kLength);
        static constexpr TaperShape kShapes[] = {TaperShape::round, TaperShape::linear, TaperShape::sharp};
        made.shape = kShapes[taper.choice("shape", {"round", "linear", "sharp"}).value_or(0)];
        made.at = taper.choice("at", {"free", "all"}) == 1u ? TaperAt::all : TaperAt::free;
        taper.finish();
        style_.taper = std::move(made);
    }

    void read_dash() {
        if (t_.node("dash") == nullptr) return;
        if (is_word("dash", "solid")) return style_.dash.clear();
        const std::size_t count = SheetValueReader::list_size(t_, "dash");
        if (count < 2 || count > 8 || count % 2 != 0)
            t_.fail("dash", "must be a list of 2, 4, 6 or 8 lengths, on, off, ..., or \"solid\"");
        style_.dash.clear();
        for (std::size_t k = 0; k < count; ++k) style_.dash.push_back(values_.element(t_, "dash", k, kPositiveLength));
    }

    void read_wobble() {
        if (t_.node("wobble") == nullptr) return;
        if (is_word("wobble", "none")) return style_.wobble.reset();
        TomlReader wobble = *t_.table("wobble");
        StyleWobble made;
        if (wobble.node("amplitude") != nullptr) made.amplitude = values_.value(wobble, "amplitude", kAmplitude);
        if (wobble.node("wavelength") != nullptr)
            made.wavelength = values_.value(wobble, "wavelength", kPositiveLength);
        made.octaves = wobble.integer("octaves", 1, 8).value_or(1);
        made.anchor = wobble.choice("anchor", {"object", "chain"}) == 1u ? WobbleAnchor::chain : WobbleAnchor::object;
        made.pin = wobble.boolean("pin").value_or(true);
        wobble.finish();
        style_.wobble = std::move(made);
    }

    /// Two lengths, the smaller one first; or one that counts for both.
    void read_pair(const char* key, std::array<StyleValue, 2>& pair, bool may_be_one) {
        if (t_.node(key) == nullptr) return;
        const bool is_list = t_.node(key)->is_array();
        if (!is_list && may_be_one) {
            pair.fill(values_.value(t_, key, kLength));
            return;
        }
        if (SheetValueReader::list_size(t_, key) != 2)
            t_.fail(key, std::string("must be ") + (may_be_one ? "a length, or " : "") + "a list of two lengths");
        for (std::size_t k = 0; k < 2; ++k) pair[k] = values_.element(t_, key, k, kLength);
        const auto is_number = [](const StyleValue& v) { return v.kind == StyleValue::Kind::number; };
        if (is_number(pair[0]) && is_number(pair[1]) && pair[0].unit == pair[1].unit && pair[0].number > pair[1].number)
            t_.fail(key, "must have the smaller length first");
    }

    void read_settings() {
        StyleSettings& to = style_.settings;
        static constexpr StrokeSide kSides[] = {StrokeSide::both, StrokeSide::inside, StrokeSide::outside};
        if (const auto side = t_.choice("side", {"both", "inside", "outside"})) to.side = kSides[*side];
        if (const auto caps = t_.choice("caps", {"round", "butt"}))
            to.caps = *caps == 0 ? StrokeCaps::round : StrokeCaps::butt;
        if (const auto blend = t_.choice("blend", {"over", "multiply"}))
            to.blend = *blend == 0 ? InkBlend::over : InkBlend::multiply;
        to.copies = t_.integer("copies", 1, 8).value_or(to.copies);
        to.priority = t_.integer("priority", -1000000, 1000000).value_or(to.priority);
        if (const auto seed = t_.integer("seed", 0, 2147483647)) to.seed = static_cast<std::uint32_t>(*seed);
        to.hold = t_.integer("hold", 1, 1000000).value_or(to.hold);
        to.boil = t_.boolean("boil").value_or(to.boil);
    }

    TomlReader& t_;
    SheetValueReader& values_;
    SheetStyle& style_;
};

/// Completes styles by what they inherit.
class StyleTable {
  public:
    StyleTable(TomlReader& styles, SheetValueReader& values)
        : styles_(styles), values_(values), names_(styles.keys()) {}

    std::vector<SheetStyle> read() {
        if (names_.size() > kMostSheetStyles)
            styles_.fail("has more than " + std::to_string(kMostSheetStyles) + " styles");
        std::vector<SheetStyle> result;
        for (const std::string& name : names_) result.push_back(complete(name));
        return result;
    }

  private:
    const SheetStyle& complete(const std::string& name) {
        if (const auto known = done_.find(name); known != done_.end()) return known->second;
        TomlReader table = *styles_.table(name);
        if (!is_sheet_word(name)) table.fail("a style's name has letters, digits, _ and - only");
        going_on_.push_back(name);
        SheetStyle style;
        if (const auto base = table.text("base")) {
            if (std::find(names_.begin(), names_.end(), *base) == names_.end())
                table.fail("base", "there is no style " + in_quotes(*base) + suggestion_of(*base, names_));
            const auto loop = std::find(going_on_.begin(), going_on_.end(), *base);
            if (loop != going_on_.end()) {
                std::string way;
                for (auto at = loop; at != going_on_.end(); ++at) way += *at + " -> ";
                table.fail("base", "styles inherit from each other in a circle: " + way + *base);
            }
            style = complete(*base);
        }
        style.name = name;
        style.where = table.position();
        StyleReader(table, values_, style).read();
        going_on_.pop_back();
        return done_.emplace(name, std::move(style)).first->second;
    }

    TomlReader& styles_;
    SheetValueReader& values_;
    std::vector<std::string> names_;
    std::vector<std::string> going_on_;
    std::map<std::string, SheetStyle> done_;
};

}  // namespace

std::vector<SheetStyle> read_styles(TomlReader& styles, SheetValueReader& values) {
    return StyleTable(styles, values).read();
}

}  // namespace burin
