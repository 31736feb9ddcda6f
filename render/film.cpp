#include "render/film.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <type_traits>

#include "base/error.h"
#include "base/stream_store.h"
#include "image/half.h"

namespace burin {
namespace {

constexpr int kWholeShift = 31;  // one band has all rows

/// Calls add(name, type, plane) for the channels of the chosen layers.
template <typename Planes, typename Add>
void for_channels(const LayerSet& layers, LineClassSet classes, Planes& planes, const Add& add) {
    const auto add_rgba = [&](const std::string& prefix, std::uint16_t* (&of)[4]) {
        const char* const names[4] = {"R", "G", "B", "A"};
        for (int c = 0; c < 4; ++c) add(prefix + names[c], PixelType::float16, of[c]);
    };
    if (layers.beauty) add_rgba("", planes.beauty);
    if (layers.lines) add_rgba("lines.", planes.lines);
    if (layers.surface) add_rgba("surface.", planes.surface);
    if (layers.lines_hidden) add_rgba("lines_hidden.", planes.lines_hidden);
    for (std::size_t i = 0; i < kLineClassCount && layers.coverage; ++i) {
        if (!classes.has(static_cast<LineClass>(i))) continue;
        add("coverage." + std::string(kLineClassNames[i]), PixelType::float16, planes.coverage[i]);
    }
    if (layers.depth) add("Z", PixelType::float32, planes.depth);
    if (layers.normal) {
        add("N.X", PixelType::float32, planes.normal[0]);
        add("N.Y", PixelType::float32, planes.normal[1]);
        add("N.Z", PixelType::float32, planes.normal[2]);
    }
    if (layers.ids) {
        add("id.object", PixelType::uint32, planes.ids[0]);
        add("id.material", PixelType::uint32, planes.ids[1]);
        add("id.polygon", PixelType::uint32, planes.ids[2]);
    }
}

}  // namespace

std::uint16_t Film::to_half(float value) { return half_from_float(std::min(value, 65504.0f)); }

struct Film::Opening {
    std::mutex mutex;
    std::size_t bands = 0;                      // that are open
    std::vector<std::unique_ptr<Band>> closed;  // for others: between them a heap would fall to pieces
};

Film::Film(PixelRect display, PixelRect crop, const LayerSet& layers, LineClassSet classes)
    : Film(display, crop, layers, classes, kWholeShift) {
    open(crop.y0, crop.y1);
}

Film Film::in_bands(PixelRect display, PixelRect crop, const LayerSet& layers, LineClassSet classes) {
    return {display, crop, layers, classes, std::countr_zero(static_cast<unsigned>(kBandRows))};
}

Film::Film(PixelRect display, PixelRect crop, const LayerSet& layers, LineClassSet classes, int band_shift)
    : display_(display),
      crop_(crop),
      layers_(layers),
      classes_(classes),
      band_shift_(band_shift),
      bands_(number_of(std::max(crop.y0, crop.y1 - 1)) + 1),
      opening_(std::make_unique<Opening>()) {}

Film::~Film() = default;
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;

std::vector<ChannelFormat> Film::channels() const {
    std::vector<ChannelFormat> channels;
    Planes none;
    for_channels(layers_, classes_, none, [&](const std::string& name, PixelType type, const auto*) { channels.push_back({name, type}); });
    return channels;
}

void Film::check_memory(std::size_t bands) const {
    const double rows = std::min(std::ldexp(static_cast<double>(bands), band_shift_), double(crop_.height()));
    std::size_t bytes_per_pixel = 0;
    for (const ChannelFormat& channel : channels()) bytes_per_pixel += size_of(channel.type);
    const double needed = crop_.width() * rows * static_cast<double>(bytes_per_pixel);
    const double physical = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (needed <= 0.8 * physical) return;
    throw InputError("an image of " + std::to_string(crop_.width()) + "x" + std::to_string(crop_.height()) +
                     " pixels needs " + std::to_string(static_cast<long>(needed / 1e9)) + " GB, this machine has " +
                     std::to_string(static_cast<long>(physical / 1e9)) +
                     "; use a smaller --size, fewer --layers, or render parts with --crop");
}

PixelRect Film::rows_of(std::size_t band) const {
    const std::int64_t first = crop_.y0 + (static_cast<std::int64_t>(band) << band_shift_);
    const std::int64_t end = std::min<std::int64_t>(first + (std::int64_t{1} << band_shift_), crop_.y1);
    return {crop_.x0, static_cast<int>(first), crop_.x1, static_cast<int>(end)};
}

std::unique_ptr<Film::Band> Film::make_band(PixelRect rows) const {
    auto band = std::make_unique<Band>();
    band->image = Image(display_, rows);
    for_channels(layers_, classes_, band->planes, [&](const std::string& name, PixelType type, auto*& plane) {
        using Value = std::remove_pointer_t<std::remove_reference_t<decltype(plane)>>;
        plane = band->image.add_unfilled(name, type).template as<Value>().data();
    });
    return band;
}

void Film::open(int y0, int y1) {
    y0 = std::max(y0, crop_.y0);
    y1 = std::min(y1, crop_.y1);
    if (y0 >= y1) return;
    const std::lock_guard lock(opening_->mutex);
    const auto first = bands_.begin() + static_cast<std::ptrdiff_t>(number_of(y0));
    const auto end = bands_.begin() + static_cast<std::ptrdiff_t>(number_of(y1 - 1)) + 1;
    const auto missing = static_cast<std::size_t>(std::count(first, end, nullptr));
    if (missing > 0) check_memory(opening_->bands + missing);
    for (std::size_t i = number_of(y0); i <= number_of(y1 - 1); ++i) {
        if (bands_[i] != nullptr) continue;
        const PixelRect rows = rows_of(i);
        auto& closed = opening_->closed;
        if (!closed.empty() && closed.back()->image.height() == rows.height()) {
            bands_[i] = std::move(closed.back());
            closed.pop_back();
            bands_[i]->image.move_to(rows.y0);
        } else {
            bands_[i] = make_band(rows);
        }
        for (std::uint16_t* const plane : bands_[i]->planes.lines_hidden) {  // not put for each pixel
            if (plane != nullptr) std::fill_n(plane, bands_[i]->image.pixel_count(), std::uint16_t{0});
        }
        ++opening_->bands;
    }
}

void Film::close(std::size_t number) {
    const std::lock_guard lock(opening_->mutex);
    if (bands_[number] == nullptr) return;
    opening_->closed.push_back(std::move(bands_[number]));
    --opening_->bands;
}

Film::Place Film::place_of(int x, int y) const {
    const int row = y - crop_.y0;
    const Band& band = *bands_[number_of(y)];
    const std::size_t row_in_band = static_cast<std::size_t>(row) & ((std::size_t{1} << band_shift_) - 1);
    return {band.planes, row_in_band * static_cast<std::size_t>(crop_.width()) + static_cast<std::size_t>(x - crop_.x0)};
}

bool Film::has_geometry() const { return layers_.depth || layers_.normal || layers_.ids; }

void Film::put_background(int x0, int x1, int y) {
    const auto [planes, begin] = place_of(x0, y);
    const std::size_t count = static_cast<std::size_t>(x1 - x0);
    const auto clear = [&](auto* plane, auto value) {
        if (plane != nullptr) stream_fill(plane + begin, count, value);
    };
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::uint16_t* plane : {planes.beauty[c], planes.lines[c], planes.surface[c]}) {
            clear(plane, std::uint16_t{0});
        }
    }
    for (std::uint16_t* plane : planes.coverage) clear(plane, std::uint16_t{0});
    clear(planes.depth, std::numeric_limits<float>::infinity());
    for (std::size_t c = 0; c < 3; ++c) {
        clear(planes.normal[c], 0.0f);
        clear(planes.ids[c], std::uint32_t{0});
    }
}

