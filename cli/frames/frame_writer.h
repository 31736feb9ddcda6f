#pragma once

#include <functional>
#include <future>
#include <memory>

#include "cli/frames/frame_renderer.h"

namespace burin {

/// Writes drawn frames one after the other, each beside the drawing of the next one. What is being written when the
/// user stops the program is finished.
class FrameWriter {
  public:
    /// `in_background`: false: each is written before write() returns. `finished`: called when a frame is written,
    /// maybe by another thread; `failed`: when it could not be, with what write() threw.
    FrameWriter(const Arguments& arguments, bool in_background, std::function<void(const DrawnFrame&)> finished,
                std::function<void(const DrawnFrame&, const std::string&)> failed);
    ~FrameWriter();
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    /// Waits for the last frame, then begins with this one.
    void write(DrawnFrame frame);
    /// Waits for the last frame. Throws what was no InputError.
    void wait();

  private:
    void write_now(DrawnFrame& frame) const;

    const Arguments& arguments_;
    bool in_background_;
    std::function<void(const DrawnFrame&)> finished_;
    std::function<void(const DrawnFrame&, const std::string&)> failed_;
    std::future<void> current_;
};

}  // namespace burin
