#include "output/paths/surface_grid.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/interrupt.h"
#include "image/half.h"

namespace burin {
namespace {

constexpr std::uint32_t kNoLook = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMostColors = 64;

std::size_t hash_of(std::uint32_t object, std::uint64_t halfs) {
    std::uint64_t bits = (halfs ^ object * std::uint64_t{0xD1B54A32D192ED03}) * 0x9E3779B97F4A7C15;
    bits ^= bits >> 29;
    return static_cast<std::size_t>(bits * 0x9E3779B97F4A7C15 >> 16);
}

glm::vec4 color_of(std::uint64_t halfs) {
    glm::vec4 color;
    for (int k = 0; k < 4; ++k) color[k] = float_from_half(static_cast<std::uint16_t>(halfs >> 16 * k));
    return color;
}

float square_apart(const glm::vec4& a, const glm::vec4& b) {
    const glm::vec4 d = a - b;
    return glm::dot(d, d);
}

SurfaceGrid::Look look_of(std::uint32_t object, const glm::vec4& color) {
    SurfaceGrid::Look look;
    look.object = object;
    look.opacity = std::clamp(color.a, 0.0f, 1.0f);
    if (color.a > 0) look.color = glm::vec3(color) / color.a;
    return look;
}

}  // namespace

SurfaceGridMaker::SurfaceGridMaker(PixelRect area, int places_per_px, glm::dvec2 place) : slots_(1024, 0) {
    grid_.area = area;
    grid_.places_per_px = places_per_px;
    grid_.place = place;
    grid_.looks.emplace_back();
    grid_.look_at.reserve(static_cast<std::size_t>(grid_.columns()) * static_cast<std::size_t>(grid_.rows()));
    number_of(0, 0);
}

std::uint32_t SurfaceGridMaker::number_of(std::uint32_t object, std::uint64_t halfs) {
    std::size_t slot = hash_of(object, halfs) & (slots_.size() - 1);
    for (; slots_[slot] != 0; slot = (slot + 1) & (slots_.size() - 1)) {
        const Seen& seen = seen_[slots_[slot] - 1];
        if (seen.object == object && seen.halfs == halfs) return slots_[slot] - 1;
    }
    seen_.push_back({object, halfs, color_of(halfs)});
    slots_[slot] = static_cast<std::uint32_t>(seen_.size());
    if (2 * seen_.size() > slots_.size()) grow();
    return static_cast<std::uint32_t>(seen_.size() - 1);
}

void SurfaceGridMaker::grow() {
    slots_.assign(4 * slots_.size(), 0);
    for (std::size_t i = 0; i < seen_.size(); ++i) {
        std::size_t slot = hash_of(seen_[i].object, seen_[i].halfs) & (slots_.size() - 1);
        while (slots_[slot] != 0) slot = (slot + 1) & (slots_.size() - 1);
        slots_[slot] = static_cast<std::uint32_t>(i + 1);
    }
}

void SurfaceGridMaker::add_row(const std::uint32_t* objects, const std::array<const std::uint16_t*, 4>& colors) {
    throw_if_interrupted();
    for (int x = 0; x < grid_.columns(); ++x) {
        std::uint64_t halfs = 0;
        for (int k = 0; k < 4; ++k) halfs |= std::uint64_t{colors[static_cast<std::size_t>(k)][x]} << 16 * k;
        if (seen_[last_].object != objects[x] || seen_[last_].halfs != halfs) last_ = number_of(objects[x], halfs);
        ++seen_[last_].count;
        grid_.look_at.push_back(last_);
    }
}

void SurfaceGridMaker::find_squares() {
    const auto columns = static_cast<std::size_t>(grid_.columns()), rows = static_cast<std::size_t>(grid_.rows());
    const std::vector<std::uint32_t>& at = grid_.look_at;
    is_in_square_.assign(at.size(), false);
    for (std::size_t y = 0; y + 1 < rows; ++y) {
        for (std::size_t i = y * columns; i + 1 < (y + 1) * columns; ++i) {
            if (at[i] != at[i + 1] || at[i] != at[i + columns] || at[i] != at[i + columns + 1]) continue;
            for (const std::size_t k : {i, i + 1, i + columns, i + columns + 1}) is_in_square_[k] = true;
        }
    }
    for (std::size_t i = 0; i < at.size(); ++i) seen_[at[i]].in_squares += is_in_square_[i] ? 1 : 0;
}

void SurfaceGridMaker::name_looks() {
    struct ObjectColors {
        std::size_t count = 0, in_squares = 0, colors = 0;
        glm::dvec4 sum{0.0};
        std::uint32_t mean_look = kNoLook;
    };
    std::uint32_t last_object = 0;
    for (const Seen& seen : seen_) last_object = std::max(last_object, seen.object);
    std::vector<ObjectColors> objects(std::size_t{last_object} + 1);
    for (const Seen& seen : seen_) {
        ObjectColors& object = objects[seen.object];
        object.count += seen.count;
        object.in_squares += seen.in_squares;
        object.colors += seen.in_squares > 0 ? 1 : 0;
        object.sum += glm::dvec4(seen.color) * static_cast<double>(seen.count);
    }
    for (std::uint32_t number = 1; number <= last_object; ++number) {
        ObjectColors& object = objects[number];
        // Of small objects all places may be at edges.
        if (object.colors <= kMostColors && (2 * object.in_squares >= object.count || object.colors == 1)) continue;
        if (object.count == 0) continue;
        object.mean_look = static_cast<std::uint32_t>(grid_.looks.size());
        const glm::vec4 mean(object.sum / static_cast<double>(object.count));
        grid_.looks.push_back(look_of(number, {glm::vec3(mean) / std::max(mean.a, 1e-6f), 1.0f}));
        if (object.in_squares > 0 || object.count > 64) ++grid_.mean_objects;
    }
    for (const Seen& seen : seen_) {
        const ObjectColors& object = objects[seen.object];
        std::uint32_t look = kNoLook;
        if (seen.color.a == 0) {
            look = 0;
        } else if (object.mean_look != kNoLook) {
            look = object.mean_look;
        } else if (seen.in_squares > 0) {
            look = static_cast<std::uint32_t>(grid_.looks.size());
            grid_.looks.push_back(look_of(seen.object, seen.color));
        }
        look_of_seen_.push_back(look);
    }
    for (std::size_t i = 0; i < grid_.look_at.size(); ++i) {
        const std::uint32_t seen = grid_.look_at[i];
        const bool is_named =
            is_in_square_[i] || seen_[seen].color.a == 0 || objects[seen_[seen].object].mean_look != kNoLook;
        if (!is_named) unnamed_.push_back(static_cast<std::uint32_t>(i));
    }
}

void SurfaceGridMaker::spread_looks() {
    const auto columns = static_cast<std::size_t>(grid_.columns()), rows = static_cast<std::size_t>(grid_.rows());
    std::vector<std::uint32_t>& at = grid_.look_at;
    // Of places without a look the colours, and what they get.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> waiting;  // a place, and what is seen there
    for (const std::uint32_t i : unnamed_) waiting.emplace_back(i, at[i]);
    std::size_t next = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const bool waits = next < unnamed_.size() && unnamed_[next] == i;
        at[i] = waits ? kNoLook : look_of_seen_[at[i]];
        next += waits ? 1 : 0;
    }
    // The nearest of its own object, in rounds from the edges of what has a look; then the nearest of any.
    for (const bool of_any_object : {false, true}) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> found, rest;
        do {
            throw_if_interrupted();
            found.clear();
            rest.clear();
            for (const auto& [place, number] : waiting) {
                const Seen& seen = seen_[number];
                std::uint32_t best = kNoLook;
                float least = std::numeric_limits<float>::infinity();
                const auto ask = [&](std::size_t other) {
                    const std::uint32_t look = at[other];
                    if (look == kNoLook) return;
                    const SurfaceGrid::Look& own = grid_.looks[look];
                    if (!of_any_object && own.object != seen.object) return;
                    const float apart = square_apart(glm::vec4(own.color * own.opacity, own.opacity), seen.color);
                    if (apart < least || (apart == least && look < best)) {
                        least = apart;
                        best = look;
                    }
                };
                const std::size_t x = place % columns, y = place / columns;
                if (x > 0) ask(place - 1);
                if (x + 1 < columns) ask(place + 1);
                if (y > 0) ask(place - columns);
                if (y + 1 < rows) ask(place + columns);
                if (best == kNoLook) {
                    rest.emplace_back(place, number);
                } else {
                    found.emplace_back(place, best);
                }
            }
            for (const auto& [place, look] : found) at[place] = look;
            std::swap(waiting, rest);
        } while (!found.empty() && !waiting.empty());
    }
    for (const auto& [place, number] : waiting) at[place] = 0;
}

SurfaceGrid SurfaceGridMaker::grid() {
    find_squares();
    name_looks();
    spread_looks();
    return std::move(grid_);
}

}  // namespace burin
