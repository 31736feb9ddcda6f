#pragma once

#include <string>
#include <utility>
#include <vector>

#include "burin/burin.h"
#include "burin/view_input.h"
#include "render/film.h"
#include "render/frame.h"
#include "scene/scene.h"

namespace burin {

/// What is encoded and written through a `const void*` begins with this.
enum class OutputKind : std::uint32_t { picture = 0x62757270, drawing = 0x62757264 };

/// A film with the layers that options ask for. Throws UsageError where it would have no channel.
Film film_of(const Frame& frame, const OptionsInput& options);

}  // namespace burin

struct burin_picture {
    const burin::OutputKind kind = burin::OutputKind::picture;
    burin::Film film;
    burin::PictureSettings settings;  ///< what is below it
    int threads = 0;                  ///< for encoding, as for drawing
    std::vector<std::string> notes;   ///< what its user should know

    burin_picture(burin::Film f, burin::PictureSettings s, int t, std::vector<std::string> n)
        : film(std::move(f)), settings(std::move(s)), threads(t), notes(std::move(n)) {}
};
