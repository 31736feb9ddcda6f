#include "output/deep_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/murmur_hash.h"
#include "image/half.h"
#include "render/film.h"
#include "render/matte_names.h"
#include "render/seen_parts.h"

namespace burin {
namespace {

/// Of alphas: less than this is nothing.
constexpr double kNothing = 1e-6;

/// LayeredSum makes alphas and colours of layers that lie over each other, nearest first, so that they add up to given
/// shares.
class LayeredSum {
  public:
    /// With it the next layer has its share, by what is really left. Mattes of lines are as exact as half precision is.
    double alpha_of_line(double share) {
        wanted_left_ -= share;
        return wanted_left_ < kNothing ? 1.0 : std::clamp(share / left_, 0.0, 1.0);
    }
    /// With it all layers up to the next one have their shares: what rounding took or added is made up for.
    double alpha_of_surface(double share) {
        wanted_left_ -= share;
        return wanted_left_ < kNothing ? 1.0 : std::clamp(1.0 - wanted_left_ / left_, 0.0, 1.0);
    }
    glm::dvec3 color_for(const glm::dvec3& color) {
        wanted_color_ += color;
        return glm::max((wanted_color_ - color_) / left_, 0.0);
    }
    /// As they were rounded.
    void add(double alpha, const glm::dvec3& color) {
        color_ += color * left_;
        left_ *= 1.0 - alpha;
    }
    /// For the last layer: with it the sum is `whole`, colour and alpha.
    double last_alpha(const glm::dvec4& whole) const { return std::clamp(1.0 - (1.0 - whole.a) / left_, 0.0, 1.0); }
    glm::dvec3 last_color(const glm::dvec4& whole) const { return glm::max((glm::dvec3(whole) - color_) / left_, 0.0); }
    bool has_any_left() const { return left_ > kNothing; }
    /// Of all layers over each other, as they were rounded.
    const glm::dvec3& color() const { return color_; }
    double left() const { return left_; }

  private:
    double left_ = 1, wanted_left_ = 1;
    glm::dvec3 color_{0.0}, wanted_color_{0.0};
};

/// ClassShares has the lines of each class, however many owners they have, add up to the coverage on the film.
class ClassShares {
  public:
    void expect(LineClass c, double share) {
        OfClass& own = of(c);
        own.wanted += share;
        ++own.count;
    }
    /// Of the next line; `share`: its own.
    double next(LineClass c, double share) {
        OfClass& own = of(c);
        if (--own.count > 0) return share;
        return std::max(on_film(own) - own.sum, 0.0);
    }
    /// As it was rounded.
    void add(LineClass c, double share) { of(c).sum += share; }
    /// How far the sum of a class is from what the film has, at most.
    double largest_error() const {
        double largest = 0;
        for (const OfClass& own : classes_) largest = std::max(largest, std::abs(on_film(own) - own.sum));
        return largest;
    }

  private:
    struct OfClass {
        double wanted = 0, sum = 0;
        int count = 0;
    };
    static double on_film(const OfClass& own) {
        return static_cast<double>(float_from_half(Film::to_half(static_cast<float>(own.wanted))));
    }
    OfClass& of(LineClass c) { return classes_[static_cast<std::size_t>(c)]; }

    std::array<OfClass, kLineClassCount> classes_;
};

/// As the film has it.
template <typename Vector>
Vector as_on_film(const Vector& color) {
    Vector on_film;
    for (int c = 0; c < Vector::length(); ++c)
        on_film[c] = static_cast<double>(float_from_half(Film::to_half(static_cast<float>(color[c]))));
    return on_film;
}

double nearest_of(const SurfaceSet& surfaces) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < surfaces.instances.size(); ++i) {
        const std::size_t count = surfaces.instances[i].mesh->positions.size();
        for (std::uint32_t v = 0; v < count; ++v) nearest = std::min(nearest, -surfaces.view_position(i, v).z);
    }
    return std::isfinite(nearest) ? nearest : 0.0;
}

}  // namespace

void DeepSampler::Names::add(std::string_view name) {
    names.push_back(matte_name(name));
    ids.push_back(murmur_hash(names.back()));
}

DeepSampler::DeepSampler(const Frame& frame)
    : is_float_(frame.scene->deep.is_float), is_orthographic_(frame.surfaces.projection.orthographic) {
    if (is_orthographic_) nearest_ = nearest_of(frame.surfaces);
    for (const std::string_view name : kLineClassNames) classes_.add(name);
    for (const Material& material : frame.scene->materials) materials_.add(material.name);
    for (const SceneObject& object : frame.scene->objects) objects_.add(object.name);
}

