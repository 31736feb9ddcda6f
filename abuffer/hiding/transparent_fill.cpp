#include "abuffer/hiding/transparent_fill.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "abuffer/edges/occluder.h"
#include "abuffer/samples/sample_tile.h"
#include "abuffer/screen/sampling.h"
#include "base/parallel.h"
#include "kernels/tile_kernels.h"
#include "render/mattes.h"
#include "shading/surface/fragment_shader.h"
#include "shading/surface_shader.h"
#include "view/scan_convert.h"

namespace burin {
namespace {

/// A transparent triangle at a sample.
struct TransparentSample {
    std::uint32_t sample;
    float nearness;
    std::uint32_t number;
    bool operator<(const TransparentSample& o) const {
        if (sample != o.sample) return sample < o.sample;
        if (nearness != o.nearness) return nearness > o.nearness;
        return number < o.number;
    }
};

/// A polygon on the screen and its plane.
struct PlacedPolygon {
    ScreenPolygon polygon;
    SpanPlane plane;
};

class TransparentTile {
  public:
    TransparentTile(const Frame& frame, const ScreenSurfaces& screen, const ShadedSurfaces* shaded,
                    const OccluderBins& bins, const PixelTiles& grid)
        : frame_(frame), screen_(screen), bins_(bins), grid_(grid), kernels_(best_kernels()) {
        if (shaded != nullptr) shader_.emplace(*shaded);
    }

    void fill(std::size_t tile, Film& film) {
        const auto numbers = bins_.triangles(tile);
        const bool any = std::any_of(numbers.begin(), numbers.end(), [&](std::uint32_t n) { return opacity(n) < 1; });
        if (!any) return;
        rect_ = grid_.tile(tile);
        const int s = samples_per_pixel_of(frame_);
        samples_.reset(rect_.x0 * s, rect_.y0 * s, rect_.width() * s, rect_.height() * s, s);
        transparent_.clear();
        for (const std::uint32_t n : numbers) {
            if (opacity(n) == 1) draw_opaque(n);
        }
        for (const std::uint32_t n : numbers) {
            if (opacity(n) < 1) draw_transparent(n);
        }
        std::sort(transparent_.begin(), transparent_.end());
        composite(film);
    }

  private:
    /// What one material of one object has in a pixel, summed over samples.
    struct Share {
        MatteOwner owner;
        float sum = 0;
        glm::vec3 color{0.0f};  // times the share
        double distance = 0;
        int samples = 0;
    };

    SurfaceId surface(std::uint32_t value) const { return screen_.surface_of(value & ~OccluderBins::kClipped); }
    float opacity(std::uint32_t value) const { return frame_.material_of(surface(value)).opacity; }
    SampleView view() {
        return {samples_.nearness.data(),
                samples_.ids.data(),
                samples_.first_column,
                samples_.first_row,
                samples_.columns,
                samples_.rows,
                samples_.stride,
                samples_.samples_per_pixel,
                0,
                0,
                nullptr,
                nullptr,
                0};
    }

    PlacedPolygon placed(std::uint32_t value) const {
        const SurfaceSet& surfaces = frame_.surfaces;
        const SurfaceId s = surface(value);
        PlacedPolygon placed;
        placed.polygon = surfaces.screen_polygon(s);
        const DepthPlane plane = surfaces.plane(s);
        const SubpixelPoint at = placed.polygon.corners[0];
        const double zero = surfaces.farthest_nearness;
        placed.plane = {at.x,
                        at.y,
                        static_cast<float>(plane.extended_to(to_pixels(glm::dvec2(at.x, at.y))) - zero),
                        static_cast<float>(plane.per_x / kSubpixelsPerPixel),
                        static_cast<float>(plane.per_y / kSubpixelsPerPixel),
                        static_cast<float>(plane.lowest - zero),
                        static_cast<float>(plane.highest - zero),
                        (value & ~OccluderBins::kClipped) << 1};
        return placed;
    }

