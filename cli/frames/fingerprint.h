#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/content_hash.h"
#include "cli/arguments.h"
#include "cli/job.h"
#include "output/output_format.h"

namespace burin {

/// The fingerprint of a frame; both are empty if files are to have none. An EXR says which part of the picture it has,
/// others do not.
struct FrameFingerprint {
    std::string of_exr, of_others;

    const std::string& of(OutputFormat format) const { return format == OutputFormat::exr ? of_exr : of_others; }
};

/// Tells by 16 hexadecimal digits whether a frame has been made from the same input: the version of the program, the
/// scene with what the command line says of it, the contents of all files that were read, where everything stands in
/// that frame, and its number. What changes no pixel is not in it.
class Fingerprints {
  public:
    /// Reads all files of the input. `scene`: at rest. Throws InputError.
    Fingerprints(const Arguments& arguments, const LoadedInput& input);

    /// `places`: of the frame, without what moves within models; `cameras`: all that see it; `files`: those that are
    /// read for this frame alone; `later_files`: those of the next one, which a frame can do without. Throws
    /// InputError.
    FrameFingerprint of(const SceneChange& places, const std::vector<Camera>& cameras,
                        const std::vector<std::string>& files, const std::vector<std::string>& later_files) const;

  private:
    const Arguments& arguments_;
    ContentHash of_all_;  // frames
};

}  // namespace burin