std::vector<NamedIds> DeepSampler::names() const {
    const auto group = [](const char* channel, const char* component, const Names& known) {
        NamedIds ids{channel, component, {}};
        for (std::size_t i = 0; i < known.ids.size(); ++i) ids.names.emplace(known.ids[i], known.names[i]);
        return ids;
    };
    return {group("lineid", "line class", classes_), group("materialid", "material", materials_),
            group("objectid", "object", objects_)};
}

float DeepSampler::z_of(float distance) const {
    const float z = is_orthographic_ ? static_cast<float>(static_cast<double>(distance) - nearest_ + 1.0) : distance;
    return std::clamp(z, std::numeric_limits<float>::min(), std::numeric_limits<float>::max());
}

double DeepSampler::rounded(double value) const {
    const auto number = static_cast<float>(value);
    return static_cast<double>(is_float_ ? number : float_from_half(Film::to_half(number)));
}

glm::dvec3 DeepSampler::rounded(const glm::dvec3& color) const {
    return {rounded(color.r), rounded(color.g), rounded(color.b)};
}

void DeepSampler::find_parts(const Mattes::DeepPixel& pixel) {
    parts_.clear();
    has_line_behind_ = false;
    const LeftByLines left(pixel);
    left_ = left.all;
    double covered = 0;
    constexpr float kFar = std::numeric_limits<float>::infinity();
    float nearest = kFar, nearest_opaque = kFar;
    glm::dvec3 color(0.0);
    for (const DeepSurface& surface : pixel.surfaces) {
        Part& part = parts_.emplace_back(
            Part{&surface, nullptr, surface.distance, static_cast<double>(surface.share), glm::dvec3(surface.color)});
        part.alone = part.share;
        part.color_alone = part.color;
        if (pixel.is_mean) {
            part.alone = static_cast<double>(surface.alone);
            if (part.share > 0) {
                part.color_alone *= part.alone / part.share;
            } else {
                part.color = glm::dvec3(0.0);
            }
        }
        covered += part.share;
        color += parts_.back().color;
        nearest = std::min(nearest, surface.distance);
        if (surface.is_opaque) nearest_opaque = std::min(nearest_opaque, surface.distance);
    }
    for (const DeepLine& line : pixel.lines) {
        if (line.line.is_hidden) continue;
        // Lines are drawn over all surfaces of a pixel, be it one that the line is no line of.
        const float distance = std::min(line.distance, line.is_behind ? nearest_opaque : nearest);
        has_line_behind_ = has_line_behind_ || distance > nearest;
        const double share = left.seen_of(line);
        parts_.push_back({nullptr, &line, distance, share, color_over(line, color, covered) * share});
    }
    const auto is_before = [](const Part& a, const Part& b) {
        if (a.distance != b.distance) return a.distance < b.distance;
        return a.line != nullptr && b.line == nullptr;
    };
    for (std::size_t i = 1; i < parts_.size(); ++i) {  // a few; equal ones keep their order
        for (std::size_t k = i; k > 0 && is_before(parts_[k], parts_[k - 1]); --k) std::swap(parts_[k], parts_[k - 1]);
    }
}

DeepSample& DeepSampler::add_sample(const Part& part, double alpha, const glm::dvec3& color) {
    DeepSample& sample = samples_.emplace_back();
    sample.z = z_of(part.distance);
    if (samples_.size() > 1)
        sample.z =
            std::max(sample.z, std::nextafter(samples_[samples_.size() - 2].z, std::numeric_limits<float>::max()));
    sample.alpha = static_cast<float>(rounded(alpha));
    sample.color = glm::vec3(rounded(color));
    const MatteOwner& owner = part.line != nullptr ? part.line->line.owner : part.surface->owner;
    sample.object = objects_.id_of(owner.object);
    sample.material = materials_.id_of(owner.material);
    if (part.line == nullptr) return sample;
    sample.line = classes_.ids[static_cast<std::size_t>(part.line->line.drawn_as)];
    sample.invisibility = part.line->invisibility;
    return sample;
}

/// Gives what the layers are over each other, colour and alpha.
glm::dvec4 DeepSampler::find_surface_layers() {
    surface_layers_.clear();
    LayeredSum sum;
    glm::dvec3 color(0.0);
    std::size_t count = 0;
    for (const Part& part : parts_) {
        if (part.line != nullptr) continue;
        color += part.color;
        ++count;
    }
    glm::dvec3 rest = as_on_film(color);
    for (const Part& part : parts_) {
        if (part.line != nullptr || !sum.has_any_left()) continue;
        const glm::dvec3 own_color = --count == 0 ? rest : part.color;
        rest -= part.color;
        const Layer& layer = surface_layers_.emplace_back(
            Layer{&part, rounded(sum.alpha_of_surface(part.share)), rounded(sum.color_for(own_color))});
        sum.add(layer.alpha, layer.color);
    }
    return {sum.color(), 1.0 - sum.left()};
}