    /// Calls visit(row, first column, end column), counted in the tile.
    template <typename Visit>
    void for_spans(const ScreenPolygon& polygon, const Visit& visit) const {
        if (polygon.count == 0) return;
        const ScanConverter scan(polygon, samples_.samples_per_pixel);
        const int end_row = std::min(scan.end_row(), samples_.first_row + samples_.rows);
        for (int row = std::max(scan.first_row(), samples_.first_row); row < end_row; ++row) {
            const SampleSpan span = scan.span(row);
            const int begin = std::max(span.begin - samples_.first_column, 0);
            const int end = std::min(span.end - samples_.first_column, samples_.columns);
            if (begin < end) visit(row - samples_.first_row, begin, end);
        }
    }

    void draw_opaque(std::uint32_t value) {
        const PlacedPolygon p = placed(value);
        for_spans(p.polygon,
                  [&](int row, int begin, int end) { kernels_.draw.span(view(), row, begin, end, p.plane); });
    }

    void draw_transparent(std::uint32_t value) {
        const PlacedPolygon p = placed(value);
        const std::int32_t pitch = kSubpixelsPerPixel / samples_.samples_per_pixel;
        for_spans(p.polygon, [&](int row, int begin, int end) {
            const auto y = static_cast<float>((samples_.first_row + row) * pitch + pitch / 2 - p.plane.y);
            for (int column = begin; column < end; ++column) {
                const auto x = static_cast<float>((samples_.first_column + column) * pitch + pitch / 2 - p.plane.x);
                const float nearness =
                    std::clamp(x * p.plane.per_x + p.plane.nearness + y * p.plane.per_y, p.plane.low, p.plane.high);
                const auto i = static_cast<std::uint32_t>(row * samples_.stride + column);
                const float gap = nearness - samples_.nearness[i];
                const double level = level_slack(frame_.surfaces, static_cast<double>(nearness));
                const bool is_level = static_cast<double>(std::abs(gap)) <= level;
                const bool is_seen = is_level ? is_in_front(p.plane.id >> 1, samples_.ids[i] >> 1, gap) : gap > 0;
                if (is_seen) transparent_.push_back({i, nearness, p.plane.id >> 1});
            }
        });
    }

    /// Whether the first of two surfaces at about one depth is in front; it is nearer by `gap` at a sample. It is asked
    /// about the same two for one sample after the other.
    bool is_in_front(std::uint32_t number, std::uint32_t opaque, float gap) {
        if (compared_[0] != number || compared_[1] != opaque) {
            compared_[0] = number;
            compared_[1] = opaque;
            order_ = frame_.surfaces.order(screen_.surface_of(number), screen_.surface_of(opaque));
        }
        if (order_.are_coincident()) return number < opaque;
        return order_.is_in_front() || (gap > 0 && !order_.is_behind());
    }

    void composite(Film& film) {
        const Mattes* const mattes = film.mattes();
        has_mattes_ = mattes != nullptr && (mattes->wants_surfaces() || mattes->wants_deep()) &&
                      frame_.scene->surfaces.shading != SurfaceShading::none;
        const int s = samples_.samples_per_pixel;
        // Where each row of pixels begins in transparent_; sorted by sample, so rows of samples follow each other.
        for (int y = std::max(rect_.y0, frame_.crop.y0); y < std::min(rect_.y1, frame_.crop.y1); ++y) {
            if (shader_) shade_row(y);
            for (int x = std::max(rect_.x0, frame_.crop.x0); x < std::min(rect_.x1, frame_.crop.x1); ++x) {
                glm::vec4 sum(0.0f);
                bool any = false;
                last_number_ = ~0u;
                shares_.clear();
                for (int row = (y - rect_.y0) * s; row < (y - rect_.y0 + 1) * s; ++row) {
                    for (int column = (x - rect_.x0) * s; column < (x - rect_.x0 + 1) * s; ++column) {
                        sum += sample_color(static_cast<std::uint32_t>(row * samples_.stride + column), x, y, any);
                    }
                }
                if (!any) continue;
                film.replace_surface(x, y, sum / static_cast<float>(s * s));
                for (const Share& share : shares_) add_to_batch(share, x, y, *film.mattes());
            }
        }
        if (film.mattes() != nullptr) film.mattes()->add(batch_);
    }

