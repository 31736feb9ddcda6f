#include "cli/frames/frame_writer.h"

#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/interrupt.h"

namespace burin {
namespace {

/// The flag that writing looks at: nobody sets it.
const StopFlag kNeverStops{false};

}  // namespace

FrameWriter::FrameWriter(const Arguments& arguments, bool in_background,
                         std::function<void(const DrawnFrame&)> finished,
                         std::function<void(const DrawnFrame&, const std::string&)> failed)
    : arguments_(arguments),
      in_background_(in_background),
      finished_(std::move(finished)),
      failed_(std::move(failed)) {}

FrameWriter::~FrameWriter() {
    if (current_.valid()) current_.wait();
}

void FrameWriter::write(DrawnFrame frame) {
    wait();
    if (in_background_) {
        const auto shared = std::make_shared<DrawnFrame>(std::move(frame));
        try {
            current_ = std::async(std::launch::async, [this, shared] { write_now(*shared); });
        } catch (const std::system_error&) {  // the system has no more threads
            write_now(*shared);
        }
        return;
    }
    write_now(frame);
}

void FrameWriter::wait() {
    if (current_.valid()) current_.get();
}

void FrameWriter::write_now(DrawnFrame& frame) const {
    const StopScope scope(kNeverStops);
    try {
        frame.write(arguments_);
    } catch (const InputError& error) {
        failed_(frame, error.what());
        return;
    }
    finished_(frame);
}

}  // namespace burin
