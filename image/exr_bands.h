#pragma once

#include <string>
#include <vector>

#include "image/image.h"

namespace burin {

/// Joins EXR files of bands of one picture, as `--crop 0,Y0,W,Y1` makes them, to one file: chunks are copied as they
/// are, windows and tables of places written anew. If Y0 of each band but the first is a multiple of the rows of a
/// chunk (16 for ZIP) below the first one's, the file is the one, byte for byte, that the whole picture is when it is
/// rendered at once. Bands may come in any order.
///
/// Throws InputError, which names the file, for what is no whole EXR, and for bands of other headers, other columns,
/// with gaps, or over each other. The output appears only when it is complete. Bands that no fingerprint tells apart
/// may be of different scenes.
struct JoinedBands {
    PixelRect display;             ///< display window
    PixelRect data;                ///< data window of the joined file
    bool has_fingerprint = false;  ///< by which bands are known to be of one scene
};
JoinedBands join_exr_bands(const std::vector<std::string>& band_paths, const std::string& output_path);

}  // namespace burin
