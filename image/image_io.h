#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/byte_sink.h"
#include "image/display_image.h"
#include "image/image.h"

// A film over paper becomes a picture for the screen, and that a PNG or a TIFF.

namespace burin {

/// sRGB transfer function (IEC 61966-2-1): linear light 0..1 to code value 0..1, and back.
float srgb_from_linear(float linear);
float linear_from_srgb(float code);

/// The channels R, G, B, A (premultiplied, linear) as a picture over `background` (linear), or, if
/// there is none, with an alpha channel. The display window is filled; pixels outside of the data
/// window are background.
DisplayImage to_display(const Image& image, std::optional<glm::vec3> background);

/// Writes a PNG or TIFF (by extension) with 8 or 16 bits per value. The file appears under its name
/// only when it is complete. Throws InputError.
void write_display_image(const std::string& path, const DisplayImage& image, int bits);

/// The same into a file that is open. `extension`: ".png", ".tif" or ".tiff"; `name`: for messages.
void write_display_image(ByteSink& file, const std::string& name, const std::string& extension,
                         const DisplayImage& image, int bits);

/// Fails before the work, not after it: throws InputError if write_display_image() does not know the suffix of this
/// path or what it needs for it cannot be loaded.
void check_display_writer(const std::string& path);

/// Reads a PNG or TIFF. Throws InputError. For tests and tools.
DisplayImage read_display_image(const std::string& path);

}  // namespace burin
