#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"

namespace burin {

/// Options of render farms as they were typed.
struct FarmTexts {
    std::string chunk, bands, retries;
    bool is_dry_run = false;
    std::vector<std::string> band_files;      ///< of `assemble`
    std::vector<std::string> sbatch_options;  ///< of `submit`: what stands behind --
};

/// Checks them. Throws UsageError. The other options have been checked.
void fill_farm_options(const FarmTexts& texts, Arguments& arguments);

}  // namespace burin
