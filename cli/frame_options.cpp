#include "cli/frame_options.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "cli/option_values.h"
#include "scene/animation/frame_list.h"

namespace burin {

using namespace option_values;

void fill_frame_options(const FrameTexts& t, Arguments& a) {
    try {
        if (!t.frames.empty()) a.frame_list = parse_frame_list(t.frames);
    } catch (const InputError& error) {
        fail("--frames", error.what());
    }
    try {
        if (!t.fps.empty()) a.fps = parse_frame_rate(t.fps);
    } catch (const InputError& error) {
        fail("--fps", error.what());
    }
    if (!t.turntable.empty())
        a.turntable_frames = integer("--turntable", t.turntable, 1, static_cast<int>(kMostFrames));
    a.skips_existing = t.skips_existing;
    a.keeps_going = t.keeps_going;
    fill_blur_options(t.blur, a);
    const auto refuse = [&](bool is_given, const char* beside) {
        if (!is_given) return;
        const std::string option = a.frame_list.empty() ? "--turntable" : "--frames";
        fail(option, std::string("cannot stand beside ") + beside + "; remove one");
    };
    if (a.frame_list.empty() && !a.turntable_frames) return;
    refuse(a.frame.has_value(), "--frame");
    refuse(a.repeat > 0, "--repeat");
    if (a.turntable_frames) refuse(!a.views.empty(), "--views");
}

bool changes_no_picture(std::string_view option) {
    static constexpr std::array kOptions = {"INPUT",
                                            "--output",
                                            "--threads",
                                            "--memory",
                                            "--memory-model",
                                            "--stats",
                                            "--progress",
                                            "-v",
                                            "-q",
                                            "--frames",
                                            "--frame",
                                            "--turntable",
                                            "--crop",
                                            "--repeat",
                                            "--skip-existing",
                                            "--keep-going",
                                            "--strict",
                                            "--dry-run",
                                            "--json",
                                            "--chunk",
                                            "--depth-complexity",
                                            "--bands",
                                            "--retries",
                                            "--save-lines",
                                            "--fps",
                                            "--deep"};
    return std::find(kOptions.begin(), kOptions.end(), option) != kOptions.end();
}

}  // namespace burin
