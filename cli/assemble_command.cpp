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
    join_exr_bands(a.bands, a.output);
}

}  // namespace burin
