#include "render/film.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <limits>
#include <mutex>
#include <string>
#include <type_traits>

#include "base/error.h"
#include "base/interrupt.h"
#include "base/stream_store.h"
#include "image/half.h"
#include "render/mattes.h"

namespace burin {
namespace {

/// Calls add(name, type, plane, background) for the channels of the chosen layers; the last one is what a channel has
/// where there is no surface and no line.
template <typename Planes, typename Add>
void for_channels(const LayerSet& layers, LineClassSet classes, Planes& planes, const Add& add) {
    const auto add_half = [&](const std::string& name, std::uint16_t*& plane) {
        add(name, PixelType::float16, plane, std::uint16_t{0});
    };
    const auto add_float = [&](const std::string& name, float*& plane, float background) {
        add(name, PixelType::float32, plane, background);
    };
    const auto add_number = [&](const std::string& name, std::uint32_t*& plane) {
        add(name, PixelType::uint32, plane, std::uint32_t{0});
    };
    const auto add_rgba = [&](const std::string& prefix, std::uint16_t*(&of)[4]) {
        const char* const names[4] = {"R", "G", "B", "A"};
        for (int c = 0; c < 4; ++c) add_half(prefix + names[c], of[c]);
    };
    if (layers.beauty) add_rgba("", planes.beauty);
    if (layers.lines) add_rgba("lines.", planes.lines);
    if (layers.surface) add_rgba("surface.", planes.surface);
    if (layers.lines_hidden) add_rgba("lines_hidden.", planes.lines_hidden);
    planes.line_sets.resize(layers.line_sets.size());
    for (std::size_t i = 0; i < layers.line_sets.size(); ++i)
        add_rgba("lines_" + layers.line_sets[i] + ".", planes.line_sets[i].of);
    for (std::size_t i = 0; i < kLineClassCount && layers.coverage; ++i) {
        if (!classes.has(static_cast<LineClass>(i))) continue;
        add_half("coverage." + std::string(kLineClassNames[i]), planes.coverage[i]);
    }
    if (layers.depth) add_float("Z", planes.depth, std::numeric_limits<float>::infinity());
    if (layers.normal) {
        add_float("N.X", planes.normal[0], 0);
        add_float("N.Y", planes.normal[1], 0);
        add_float("N.Z", planes.normal[2], 0);
    }
    if (layers.ids) {
        add_number("id.object", planes.ids[0]);
        add_number("id.material", planes.ids[1]);
        add_number("id.polygon", planes.ids[2]);
    }
    if (layers.motion) {
        add_float("forward.u", planes.motion[0], 0);
        add_float("forward.v", planes.motion[1], 0);
    }
}

/// Runs of pixels are short: the last ones are written twice, not one by one.
void fill_run(std::uint16_t* to, std::size_t count, std::uint16_t value) {
    typedef std::uint16_t Eight __attribute__((vector_size(16)));
    constexpr std::size_t kEight = 8;
    if (count < kEight) {
        std::fill_n(to, count, value);
        return;
    }
    const Eight eight = Eight{} + value;
    for (std::size_t i = 0; i + kEight <= count; i += kEight) std::memcpy(to + i, &eight, sizeof eight);
    std::memcpy(to + count - kEight, &eight, sizeof eight);
}

/// Whether the processor knows the instruction below: not each x86-64 does, but those with AVX2 do.
inline bool can_prefetch_to_write() {
#ifdef __x86_64__
    return __builtin_cpu_supports("avx2") != 0;
#else
    return true;
#endif
}

/// Has a cache line fetched to be written, so that no other core has it any more. For a general x86-64, g++ 12 makes a
/// fetch to read even of __builtin_prefetch(at, 1).
inline void prefetch_to_write(const void* at) {
#ifdef __x86_64__
    asm volatile("prefetchw %0" : : "m"(*static_cast<const char*>(at)));
#else
    __builtin_prefetch(at, 1);
#endif
}

/// Draws a colour over one pixel of four channels.
__attribute__((always_inline)) inline void blend(std::uint16_t* const (&planes)[4], std::size_t i,
                                                 const glm::vec4& over) {
    std::uint16_t* const places[4] = {planes[0] + i, planes[1] + i, planes[2] + i, planes[3] + i};
    const FourFloats color = {over.r, over.g, over.b, over.a};
    const FourFloats before = floats_from_halves(FourHalves{*places[0], *places[1], *places[2], *places[3]});
    const FourFloats after = before * (1.0f - over.a) + color;
    const FourHalves halves = halves_from_floats(after > 65504.0f ? FourFloats{} + 65504.0f : after);
    for (unsigned c = 0; c < 4; ++c) *places[c] = static_cast<std::uint16_t>(halves[c]);
}

/// Of each as Film::to_half().
HalfColor to_halves(const glm::vec4& color) {
    const FourFloats values = {color.r, color.g, color.b, color.a};
    const FourHalves halves = halves_from_floats(values > 65504.0f ? FourFloats{} + 65504.0f : values);
    return {static_cast<std::uint16_t>(halves[0]), static_cast<std::uint16_t>(halves[1]),
            static_cast<std::uint16_t>(halves[2]), static_cast<std::uint16_t>(halves[3])};
}

}  // namespace

std::uint16_t Film::to_half(float value) { return half_from_float(std::min(value, 65504.0f)); }

struct Film::Pool {
    std::mutex mutex;
    std::size_t used = 0;  // pixels, of blocks in the film
    std::vector<std::unique_ptr<Block>> made;
    std::vector<Block*> closed;  // of them, for others: between them a heap would fall to pieces
};

Film::Film(PixelRect display, PixelRect crop, const LayerSet& layers, LineClassSet classes)
    : Film(display, crop, layers, classes, kWholeShift, kWholeShift) {
    add_block(0, true);
    drawn_ = DrawnSpans(std::max(crop.width(), 0), std::max(crop.height(), 0));
}

Film Film::in_bands(PixelRect display, PixelRect crop, const LayerSet& layers, LineClassSet classes) {
    const auto shift = [](int size) { return std::countr_zero(static_cast<unsigned>(size)); };
    return {display, crop, layers, classes, shift(kBlockColumns), shift(kBandRows)};
}

Film::Film(PixelRect display, PixelRect crop, const LayerSet& layers, LineClassSet classes, int column_shift,
           int row_shift)
    : display_(display),
      crop_(crop),
      layers_(layers),
      classes_(classes),
      column_shift_(column_shift),
      row_shift_(row_shift),
      columns_((static_cast<std::size_t>(std::max(crop.width() - 1, 0)) >> column_shift) + 1),
      blocks_(columns_ * ((static_cast<std::size_t>(std::max(crop.height() - 1, 0)) >> row_shift) + 1)),
      pool_(std::make_unique<Pool>()) {
    for (const ChannelFormat& channel : channels()) bytes_per_pixel_ += size_of(channel.type);
    const MatteWishes wishes{layers.crypto, layers.line, layers.deep, layers.deep_hidden};
    if (wishes.has_any()) mattes_ = std::make_unique<Mattes>(crop, wishes);
}

Film::~Film() = default;
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;

Film Film::copy() const {
    Film other(display_, crop_, layers_, classes_);
    for (const Channel& channel : image().channels()) {
        const auto& bytes = channel.bytes;
        std::copy(bytes.begin(), bytes.end(), other.block_of(0)->image.find(channel.name)->bytes.begin());
    }
    return other;
}

std::vector<ChannelFormat> Film::channels() const {
    std::vector<ChannelFormat> channels;
    Planes none;
    for_channels(layers_, classes_, none, [&](const std::string& name, PixelType type, const auto*, auto) {
        channels.push_back({name, type});
    });
    return channels;
}

void Film::check_memory(std::size_t pixels) const {
    static const double physical =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    const double needed = static_cast<double>(pixels) * static_cast<double>(bytes_per_pixel_);
    if (needed <= 0.8 * physical) return;
    throw InputError("an image of " + std::to_string(crop_.width()) + "x" + std::to_string(crop_.height()) +
                     " pixels needs " + std::to_string(static_cast<long>(needed / 1e9)) + " GB, this machine has " +
                     std::to_string(static_cast<long>(physical / 1e9)) +
                     "; make it smaller, ask for fewer layers, or draw parts of it as crops");
}

PixelRect Film::rect_of(std::size_t block) const {
    const auto begin = [](std::size_t number, int origin, int shift) {
        return static_cast<int>(origin + (static_cast<std::int64_t>(number) << shift));
    };
    const int x0 = begin(block % columns_, crop_.x0, column_shift_), y0 = begin(block / columns_, crop_.y0, row_shift_);
    return {x0, y0, std::min(crop_.x1, first_of_next(x0, crop_.x0, column_shift_)),
            std::min(crop_.y1, first_of_next(y0, crop_.y0, row_shift_))};
}

std::unique_ptr<Film::Block> Film::make_block(PixelRect rect) const {
    auto block = std::make_unique<Block>();
    block->image = Image(display_, rect);
    for_channels(layers_, classes_, block->planes, [&](const std::string& name, PixelType type, auto*& plane, auto) {
        using Value = std::remove_pointer_t<std::remove_reference_t<decltype(plane)>>;
        plane = block->image.add_unfilled(name, type).template as<Value>().data();
    });
    return block;
}

void Film::fill_with_background(Block& block) const {
    for_channels(layers_, classes_, block.planes, [&](const std::string&, PixelType, auto* plane, auto background) {
        fill_stoppably(plane, block.image.pixel_count(), background);
    });
}

Film::Block& Film::add_block(std::size_t number, bool all_is_put) {
    const std::lock_guard lock(pool_->mutex);
    if (Block* const block = block_of(number)) return *block;  // another thread was faster
    const PixelRect rect = rect_of(number);
    const std::size_t pixels = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
    check_memory(pool_->used + pixels);
    const auto same = std::find_if(pool_->closed.rbegin(), pool_->closed.rend(), [&](const Block* closed) {
        return closed->image.width() == rect.width() && closed->image.height() == rect.height();
    });
    Block* block;
    if (same != pool_->closed.rend()) {
        block = *same;
        pool_->closed.erase(std::next(same).base());
        block->image.move_to(rect.x0, rect.y0);
    } else {
        pool_->made.push_back(make_block(rect));
        block = pool_->made.back().get();
    }
    if (!all_is_put) fill_with_background(*block);
    for (std::uint16_t* const plane : block->planes.lines_hidden) {  // not put for each pixel
        if (plane != nullptr) fill_stoppably(plane, block->image.pixel_count(), std::uint16_t{0});
    }
    for (const HalfPlanes& set : block->planes.line_sets) {
        for (std::uint16_t* const plane : set.of) fill_stoppably(plane, block->image.pixel_count(), std::uint16_t{0});
    }
    pool_->used += pixels;
    blocks_[number].store(block, std::memory_order_release);
    return *block;
}

ImageStrip Film::band(std::size_t number) const {
    const std::size_t first = number * columns_;
    ImageStrip strip{rect_of(first), std::min(crop_.width(), kBlockColumns), {}, {}};
    strip.data.x1 = crop_.x1;
    for (std::size_t i = first; i < first + columns_; ++i) {
        const Block* const block = block_of(i);
        strip.blocks.push_back(block == nullptr ? nullptr : &block->image);
    }
    Planes none;
    for_channels(layers_, classes_, none, [&](const std::string&, PixelType, const auto*, auto background) {
        std::memcpy(strip.background.emplace_back().data(), &background, sizeof background);
    });
    return strip;
}

void Film::close(std::size_t number) {
    if (mattes_ != nullptr) mattes_->close(number);
    const std::lock_guard lock(pool_->mutex);
    for (std::size_t i = number * columns_; i < (number + 1) * columns_; ++i) {
        Block* const block = blocks_[i].exchange(nullptr, std::memory_order_acq_rel);
        if (block == nullptr) continue;
        pool_->closed.push_back(block);
        pool_->used -= block->image.pixel_count();
    }
}

Film::Place Film::place_of(int x, int y) {
    const std::size_t number = number_of(x, y);
    Block* block = block_of(number);
    if (block == nullptr) block = &add_block(number);
    const auto row = static_cast<std::size_t>(y - block->image.data().y0),
               column = static_cast<std::size_t>(x - block->image.data().x0);
    return {block->planes, row * static_cast<std::size_t>(block->image.width()) + column};
}

bool Film::has_geometry() const { return layers_.depth || layers_.normal || layers_.ids; }

void Film::expect_all_of(PixelRect part) {
    const std::size_t number = number_of(part.x0, part.y0);
    if (block_of(number) == nullptr && rect_of(number) == part) add_block(number, true);
    for (int y = part.y0; y < part.y1; ++y) drawn_.note(part.x0 - crop_.x0, part.x1 - crop_.x0, y - crop_.y0);
}

template <typename Use>
void Film::for_row(int x0, int x1, int y, const Use& use) {
    for_parts({x0, y, x1, y + 1}, [&](PixelRect part) {
        const auto [planes, begin] = place_of(part.x0, y);
        use(planes, begin, static_cast<std::size_t>(part.width()), static_cast<std::size_t>(part.x0 - x0));
    });
}

void Film::put_background(int x0, int x1, int y) {
    if (!is_whole()) return;
    const auto [planes, begin] = place_of(x0, y);
    const int first = x0 - crop_.x0;
    drawn_.for_drawn(first, x1 - crop_.x0, y - crop_.y0, [&, &planes = planes, at = begin](int from, int to) {
        const auto clear = [&](auto* plane, auto value) {
            if (plane != nullptr) stream_fill(plane + at + (from - first), static_cast<std::size_t>(to - from), value);
        };
        for (std::size_t c = 0; c < 4; ++c) {
            for (std::uint16_t* plane :
                 {planes.beauty[c], planes.lines[c], planes.surface[c], planes.lines_hidden[c]}) {
                clear(plane, std::uint16_t{0});
            }
        }
        for (std::uint16_t* plane : planes.coverage) clear(plane, std::uint16_t{0});
        for (const HalfPlanes& set : planes.line_sets) {
            for (std::uint16_t* plane : set.of) clear(plane, std::uint16_t{0});
        }
        clear(planes.depth, std::numeric_limits<float>::infinity());
        for (std::size_t c = 0; c < 3; ++c) {
            clear(planes.normal[c], 0.0f);
            clear(planes.ids[c], std::uint32_t{0});
        }
        for (float* plane : planes.motion) clear(plane, 0.0f);
    });
}

void Film::put_motion(int x0, int x1, int y, const float* right, const float* up) {
    for_row(x0, x1, y, [&](const Planes& planes, std::size_t begin, std::size_t count, std::size_t from) {
        if (planes.motion[0] == nullptr) return;
        std::copy_n(right + from, count, planes.motion[0] + begin);
        std::copy_n(up + from, count, planes.motion[1] + begin);
    });
}

void Film::put_color(int x0, int x1, int y, const HalfColor& color) {
    for_row(x0, x1, y, [&](const Planes& planes, std::size_t begin, std::size_t count, std::size_t) {
        const auto fill = [&](std::uint16_t* plane, std::uint16_t value) {
            if (plane != nullptr) fill_run(plane + begin, count, value);
        };
        for (std::size_t c = 0; c < 4; ++c) {
            fill(planes.beauty[c], color[c]);
            fill(planes.surface[c], color[c]);
            fill(planes.lines[c], 0);
            fill(planes.lines_hidden[c], 0);
        }
        for (std::uint16_t* plane : planes.coverage) fill(plane, 0);
        for (const HalfPlanes& set : planes.line_sets) {
            for (std::uint16_t* plane : set.of) fill(plane, 0);
        }
    });
}

void Film::prefetch_color(int x0, int x1, int y) const {
    if (x0 >= x1 || block_of(number_of(x0, y)) == nullptr || !can_prefetch_to_write()) return;
    const auto [planes, begin] = const_cast<Film*>(this)->place_of(x0, y);
    const auto ask = [first = begin, last = begin + static_cast<std::size_t>(x1 - x0) - 1](const std::uint16_t* plane) {
        constexpr std::size_t kPerLine = 64 / sizeof *plane;
        if (plane == nullptr) return;
        for (std::size_t i = first; i < last; i += kPerLine) prefetch_to_write(plane + i);
        prefetch_to_write(plane + last);
    };
    for (std::size_t c = 0; c < 4; ++c) {  // the others are rarely wanted
        ask(planes.beauty[c]);
        ask(planes.lines[c]);
    }
}

void Film::put_colors(int x0, int x1, int y, const std::array<const std::uint16_t*, 4>& colors) {
    for_row(x0, x1, y, [&](const Planes& planes, std::size_t begin, std::size_t count, std::size_t from) {
        const auto clear = [&](std::uint16_t* plane) {
            if (plane != nullptr) std::fill_n(plane + begin, count, std::uint16_t{0});
        };
        for (std::size_t c = 0; c < 4; ++c) {
            for (std::uint16_t* plane : {planes.beauty[c], planes.surface[c]}) {
                if (plane != nullptr) std::copy_n(colors[c] + from, count, plane + begin);
            }
            clear(planes.lines[c]);
            clear(planes.lines_hidden[c]);
        }
        for (std::uint16_t* plane : planes.coverage) clear(plane);
        for (const HalfPlanes& set : planes.line_sets) {
            for (std::uint16_t* plane : set.of) clear(plane);
        }
    });
}

GeometryRow Film::geometry_place(int x, int y, const GeometryRow& spare) {
    const auto [planes, begin] = place_of(x, y);
    const auto choose = [at = begin](auto* plane, auto* other) { return plane != nullptr ? plane + at : other; };
    GeometryRow row{choose(planes.depth, spare.distance), {}, {}};
    for (std::size_t c = 0; c < 3; ++c) {
        row.normal[c] = choose(planes.normal[c], spare.normal[c]);
        row.ids[c] = choose(planes.ids[c], spare.ids[c]);
    }
    return row;
}

void Film::put_geometry(int x0, int x1, int y, const GeometryRow& row) {
    for_row(x0, x1, y, [&](const Planes& planes, std::size_t begin, std::size_t count, std::size_t from) {
        const auto copy = [&](auto* plane, const auto* values) {
            if (plane == nullptr) return;
            if (is_whole()) {  // nothing is drawn over these
                stream_copy(values + from, count, plane + begin);
            } else {
                std::copy_n(values + from, count, plane + begin);
            }
        };
        copy(planes.depth, row.distance);
        for (std::size_t c = 0; c < 3; ++c) {
            copy(planes.normal[c], row.normal[c]);
            copy(planes.ids[c], row.ids[c]);
        }
    });
}

void Film::prefetch(int x, int y) const {
    if (block_of(number_of(x, y)) == nullptr) return;
    const auto [planes, i] = const_cast<Film*>(this)->place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        if (planes.lines[c] != nullptr) __builtin_prefetch(planes.lines[c] + i, 1);
        if (planes.beauty[c] != nullptr) __builtin_prefetch(planes.beauty[c] + i, 1);
    }
}

