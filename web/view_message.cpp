#include "web/view_message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "mesh/text_scan.h"
#include "scene/parse_toml.h"
#include "scene/toml_reader.h"

namespace burin {
namespace {

constexpr std::string_view kPage = "docs/view.md";
constexpr int kLastNumber = std::numeric_limits<int>::max();

int whole_side(TomlReader& t, double side) {
    if (!(side >= 1 && side <= kLargestViewSide && side == std::floor(side)))
        t.fail("size", "must be two whole numbers from 1 to " + std::to_string(kLargestViewSide));
    return static_cast<int>(side);
}

glm::dvec3 needed_vector(TomlReader& t, const char* key) {
    const auto vector = t.vector(key);
    if (!vector) t.fail(std::string(key) + " is missing");
    return *vector;
}

void read_size(TomlReader& t, View& view) {
    const auto size = t.numbers("size", 2);
    if (!size) t.fail("size is missing");
    view.width = whole_side(t, (*size)[0]);
    view.height = whole_side(t, (*size)[1]);
}

void read_camera(TomlReader& root, View& view) {
    auto t = root.table("camera");
    if (!t) root.fail("camera is missing");
    view.eye = needed_vector(*t, "eye");
    view.target = needed_vector(*t, "target");
    view.up = needed_vector(*t, "up");
    if (t->has("height") && t->has("fov")) t->fail("height", "cannot stand beside fov");
    view.height_of_view = t->number("height", kPositive);
    view.fov_deg = t->number("fov", {0, 180, true, true}).value_or(view.fov_deg);
    t->finish();
}

Look read_look(TomlReader& root) {
    Look look;
    look.classes = {};
    for (const std::string& name : root.texts("lines").value_or(std::vector<std::string>{})) {
        const auto line_class = line_class_named(name);
        if (!line_class) root.fail("lines", "unknown line class '" + printable(name) + "'");
        look.classes |= *line_class;
    }
    look.crease_angle_deg = root.number("crease_angle", {0, 180}).value_or(look.crease_angle_deg);
    look.width_px = root.number("width", {0, 1024, true, false}).value_or(look.width_px);
    static constexpr HiddenStyle kStyles[] = {HiddenStyle::none, HiddenStyle::solid, HiddenStyle::dashed};
    look.hidden = kStyles[root.choice("hidden", {"none", "solid", "dashed"}).value_or(0)];
    static const std::vector<std::string_view> kShadings = {"",     "paper", "lambert", "none",
                                                            "flat", "toon",  "gooch",   "hatch"};
    look.shading = kShadings[root.choice("shading", kShadings).value_or(0)];
    look.style = root.text("style").value_or("");
    look.sheet = root.text("sheet").value_or("");
    if (auto parameters = root.table("parameters")) {
        const std::vector<std::string> names = parameters->keys();
        if (names.size() > kMostParameters) root.fail("parameters", "are too many");
        for (const std::string& name : names) look.parameters.emplace_back(name, *parameters->text(name));
    }
    return look;
}

ViewMessage read_message(TomlReader& root) {
    using Kind = ViewMessage::Kind;
    static constexpr std::array kKinds = {Kind::draw,    Kind::look, Kind::home,   Kind::fit,
                                          Kind::explain, Kind::save, Kind::command};
    ViewMessage message;
    const auto kind = root.choice("kind", {"draw", "look", "home", "fit", "explain", "save", "command"});
    if (!kind) root.fail("kind is missing");
    message.kind = kKinds[*kind];
    message.number = root.integer("number", 0, kLastNumber).value_or(0);
    if (message.kind == Kind::look) {
        message.look = read_look(root);
    } else {
        read_size(root, message.view);
        if (message.kind != Kind::home) read_camera(root, message.view);
    }
    if (message.kind == Kind::draw) message.is_full = root.boolean("full").value_or(false);
    if (message.kind == Kind::explain) {
        const auto x = root.integer("x", 0, message.view.width - 1), y = root.integer("y", 0, message.view.height - 1);
        if (!x || !y) root.fail("x or y is missing");
        message.x = *x;
        message.y = *y;
        message.reach_px = root.integer("reach", 0, kMostReachPx).value_or(0);
    }
    if (message.kind == Kind::save) {
        static constexpr ViewMessage::Format kFormats[] = {ViewMessage::Format::png, ViewMessage::Format::svg,
                                                           ViewMessage::Format::toml};
        const auto format = root.choice("format", {"png", "svg", "toml"});
        if (!format) root.fail("format is missing");
        message.format = kFormats[*format];
    }
    root.finish();
    return message;
}

}  // namespace

CameraSettings View::camera() const {
    CameraSettings camera;
    camera.eye = eye;
    camera.target = target;
    camera.up = up;
    camera.fov_deg = fov_deg;
    camera.orthographic = height_of_view.has_value();
    camera.height = height_of_view;
    return camera;
}

ViewMessage read_view_message(std::string_view text) {
    const toml::table tables = parse_checked_toml(text, "message", "a message", kMostMessageBytes);
    TomlReader root(tables, "", "message", kPage);
    return read_message(root);
}

}  // namespace burin
