#include "shading/ink/line_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/expression_kernels.h"
#include "mesh/vectors.h"
#include "shading/surface/shadow_casters.h"

namespace burin {
namespace {

using V = Variable;

/// The direction of (x, y) in degrees, equal on all machines.
float angle_deg(double y, double x) {
    const float given[2] = {static_cast<float>(y), static_cast<float>(x)};
    float angle = 0;
    const ExpressionBlock block{&angle, {{&given[0], 0}, {&given[1], 0}, {nullptr, 0}}, 1, nullptr, 0};
    best_expression_kernels().loops[static_cast<std::size_t>(ExpressionOperation::angle)](block);
    return angle;
}

/// Of a line on the screen, where y runs down.
float direction_deg(const LinePiece& piece) {
    const glm::dvec2 way = piece.to - piece.from;
    const float angle = angle_deg(-way.y, way.x);
    const float positive = angle < 0 ? angle + 180 : angle;
    return positive >= 180 ? positive - 180 : positive;
}

double end_distance_px(const LineRuns& runs, const LineRun& run, double at) {
    double least = std::numeric_limits<double>::infinity();
    if (run.is_closed) return least;
    if (run.ends[0] == RunEnd::free) least = std::min(least, at - runs.pieces[run.first].at_from_px);
    if (run.ends[1] == RunEnd::free) least = std::min(least, runs.pieces[run.first + run.count - 1].at_to_px - at);
    return std::max(least, 0.0);
}

}  // namespace

/// The columns that fill() writes: nullptr where one is not asked for.
struct LineColumns::Columns {
    VariableColumns& of;
    std::size_t count;