LineInk::LineInk(const LinePixel& lines) : color(lines.color), half_color(to_halves(lines.color)) {
    for (std::size_t c = 0; c < kLineClassCount; ++c) coverage[c] = Film::to_half(lines.coverage[c]);
}

LineInk::LineInk(const glm::vec4& all, LineClass its_class, float covered) : color(all), half_color(to_halves(all)) {
    coverage[static_cast<std::size_t>(its_class)] = Film::to_half(covered);
}

HiddenInk::HiddenInk(const glm::vec4& color, const glm::vec4& seen_part)
    : half_color(to_halves(color)), seen(seen_part) {}

void Film::draw_over(int x, int y, const LineInk& lines) {
    note_drawn(x, y);
    const auto [planes, i] = place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        if (planes.lines[c] != nullptr) planes.lines[c][i] = lines.half_color[c];
    }
    if (planes.beauty[0] != nullptr) blend(planes.beauty, i, lines.color);
    for (std::size_t c = 0; c < kLineClassCount && layers_.coverage; ++c) {
        if (planes.coverage[c] != nullptr) planes.coverage[c][i] = lines.coverage[c];
    }
}

void Film::replace_surface(int x, int y, const glm::vec4& color) {
    note_drawn(x, y);
    const auto [planes, i] = place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        const std::uint16_t value = to_half(color[static_cast<int>(c)]);
        if (planes.beauty[c] != nullptr) planes.beauty[c][i] = value;
        if (planes.surface[c] != nullptr) planes.surface[c][i] = value;
    }
}

void Film::draw_hidden(int x, int y, const HiddenInk& lines) {
    note_drawn(x, y);
    const auto [planes, i] = place_of(x, y);
    for (std::size_t c = 0; c < 4; ++c) {
        if (planes.lines_hidden[c] != nullptr) planes.lines_hidden[c][i] = lines.half_color[c];
    }
    if (planes.beauty[0] != nullptr) blend(planes.beauty, i, lines.seen);
}

void Film::put(int x, int y, const PixelResult& pixel) {
    note_drawn(x, y);
    const auto [planes, i] = place_of(x, y);
    const auto put_rgba = [at = i](std::uint16_t* const(&of)[4], const glm::vec4& color) {
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
