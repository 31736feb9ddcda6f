#include <algorithm>

#include "abuffer/samples/pixel_fill.h"
#include "render/motion.h"

// What is kept of pixels beside their colours and geometry, where layers ask for it.

namespace burin {

const MatteOwner& PixelFiller::owner_of(std::uint32_t number) {
    if (number != owned_number_) {
        owned_number_ = number;
        const SurfaceId id = screen_.surface_of(number);
        owner_ = {frame_.surfaces.object_id(id), frame_.surfaces.material_id(id)};
    }
    return owner_;
}

/// Counts the samples of a pixel by what they belong to.
void PixelFiller::find_owners(const SampleTile& samples, int x, int y) {
    owned_.clear();
    const int s = samples.samples_per_pixel;
    for (int row = 0; row < s; ++row) {
        const std::uint32_t* const ids = &samples.ids[samples.index(x * s, y * s + row)];
        for (int column = 0; column < s; ++column) {
            if (ids[column] == SampleTile::kBackground) continue;
            const MatteOwner owner = owner_of(ids[column] >> 1);
            const auto known =
                std::find_if(owned_.begin(), owned_.end(), [&](const Owned& o) { return o.owner == owner; });
            if (known == owned_.end()) {
                owned_.push_back({owner, 1});
            } else {
                ++known->samples;
            }
        }
    }
}

void PixelFiller::add_mattes(const SampleTile& samples, PixelRect rect, Mattes& mattes) {
    // Surfaces without a shading are not in the picture.
    if (frame_.scene->surfaces.shading == SurfaceShading::none) return;
    if (mattes.wants_deep()) add_deep(samples, rect, mattes);
    if (!mattes.wants_surfaces()) return;
    const auto all = static_cast<float>(samples.samples_per_pixel * samples.samples_per_pixel);
    std::vector<Owned> run;
    for (int y = rect.y0; y < rect.y1; ++y) {
        const auto put = [&](int from, int to) {
            for (const Owned& o : run)
                mattes.put_surface(from, to, y, o.owner, static_cast<float>(o.samples) / all, false, matte_batch_);
        };
        int begin = rect.x0;
        run.clear();
        for (int x = rect.x0; x < rect.x1; ++x) {
            find_owners(samples, x, y);
            if (owned_ == run) continue;
            put(begin, x);
            begin = x;
            run = owned_;
        }
        put(begin, rect.x1);
    }
    mattes.add(matte_batch_);
}

/// Sums up the samples of a pixel by what they belong to. `first_fragment`: of the pixel, where the shading varies.
void PixelFiller::find_deep(const SampleTile& samples, int x, int y, std::size_t first_fragment) {
    seen_.clear();
    numbers_seen_.clear();
    const SurfaceStyle& surfaces = frame_.scene->surfaces;
    const int s = samples.samples_per_pixel;
    std::uint32_t last = SampleTile::kBackground >> 1;
    std::size_t at = 0;  // of the last one's owner
    for (int row = 0; row < s; ++row) {
        const std::size_t first = samples.index(x * s, y * s + row);
        for (std::size_t i = first; i < first + static_cast<std::size_t>(s); ++i) {
            if (samples.ids[i] == SampleTile::kBackground) continue;
            const std::uint32_t number = samples.ids[i] >> 1;
            if (number != last) {
                last = number;
                const MatteOwner owner = owner_of(number);
                const auto known =
                    std::find_if(seen_.begin(), seen_.end(), [&](const Seen& other) { return other.owner == owner; });
                at = static_cast<std::size_t>(known - seen_.begin());
                if (at == seen_.size()) seen_.push_back({owner});
            }
            Seen* const seen = &seen_[at];
            ++seen->samples;
            const double nearness = frame_.surfaces.farthest_nearness + static_cast<double>(samples.nearness[i]);
            seen->distance += frame_.surfaces.projection.distance(nearness);
            if (surfaces.shading == SurfaceShading::paper) {
                seen->color += surfaces.paper_color;
            } else if (!fragment_shader_) {
                seen->color += glm::vec3(color(number, x, y));
            } else {
                const auto known = std::find(numbers_seen_.begin(), numbers_seen_.end(), number);
                seen->color += colors_[first_fragment + static_cast<std::size_t>(known - numbers_seen_.begin())];
                if (known == numbers_seen_.end()) numbers_seen_.push_back(number);
            }
        }
    }
}

void PixelFiller::add_deep(const SampleTile& samples, PixelRect rect, Mattes& mattes) {
    const auto all = static_cast<float>(samples.samples_per_pixel * samples.samples_per_pixel);
    std::size_t pixel = 0, fragment = 0;
    for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) {
            find_deep(samples, x, y, fragment);
            if (fragment_shader_) fragment += fragments_of_[pixel++];
            for (const Seen& seen : seen_) {
                const bool is_opaque = frame_.scene->materials[seen.owner.material - 1].opacity == 1;
                matte_batch_.deep_surfaces.push_back(
                    {mattes.place_of(x, y), false, is_opaque, seen.owner, static_cast<float>(seen.samples) / all,
                     static_cast<float>(seen.distance / seen.samples), seen.color / all});
            }
        }
    }
    mattes.add(matte_batch_);
}

void PixelFiller::put_motion(const SampleTile& samples, PixelRect rect, int y, Film& film) const {
    const int s = samples.samples_per_pixel;
    float right[kWidth] = {}, up[kWidth] = {};
    for (int x = rect.x0; x < rect.x1 && frame_.next != nullptr; ++x) {
        const std::uint32_t id = samples.ids[samples.index(x * s + s / 2, y * s + s / 2)];
        if (id == SampleTile::kBackground) continue;
        const glm::vec2 way = motion_at(frame_.surfaces, *frame_.next, screen_.surface_of(id >> 1), {x + 0.5, y + 0.5});
        right[x - rect.x0] = way.x;
        up[x - rect.x0] = way.y;
    }
    film.put_motion(rect.x0, rect.x1, y, right, up);
}

}  // namespace burin