void Film::put_color(int x0, int x1, int y, const HalfColor& color) {
    const auto [planes, begin] = place_of(x0, y);
    const std::size_t count = static_cast<std::size_t>(x1 - x0);
    const auto fill = [&](std::uint16_t* plane, std::uint16_t value) {
        if (plane != nullptr) std::fill_n(plane + begin, count, value);
    };
    for (std::size_t c = 0; c < 4; ++c) {
        fill(planes.beauty[c], color[c]);
        fill(planes.surface[c], color[c]);
        fill(planes.lines[c], 0);
    }
    for (std::uint16_t* plane : planes.coverage) fill(plane, 0);
}

void Film::put_colors(int x0, int x1, int y, const std::array<const std::uint16_t*, 4>& colors) {
    const auto [planes, begin] = place_of(x0, y);
    const std::size_t count = static_cast<std::size_t>(x1 - x0);
    const auto clear = [&](std::uint16_t* plane) {
        if (plane != nullptr) std::fill_n(plane + begin, count, std::uint16_t{0});
    };
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::uint16_t* plane : {planes.beauty[c], planes.surface[c]}) {
            if (plane != nullptr) std::copy_n(colors[c], count, plane + begin);
        }
        clear(planes.lines[c]);
    }
    for (std::uint16_t* plane : planes.coverage) clear(plane);
}