    glm::vec4 sample_color(std::uint32_t sample, int x, int y, bool& any) {
        auto at = first_at(sample);
        glm::vec4 color(0.0f);
        float left = 1;
        for (; at != transparent_.end() && at->sample == sample; ++at) {
            any = true;
            const float o = opacity(at->number);
            const glm::vec4 own = surface_at(at->number, x, y) * (left * o);
            color += own;
            if (has_mattes_) add_share(at->number, left * o, at->nearness, own);
            left *= 1 - o;
        }
        const std::uint32_t id = samples_.ids[sample];
        if (id == SampleTile::kBackground) return color;
        const glm::vec4 own = surface_at(id >> 1, x, y) * left;
        if (has_mattes_) add_share(id >> 1, left, samples_.nearness[sample], own);
        return color + own;
    }

    void add_share(std::uint32_t number, float share, float nearness, const glm::vec4& color) {
        const SurfaceId id = screen_.surface_of(number);
        const MatteOwner owner{frame_.surfaces.object_id(id), frame_.surfaces.material_id(id)};
        auto known = std::find_if(shares_.begin(), shares_.end(), [&](const Share& s) { return s.owner == owner; });
        if (known == shares_.end()) known = shares_.insert(shares_.end(), {owner});
        known->sum += share;
        known->color += glm::vec3(color);
        const double whole = frame_.surfaces.farthest_nearness + static_cast<double>(nearness);
        known->distance += frame_.surfaces.projection.distance(whole);
        ++known->samples;
    }

    void add_to_batch(const Share& share, int x, int y, const Mattes& mattes) {
        const auto all = static_cast<float>(samples_.samples_per_pixel * samples_.samples_per_pixel);
        if (mattes.wants_surfaces()) mattes.put_surface(x, x + 1, y, share.owner, share.sum / all, true, batch_);
        if (!mattes.wants_deep()) return;
        const bool is_opaque = frame_.scene->materials[share.owner.material - 1].opacity == 1;
        batch_.deep_surfaces.push_back({mattes.place_of(x, y), true, is_opaque, share.owner, share.sum / all,
                                        static_cast<float>(share.distance / share.samples), share.color / all});
    }

    /// The first transparent triangle at a sample or behind it.
    std::vector<TransparentSample>::const_iterator first_at(std::uint32_t sample) const {
        return std::lower_bound(transparent_.begin(), transparent_.end(), sample,
                                [](const TransparentSample& l, std::uint32_t i) { return l.sample < i; });
    }

    /// Calls visit(x, number, column, row) for all surfaces that are seen at samples of a row of pixels, pixel by
    /// pixel, where any is transparent.
    template <typename Visit>
    void for_surfaces(int y, const Visit& visit) const {
        const int s = samples_.samples_per_pixel;
        const int first_row = (y - rect_.y0) * s;
        const auto sample_at = [&](int column, int row) {
            return static_cast<std::uint32_t>(row * samples_.stride + column);
        };
        for (int x = std::max(rect_.x0, frame_.crop.x0); x < std::min(rect_.x1, frame_.crop.x1); ++x) {
            const int first_column = (x - rect_.x0) * s;
            bool any = false;
            for (int row = first_row; row < first_row + s && !any; ++row) {
                const auto at = first_at(sample_at(first_column, row));
                any = at != transparent_.end() && at->sample < sample_at(first_column + s, row);
            }
            for (int i = 0; any && i < s * s; ++i) {
                const int column = first_column + i % s, row = first_row + i / s;
                const std::uint32_t sample = sample_at(column, row);
                for (auto at = first_at(sample); at != transparent_.end() && at->sample == sample; ++at)
                    visit(x, at->number, column, row);
                const std::uint32_t id = samples_.ids[sample];
                if (id != SampleTile::kBackground) visit(x, id >> 1, column, row);
            }
        }
    }