double DeepSampler::find_line_layers(const glm::dvec4& surfaces, const glm::dvec4& whole, const More& more) {
    line_layers_.clear();
    LayeredSum sum;
    ClassShares classes;
    std::size_t lines_left = 0;
    for (const Part& part : parts_) {
        if (part.line == nullptr) continue;
        classes.expect(part.line->line.drawn_as, part.share);
        ++lines_left;
    }
    std::size_t largest = 0;
    double left_of_largest = 1;
    for (const Part& part : parts_) {
        if (part.line == nullptr || !sum.has_any_left()) continue;
        const LineClass c = part.line->line.drawn_as;
        const double left = sum.left();
        double share = classes.next(c, part.share);
        if (line_layers_.empty()) share += more.of_nearest;
        if (--lines_left == 0) share += more.of_farthest * left;
        share = std::max(share, 0.0);
        const Layer& layer = line_layers_.emplace_back(
            Layer{&part, rounded(sum.alpha_of_line(share)), rounded(glm::max(part.color / left, 0.0))});
        classes.add(c, layer.alpha * left);
        sum.add(layer.alpha, layer.color);
        if (part.share <= line_layers_[largest].part->share) continue;
        largest = line_layers_.size() - 1;
        left_of_largest = left;
    }
    double off = std::abs(1.0 - sum.left() * (1.0 - surfaces.a) - whole.a);
    // What rounding took or added is made up for by the line that has most.
    glm::dvec3& color = line_layers_[largest].color;
    const glm::dvec3 others = sum.color() - color * left_of_largest + glm::dvec3(surfaces) * sum.left();
    const glm::dvec3 wanted = glm::dvec3(whole) - others;
    color = rounded(glm::max(wanted / left_of_largest, 0.0));
    for (int c = 0; c < 3; ++c) off = std::max(off, std::abs(wanted[c] - color[c] * left_of_largest));
    return std::max(classes.largest_error(), off / 2);
}

void DeepSampler::find_line_layers(const glm::dvec4& surfaces) {
    // An alpha above 1/2 is off by up to 2.4e-4, and so is the film. Where both are, a little more or less of the line
    // in front of it helps, or a step of its own.
    constexpr double kBearable = 2e-4, kStep = 4.9e-4;
    const glm::dvec4 whole = beauty();
    More best;
    double least = find_line_layers(surfaces, whole, best);
    if (least <= kBearable) return;
    for (const double of_farthest : {0.0, kStep, -kStep}) {
        for (const double of_nearest : {0.0, 6e-5, -6e-5, 1.2e-4, -1.2e-4, 2.4e-4, -2.4e-4}) {
            const More more{of_nearest, of_farthest};
            const double error = find_line_layers(surfaces, whole, more);
            if (error >= least) continue;
            least = error;
            best = more;
        }
    }
    find_line_layers(surfaces, whole, best);
}

/// Where all lines are in front: surfaces have the samples that they would have without these.
void DeepSampler::lay_lines_first() {
    const glm::dvec4 surfaces = find_surface_layers();
    line_layers_.clear();
    const auto is_line = [](const Part& part) { return part.line != nullptr; };
    if (std::any_of(parts_.begin(), parts_.end(), is_line)) find_line_layers(surfaces);
    for (const Layer& layer : line_layers_) add_sample(*layer.part, layer.alpha, layer.color);
    for (const Layer& layer : surface_layers_) add_sample(*layer.part, layer.alpha, layer.color);
}

/// The beauty on the film, which is rounded with each kind of ink that is laid over it.
glm::dvec4 DeepSampler::beauty() const {
    glm::dvec4 surfaces(0.0), below(0.0), above(0.0);
    for (const Part& part : parts_) {
        glm::dvec4& kind = part.surface != nullptr ? surfaces : part.line->line.is_below ? below : above;
        kind += glm::dvec4(part.color, part.share);
    }
    if (is_mean_) return as_on_film(surfaces + below + above);
    const double left = 1.0 - above.a;
    glm::dvec4 film = as_on_film(surfaces);
    if (below.a > 0 && left > kNothing) film = as_on_film(film * (1.0 - below.a / left) + below / left);
    return as_on_film(film * left + above);
}

