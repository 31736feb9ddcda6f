#include "mesh/gltf_animation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "base/interrupt.h"

namespace burin {
namespace {

std::string name_of_animation(const JsonPlace& animation) { return animation.text_or("name", ""); }

/// "Walk", "Idle" and 2 more without names.
std::string names_of_animations(const JsonPlace& root) {
    std::string names;
    std::size_t unnamed = 0;
    for (std::size_t i = 0; i < root.size_of("animations"); ++i) {
        const std::string name = name_of_animation(root.at("animations").element(i));
        if (name.empty()) {
            ++unnamed;
        } else {
            names += (names.empty() ? "\"" : ", \"") + printable(name) + "\"";
        }
    }
    if (names.empty()) return std::to_string(unnamed) + " without names, whose numbers begin with 0";
    return names + (unnamed > 0 ? ", and " + std::to_string(unnamed) + " without names" : "");
}

/// How many numbers a value has: of `weights`, as many as the node's mesh has morph targets.
std::size_t width_of(GltfPath path, std::size_t targets) {
    switch (path) {
        case GltfPath::rotation:
            return 4;
        case GltfPath::weights:
            return targets;
        default:
            return 3;
    }
}

GltfPath read_path(const JsonPlace& place) {
    const std::string path = place.text();
    if (path == "translation") return GltfPath::translation;
    if (path == "rotation") return GltfPath::rotation;
    if (path == "scale") return GltfPath::scale;
    if (path == "weights") return GltfPath::weights;
    place.fail("must be translation, rotation, scale or weights");
}

/// How many morph targets the mesh of a node has.
std::size_t targets_of(const JsonPlace& root, const JsonPlace& target, std::uint32_t node) {
    const JsonPlace place = root.at("nodes").element(node);
    if (!place.has("mesh")) target.fail("node " + std::to_string(node) + " has no mesh whose weights could move");
    const std::uint32_t number = place.at("mesh").index_below(root.size_of("meshes"), "mesh");
    const JsonPlace primitives = root.at("meshes").element(number).at("primitives");
    const std::size_t targets = primitives.size() == 0 ? 0 : primitives.element(0).size_of("targets");
    if (targets == 0) target.fail("the mesh of node " + std::to_string(node) + " has no morph targets");
    return targets;
}

/// A sampler of an animation, as the file has it.
struct SamplerPlan {
    JsonPlace place;
    GltfPath path;
    std::size_t width;
    GltfInterpolation interpolation = GltfInterpolation::linear;
    const char* type;  // of values
    std::uint64_t size_bytes = 0;

    SamplerPlan(const JsonPlace& sampler, GltfPath moved, std::size_t numbers, GltfBuffers& buffers)
        : place(sampler),
          path(moved),
          width(numbers),
          type(moved == GltfPath::weights ? "SCALAR" : (moved == GltfPath::rotation ? "VEC4" : "VEC3")) {
        const std::string word = place.text_or("interpolation", "LINEAR");
        if (word == "STEP") {
            interpolation = GltfInterpolation::step;
        } else if (word == "CUBICSPLINE") {
            interpolation = GltfInterpolation::cubic_spline;
        } else if (word != "LINEAR") {
            place.at("interpolation").fail("must be STEP, LINEAR or CUBICSPLINE");
        }
        const GltfAccessor times = plan_times(place, buffers);
        const GltfAccessor values = buffers.without_sparse(place.at("output"), type);
        if (values.component_type == kGltfUnsignedInt) place.at("output").fail("must be floats or normalized integers");
        const std::uint64_t per_key = (interpolation == GltfInterpolation::cubic_spline ? 3 : 1) *
                                      (path == GltfPath::weights ? std::uint64_t{width} : 1);
        if (values.count != saturating_product(times.count, per_key)) {
            place.at("output").fail("has " + std::to_string(values.count) + " elements; " +
                                    std::to_string(times.count) + (times.count == 1 ? " key needs " : " keys need ") +
                                    std::to_string(saturating_product(times.count, per_key)));
        }
        size_bytes = sizeof(double) * (times.count + values.count * static_cast<std::uint64_t>(values.components));
    }

    /// The times, as if they were not sparse.
    static GltfAccessor plan_times(const JsonPlace& place, GltfBuffers& buffers) {
        const JsonPlace input = place.at("input");
        const GltfAccessor times = buffers.without_sparse(input, "SCALAR");
        if (times.component_type != kGltfFloat) input.fail("times must be floats");
        if (times.count == 0) input.fail("an animation needs a key");
        return times;
    }

    GltfSampler read(GltfBuffers& buffers) const {
        const GltfAccessor times = buffers.accessor(place.at("input"), "SCALAR");
        GltfAccessor values = buffers.accessor(place.at("output"), type);
        values.normalized = values.component_type != kGltfFloat;
        GltfSampler sampler;
        sampler.interpolation = interpolation;
        sampler.width = width;
        sampler.times_s.reserve(times.count);
        for (std::uint64_t i = 0; i < times.count; ++i) {
            const double time = times.number(i, 0);
            if (!(std::abs(time) <= kLargestCoordinate))
                place.at("input").fail("the time of key " + std::to_string(i) + " is not finite or beyond 1e30");
            if (i > 0 && !(time > sampler.times_s.back())) {
                place.at("input").fail("the time of key " + std::to_string(i) +
                                       " is not after that of the one before; times must ascend");
            }
            sampler.times_s.push_back(time);
        }
        sampler.values.reserve(values.count * static_cast<std::uint64_t>(values.components));
        for (std::uint64_t i = 0; i < values.count; ++i) {
            if ((i & 0xFFFF) == 0) throw_if_interrupted();
            for (int c = 0; c < values.components; ++c) {
                sampler.values.push_back(values.number(i, c));
                if (!(std::abs(sampler.values.back()) <= kLargestCoordinate))
                    place.at("output").fail("element " + std::to_string(i) + " is not finite or beyond 1e30");
            }
        }
        if (path == GltfPath::rotation) check_rotations(sampler);
        return sampler;
    }