    float* place(Variable v, std::size_t component = 0) const { return const_cast<float*>(of.of(v, component)); }
    /// Computes a number for each sample.
    template <typename Compute>
    void each(Variable v, const Compute& compute) const {
        float* const to = place(v);
        if (to == nullptr) return;
        for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<float>(compute(i));
    }
    /// Computes a triple for each sample.
    template <typename Compute>
    void each_triple(Variable v, const Compute& compute) const {
        if (place(v, 0) == nullptr && place(v, 1) == nullptr && place(v, 2) == nullptr) return;
        for (std::size_t i = 0; i < count; ++i) {
            const auto triple = compute(i);
            for (int k = 0; k < 3; ++k) {
                if (float* const to = place(v, static_cast<std::size_t>(k))) to[i] = static_cast<float>(triple[k]);
            }
        }
    }
};

LineColumns::LineColumns(const FoundLines& lines, LineClassSet asked, const VariableSet& variables)
    : lines_(lines), runs_(lines.runs), asked_(asked) {
    if (!variables.has(V::s_world)) return;
    world_length_.resize(runs_.pieces.size());
    for (std::uint32_t r = 0; r < runs_.runs.size(); ++r) {
        const LineRun& run = runs_.runs[r];
        double length = 0;
        for (std::size_t i = run.first; i < run.first + run.count; ++i) {
            world_length_[i] = length;
            const auto piece = static_cast<std::uint32_t>(i);
            length += glm::distance(position_of({r, piece, 0}), position_of({r, piece, 1}));
        }
    }
}

glm::dvec3 LineColumns::position_of(const LineSample& sample) const {
    glm::dvec3 origin, direction;
    lines_.projection.view_ray(place_of(sample), origin, direction);
    return origin + direction * depth_at(sample);
}

double LineColumns::depth_at(const LineSample& sample) const {
    const LinePiece& p = runs_.pieces[sample.piece].piece;
    return lines_.projection.distance(
        glm::mix(static_cast<double>(p.nearness_from), static_cast<double>(p.nearness_to), sample.share));
}

std::uint32_t LineColumns::anchor_of(std::size_t piece) const {
    const LineSides& sides = lines_.sides[piece];
    const std::uint32_t front = sides.front_object, other = sides.other_object;
    if (sides.is_beyond || front == 0 || other == 0 || front == other) return front;
    const auto key = [this](std::uint32_t object) {
        const ObjectOfLines& o = lines_.objects[object - 1];
        return LineHash(0).add(std::string_view(o.name)).add(std::uint64_t{o.same_name_before}).bits();
    };
    return key(other) < key(front) ? other : front;
}

LineHash LineColumns::object_hash(std::size_t piece, const SampleVariant& variant) const {
    LineHash hash(variant.seed);
    if (const std::uint32_t object = anchor_of(piece); object > 0) {
        const ObjectOfLines& o = lines_.objects[object - 1];
        hash.add(std::string_view(o.name)).add(std::uint64_t{o.same_name_before});
    }
    return hash.add(std::uint64_t{variant.copy});
}

LineHash LineColumns::chain_hash(const LineRun& run, const SampleVariant& variant) const {
    LineHash hash = object_hash(run.first, variant);
    return run.chain_place == 0 ? hash.add(name_of(runs_.pieces[run.first].piece.drawn_as)) : hash.add(run.chain_place);
}

LineColumns::InObject LineColumns::in_object(const LineSample& sample) const {
    const glm::dvec3 view = position_of(sample);
    const double px_size = lines_.projection.pixel_size(depth_at(sample));
    const std::uint32_t object = anchor_of(sample.piece);
    if (object == 0) return {view, px_size};
    const ObjectOfLines& o = lines_.objects[object - 1];
    return {glm::dvec3(o.from_view * glm::dvec4(view, 1.0)), px_size * o.units_per_view};
}

/// The depth of what is seen behind a line, beside it, less that of the line.
float LineColumns::gap_at(const LineSample& sample) const {
    const LineSides& sides = sides_of(sample.piece);
    if (!sides.is_beyond) return 0;
    if (sides.other_object == 0) return std::numeric_limits<float>::infinity();
    const double behind = lines_.projection.distance(sides.beyond_plane.nearness(place_of(sample)));
    return static_cast<float>(std::max(behind - depth_at(sample), 0.0));
}

void LineColumns::fill(std::span<const LineSample> samples, const VariableSet& variables, const SampleVariant& variant,
                       SampleColumns& columns, std::span<const std::string> attributes) const {
    const std::size_t n = samples.size();
    columns.columns_ = {};
    std::size_t count = 0;
    for (std::size_t v = 0; v < kVariableCount; ++v) {
        for (std::size_t k = 0; k < 3; ++k) count += variables.has(static_cast<V>(v), k) ? 1 : 0;
    }
    columns.numbers_.resize((count + attributes.size()) * n);
    float* next = columns.numbers_.data();
    columns.attributes_.clear();
    for (const std::string& name : attributes) {
        const std::optional<std::size_t> column = lines_.surface.column_of_attribute(name);
        columns.attributes_.push_back(next);
        for (const LineSample& sample : samples) *next++ = column ? surface_value(sample, *column) : 0.0f;
    }
    for (std::size_t v = 0; v < kVariableCount; ++v) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (!variables.has(static_cast<V>(v), k)) continue;
            columns.columns_.of(static_cast<V>(v), k) = next;
            next += n;
        }
    }
    Columns out{columns.columns_, n};
    const Projection& projection = lines_.projection;
    const auto piece = [&](std::size_t i) -> const LinePiece& { return runs_.pieces[samples[i].piece].piece; };
    const auto run = [&](std::size_t i) -> const LineRun& { return runs_.runs[samples[i].run]; };

    out.each(V::x, [&](std::size_t i) { return place_of(samples[i]).x; });
    out.each(V::y, [&](std::size_t i) { return place_of(samples[i]).y; });
    out.each(V::depth, [&](std::size_t i) { return depth_at(samples[i]); });
    out.each(V::distance, [&](std::size_t i) {
        const double depth = depth_at(samples[i]);
        if (projection.orthographic) return depth;
        const glm::dvec2 at = (place_of(samples[i]) - projection.center_px) / projection.focal_xy_px();
        return depth * std::sqrt(1 + glm::dot(at, at));
    });
    out.each(V::px_size, [&](std::size_t i) { return projection.pixel_size(depth_at(samples[i])); });
    out.each_triple(V::P, [&](std::size_t i) {
        return glm::dvec3(lines_.camera_to_world * glm::dvec4(position_of(samples[i]), 1.0));
    });
    out.each_triple(V::PO, [&](std::size_t i) { return in_object(samples[i]).position; });

    // Classes are numbered as LineClass counts, from 0.
    const auto drawn_as = [&](std::size_t i) {
        return (piece(i).classes & asked_).first().value_or(piece(i).drawn_as);
    };
    out.each(V::drawn_class, [&](std::size_t i) { return static_cast<int>(drawn_as(i)); });
    for (int c = 0; c < kLineClassCount; ++c) {
        const auto line_class = static_cast<LineClass>(c);
        out.each(is_class(line_class), [&](std::size_t i) { return piece(i).classes.has(line_class) ? 1 : 0; });
    }
    out.each(V::qi, [&](std::size_t i) { return piece(i).invisibility; });
    out.each(V::transmission, [&](std::size_t i) { return static_cast<double>(piece(i).transmission) / 255; });
    out.each(V::direction, [&](std::size_t i) { return direction_deg(piece(i)); });
    out.each(V::rand_object, [&](std::size_t i) { return object_hash(samples[i].piece, variant).unit(); });
    out.each(V::rand_chain, [&](std::size_t i) { return chain_hash(run(i), variant).unit(); });
    out.each(V::rand_set, [&](std::size_t) {
        return LineHash(variant.seed).add(variant.set).add(std::uint64_t{variant.copy}).unit();
    });
    out.each(V::copy, [&](std::size_t) { return variant.copy; });
    out.each(V::frame, [&](std::size_t) { return lines_.frame; });
    out.each(V::time, [&](std::size_t) { return lines_.frame / lines_.fps; });
    out.each(V::width_px, [&](std::size_t) { return lines_.width_px; });
    out.each(V::height_px, [&](std::size_t) { return lines_.height_px; });
    fill_sides(samples, out);
    fill_surface(samples, out);
    fill_chains(samples, variables, out);
}

