#include "abuffer/samples/pixel_fill.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <limits>

#include "abuffer/screen/sampling.h"
#include "base/interrupt.h"
#include "base/stream_store.h"
#include "shading/surface_shader.h"

namespace burin {
namespace {

glm::dvec3 vector_of(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

HalfColor half_color(const glm::vec4& color) {
    return {Film::to_half(color.r), Film::to_half(color.g), Film::to_half(color.b), Film::to_half(color.a)};
}

/// Whether any sample of those pixels has a surface.
bool is_covered(const SampleTile& samples, PixelRect rect) {
    const int s = samples.samples_per_pixel;
    for (int y = rect.y0 * s; y < rect.y1 * s; ++y) {
        const std::uint32_t* const row = &samples.ids[samples.index(rect.x0 * s, y)];
        std::uint32_t all = SampleTile::kBackground;
        for (int x = 0; x < rect.width() * s; ++x) all &= row[x];
        if (all != SampleTile::kBackground) return true;
    }
    return false;
}

/// Whether all samples of a pixel have one id, but for whether it is plain. `ids`: of its first row.
bool is_all_of(const std::uint32_t* ids, int stride, int s) {
    const std::uint32_t id = ids[0];
    if (s == 2) return ((ids[1] ^ id) | (ids[stride] ^ id) | (ids[stride + 1] ^ id)) >> 1 == 0;
    std::uint32_t others = 0;
    for (int row = 0; row < s; ++row, ids += stride) {
        for (int column = 0; column < s; ++column) others |= ids[column] ^ id;
    }
    return others >> 1 == 0;
}

/// is_all_of() for a row of pixels with so many columns of samples.
bool is_row_of(const std::uint32_t* ids, int stride, int s, int columns) {
    const std::uint32_t id = ids[0];
    for (int row = 0; row < s; ++row, ids += stride) {
        std::uint32_t others = 0;
        for (int column = 0; column < columns; ++column) others |= ids[column] ^ id;
        if (others >> 1 != 0) return false;
    }
    return true;
}

}  // namespace

PixelFiller::PixelFiller(const Frame& frame, const ScreenSurfaces& screen, const TileKernels& kernels,
                         const ShadedSurfaces* shaded)
    : frame_(frame), screen_(screen), kernels_(kernels), place_kernels_(best_place_kernels()) {
    if (shaded != nullptr) fragment_shader_.emplace(*shaded);
    const int per_pixel = samples_per_pixel_of(frame);
    const auto samples = static_cast<float>(per_pixel * per_pixel);
    for (int covered = 0; covered <= per_pixel * per_pixel; ++covered) {
        const glm::vec4 sum = glm::vec4(frame.scene->surfaces.paper_color, 1.0f) * static_cast<float>(covered);
        const glm::vec4 color = sum / samples;
        paper_.push_back(half_color(color));
    }
}

void PixelFiller::find_geometries(const SampleTile& samples, PixelRect rect) {
    const int s = samples.samples_per_pixel;
    const auto width = static_cast<std::size_t>(rect.width());
    geometry_at_.resize(width * static_cast<std::size_t>(rect.height()));
    numbers_.resize(geometry_at_.size() + 1);
    std::size_t count = 1;
    struct Pixel {
        std::uint32_t id;
        std::uint16_t geometry;
    };
    Pixel above[kWidth];
    std::fill_n(above, width, Pixel{SampleTile::kBackground, 0});
    std::size_t at = 0;
    for (int y = rect.y0; y < rect.y1; ++y) {
        const std::uint32_t* sample = &samples.ids[samples.index(rect.x0 * s + s / 2, y * s + s / 2)];
        Pixel left{SampleTile::kBackground, 0};
        // There are no branches: they would be unpredictable where triangles are small.
        for (std::size_t x = 0; x < width; ++x, ++at, sample += s) {
            const std::uint32_t id = *sample;
            const std::uint32_t is_surface = id != SampleTile::kBackground ? 1u : 0u, is_left = id == left.id ? 1u : 0u;
            const std::uint32_t is_new = is_surface & (is_left ^ 1u) & (id != above[x].id ? 1u : 0u);
            const auto choose = [](std::uint32_t condition, std::uint32_t a, std::uint32_t b) {
                return b ^ ((a ^ b) & (0u - condition));
            };
            const std::uint32_t known = choose(is_left, left.geometry, above[x].geometry) & (0u - is_surface);
            left = {id, static_cast<std::uint16_t>(choose(is_new, static_cast<std::uint32_t>(count), known))};
            above[x] = left;
            geometry_at_[at] = left.geometry;
            numbers_[count] = id >> 1;
            count += is_new;
        }
    }
    numbers_.resize(count);
}

void PixelFiller::make_geometries() {
    geometries_.resize(numbers_.size());
    geometries_[0] = TriangleGeometry{};
    geometries_[0].nearest = geometries_[0].farthest = std::numeric_limits<double>::infinity();
    std::uint32_t triangles[kWidth];
    for (std::size_t i = 1; i < numbers_.size();) {
        const SurfaceId first = screen_.surface_of(numbers_[i]);
        const Mesh& mesh = screen_.surfaces().mesh_of(first);
        const std::uint32_t offset = numbers_[i] - first.triangle;
        std::size_t count = 0;
        while (count < kWidth && i + count < numbers_.size() && mesh.polygon_normals.empty() && !mesh.has_residuals()) {
            const std::uint32_t number = numbers_[i + count];
            if (number - offset >= mesh.triangles.size() || screen_.facing(number) == off_screen) break;
            triangles[count++] = number - offset;
        }
        if (count == 0) {
            geometries_[i] = geometry_of(numbers_[i]);
            ++i;
            continue;
        }
        kernels_.fill.geometries(screen_.transform(first.instance), glm::value_ptr(mesh.positions.front()),
                                 screen_.mesh(first.instance), triangles, count, &geometries_[i]);
        for (; count > 0; --count, ++i) fill_ids(numbers_[i], geometries_[i]);
    }
}

void PixelFiller::fill_ids(std::uint32_t number, TriangleGeometry& geometry) const {
    const SurfaceSet& surfaces = frame_.surfaces;
    const SurfaceId id = screen_.surface_of(number);
    geometry.object_id = surfaces.object_id(id);
    geometry.material_id = surfaces.material_id(id);
    geometry.polygon_id = surfaces.polygon_id(id);
}

TriangleGeometry PixelFiller::geometry_of(std::uint32_t number) const {
    TriangleGeometry geometry{};
    fill_ids(number, geometry);
    const SurfaceSet& surfaces = frame_.surfaces;
    const SurfaceId id = screen_.surface_of(number);
    glm::dvec3 corners[3];
    surfaces.view_corners(id, corners);
    const glm::dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const Mesh& mesh = surfaces.mesh_of(id);
    // A polygon of several triangles has one normal; which side is seen, the triangle says.
    glm::dvec3 normal = area / std::max(glm::length(area), 1e-300);
    if (!mesh.polygon_normals.empty()) {
        const glm::dvec3 own = surfaces.instance_of(id).normal_to_view * mesh.polygon_area_vector(id.triangle);
        normal = (glm::dot(own, area) < 0 ? -1.0 : 1.0) * surfaces.view_normal(id);
    }
    const Facing facing = screen_.facing(number);
    const glm::dvec3 to_corner = surfaces.projection.orthographic ? glm::dvec3(0, 0, -1) : corners[0];
    const bool away = facing == off_screen ? glm::dot(area, to_corner) > 0 : facing == clockwise;
    normal *= away ? -1.0 : 1.0;
    const glm::vec3 world(surfaces.view_to_world * normal);
    for (int c = 0; c < 3; ++c) {
        geometry.normal[c] = normal[c];
        geometry.world_normal[c] = world[c];
    }
    geometry.offset = glm::dot(normal, corners[0]);
    geometry.nearest =
        std::max(std::min({-corners[0].z, -corners[1].z, -corners[2].z}), surfaces.projection.near_distance);
    geometry.farthest = std::max({-corners[0].z, -corners[1].z, -corners[2].z});
    return geometry;
}

void PixelFiller::put_geometry(PixelRect rect, int y, Film& film) {
    const auto width = static_cast<std::size_t>(rect.width());
    const Projection& p = frame_.surfaces.projection;
    const glm::dvec2 first = glm::dvec2(rect.x0 + 0.5, y + 0.5) - p.center_px;
    const GeometryRow own{
        row_.distance, {row_.normal[0], row_.normal[1], row_.normal[2]}, {row_.ids[0], row_.ids[1], row_.ids[2]}};
    const bool is_made_in_place = !film.is_whole() && width % 4 == 0;  // see GeometryRow
    const glm::dvec2 focal = p.focal_xy_px();
    kernels_.fill.geometry({p.orthographic, first.x, first.y, focal.x, focal.y}, geometries_.data(),
                           &geometry_at_[static_cast<std::size_t>(y - rect.y0) * width], width,
                           is_made_in_place ? film.geometry_place(rect.x0, y, own) : own);
    if (!is_made_in_place) film.put_geometry(rect.x0, rect.x1, y, own);
}

void PixelFiller::put_paper(const SampleTile& samples, PixelRect rect, Film& film) {
    const int s = samples.samples_per_pixel;
    std::uint8_t covered[kWidth + 8] = {};
    const auto end_of_run = [&](int begin) {  // eight at a time: where it ends is unpredictable
        for (int at = begin; at < rect.width(); at += 8) {
            std::uint64_t eight;
            std::memcpy(&eight, covered + at, sizeof eight);
            const std::uint64_t others = eight ^ covered[begin] * 0x0101010101010101u;
            if (others != 0) return std::min(at + std::countr_zero(others) / 8, rect.width());
        }
        return rect.width();
    };
    constexpr int kAhead = 4;
    const auto prefetch = [&](int y) {
        if (y < rect.y1) film.prefetch_color(rect.x0, rect.x1, y);
    };
    for (int y = rect.y0; y < rect.y0 + kAhead; ++y) prefetch(y);
    for (int y = rect.y0; y < rect.y1; ++y) {
        prefetch(y + kAhead);
        const std::size_t first = samples.index(rect.x0 * s, y * s);
        kernels_.fill.count_covered(&samples.ids[first], samples.stride, s, rect.width(), covered);
        for (int begin = 0, end; begin < rect.width(); begin = end) {  // a few runs of equal counts
            end = end_of_run(begin);
            film.put_color(rect.x0 + begin, rect.x0 + end, y, paper_[covered[begin]]);
        }
    }
}

glm::vec4 PixelFiller::color(std::uint32_t number, int x, int y) {
    if (number != shaded_number_) {
        shaded_number_ = number;
        shaded_geometry_ = geometry_of(number);
    }
    const Scene& scene = *frame_.scene;
    glm::dvec3 origin, ray;
    frame_.surfaces.projection.view_ray({x + 0.5, y + 0.5}, origin, ray);
    return surface_color(scene.surfaces, scene.materials[shaded_geometry_.material_id - 1],
                         vector_of(shaded_geometry_.normal), -glm::normalize(ray));
}

void PixelFiller::put_shaded(const SampleTile& samples, PixelRect rect, int y, Film& film) {
    const int s = samples.samples_per_pixel;
    for (int x = rect.x0; x < rect.x1; ++x) {
        glm::vec4 sum(0.0f);
        std::uint32_t last_id = SampleTile::kBackground;
        glm::vec4 last_color(0.0f);
        for (int row = 0; row < s; ++row) {
            for (int column = 0; column < s; ++column) {
                const std::uint32_t id = samples.ids[samples.index(x * s + column, y * s + row)];
                if (id != last_id) {
                    last_id = id;
                    last_color = id == SampleTile::kBackground ? glm::vec4(0.0f) : color(id >> 1, x, y);
                }
                sum += last_color;
            }
        }
        sum /= static_cast<float>(s * s);
        for (int c = 0; c < 4; ++c) row_.color[c][x - rect.x0] = Film::to_half(sum[c]);
    }
    film.put_colors(rect.x0, rect.x1, y, {row_.color[0], row_.color[1], row_.color[2], row_.color[3]});
}

void PixelFiller::add_fragments(const SampleTile& samples, int x, int y) {
    const int s = samples.samples_per_pixel;
    struct Found {
        std::uint32_t id, count;
        int columns, rows;  // sums over its samples
        std::uint64_t samples;
    };
    std::array<Found, 64> found;
    std::size_t count = 0;
    for (int row = 0; row < s; ++row) {
        const std::uint32_t* const ids = &samples.ids[samples.index(x * s, y * s + row)];
        for (int column = 0; column < s; ++column) {
            if (ids[column] == SampleTile::kBackground) continue;
            const std::uint32_t id = ids[column] >> 1;
            std::size_t i = count;
            while (i > 0 && found[i - 1].id != id) --i;
            if (i == 0) found[count++] = {id, 0, 0, 0, 0};
            Found& own = found[i == 0 ? count - 1 : i - 1];
            ++own.count;
            own.columns += column;
            own.rows += row;
            own.samples |= std::uint64_t{1} << (row * s + column);
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double scale = 1.0 / (s * static_cast<double>(found[i].count)), half = 0.5 / s;
        fragments_.push_back({screen_.surface_of(found[i].id),
                              {x + half + found[i].columns * scale, y + half + found[i].rows * scale},
                              1,
                              {static_cast<std::uint8_t>(s), found[i].samples}});
        samples_of_.push_back(static_cast<std::uint8_t>(found[i].count));
    }
    fragments_of_.push_back(static_cast<std::uint8_t>(count));
}

void PixelFiller::find_fragments(const SampleTile& samples, PixelRect rect) {
    fragments_.clear();
    samples_of_.clear();
    fragments_of_.clear();
    row_kinds_.clear();
    const int s = samples.samples_per_pixel;
    const auto all = static_cast<std::uint8_t>(s * s);
    for (int y = rect.y0; y < rect.y1; ++y) {
        const std::uint32_t* ids = &samples.ids[samples.index(rect.x0 * s, y * s)];
        std::uint32_t last_number = SampleTile::kBackground >> 1;
        SurfaceId last = kBackground;
        const auto add = [&](std::uint32_t number, int begin, int end) {
            const bool is_surface = number != SampleTile::kBackground >> 1;
            const auto count = static_cast<std::size_t>(end - begin);
            fragments_of_.insert(fragments_of_.end(), count, is_surface ? 1 : 0);
            if (!is_surface) return;
            if (number != last_number) last = screen_.surface_of(number);
            last_number = number;
            samples_of_.insert(samples_of_.end(), count, all);
            fragments_.push_back({last, {begin + 0.5, y + 0.5}, static_cast<std::uint32_t>(count)});
        };
        if (is_row_of(ids, samples.stride, s, rect.width() * s)) {
            add(ids[0] >> 1, rect.x0, rect.x1);
            row_kinds_.push_back(last_number != SampleTile::kBackground >> 1 ? RowKind::of_one : RowKind::mixed);
            continue;
        }
        row_kinds_.push_back(RowKind::mixed);
        for (int x = rect.x0; x < rect.x1; ++x, ids += s) {
            if (is_all_of(ids, samples.stride, s)) {
                add(ids[0] >> 1, x, x + 1);
            } else {
                add_fragments(samples, x, y);
            }
        }
    }
}

void PixelFiller::put_fragments(const SampleTile& samples, PixelRect rect, Film& film) {
    find_fragments(samples, rect);
    fragment_shader_->shade(fragments_, colors_);
    const int s = samples.samples_per_pixel;
    const float scale = 1.0f / static_cast<float>(s * s);
    const auto width = static_cast<std::size_t>(rect.width());
    std::size_t pixel = 0, fragment = 0;
    constexpr std::uint16_t kHalfOne = 0x3C00;
    for (int y = rect.y0; y < rect.y1; ++y) {
        if (row_kinds_[static_cast<std::size_t>(y - rect.y0)] == RowKind::of_one) {
            for (std::size_t c = 0; c < 3; ++c)
                place_kernels_.halves(&colors_.parts[c][fragment], width, row_.color[c]);
            std::fill_n(row_.color[3], width, kHalfOne);
            pixel += width;
            fragment += width;
            film.put_colors(rect.x0, rect.x1, y, {row_.color[0], row_.color[1], row_.color[2], row_.color[3]});
            continue;
        }
        for (std::size_t x = 0; x < width; ++x, ++pixel) {
            glm::vec4 sum(0.0f);
            for (int i = 0; i < fragments_of_[pixel]; ++i, ++fragment)
                sum += glm::vec4(colors_[fragment], 1.0f) * (static_cast<float>(samples_of_[fragment]) * scale);
            for (std::size_t c = 0; c < 4; ++c) row_.sum[c][x] = sum[static_cast<int>(c)];
        }
        for (std::size_t c = 0; c < 4; ++c) place_kernels_.halves(row_.sum[c], width, row_.color[c]);
        film.put_colors(rect.x0, rect.x1, y, {row_.color[0], row_.color[1], row_.color[2], row_.color[3]});
    }
}

PixelRect PixelFiller::in_crop(PixelRect r) const {
    const PixelRect& crop = frame_.crop;
    const PixelRect common{std::max(r.x0, crop.x0), std::max(r.y0, crop.y0), std::min(r.x1, crop.x1),
                           std::min(r.y1, crop.y1)};
    return common.x0 < common.x1 && common.y0 < common.y1 ? common : PixelRect{};
}

void PixelFiller::clear(PixelRect rect, Film& film) const {
    rect = in_crop(rect);
    if (rect.x0 >= rect.x1) return;
    for (int y = rect.y0; y < rect.y1; ++y) {
        throw_if_interrupted();  // all empty tiles of a row come at once: megabytes that may have to be backed first
        film.put_background(rect.x0, rect.x1, y);
    }
    finish_stream_stores();
}

void PixelFiller::fill_part(const SampleTile& samples, PixelRect part, Film& film) {
    const bool has_geometry = film.has_geometry();
    if (has_geometry) {
        find_geometries(samples, part);
        make_geometries();
    }
    const bool is_paper = frame_.scene->surfaces.shading == SurfaceShading::paper;
    if (is_paper) put_paper(samples, part, film);
    if (fragment_shader_) put_fragments(samples, part, film);
    const bool is_put = is_paper || fragment_shader_.has_value();
    for (int y = part.y0; y < part.y1; ++y) {
        if (has_geometry) put_geometry(part, y, film);
        if (!is_put) put_shaded(samples, part, y, film);
        if (film.layers().motion) put_motion(samples, part, y, film);
    }
    if (film.mattes() != nullptr) add_mattes(samples, part, *film.mattes());
}

void PixelFiller::fill(const SurfaceTile& tile, Film& film) {
    film.for_parts(in_crop(tile.rect()), [&](PixelRect part) {
        if (is_covered(tile.samples(), part)) {
            film.expect_all_of(part);
            fill_part(tile.samples(), part, film);
        } else {
            clear(part, film);
        }
    });
    finish_stream_stores();
}

}  // namespace burin
