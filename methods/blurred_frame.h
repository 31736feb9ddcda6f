#pragma once

#include <functional>
#include <optional>

#include "render/method.h"
#include "render/sub_frames.h"

// Motion blur and depth of field, by any method: sub-frames are drawn one after the other, and their mean is the frame.

namespace burin {

/// A scene as it is at one time, and the camera that sees it.
struct Moment {
    const Scene* scene = nullptr;
    Camera camera;
    const PreparedScene* prepared = nullptr;  ///< of the scene; nullptr: nothing is prepared
};

/// What a Moment is wanted for.
enum class MomentUse : std::uint8_t {
    drawing,
    extent,  ///< only places are looked at, so that nothing need be prepared
};

/// Gives the scene at a time, in frames relative to the frame; it is valid until the next call.
using MomentAt = std::function<Moment(double time, MomentUse use)>;

/// Makes a frame ready to be drawn, beyond what its scene asks for. `is_middle`: what has no mean is taken of it.
using ReadyFrame = std::function<void(Frame& frame, bool is_middle)>;

/// How a frame is blurred.
struct Blur {
    std::optional<ShutterSettings> shutter;  ///< none: nothing moves while it is open
    bool has_lens = false;
    std::optional<int> samples;  ///< sub-frames; none: as many as the picture needs

    bool is_asked_for() const { return shutter || has_lens; }
};

/// How many sub-frames a picture of this size has. 1: it is drawn as without blur, at the frame's own time.
int sub_frame_count(const Blur& blur, const MomentAt& moment_at, int width, int height);

/// Draws a frame as the mean of `count` sub-frames, 2 or more. What has no mean (depth, normals, ids, motion, single
/// lines) is that of the middle of shutter and lens. `film` lies in memory as a whole; `width` and `height` are those
/// of the whole picture. Sums take 4 bytes per pixel and channel that has a mean; under a cap for memory they are made
/// for some rows after the other. Progress counts sub-frames.
RenderStats render_blurred(const Method& method, const Blur& blur, int count, const MomentAt& moment_at, int width,
                           int height, const RunOptions& options, Film& film, const ReadyFrame& make_ready = {});

/// How many pictures render_blurred() draws.
std::size_t sub_frames_drawn(int count, const RunOptions& options, const Film& film);

/// The rows that sub-frames are drawn and summed for at once, one part of the picture after the other, and the cap for
/// memory (0: none) that drawing has beside their sums.
struct BlurParts {
    std::vector<PixelRect> rows;
    std::uint64_t cap_bytes = 0;
};
BlurParts blur_parts(const RunOptions& options, const Film& film);

}  // namespace burin