void Film::put_geometry(int x0, int x1, int y, const GeometryRow& row) {
    const auto [planes, begin] = place_of(x0, y);
    const std::size_t count = static_cast<std::size_t>(x1 - x0);
    const auto stream = [&](auto* plane, const auto* values) {  // nothing is drawn over these
        if (plane != nullptr) stream_copy(values, count, plane + begin);
    };
    stream(planes.depth, row.distance);
    for (std::size_t c = 0; c < 3; ++c) {
        stream(planes.normal[c], row.normal[c]);
        stream(planes.ids[c], row.ids[c]);
    }
}

void Film::prefetch(int x, int y) const {
    const auto [planes, i] = place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        if (planes.lines[c] != nullptr) __builtin_prefetch(planes.lines[c] + i, 1);
        if (planes.beauty[c] != nullptr) __builtin_prefetch(planes.beauty[c] + i, 1);
    }
}

void Film::draw_over(int x, int y, const LinePixel& lines) {
    const auto [planes, i] = place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        const float color = lines.color[static_cast<int>(c)];
        if (planes.lines[c] != nullptr) planes.lines[c][i] = to_half(color);
        std::uint16_t* const beauty = planes.beauty[c];
        if (beauty != nullptr) beauty[i] = to_half(float_from_half(beauty[i]) * (1.0f - lines.color.a) + color);
    }
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        if (planes.coverage[c] != nullptr) planes.coverage[c][i] = to_half(lines.coverage[c]);
    }
}

void Film::replace_surface(int x, int y, const glm::vec4& color) {
    const auto [planes, i] = place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        const std::uint16_t value = to_half(color[static_cast<int>(c)]);
        if (planes.beauty[c] != nullptr) planes.beauty[c][i] = value;
        if (planes.surface[c] != nullptr) planes.surface[c][i] = value;
    }
}

void Film::draw_hidden(int x, int y, const glm::vec4& hidden, const glm::vec4& seen) {
    const auto [planes, i] = place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        if (planes.lines_hidden[c] != nullptr) planes.lines_hidden[c][i] = to_half(hidden[static_cast<int>(c)]);
        std::uint16_t* const beauty = planes.beauty[c];
        if (beauty == nullptr) continue;
        beauty[i] = to_half(float_from_half(beauty[i]) * (1.0f - seen.a) + seen[static_cast<int>(c)]);
    }
}

void Film::add_lines(int x, int y, const LinePixel& lines) {
    const auto [planes, i] = place_of(x, y);
    const auto add = [i](std::uint16_t* plane, float value) {
        if (plane != nullptr) plane[i] = to_half(float_from_half(plane[i]) + value);
    };
    for (std::size_t c = 0; c < 4; ++c) add(planes.lines[c], lines.color[static_cast<int>(c)]);
    for (std::size_t c = 0; c < kLineClassCount; ++c) add(planes.coverage[c], lines.coverage[c]);
}

void Film::put(int x, int y, const PixelResult& pixel) {
    const auto [planes, i] = place_of(x, y);
    const auto put_rgba = [at = i](std::uint16_t* const (&of)[4], const glm::vec4& color) {
        if (of[0] == nullptr) return;
        for (int c = 0; c < 4; ++c) of[c][at] = to_half(color[c]);
    };
    put_rgba(planes.beauty, pixel.beauty);
    put_rgba(planes.lines, pixel.lines);
    put_rgba(planes.surface, pixel.surface);
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        if (planes.coverage[c] != nullptr) planes.coverage[c][i] = to_half(pixel.coverage[c]);
    }
    if (planes.depth != nullptr) planes.depth[i] = pixel.distance;
    if (planes.normal[0] != nullptr) {
        for (int c = 0; c < 3; ++c) planes.normal[c][i] = pixel.normal[c];
    }
    if (planes.ids[0] != nullptr) {
        planes.ids[0][i] = pixel.object_id;
        planes.ids[1][i] = pixel.material_id;
        planes.ids[2][i] = pixel.polygon_id;
    }
}

}  // namespace burin
