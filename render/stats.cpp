#include "render/stats.h"

#include <algorithm>

namespace burin {

void add(const RenderStats& more, RenderStats& sum) {
    for (double RenderStats::*stage : {&RenderStats::prepare_s, &RenderStats::raster_s, &RenderStats::resolve_s,
                                       &RenderStats::lines_s, &RenderStats::shade_s, &RenderStats::write_s})
        sum.*stage += more.*stage;
    sum.triangles = more.triangles;
    sum.fragments += more.fragments;
    sum.threads = more.threads;
    for (const std::string& note : more.notes) {
        if (std::find(sum.notes.begin(), sum.notes.end(), note) == sum.notes.end()) sum.notes.push_back(note);
    }
}

}  // namespace burin
