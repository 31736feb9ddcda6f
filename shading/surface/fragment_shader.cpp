#include "shading/surface/fragment_shader.h"

#include <algorithm>
#include <cmath>

#include "shading/surface/hatching.h"

namespace burin {
namespace {

using S = SurfaceVariable;

glm::dvec3 unit_or_zero(const glm::dvec3& v) { return v / std::max(glm::length(v), 1e-300); }

/// By how much a level's direction differs from that of the first one: no two are across each other, for then lines
/// would leave rows of dots.
constexpr double kLevelTurnsDeg[] = {0, 70, 125, 30};

/// Planes that cut a surface at a smaller angle than the first of these make no lines on it, at a larger one than the
/// second no others are needed. Sines.
constexpr double kLevelPlanes[] = {0.12, 0.3};

}  // namespace

FragmentShader::FragmentShader(const ShadedSurfaces& surfaces)
    : surfaces_(surfaces),
      look_(surfaces.look()),
      projection_(surfaces.surfaces().projection),
      kernels_(best_place_kernels()) {
    const bool is_on_object = look_.shading == SurfaceShading::hatch && look_.hatch_space == HatchSpace::object;
    const bool reads_light = look_.shading == SurfaceShading::toon || look_.shading == SurfaceShading::gooch;
    SurfaceVariables of_pixel, of_file;
    for (const S v : {S::x, S::y, S::C, S::object, S::material}) of_pixel.set(number_of(v));
    for (const S v : {S::u, S::v, S::Cv, S::attribute}) of_file.set(number_of(v));
    needs_places_ = look_.needs_lit || reads_light || is_on_object || (look_.variables & ~(of_pixel | of_file)).any();
    needs_shares_ = !look_.layers.empty() || look_.variables[number_of(S::kr)];
    needs_changes_ = look_.needs_lit || look_.shading == SurfaceShading::toon || is_on_object;
    columns_.resize(look_.inputs.size() * kColumn);
    column_list_.resize(look_.inputs.size());
    std::size_t results = 0;
    for (const ExpressionOutput& output : look_.program.outputs()) results += output.components;
    values_.resize(results * kBlock);
    triangles_.reserve(kBlock);
    const glm::dvec3 axis = unit_or_zero(look_.hatch_axis);
    const glm::dvec3 across =
        unit_or_zero(glm::cross(axis, std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 other = glm::cross(across, axis);
    for (int level = 0; level < look_.hatch_levels; ++level) {
        const double turn = glm::radians(kLevelTurnsDeg[level]);
        const double angle = glm::radians(look_.hatch_angle_deg) + turn;
        const bool is_uv = look_.hatch_space == HatchSpace::uv;
        hatch_directions_.emplace_back(is_uv ? -std::sin(angle) : std::sin(angle),
                                       std::cos(angle));  // across the lines; y runs down, v up
        hatch_axes_.push_back(level % 2 == 0 ? unit_or_zero(axis * std::cos(turn) + across * std::sin(turn))
                                             : unit_or_zero(axis * std::cos(turn) + other * std::sin(turn)));
        const glm::dvec3 aside(0.36, 0.48, 0.8);
        const bool is_aside = std::abs(glm::dot(hatch_axes_.back(), aside)) < 0.95;
        other_axes_.push_back(unit_or_zero(glm::cross(hatch_axes_.back(), is_aside ? aside : glm::dvec3(1, 0, 0))));
    }
}

void FragmentShader::shade(std::span<const SurfaceFragment> fragments, FragmentColors& colors) {
    std::size_t all = 0, done = 0;
    for (const SurfaceFragment& fragment : fragments) all += fragment.count;
    colors.resize(all);
    const auto finish_block = [&] {
        shade_block({&colors.parts[0][done], &colors.parts[1][done], &colors.parts[2][done]});
        done += count_;
        begin_block();
    };
    begin_block();
    for (const SurfaceFragment& fragment : fragments) {
        for (std::size_t added = 0; added < fragment.count;) {
            if (count_ == kBlock) finish_block();
            added += add_places(fragment, added);
        }
    }
    if (count_ > 0) finish_block();
}

void FragmentShader::begin_block() {
    count_ = 0;
    triangles_.clear();
    slots_.fill(0);
    runs_.clear();
}

std::size_t FragmentShader::add_places(const SurfaceFragment& fragment, std::size_t first) {
    const std::size_t begin = count_, added = std::min(kBlock - begin, fragment.count - first);
    const bool is_known = !runs_.empty() && triangles_[runs_.back().triangle].id() == fragment.surface;
    if (!is_known) runs_.push_back({begin, begin, triangle_number(fragment.surface)});
    runs_.back().end = count_ = begin + added;
    std::fill_n(&triangle_at_[begin], added, runs_.back().triangle);
    if (look_.needs_lit) std::fill_n(&samples_[begin], added, fragment.samples);
    std::fill_n(&y_[begin], added, fragment.place.y);
    for (std::size_t i = 0; i < added; ++i)
        x_[begin + i] = fragment.place.x + static_cast<double>(static_cast<std::int32_t>(first + i));
    return added;
}

std::uint16_t FragmentShader::triangle_number(SurfaceId id) {
    std::size_t slot = (id.triangle * 0x9E3779B1u ^ id.instance * 0x85EBCA77u) >> 7 & (kSlots - 1);
    for (; slots_[slot] != 0; slot = (slot + 1) & (kSlots - 1)) {
        const auto number = static_cast<std::uint16_t>(slots_[slot] - 1);
        if (triangles_[number].id() == id) return number;
    }
    triangles_.emplace_back(surfaces_, id);
    slots_[slot] = static_cast<std::uint16_t>(triangles_.size());
    return static_cast<std::uint16_t>(triangles_.size() - 1);
}

void FragmentShader::find_places() {
    if (needs_places_) {
        for (const Run& run : runs_) kernels_.places(triangles_[run.triangle].view(), view(run.begin, run.end));
    }
    if (needs_changes_) {
        for (std::size_t i = 0; i < count_; ++i) changes_[i] = triangle_of(i).changes_at(pixel(i), place(i));
    }
}

PlaceView FragmentShader::view(std::size_t begin, std::size_t end) {
    return {&x_[begin],
            &y_[begin],
            {&position_[0][begin], &position_[1][begin], &position_[2][begin]},
            {&normal_[0][begin], &normal_[1][begin], &normal_[2][begin]},
            end - begin};
}

void FragmentShader::shade_block(const std::array<float*, 3>& colors) {
    find_places();
    if (needs_shares_) {
        for (std::size_t i = 0; i < count_; ++i) shares_[i] = triangle_of(i).shares_at(pixel(i));
    }
    if (look_.needs_lit) {
        for (std::size_t i = 0; i < count_; ++i) lit_[i] = lit_share(i);
    }
    if (!look_.program.outputs().empty()) evaluate(colors);
    if (look_.shading == SurfaceShading::expression) return;
    const auto in_light = [&](std::size_t i, const auto& shade) -> glm::vec3 {
        if (!look_.has_shadows || lit_[i] == 1) return shade(false);
        if (lit_[i] == 0) return shade(true);
        return glm::mix(shade(true), shade(false), lit_[i]);
    };
    for (std::size_t i = 0; i < count_; ++i) {
        glm::vec3 color;
        switch (look_.shading) {
            case SurfaceShading::toon:
                color = in_light(i, [&](bool in_shadow) { return toon(i, in_shadow); });
                break;
            case SurfaceShading::gooch:
                color = in_light(i, [&](bool in_shadow) { return gooch(i, in_shadow); });
                break;
            case SurfaceShading::hatch:
                color = hatch(i, pixel(i));
                break;
            default:
                color = triangle_of(i).color();
                break;
        }
        for (std::size_t c = 0; c < 3; ++c) colors[c][i] = color[static_cast<int>(c)];
    }
}

void FragmentShader::fill_column(const SurfaceInput& input, float* to) {
    const std::size_t n = count_;
    const auto c = static_cast<int>(input.component);
    const auto each = [&](const auto& compute) {
        for (std::size_t i = 0; i < n; ++i) to[i] = static_cast<float>(compute(i));
    };
    const auto each_run = [&](const auto& compute) {
        for (const Run& run : runs_)
            std::fill(to + run.begin, to + run.end, static_cast<float>(compute(triangles_[run.triangle])));
    };
    const double* const positions[3] = {position_[0].data(), position_[1].data(), position_[2].data()};
    const double* const normals[3] = {normal_[0].data(), normal_[1].data(), normal_[2].data()};
    const auto cosines = [&](const ViewLight& light) {
        kernels_.cosines({light.is_at_point, {light.place.x, light.place.y, light.place.z}}, view(0, n), to);
    };
    const glm::dmat4& to_world = surfaces_.camera_to_world();
    switch (input.variable) {
        case S::x:
            return each([&](std::size_t i) { return x_[i]; });
        case S::y:
            return each([&](std::size_t i) { return y_[i]; });
        case S::depth:
            return each([&](std::size_t i) { return -position_[2][i]; });
        case S::distance:
            return each([&](std::size_t i) {
                return projection_.orthographic ? -position_[2][i] : glm::length(place(i).position);
            });
        case S::px_size:
            return each([&](std::size_t i) { return projection_.pixel_size(-position_[2][i]); });
        case S::P:
            return kernels_.rows({to_world[0][c], to_world[1][c], to_world[2][c], to_world[3][c]}, positions, n, to);
        case S::PO:
            for (const Run& run : runs_) {
                const glm::dmat4& m = surfaces_.to_object(triangles_[run.triangle].id().instance);
                kernels_.rows({m[0][c], m[1][c], m[2][c], m[3][c]},
                              {positions[0] + run.begin, positions[1] + run.begin, positions[2] + run.begin},
                              run.end - run.begin, to + run.begin);
            }
            return;
        case S::N:  // to add -0 changes nothing
            return kernels_.rows({to_world[0][c], to_world[1][c], to_world[2][c], -0.0}, normals, n, to);
        case S::facing:
            return cosines(light_at_eye(projection_));
        case S::light:
            return cosines(surfaces_.lights().front());
        case S::lit:
            return each([&](std::size_t i) { return lit_[i]; });
        case S::C:
            return each_run([&](const ShadedTriangle& triangle) { return triangle.color()[c]; });
        case S::object:
            return each_run([](const ShadedTriangle& triangle) { return triangle.object_id(); });
        case S::material:
            return each_run([](const ShadedTriangle& triangle) { return triangle.material_id(); });
        case S::kr:
            return each([&, eye = light_at_eye(projection_)](std::size_t i) {
                const SurfaceId id = triangle_of(i).id();
                return radial_curvature(surfaces_.curvature(id.instance), id.triangle, shares_[i],
                                        glm::dmat3(surfaces_.to_object(id.instance)), place(i).normal,
                                        eye.towards(place(i).position));
            });
        case S::u:
        case S::v:
            return each([&](std::size_t i) { return file_value(i, input.layer, input.variable == S::u ? 0 : 1); });
        case S::Cv:
        case S::attribute:
            return each([&](std::size_t i) { return file_value(i, input.layer, input.component); });
    }
}

void FragmentShader::evaluate(const std::array<float*, 3>& colors) {
    for (std::size_t k = 0; k < look_.inputs.size(); ++k) {
        fill_column(look_.inputs[k], &columns_[k * kColumn]);
        column_list_[k] = &columns_[k * kColumn];
    }
    std::array<float*, 9> values{};
    for (std::size_t k = 0; k * kBlock < values_.size(); ++k) values[k] = &values_[k * kBlock];
    if (look_.shading == SurfaceShading::expression) std::copy(colors.begin(), colors.end(), values.begin());
    std::array<NotNumbers, 3> found{};
    const std::size_t results = look_.program.outputs().size();
    look_.program.evaluate(column_list_, count_, values, std::span(found).first(results));
    std::uint64_t count = 0;
    for (const NotNumbers& of_result : found) count += of_result.count;
    if (count != 0) surfaces_.count_not_numbers(count);
}

float FragmentShader::file_value(std::size_t i, std::size_t layer, std::size_t component) const {
    const SurfaceId id = triangle_of(i).id();
    const AttributeLayer* const values = surfaces_.layer(id.instance, layer);
    if (values == nullptr) return 0;
    std::array<float, 3> row{};
    attribute_at(*values, id.triangle, shares_[i], row.data());
    return row[component];
}

glm::vec3 FragmentShader::toon(std::size_t i, bool in_shadow) const {
    const glm::vec3& color = triangle_of(i).color();
    const Light light = light_at(i, in_shadow);
    const auto tone = [&](const ToneCurve& curve) {
        const glm::vec3 value = curve.at(light.value, light.change_per_px * look_.softness_px);
        return curve.is_color() ? value : value * color;
    };
    const glm::vec3 main = tone(look_.tones);
    if (!look_.has_detail) return main;
    return main + (tone(look_.detail_tones) - main) * values_[i];
}

glm::vec3 FragmentShader::gooch(std::size_t i, bool in_shadow) const {
    const glm::vec3& color = triangle_of(i).color();
    const auto share = static_cast<float>(0.5 * (1 + light_at(i, in_shadow).value));
    return glm::mix(look_.cool + 0.25f * color, look_.warm + 0.5f * color, share);
}

double FragmentShader::covered_on_object(std::size_t i, const glm::dvec3& axis, double width) const {
    const glm::dmat4& to_object = surfaces_.to_object(triangle_of(i).id().instance);
    const SurfacePlace p = place(i);
    const glm::dvec3 in_view = axis_in_view(i, axis);
    const double place = glm::dot(in_view, p.position) + glm::dot(axis, glm::dvec3(to_object[3]));
    const glm::dvec2 change(glm::dot(in_view, changes_[i].position[0]), glm::dot(in_view, changes_[i].position[1]));
    // Where planes are nearly level with the surface, lines would crowd.
    const double least = 0.1 * glm::length(in_view) * projection_.pixel_size(-p.position.z);
    return covered_by_adaptive_lines(place, std::max(glm::length(change), least), look_.hatch_spacing_px, width);
}

double FragmentShader::covered_on_texture(std::size_t i, const glm::dvec2& across, double width,
                                          glm::dvec2 pixel) const {
    const ShadedTriangle& triangle = triangle_of(i);
    const SurfaceId id = triangle.id();
    const AttributeLayer* const uv = surfaces_.layer(id.instance, look_.hatch_layer);
    const std::uint32_t* const rows = uv != nullptr ? &uv->rows[3 * std::size_t{id.triangle}] : nullptr;
    if (rows == nullptr || std::find(rows, rows + 3, AttributeLayer::kNoRow) != rows + 3) return width;
    const auto changes = triangle.share_changes_at(pixel);
    double place = 0;
    glm::dvec2 change(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::span<const float> row = uv->row(rows[k]);
        const double at_corner = across.x * static_cast<double>(row[0]) + across.y * static_cast<double>(row[1]);
        place += shares_[i][k] * at_corner;
        change += glm::dvec2(changes[0][k], changes[1][k]) * at_corner;
    }
    const double per_px = glm::length(change);
    // Where the texture stands still, lines have no place: the tone is even.
    if (!(per_px > 1e-100 && per_px < 1e100)) return width;
    return covered_by_adaptive_lines(place, per_px, look_.hatch_spacing_px, width);
}

glm::dvec3 FragmentShader::axis_in_view(std::size_t i, const glm::dvec3& axis) const {
    const glm::dmat4& to_object = surfaces_.to_object(triangle_of(i).id().instance);
    return {glm::dot(axis, glm::dvec3(to_object[0])), glm::dot(axis, glm::dvec3(to_object[1])),
            glm::dot(axis, glm::dvec3(to_object[2]))};
}

double FragmentShader::free_of_level(std::size_t i, std::size_t level, double width, glm::dvec2 pixel) const {
    if (look_.hatch_space == HatchSpace::screen) {
        const double place = glm::dot(pixel, hatch_directions_[level]) / look_.hatch_spacing_px;
        return 1 - covered_by_lines(place, 1 / look_.hatch_spacing_px, width);
    }
    if (look_.hatch_space == HatchSpace::uv) return 1 - covered_on_texture(i, hatch_directions_[level], width, pixel);
    // Where the planes of the level hardly cut the surface, others take over.
    const glm::dvec3& axis = hatch_axes_[level];
    const double cosine = std::min(std::abs(glm::dot(unit_or_zero(axis_in_view(i, axis)), place(i).normal)), 1.0);
    const double sine = std::sqrt(1 - cosine * cosine);
    const double u = std::clamp((sine - kLevelPlanes[0]) / (kLevelPlanes[1] - kLevelPlanes[0]), 0.0, 1.0);
    const double own = width * u * u * (3 - 2 * u);
    double free = 1;
    if (own > 0) free *= 1 - covered_on_object(i, axis, own);
    if (own < width) free *= 1 - covered_on_object(i, other_axes_[level], 1 - (1 - width) / (1 - own));
    return free;
}

glm::vec3 FragmentShader::hatch(std::size_t i, glm::dvec2 pixel) const {
    const auto tone = static_cast<double>(values_[i]);
    const HatchLevels levels{look_.hatch_levels};
    double free = 1;
    for (int level = 0; level < look_.hatch_levels; ++level) {
        const double width = levels.coverage(level, tone);
        if (!(width > 0)) break;
        free *= free_of_level(i, static_cast<std::size_t>(level), width, pixel);
    }
    const auto covered = static_cast<float>(1 - free);
    const glm::vec3 ink(values_[kBlock + i], values_[2 * kBlock + i], values_[3 * kBlock + i]);
    const glm::vec3 ground(values_[4 * kBlock + i], values_[5 * kBlock + i], values_[6 * kBlock + i]);
    return ground + (ink - ground) * covered;
}

}  // namespace burin