/// Where lines are seen through glass: all takes what it has of the beauty, one after the other.
void DeepSampler::lay_in_turns() {
    LayeredSum all;
    ClassShares classes;
    for (const Part& part : parts_) {
        if (part.line != nullptr) classes.expect(part.line->line.drawn_as, part.share);
    }
    // What the film has by rounding alone is the first surface's.
    const glm::dvec4 whole = beauty();
    glm::dvec4 rounding = whole;
    for (const Part& part : parts_)
        rounding -= glm::dvec4(part.color, part.share) * (part.surface != nullptr ? left_ : 1.0);
    const auto is_seen = [](const Part& part) { return part.line != nullptr || part.share > 0; };
    const auto last = std::find_if(parts_.rbegin(), parts_.rend(), is_seen);
    const Part* const last_seen = last != parts_.rend() ? &*last : nullptr;
    double in_front = 0;  // of surfaces
    for (const Part& part : parts_) {
        if (!is_seen(part) && all.has_any_left()) continue;
        double share = part.share * (part.surface != nullptr ? left_ : 1.0);
        glm::dvec3 color = part.color * (part.surface != nullptr ? left_ : 1.0);
        if (part.surface != nullptr) {
            share += rounding.a;
            color += glm::dvec3(rounding);
            rounding = glm::dvec4(0.0);
        }
        double alpha = part.line != nullptr ? all.alpha_of_line(classes.next(part.line->line.drawn_as, share))
                                            : all.alpha_of_surface(share);
        glm::dvec3 own_color;
        if (all.has_any_left()) {
            own_color = all.color_for(color);
            if (&part == last_seen && part.surface != nullptr) {
                alpha = all.last_alpha(whole);
                own_color = all.last_color(whole);
            }
        } else if (part.surface != nullptr) {  // lines leave nothing of it: as it would be without them
            alpha = std::min(part.alone / std::max(1.0 - in_front, part.alone), 1.0);
            own_color = part.color_alone * (alpha / part.alone);
        } else {
            continue;
        }
        if (part.surface != nullptr) in_front += part.alone;
        const DeepSample& sample = add_sample(part, alpha, own_color);
        if (part.line != nullptr) classes.add(part.line->line.drawn_as, static_cast<double>(sample.alpha) * all.left());
        all.add(static_cast<double>(sample.alpha), glm::dvec3(sample.color));
    }
}

/// Lines behind opaque surfaces that cover the whole pixel.
void DeepSampler::add_hidden(const Mattes::DeepPixel& pixel) {
    hidden_.clear();
    for (const DeepLine& line : pixel.lines) {
        if (!line.line.is_hidden) continue;
        double covered = 0;
        for (const DeepSurface& surface : pixel.surfaces)
            covered += surface.distance < line.distance ? static_cast<double>(surface.share) : 0.0;
        if (pixel.is_mean) {  // surfaces have what lines leave of them
            for (const Part& part : parts_) covered += part.line != nullptr ? part.share : 0.0;
        }
        if (covered > 1.0 - kNothing) hidden_.push_back(&line);
    }
    std::stable_sort(hidden_.begin(), hidden_.end(),
                     [](const DeepLine* a, const DeepLine* b) { return a->distance < b->distance; });
    LayeredSum sum;
    for (const DeepLine* const line : hidden_) {
        if (!sum.has_any_left()) continue;
        const double share = static_cast<double>(line->line.share);
        const double alpha = sum.alpha_of_line(share);
        const Part part{nullptr, line, line->distance, share, {}};
        const DeepSample& sample = add_sample(part, alpha, sum.color_for(color_over(*line, {}, 0.0) * share));
        sum.add(static_cast<double>(sample.alpha), glm::dvec3(sample.color));
    }
}

std::span<const DeepSample> DeepSampler::samples_of(const Mattes::DeepPixel& pixel) {
    samples_.clear();
    if (pixel.lines.empty() && pixel.surfaces.size() == 1) {  // mostly
        const DeepSurface& only = pixel.surfaces.front();
        add_sample({&only, nullptr, only.distance, 0, {}}, static_cast<double>(only.share),
                   as_on_film(glm::dvec3(only.color)));
        return samples_;
    }
    is_mean_ = pixel.is_mean;
    find_parts(pixel);
    if (has_line_behind_ || pixel.is_mean) {
        lay_in_turns();
    } else {
        lay_lines_first();
    }
    add_hidden(pixel);
    return samples_;
}

}  // namespace burin
