#include "cli/farm_options.h"

#include "base/lower_extension.h"
#include "cli/option_values.h"

namespace burin {

using namespace option_values;

void fill_farm_options(const FarmTexts& t, Arguments& a) {
    constexpr int kMostFramesOfATask = 100000, kMostBands = 1000, kMostRetries = 100;
    if (!t.chunk.empty()) a.frames_of_a_task = integer("--chunk", t.chunk, 1, kMostFramesOfATask);
    if (!t.bands.empty()) a.band_count = integer("--bands", t.bands, 1, kMostBands);
    if (!t.retries.empty()) a.retries = integer("--retries", t.retries, 0, kMostRetries);
    a.is_dry_run = t.is_dry_run;
    if (a.command == Command::render && a.json && !a.is_dry_run) fail("--json", "needs --dry-run");
    a.sbatch_options = t.sbatch_options;
    if (a.band_count <= 1) return;
    std::vector<std::string> pictures = a.more_outputs;
    if (!a.output.empty() || a.deep.empty()) pictures.push_back(a.output);
    for (const std::string& picture : pictures) {
        if (lower_extension(picture) != ".exr") fail("--bands", "EXR only");
    }
    if (a.crop) fail("--bands", "cannot stand beside --crop; remove one");
    if (!a.save_lines.empty()) fail("--bands", "cannot stand beside --save-lines; remove one");
}

}  // namespace burin
