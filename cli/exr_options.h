#pragma once

#include <string>

#include "cli/arguments.h"
#include "output/output_format.h"

namespace burin {

/// Options of EXR files as they were typed.
struct ExrTexts {
    std::string channel_names, compression, overscan;
    bool parts = false;
};

/// Adds them to a command. `App`: of the library that reads command lines.
template <typename App>
void add_exr_options(App& app, ExrTexts& t, bool has_overscan) {
    app.add_flag("--parts", t.parts, "EXR: each layer is a part of its own");
    app.add_option("--channel-names", t.channel_names,
                   "EXR: plain (default), or blender, which shows only channels that end in one letter");
    app.add_option("--compression", t.compression, "EXR: zip (default), zips, rle or none");
    if (has_overscan)
        app.add_option("--overscan", t.overscan, "EXR: so many pixels are rendered around the picture, too");
}

/// Checks them. Throws UsageError.
void fill_exr_options(const ExrTexts& texts, Arguments& arguments);

/// Refuses them for another format. Throws UsageError.
void refuse_exr_options(const Arguments& arguments, OutputFormat format);

}  // namespace burin
