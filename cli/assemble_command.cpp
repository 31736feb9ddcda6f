#include <cstdio>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/lower_extension.h"
#include "cli/commands.h"
#include "cli/output_files.h"
#include "image/exr_bands.h"

namespace burin {

void run_assemble(const Arguments& a) {
    if (lower_extension(a.output) != ".exr") throw UsageError("--output: bands are joined to an EXR; give a name .exr");
    const std::vector<OutputFile> outputs = {{"--output", a.output}};
    refuse_to_overwrite(outputs, a.bands);
    check_output_file(a.output);
    const JoinedBands joined = join_exr_bands(a.bands, a.output);
    if (a.quiet) return;
    if (joined.data.y0 > joined.display.y0 || joined.data.y1 < joined.display.y1) {
        std::fprintf(stderr, "burin: note: %s has rows %d to %d; the picture has %d to %d\n", a.output.c_str(),
                     joined.data.y0, joined.data.y1 - 1, joined.display.y0, joined.display.y1 - 1);
    }
    if (!joined.has_fingerprint) {
        std::fputs(
            "burin: note: the bands have no fingerprint that tells whether they are of one scene; "
            "render --skip-existing writes it\n",
            stderr);
    }
}

}  // namespace burin
