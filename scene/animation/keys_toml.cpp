#include "scene/animation/keys_toml.h"

#include <string>

#include "base/interrupt.h"
#include "mesh/text_scan.h"
#include "scene/animation/frame_list.h"

namespace burin {
namespace {

constexpr TomlReader::Range kFrames{-kLargestFrame, kLargestFrame};

Interpolation read_interpolation(TomlReader& t) {
    static constexpr Interpolation kWays[] = {Interpolation::smooth, Interpolation::linear, Interpolation::step};
    return kWays[t.choice("interpolation", {"smooth", "linear", "step"}).value_or(0)];
}

/// Calls use(key, frame) for each key of a table; it returns whether the key names anything. `owner`: 'camera "main"'.
template <typename Use>
void for_each_key(TomlReader& t, const std::string& owner, const std::string& names, const Use& use) {
    std::optional<double> before;
    for (TomlReader& key : t.tables("key")) {
        throw_if_interrupted();
        const std::optional<double> frame = key.number("frame", kFrames);
        if (!frame) TomlReader::fail_at(key.position(), owner + ": a key needs a frame");
        if (before && *frame == *before)
            TomlReader::fail_at(key.position("frame"), owner + ": two keys at frame " + text_of_frame(*frame));
        if (before && *frame < *before) {
            TomlReader::fail_at(key.position("frame"), owner + ": the key at frame " + text_of_frame(*frame) +
                                                           " stands behind that at frame " + text_of_frame(*before) +
                                                           "; put keys in ascending order");
        }
        before = frame;
        const bool has_any = use(key, *frame);
        key.finish();
        if (!has_any) {
            TomlReader::fail_at(key.position(),
                                owner + ": the key at frame " + text_of_frame(*frame) + " says nothing; give " + names);
        }
    }
}

template <typename T>
bool add_if_given(KeyCurve<T>& curve, double frame, const std::optional<T>& value) {
    if (value) curve.add(frame, *value);
    return value.has_value();
}

std::string quoted_owner(const std::string& kind, const std::string& name) {
    return name.empty() ? kind : kind + " \"" + printable(name, 200) + "\"";
}

}  // namespace

ObjectKeys read_object_keys(TomlReader& t, const Placement& rest) {
    ObjectKeys keys;
    keys.rest = rest;
    keys.interpolation = read_interpolation(t);
    if (t.has("key") && t.has("matrix")) t.fail("key", "cannot stand beside a matrix; use translate, rotate and scale");
    const std::string name = t.is_text("name") ? *t.text("name") : "";
    for_each_key(t, quoted_owner("object", name), "translate, rotate or scale", [&](TomlReader& key, double frame) {
        bool any = add_if_given(keys.translate, frame, key.vector("translate"));
        any |= add_if_given(keys.rotate_deg, frame, key.vector("rotate"));
        return any | add_if_given(keys.scale, frame, read_scale(key));
    });
    return keys;
}

CameraKeys read_camera_keys(TomlReader& t, const CameraSettings& rest) {
    CameraKeys keys;
    keys.interpolation = read_interpolation(t);
    const std::string owner = quoted_owner("camera", rest.name);
    for_each_key(t, owner, "eye, target, up, fov or height", [&](TomlReader& key, double frame) {
        const auto refuse = [&](const char* name, const std::string& why) {
            if (key.has(name)) TomlReader::fail_at(key.position(name), owner + ": " + why);
        };
        if (rest.direction) refuse("eye", "an eye cannot stand beside a direction; remove one");
        if (rest.orthographic) refuse("fov", "an orthographic camera has no fov; use height");
        if (!rest.orthographic)
            refuse("height", "a perspective camera has no height; use fov, or projection = \"orthographic\"");
        bool any = add_if_given(keys.eye, frame, key.vector("eye"));
        any |= add_if_given(keys.target, frame, key.vector("target"));
        any |= add_if_given(keys.up, frame, key.vector("up"));
        any |= add_if_given(keys.fov_deg, frame, key.number("fov", {0, 180, true, true}));
        return any | add_if_given(keys.height, frame, key.number("height", kPositive));
    });
    return keys;
}

std::optional<glm::dvec3> read_scale(TomlReader& t) {
    if (!t.has("scale")) return std::nullopt;
    const glm::dvec3 scale = t.is_number("scale") ? glm::dvec3(*t.number("scale", kAnyNumber)) : *t.vector("scale");
    if (scale.x == 0 || scale.y == 0 || scale.z == 0) t.fail("scale", "must not be zero");
    return scale;
}

Turntable read_turntable(TomlReader& t) {
    Turntable turntable;
    const std::optional<int> frames = t.integer("frames", 1, static_cast<int>(kMostFrames));
    if (!frames) t.fail("needs frames: in how many the camera goes around");
    turntable.frames = *frames;
    turntable.axis = t.vector("axis").value_or(turntable.axis);
    if (!(glm::length(turntable.axis) > 0)) t.fail("axis", "must not be zero");
    turntable.degrees = t.number("degrees", {-1e6, 1e6}).value_or(turntable.degrees);
    turntable.first = t.number("first", {-1e8, 1e8}).value_or(turntable.first);
    t.finish();
    return turntable;
}

std::vector<double> read_frame_range(TomlReader& t, std::string_view key) {
    if (t.is_number(key)) return {*t.number(key, kFrames)};
    const std::optional<std::string> text = t.text(key);
    if (!text) return {};
    try {
        return parse_frame_list(*text);
    } catch (const InputError& error) {
        t.fail(key, error.what());
    }
}

std::optional<double> read_frame_rate(TomlReader& t, std::string_view key) {
    if (!t.is_text(key)) return t.number(key, {0, 1000000, true, false});
    try {
        return parse_frame_rate(*t.text(key));
    } catch (const InputError& error) {
        t.fail(key, error.what());
    }
}

}  // namespace burin
