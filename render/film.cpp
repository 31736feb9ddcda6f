#include "render/film.h"

#include <unistd.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/stream_store.h"
#include "image/half.h"

namespace burin {
namespace {

void check_memory(PixelRect crop, std::size_t bytes_per_pixel) {
    const double needed = static_cast<double>(crop.width()) * crop.height() *
                          static_cast<double>(bytes_per_pixel);
    const double physical = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                            static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (needed > 0.8 * physical) {
        throw InputError("an image of " + std::to_string(crop.width()) + "x" +
                         std::to_string(crop.height()) + " pixels needs " +
                         std::to_string(static_cast<long>(needed / 1e9)) + " GB, this machine has " +
                         std::to_string(static_cast<long>(physical / 1e9)) +
                         "; use a smaller --size, fewer --layers, or render parts with --crop");
    }
}

}  // namespace

std::uint16_t Film::to_half(float value) { return half_from_float(std::min(value, 65504.0f)); }

Film::Film(PixelRect display, PixelRect crop, const LayerSet& layers, LineClassSet classes)
    : image_(display, crop) {
    std::size_t bytes = 0;
    std::vector<std::function<void()>> bindings;  // channel memory stands still only at the end
    using Add = Channel& (Image::*)(std::string, PixelType);
    const auto add = [&](const std::string& name, PixelType type, auto*& plane, Add how = &Image::add_unfilled) {
        bytes += size_of(type);
        auto** const target = &plane;
        bindings.push_back([this, name, type, target, how] {
            using Value = std::remove_pointer_t<std::remove_reference_t<decltype(*target)>>;
            *target = (image_.*how)(name, type).template as<Value>().data();
        });
    };
    const auto add_rgba = [&](const std::string& prefix, std::uint16_t* (&planes)[4], Add how = &Image::add_unfilled) {
        const char* const names[4] = {"R", "G", "B", "A"};
        for (int c = 0; c < 4; ++c) add(prefix + names[c], PixelType::float16, planes[c], how);
    };
    if (layers.beauty) add_rgba("", planes_.beauty);
    if (layers.lines) add_rgba("lines.", planes_.lines);
    if (layers.surface) add_rgba("surface.", planes_.surface);
    if (layers.lines_hidden) add_rgba("lines_hidden.", planes_.lines_hidden, &Image::add);
    for (std::size_t i = 0; i < kLineClassCount && layers.coverage; ++i) {
        if (!classes.has(static_cast<LineClass>(i))) continue;
        add("coverage." + std::string(kLineClassNames[i]), PixelType::float16, planes_.coverage[i]);
    }
    if (layers.depth) add("Z", PixelType::float32, planes_.depth);
    if (layers.normal) {
        add("N.X", PixelType::float32, planes_.normal[0]);
        add("N.Y", PixelType::float32, planes_.normal[1]);
        add("N.Z", PixelType::float32, planes_.normal[2]);
    }
    if (layers.ids) {
        add("id.object", PixelType::uint32, planes_.ids[0]);
        add("id.material", PixelType::uint32, planes_.ids[1]);
        add("id.polygon", PixelType::uint32, planes_.ids[2]);
    }
    check_memory(crop, bytes);
    for (const auto& bind : bindings) bind();
}

std::size_t Film::index_of(int x, int y) const {
    const PixelRect crop = image_.data();
    return static_cast<std::size_t>(y - crop.y0) * static_cast<std::size_t>(crop.width()) +
           static_cast<std::size_t>(x - crop.x0);
}

bool Film::has_geometry() const {
    return planes_.depth != nullptr || planes_.normal[0] != nullptr || planes_.ids[0] != nullptr;
}

void Film::put_background(int x0, int x1, int y) {
    const std::size_t begin = index_of(x0, y), count = static_cast<std::size_t>(x1 - x0);
    const auto clear = [&](auto* plane, auto value) {
        if (plane != nullptr) stream_fill(plane + begin, count, value);
    };
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::uint16_t* plane : {planes_.beauty[c], planes_.lines[c], planes_.surface[c]}) {
            clear(plane, std::uint16_t{0});
        }
    }
    for (std::uint16_t* plane : planes_.coverage) clear(plane, std::uint16_t{0});
    clear(planes_.depth, std::numeric_limits<float>::infinity());
    for (std::size_t c = 0; c < 3; ++c) {
        clear(planes_.normal[c], 0.0f);
        clear(planes_.ids[c], std::uint32_t{0});
    }
}

void Film::put_color(int x0, int x1, int y, const HalfColor& color) {
    const std::size_t begin = index_of(x0, y), count = static_cast<std::size_t>(x1 - x0);
    const auto fill = [&](std::uint16_t* plane, std::uint16_t value) {
        if (plane != nullptr) std::fill_n(plane + begin, count, value);
    };
    for (std::size_t c = 0; c < 4; ++c) {
        fill(planes_.beauty[c], color[c]);
        fill(planes_.surface[c], color[c]);
        fill(planes_.lines[c], 0);
    }
    for (std::uint16_t* plane : planes_.coverage) fill(plane, 0);
}

