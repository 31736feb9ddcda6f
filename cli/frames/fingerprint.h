#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/content_hash.h"
#include "cli/arguments.h"
#include "cli/job.h"
#include "output/output_format.h"

namespace burin {

/// Tells by 16 hexadecimal digits whether a frame has been made from the same input: the version of the program, the
/// scene with what the command line says of it, the contents of all files that were read, where everything stands in
/// that frame, and its number. What changes no pixel is not in it.
class Fingerprints {
  public:
    /// Reads all files of the input. `scene`: at rest. Throws InputError.
    Fingerprints(const Arguments& arguments, const LoadedInput& input);

    /// `places`: of the frame, without what moves within models; `cameras`: all that see it; `files`: those that are
    /// read for this frame alone. Throws InputError.
    std::string of(const SceneChange& places, const std::vector<Camera>& cameras, const std::vector<std::string>& files,
                   OutputFormat format) const;

  private:
    const Arguments& arguments_;
    ContentHash of_all_;  // frames
};

}  // namespace burin
