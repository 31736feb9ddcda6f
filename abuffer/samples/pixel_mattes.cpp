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
    if (!mattes.wants_surfaces() || frame_.scene->surfaces.shading == SurfaceShading::none) return;
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
