#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesh/other_files.h"
#include "mesh/polygon_soup.h"

// An OBJ names material files, from which colours and opacities are read.

namespace burin {

/// Colours (`Kd`) and opacities (`d`, `Tr`) from the MTL files that an OBJ names. Where `d` and
/// `Tr` differ, `d` counts; `Tr 1` alone is opaque: it stands in files whose writers take it for
/// the opacity, and nobody exports what cannot be seen.
///
/// `file_names` is what stands behind each `mtllib`: a name, perhaps with blanks in it, or several.
/// Only files in the OBJ's own folder or below are read, each once, and not the OBJ itself. A file
/// that is missing or broken is left out: materials then keep the default colour, and the lines are
/// the same. `other_files`: gets the paths of those that are there, and of textures that they name. `notes`: gets what
/// is not read or not understood, a line each with the count.
std::map<std::string, Material, std::less<>> read_material_files(const std::string& obj_path,
                                                                 const std::vector<std::string>& file_names,
                                                                 OtherFiles* other_files = nullptr,
                                                                 std::vector<std::string>* notes = nullptr);

}  // namespace burin