    void check_rotations(const GltfSampler& sampler) const {
        const bool is_spline = interpolation == GltfInterpolation::cubic_spline;
        for (std::size_t i = 0; i < sampler.times_s.size(); ++i) {
            const double* const q = &sampler.values[4 * (is_spline ? 3 * i + 1 : i)];
            if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0)
                place.at("output").fail("the rotation of key " + std::to_string(i) + " is 0");
        }
    }
};

struct ChannelPlan {
    std::uint32_t node = 0;
    SamplerPlan sampler;
};

std::string counted_channels(std::size_t count) {
    return count == 1 ? "1 channel" : std::to_string(count) + " channels";
}

}  // namespace

std::optional<std::uint32_t> chosen_gltf_animation(const std::string& path, const JsonPlace& root,
                                                   const AnimationChoice& choice) {
    const std::size_t count = root.size_of("animations");
    switch (choice.by) {
        case AnimationChoice::By::none:
            return std::nullopt;
        case AnimationChoice::By::order:
            return count > 0 ? std::optional<std::uint32_t>(0) : std::nullopt;
        case AnimationChoice::By::number:
            if (choice.number < count) return choice.number;
            break;
        case AnimationChoice::By::name:
            for (std::uint32_t i = 0; i < count; ++i) {
                if (name_of_animation(root.at("animations").element(i)) == choice.name) return i;
            }
            break;
    }
    const std::string wanted =
        choice.by == AnimationChoice::By::number ? std::to_string(choice.number) : "\"" + printable(choice.name) + "\"";
    throw InputError(path + ": no animation " + wanted + "; it has " +
                     (count == 0 ? "none" : names_of_animations(root)));
}

GltfAnimation read_gltf_animation(const JsonPlace& root, std::uint32_t number, const GltfNodes& nodes,
                                  GltfBuffers& buffers, ModelBudget& budget) {
    const JsonPlace place = root.at("animations").element(number);
    const JsonPlace channels = place.at("channels");
    const std::size_t sampler_count = place.size_of("samplers");
    std::vector<ChannelPlan> plans;
    std::set<std::pair<std::uint32_t, GltfPath>> moved;
    std::size_t without_node = 0, repeated = 0;
    std::uint64_t needed_bytes = 0;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        throw_if_interrupted();
        const JsonPlace channel = channels.element(i);
        const JsonPlace target = channel.at("target");
        if (!target.has("node") || target.has_extension("KHR_animation_pointer")) {
            ++without_node;
            continue;
        }
        const std::uint32_t node = target.at("node").index_below(nodes.to_world.size(), "node");
        const GltfPath path = read_path(target.at("path"));
        if (path != GltfPath::weights && root.at("nodes").element(node).has("matrix"))
            target.fail("node " + std::to_string(node) + " has a matrix, whose parts cannot be moved");
        if (!moved.insert({node, path}).second) {
            ++repeated;
            continue;
        }
        const std::size_t width = width_of(path, path == GltfPath::weights ? targets_of(root, target, node) : 0);
        const std::uint32_t sampler = channel.at("sampler").index_below(sampler_count, "sampler");
        plans.push_back({node, {place.at("samplers").element(sampler), path, width, buffers}});
        needed_bytes += plans.back().sampler.size_bytes;
    }
    // Numbers of the file take at most eight times their room in it; more is made of keys that it names again and
    // again.
    const std::uint64_t own_bytes = saturating_product(buffers.size_bytes(), 8);
    const std::string label = "animation \"" + printable(name_of_animation(place)) + "\"";
    budget.add(needed_bytes > own_bytes ? needed_bytes - own_bytes : 0, label + " with its keys");
    GltfAnimation animation;
    for (const ChannelPlan& plan : plans)
        animation.channels.push_back({plan.node, plan.sampler.path, plan.sampler.read(buffers)});
    if (without_node > 0)
        animation.notes.push_back(label + ": left out " + counted_channels(without_node) + " without a node");
    if (repeated > 0) {
        animation.notes.push_back(label + ": left out " + counted_channels(repeated) +
                                  " for what an earlier channel moves");
    }
    return animation;
}

std::vector<AnimationSummary> list_gltf_animations(const JsonPlace& root, GltfBuffers& buffers,
                                                   std::vector<std::string>& notes) {
    std::vector<AnimationSummary> list;
    for (std::size_t i = 0; i < root.size_of("animations"); ++i) {
        throw_if_interrupted();
        const JsonPlace place = root.at("animations").element(i);
        AnimationSummary& summary = list.emplace_back();
        try {
            summary.name = name_of_animation(place);
            summary.channels = place.at("channels").size();
            double last = 0;
            for (std::size_t k = 0; k < place.at("samplers").size(); ++k) {
                const JsonPlace sampler = place.at("samplers").element(k);
                SamplerPlan::plan_times(sampler, buffers);
                const GltfAccessor times = buffers.accessor(sampler.at("input"), "SCALAR");
                const double time = times.number(times.count - 1, 0);
                if (!(std::abs(time) <= kLargestCoordinate))
                    sampler.at("input").fail("the last time is not finite or beyond 1e30");
                last = std::max(last, time);
            }
            summary.seconds = last;
        } catch (const InputError& error) {
            notes.emplace_back(error.what());
        }
    }
    return list;
}

}  // namespace burin