    /// Shades what is seen in a row of pixels, each surface once in a pixel, in the middle of its samples there.
    void shade_row(int y) {
        row_.clear();
        for_surfaces(y, [&](int x, std::uint32_t number, int column, int row) {
            auto own = std::find_if(row_.rbegin(), row_.rend(),
                                    [&](const Found& f) { return f.x != x || f.number == number; });
            if (own == row_.rend() || own->x != x) {
                row_.push_back({x, number, 0, 0, 0});
                own = row_.rbegin();
            }
            ++own->count;
            own->columns += column;
            own->rows += row;
            const int side = samples_.samples_per_pixel;
            own->samples |= std::uint64_t{1} << (row % side * side + column % side);
        });
        fragments_.clear();
        const double s = samples_.samples_per_pixel;
        for (const Found& f : row_) {
            const double count = f.count;
            fragments_.push_back({screen_.surface_of(f.number),
                                  {(samples_.first_column + f.columns / count + 0.5) / s,
                                   (samples_.first_row + f.rows / count + 0.5) / s},
                                  1,
                                  {static_cast<std::uint8_t>(samples_.samples_per_pixel), f.samples}});
        }
        shader_->shade(fragments_, colors_);
    }

    glm::vec4 shaded_color(std::uint32_t number, int x) const {
        auto found = std::lower_bound(row_.begin(), row_.end(), x, [](const Found& f, int at) { return f.x < at; });
        while (found != row_.end() && found->x == x && found->number != number) ++found;
        // In a pixel without transparent surfaces nothing is replaced.
        if (found == row_.end() || found->x != x) return glm::vec4(0.0f);
        return glm::vec4(colors_[static_cast<std::size_t>(found - row_.begin())], 1.0f);
    }

    /// The colour of a surface as if it were opaque.
    glm::vec4 surface_at(std::uint32_t number, int x, int y) {
        if (shader_) return shaded_color(number, x);
        const Scene& scene = *frame_.scene;
        if (scene.surfaces.shading == SurfaceShading::none) return glm::vec4(0.0f);
        if (scene.surfaces.shading == SurfaceShading::paper) return glm::vec4(scene.surfaces.paper_color, 1.0f);
        if (number == last_number_) return last_color_;
        const SurfaceId s = screen_.surface_of(number);
        const glm::dvec2 pixel(x + 0.5, y + 0.5);
        glm::dvec3 origin, ray;
        frame_.surfaces.projection.view_ray(pixel, origin, ray);
        last_number_ = number;
        last_color_ = surface_color(scene.surfaces, frame_.material_of(s), frame_.surfaces.normal_towards_eye(s, pixel),
                                    -glm::normalize(ray));
        return last_color_;
    }

    /// A surface in a pixel.
    struct Found {
        int x;
        std::uint32_t number;
        int count, columns, rows;  // of its samples there, and the sums over them
        std::uint64_t samples = 0;
    };

    const Frame& frame_;
    const ScreenSurfaces& screen_;
    const OccluderBins& bins_;
    const PixelTiles& grid_;
    const TileKernels& kernels_;
    PixelRect rect_;
    SampleTile samples_;
    std::vector<TransparentSample> transparent_;
    std::uint32_t compared_[2] = {~0u, ~0u};
    SurfaceOrder order_;  // of these two
    std::uint32_t last_number_ = ~0u;
    glm::vec4 last_color_{0.0f};
    bool has_mattes_ = false;
    std::vector<Share> shares_;  // of a pixel
    MatteBatch batch_;
    std::optional<FragmentShader> shader_;
    std::vector<Found> row_;  // of a row of pixels, from the left
    std::vector<SurfaceFragment> fragments_;
    FragmentColors colors_;
};

}  // namespace

void fill_transparent(const Frame& frame, const ScreenSurfaces& screen, const ShadedSurfaces* shaded,
                      const OccluderBins& bins, const PixelTiles& grid, int threads, Film& film) {
    std::vector<std::unique_ptr<TransparentTile>> tiles(static_cast<std::size_t>(threads));
    parallel_for(grid.count(), threads, [&](std::size_t index, int worker) {
        auto& tile = tiles[static_cast<std::size_t>(worker)];
        if (!tile) tile = std::make_unique<TransparentTile>(frame, screen, shaded, bins, grid);
        tile->fill(index, film);
    });
}

}  // namespace burin