void Film::put_colors(int x0, int x1, int y, const std::array<const std::uint16_t*, 4>& colors) {
    const std::size_t begin = index_of(x0, y), count = static_cast<std::size_t>(x1 - x0);
    const auto clear = [&](std::uint16_t* plane) {
        if (plane != nullptr) std::fill_n(plane + begin, count, std::uint16_t{0});
    };
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::uint16_t* plane : {planes_.beauty[c], planes_.surface[c]}) {
            if (plane != nullptr) std::copy_n(colors[c], count, plane + begin);
        }
        clear(planes_.lines[c]);
    }
    for (std::uint16_t* plane : planes_.coverage) clear(plane);
}

void Film::put_geometry(int x0, int x1, int y, const GeometryRow& row) {
    const std::size_t begin = index_of(x0, y), count = static_cast<std::size_t>(x1 - x0);
    const auto stream = [&](auto* plane, const auto* values) {  // nothing is drawn over these
        if (plane != nullptr) stream_copy(values, count, plane + begin);
    };
    stream(planes_.depth, row.distance);
    for (std::size_t c = 0; c < 3; ++c) {
        stream(planes_.normal[c], row.normal[c]);
        stream(planes_.ids[c], row.ids[c]);
    }
}

void Film::prefetch(int x, int y) const {
    const std::size_t i = index_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        if (planes_.lines[c] != nullptr) __builtin_prefetch(planes_.lines[c] + i, 1);
        if (planes_.beauty[c] != nullptr) __builtin_prefetch(planes_.beauty[c] + i, 1);
    }
}

void Film::draw_over(int x, int y, const LinePixel& lines) {
    const std::size_t i = index_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        const float color = lines.color[static_cast<int>(c)];
        if (planes_.lines[c] != nullptr) planes_.lines[c][i] = to_half(color);
        std::uint16_t* const beauty = planes_.beauty[c];
        if (beauty != nullptr) beauty[i] = to_half(float_from_half(beauty[i]) * (1.0f - lines.color.a) + color);
    }
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        if (planes_.coverage[c] != nullptr) planes_.coverage[c][i] = to_half(lines.coverage[c]);
    }
}

void Film::replace_surface(int x, int y, const glm::vec4& color) {
    const std::size_t i = index_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        const std::uint16_t value = to_half(color[static_cast<int>(c)]);
        if (planes_.beauty[c] != nullptr) planes_.beauty[c][i] = value;
        if (planes_.surface[c] != nullptr) planes_.surface[c][i] = value;
    }
}

void Film::draw_hidden(int x, int y, const glm::vec4& hidden, const glm::vec4& seen) {
    const std::size_t i = index_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        if (planes_.lines_hidden[c] != nullptr) planes_.lines_hidden[c][i] = to_half(hidden[static_cast<int>(c)]);
        std::uint16_t* const beauty = planes_.beauty[c];
        if (beauty == nullptr) continue;
        beauty[i] = to_half(float_from_half(beauty[i]) * (1.0f - seen.a) + seen[static_cast<int>(c)]);
    }
}

void Film::add_lines(int x, int y, const LinePixel& lines) {
    const std::size_t i = index_of(x, y);
    const auto add = [i](std::uint16_t* plane, float value) {
        if (plane != nullptr) plane[i] = to_half(float_from_half(plane[i]) + value);
    };
    for (std::size_t c = 0; c < 4; ++c) add(planes_.lines[c], lines.color[static_cast<int>(c)]);
    for (std::size_t c = 0; c < kLineClassCount; ++c) add(planes_.coverage[c], lines.coverage[c]);
}

void Film::put(int x, int y, const PixelResult& pixel) {
    const std::size_t i = index_of(x, y);
    const auto put_rgba = [i](std::uint16_t* const (&planes)[4], const glm::vec4& color) {
        if (planes[0] == nullptr) return;
        for (int c = 0; c < 4; ++c) planes[c][i] = to_half(color[c]);
    };
    put_rgba(planes_.beauty, pixel.beauty);
    put_rgba(planes_.lines, pixel.lines);
    put_rgba(planes_.surface, pixel.surface);
    for (std::size_t c = 0; c < kLineClassCount; ++c) {
        if (planes_.coverage[c] != nullptr) planes_.coverage[c][i] = to_half(pixel.coverage[c]);
    }
    if (planes_.depth != nullptr) planes_.depth[i] = pixel.distance;
    if (planes_.normal[0] != nullptr) {
        for (int c = 0; c < 3; ++c) planes_.normal[c][i] = pixel.normal[c];
    }
    if (planes_.ids[0] != nullptr) {
        planes_.ids[0][i] = pixel.object_id;
        planes_.ids[1][i] = pixel.material_id;
        planes_.ids[2][i] = pixel.polygon_id;
    }
}

}  // namespace burin