float LineColumns::surface_value(const LineSample& sample, std::size_t column) const {
    const std::size_t columns = lines_.surface.column_count();
    const float* const begin = &lines_.surface_values[2 * columns * sample.piece + column];
    const double a = begin[0], b = begin[columns];
    double share = sample.share;
    if (!lines_.projection.orthographic) {
        // What changes linearly in space does so on the screen when it is multiplied by the nearness.
        const LinePiece& p = runs_.pieces[sample.piece].piece;
        const double from = (1 - share) * static_cast<double>(p.nearness_from);
        const double to = share * static_cast<double>(p.nearness_to);
        if (from + to > 0) share = to / (from + to);
    }
    return static_cast<float>(a + share * (b - a));
}

void LineColumns::fill_surface(std::span<const LineSample> samples, Columns& out) const {
    for (const V variable : {V::kr, V::u, V::v, V::Cv}) {
        for (std::size_t k = 0; k < component_count(row_of(variable).type); ++k) {
            const std::optional<std::size_t> column = lines_.surface.column_of(variable, k);
            float* const to = out.place(variable, k);
            for (std::size_t i = 0; to != nullptr && i < samples.size(); ++i)
                to[i] = column ? surface_value(samples[i], *column) : 0.0f;
        }
    }
}

void LineColumns::fill_sides(std::span<const LineSample> samples, Columns& out) const {
    const Projection& projection = lines_.projection;
    const auto sides = [&](std::size_t i) -> const LineSides& { return sides_of(samples[i].piece); };
    out.each(V::object, [&](std::size_t i) { return sides(i).front_object; });
    out.each(V::material, [&](std::size_t i) { return sides(i).front_material; });
    out.each(V::object2, [&](std::size_t i) { return sides(i).other_object; });
    out.each(V::material2, [&](std::size_t i) { return sides(i).other_material; });
    out.each(V::dihedral, [&](std::size_t i) { return sides(i).dihedral_deg; });
    out.each(V::convex, [&](std::size_t i) { return sides(i).convex; });
    const auto color = [&](std::uint32_t material) {
        return material == 0 ? glm::vec3(0.0f) : lines_.material_colors[material - 1];
    };
    out.each_triple(V::C, [&](std::size_t i) { return color(sides(i).front_material); });
    out.each_triple(V::C2, [&](std::size_t i) { return color(sides(i).other_material); });
    out.each(V::gap, [&](std::size_t i) { return gap_at(samples[i]); });
    out.each(V::gap_px, [&](std::size_t i) {
        return static_cast<double>(gap_at(samples[i])) / projection.pixel_size(depth_at(samples[i]));
    });
    const auto slope = [&](std::size_t i, bool down) {
        const DepthPlane& plane = sides(i).front_plane;
        const double depth = depth_at(samples[i]), change = down ? plane.per_y : plane.per_x;
        return projection.orthographic ? -change : -change * depth * depth;
    };
    out.each(V::depth_x, [&](std::size_t i) { return slope(i, false); });
    out.each(V::depth_y, [&](std::size_t i) { return slope(i, true); });

    const auto normal = [&](std::size_t i, bool is_front) {
        const auto& ends = is_front ? sides(i).front_normals : sides(i).other_normals;
        const glm::dvec3 mean = glm::mix(glm::dvec3(ends[0]), glm::dvec3(ends[1]), samples[i].share);
        return glm::dot(mean, mean) > 0 ? unit(mean) : glm::dvec3(0.0);
    };
    const auto to_eye = [&](std::size_t i) {
        glm::dvec3 origin, direction;
        projection.view_ray(place_of(samples[i]), origin, direction);
        return -unit(direction);
    };
    const auto facing = [&](bool is_front) {
        return [&, is_front](std::size_t i) { return std::clamp(glm::dot(normal(i, is_front), to_eye(i)), 0.0, 1.0); };
    };
    const auto to_light = [&](std::size_t i) {
        if (lines_.light) return unit(*lines_.light);
        return lines_.scene_light ? lines_.scene_light->towards(position_of(samples[i])) : to_eye(i);
    };
    const auto light = [&](bool is_front) {
        return
            [&, is_front](std::size_t i) { return std::clamp(glm::dot(normal(i, is_front), to_light(i)), 0.0, 1.0); };
    };
    out.each(V::facing, facing(true));
    out.each(V::facing2, facing(false));
    // A pixel in front of its surfaces: places of lines are not exact, and must not lie behind these.
    out.each(V::lit, [&](std::size_t i) {
        if (glm::dot(normal(i, true), to_light(i)) <= 0) return 0;
        const LineSides& s = sides(i);
        const glm::dvec3 other = s.is_beyond ? glm::dvec3(0.0) : normal(i, false);
        const double px_size = projection.pixel_size(depth_at(samples[i]));
        const glm::dvec3 place = position_of(samples[i]) + unit(normal(i, true) + other) * px_size;
        return lines_.casters == nullptr || lines_.casters->is_lit(place, kBackground) ? 1 : 0;
    });
    out.each(V::light, light(true));
    out.each(V::light2, light(false));
    out.each_triple(V::N, [&](std::size_t i) { return glm::dmat3(lines_.camera_to_world) * normal(i, true); });
    out.each_triple(V::N2, [&](std::size_t i) { return glm::dmat3(lines_.camera_to_world) * normal(i, false); });
}

