// What drawing a frame will take, told without drawing it.
#include <algorithm>
#include <cstddef>

#include "base/limit_error.h"
#include "cli/frames/frame_renderer.h"
#include "methods/abuffer.h"
#include "render/sub_frames.h"

namespace burin {

FrameRenderer::Outlook FrameRenderer::outlook() {
    for (auto frame = plan_.frames.begin();; ++frame) {
        try {
            pose(change_at(*frame));
            break;
        } catch (const InputError&) {
            if (!arguments_.keeps_going || frame + 1 == plan_.frames.end()) throw;
        }
    }
    Outlook found;
    const PictureSettings& picture = scene().picture;
    const MomentAt moments = [this, number = scene().frame.number](double time, MomentUse use) {
        return moment_at(number, time, use);
    };
    found.sub_frames = sub_frame_count(blur_, moments, picture.width, picture.height);
    if (blur_.shutter) moments(middle_sub_frame(&*blur_.shutter).time, MomentUse::drawing);
    Frame frame = frame_of(scene(), camera_, arguments_, &posed_.prepared());
    found.layers = layers_of_picture(frame, found.is_in_bands);
    found.is_in_bands = found.is_in_bands && found.sub_frames == 1;
    found.finishes_in_bands = method_.finishes_in_bands != nullptr && method_.finishes_in_bands(frame);
    found.covered = covered_blocks(frame);
    if (method_.name != "abuffer" || !views_.empty()) return found;
    LayerSet layers = found.layers;
    layers.motion = false;  // it changes nothing of that
    make_ready(frame, layers, 0);
    count_pieces(frame, found);
    return found;
}

void FrameRenderer::count_pieces(const Frame& frame, Outlook& outlook) const {
    RunOptions run{arguments_.threads, nullptr, arguments_.memory_bytes};
    std::size_t parts = 1;
    if (outlook.sub_frames > 1) {
        const PixelRect display{0, 0, frame.width, frame.height};
        const Film film = Film::in_bands(display, frame.crop, outlook.layers, frame.criteria.classes);
        const BlurParts blur = blur_parts(run, film);
        parts = std::max<std::size_t>(1, blur.rows.size());
        run.memory_bytes = blur.cap_bytes;
    }
    try {
        const SliceCount count = slices_of(frame, run.memory_bytes, run.threads);
        outlook.pieces = std::max(parts, count.slices);
        outlook.least_cap_bytes = count.least_bytes * (outlook.sub_frames > 1 ? 2 : 1);  // sums take up to a half
    } catch (const LimitError& error) {
        const LimitError least = outlook.sub_frames > 1 ? error.times(2) : error;
        throw InputError(arguments_.input + ": --memory: " + least.what());
    }
}

}  // namespace burin
