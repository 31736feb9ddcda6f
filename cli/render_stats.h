#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json_writer.h"
#include "output/paths/make_paths.h"
#include "render/frame.h"
#include "render/method.h"
#include "render/stats.h"

namespace burin {

/// Wall seconds of all that a picture takes.
struct StageTimes {
    double load_s = 0, write_s = 0, total_s = 0;
    RenderStats render;
    std::optional<VectorStats> paths;
};

/// The median of several renders, stage by stage.
RenderStats median_of(std::vector<RenderStats> runs);

/// Of all stages of drawing.
double drawing_seconds(const RenderStats& stats);

/// What --stats writes of one picture.
std::string stats_json(const StageTimes& times, const Frame& frame, const Method& method);

/// The member "stages" of an object.
void add_stages(JsonWriter& json, const StageTimes& times);
/// The most memory that the process has had.
std::uint64_t peak_memory_bytes();

}  // namespace burin
