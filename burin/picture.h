#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "burin/burin.h"
#include "burin/view_input.h"
#include "output/film_files.h"
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
    burin::ExrOptions exr;            ///< what a file says of it
    /// All channels, where the film has not all of them.
    std::optional<burin::Image> all_channels;

    burin_picture(const burin::Frame& frame, burin::Film f, int t, std::vector<std::string> n)
        : film(std::move(f)), settings(frame.scene->picture), threads(t), notes(std::move(n)) {
        const burin::FilmChannels channels(frame, film);
        burin::OutputOptions options;
        options.threads = t;
        exr = channels.exr_options(frame, options);
        const burin::PixelRect rows = film.crop();
        if (channels.adds_any()) all_channels = channels.rows(burin::strip_of(film.image()), rows.y0, rows.y1);
    }
    const burin::Image& image() const { return all_channels ? *all_channels : film.image(); }
};
