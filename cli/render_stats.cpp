#include "cli/render_stats.h"

#include <sys/resource.h>

#include <algorithm>

#include "cli/vector_output.h"

namespace burin {

RenderStats median_of(std::vector<RenderStats> runs) {
    RenderStats result = runs.back();
    for (double RenderStats::*stage : {&RenderStats::prepare_s, &RenderStats::raster_s, &RenderStats::resolve_s,
                                       &RenderStats::lines_s, &RenderStats::shade_s}) {
        const auto middle = runs.begin() + static_cast<std::ptrdiff_t>(runs.size() / 2);
        std::nth_element(runs.begin(), middle, runs.end(),
                         [&](const auto& x, const auto& y) { return x.*stage < y.*stage; });
        result.*stage = (*middle).*stage;
    }
    return result;
}

double drawing_seconds(const RenderStats& s) { return s.prepare_s + s.raster_s + s.resolve_s + s.lines_s + s.shade_s; }

std::uint64_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return std::uint64_t{1024} * static_cast<std::uint64_t>(usage.ru_maxrss);
}

void add_stages(JsonWriter& json, const StageTimes& times) {
    json.key("stages").begin_object();
    json.key("load").value(times.load_s);
    json.key("prepare").value(times.render.prepare_s);
    json.key("raster").value(times.render.raster_s);
    json.key("resolve").value(times.render.resolve_s);
    json.key("lines").value(times.render.lines_s);
    json.key("shade").value(times.render.shade_s);
    if (times.paths) add_stages(json, *times.paths);
    json.key("write").value(times.write_s);
    json.key("total").value(times.total_s);
    json.end_object();
}

std::string stats_json(const StageTimes& times, const Frame& frame, const Method& method) {
    JsonWriter json;
    json.begin_object();
    json.key("method").value(method.name);
    json.key("width").value(frame.width).key("height").value(frame.height);
    json.key("threads").value(times.render.threads);
    json.key("triangles").value(times.render.triangles);
    json.key("fragments").value(times.render.fragments);
    json.key("peak_rss_bytes").value(peak_memory_bytes());
    if (times.paths) add_counts(json, *times.paths);
    add_stages(json, times);
    json.end_object();
    return json.text();
}

}  // namespace burin
