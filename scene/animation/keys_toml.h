#pragma once

#include <optional>
#include <vector>

#include "scene/animation/keys.h"
#include "scene/animation/turntable.h"
#include "scene/toml_reader.h"

namespace burin {

/// A number, or one per axis, that is not 0; nothing if the key is not there.
std::optional<glm::dvec3> read_scale(TomlReader& table);

/// [[object.key]] and `interpolation` of an object's table. `rest`: its own translate, rotate and scale.
ObjectKeys read_object_keys(TomlReader& object, const Placement& rest);

/// [[camera.key]] and `interpolation` of a camera's table.
CameraKeys read_camera_keys(TomlReader& camera, const CameraSettings& rest);

/// [turntable].
Turntable read_turntable(TomlReader& table);

/// A list of frames, "1-100": `range` of [frames].
std::vector<double> read_frame_range(TomlReader& table, std::string_view key);
/// A number, or a text such as "24000/1001".
std::optional<double> read_frame_rate(TomlReader& table, std::string_view key);

}  // namespace burin