void LineColumns::fill_chains(std::span<const LineSample> samples, const VariableSet& variables, Columns& out) const {
    const auto run = [&](std::size_t i) -> const LineRun& { return runs_.runs[samples[i].run]; };
    // Beyond the beginning of a loop, places count from there again.
    const auto s = [&](std::size_t i) {
        const double at = at_of(samples[i]), length = run(i).chain_length_px;
        const RunPiece& own = runs_.pieces[samples[i].piece];
        const bool is_beyond = run(i).chain_is_closed && 0.5 * (own.at_from_px + own.at_to_px) > length;
        return std::clamp(is_beyond ? at - length : at, 0.0, length);
    };
    out.each(V::s, s);
    out.each(V::length, [&](std::size_t i) { return run(i).chain_length_px; });
    out.each(V::t, [&](std::size_t i) { return run(i).chain_length_px > 0 ? s(i) / run(i).chain_length_px : 0.0; });
    out.each(V::run_s, [&](std::size_t i) { return at_of(samples[i]) - runs_.pieces[run(i).first].at_from_px; });
    out.each(V::run_length, [&](std::size_t i) { return runs_.length_px(run(i)); });
    out.each(V::end_distance, [&](std::size_t i) { return end_distance_px(runs_, run(i), at_of(samples[i])); });
    out.each(V::closed, [&](std::size_t i) { return run(i).chain_is_closed ? 1 : 0; });
    if (!variables.has(V::s_world)) return;
    out.each(V::s_world, [&](std::size_t i) {
        const LineSample& sample = samples[i];
        const LineSample start{sample.run, static_cast<std::uint32_t>(run(i).first), 0};
        const double before = at_of(start) * lines_.projection.pixel_size(depth_at(start));
        return before + world_length_[sample.piece] +
               glm::distance(position_of({sample.run, sample.piece, 0}), position_of(sample));
    });
}

}  // namespace burin
