#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "mesh/model.h"
#include "mesh/model_player.h"
#include "tests/mesh/gltf_builder.h"
#include "tests/mesh/model_files.h"
#include "tests/support/temporary_folder.h"

// Blender, which is nobody's relative, has all vertices of an animated glTF where ModelPlayer has them.

namespace burin::gltf_in_blender_test {
namespace {

using test::ByteWriter;
using test::GltfAccessors;
using test::GltfParts;

constexpr int kFrames = 24;

std::string floats(const std::vector<float>& numbers) {
    ByteWriter bytes;
    for (const float number : numbers) bytes.add<float>({number});
    return bytes.bytes();
}

/// A number for each frame.
template <typename Value>
std::vector<float> per_frame(const Value& value) {
    std::vector<float> numbers;
    for (int frame = 0; frame <= kFrames; ++frame) {
        for (const double number : value(frame / double{kFrames})) numbers.push_back(static_cast<float>(number));
    }
    return numbers;
}

std::vector<double> turned(double degrees, const glm::dvec3& axis) {
    const double half = glm::radians(0.5 * degrees);
    const glm::dvec3 v = std::sin(half) * glm::normalize(axis);
    return {v.x, v.y, v.z, std::cos(half)};
}

/// A band whose ends follow two joints, and a plate with two morph targets; all of it moves, with a key at each frame.
/// Weights are from 0 to 1, for Blender takes no others.
GltfParts moving_parts() {
    GltfAccessors a;
    std::vector<float> band, weights, plate, first, second;
    std::string joints;
    std::vector<std::uint16_t> indices;
    constexpr int kRows = 9;
    for (int row = 0; row < kRows; ++row) {
        for (const float x : {-0.5f, 0.5f}) {
            const float y = 0.25f * static_cast<float>(row), part = static_cast<float>(row) / (kRows - 1);
            band.insert(band.end(), {x, y, 0.1f * x});
            weights.insert(weights.end(), {1 - part, part, 0, 0});
            joints += std::string("\0\1\0\0", 4);
            plate.insert(plate.end(), {x + 3, y, 0});
            first.insert(first.end(), {0, 0, y * y});
            second.insert(second.end(), {x * y, 0.3f, 0});
        }
    }
    for (std::uint16_t i = 0; i + 2 < 2 * kRows; ++i)
        indices.insert(indices.end(), {i, static_cast<std::uint16_t>(i + 1), static_cast<std::uint16_t>(i + 2)});
    const std::size_t vertices = 2 * kRows;
    a.add(floats(band), "VEC3", 5126, vertices, R"("min": [-1, 0, -1], "max": [1, 2, 1])");
    a.add(joints, "VEC4", 5121, vertices);
    a.add(floats(weights), "VEC4", 5126, vertices);
    ByteWriter corners;
    for (const std::uint16_t i : indices) corners.add<std::uint16_t>({i});
    a.add(corners.bytes(), "SCALAR", 5123, indices.size());
    a.add(floats(plate), "VEC3", 5126, vertices, R"("min": [2, 0, 0], "max": [4, 2, 0])");
    a.add(floats(first), "VEC3", 5126, vertices);
    a.add(floats(second), "VEC3", 5126, vertices);
    a.add(floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                  1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1}),
          "MAT4", 5126, 2);
    const auto add_keys = [&](const char* type, const std::vector<float>& numbers, std::size_t count) {
        return std::to_string(a.add(floats(numbers), type, 5126, count));
    };
    const std::size_t keys = kFrames + 1;
    const std::string times = std::to_string(a.add(floats(per_frame([](double t) { return std::vector{t}; })), "SCALAR",
                                                   5126, keys, R"("min": [0], "max": [1])"));
    const std::string root_turns = add_keys("VEC4", per_frame([](double t) {
                                                return turned(70 * t * t, {0.2, 1, 0.3});
                                            }),
                                            keys);
    const std::string tip_turns = add_keys("VEC4", per_frame([](double t) {
                                               return turned(-110 * t, {1, 0, 0});
                                           }),
                                           keys);
    const std::string root_moves = add_keys("VEC3", per_frame([](double t) {
                                                return std::vector{t, std::sin(3 * t), -t * t};
                                            }),
                                            keys);
    const std::string plate_sizes = add_keys("VEC3", per_frame([](double t) {
                                                 return std::vector{1 + t, 1 - 0.5 * t, 2.0};
                                             }),
                                             keys);
    const std::string plate_weights = add_keys("SCALAR", per_frame([](double t) {
                                                   return std::vector{t, 0.5 - 0.5 * std::cos(4 * t)};
                                               }),
                                               2 * keys);
    GltfParts parts;
    a.put_into(parts);
    parts.scenes = R"([{"nodes": [0, 1, 3]}])";
    parts.nodes = R"([{"mesh": 0, "skin": 0, "name": "band"}, {"children": [2], "name": "root"},)"
                  R"( {"translation": [0, 1, 0], "name": "tip"}, {"mesh": 1, "name": "plate"}])";
    parts.skins = R"([{"joints": [1, 2], "inverseBindMatrices": 7}])";
    parts.meshes = R"([{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3}]},)"
                   R"( {"primitives": [{"attributes": {"POSITION": 4}, "targets": [{"POSITION": 5}, {"POSITION": 6}],)"
                   R"( "indices": 3}], "weights": [0, 0]}])";
    const auto sampler = [&](const std::string& output) {
        return R"({"input": )" + times + R"(, "output": )" + output + "}";
    };
    const auto channel = [](int number, int node, const char* path) {
        return R"({"sampler": )" + std::to_string(number) + R"(, "target": {"node": )" + std::to_string(node) +
               R"(, "path": ")" + path + R"("}})";
    };
    parts.animations = R"([{"name": "move", "samplers": [)" + sampler(root_turns) + ", " + sampler(tip_turns) + ", " +
                       sampler(root_moves) + ", " + sampler(plate_sizes) + ", " + sampler(plate_weights) +
                       R"(], "channels": [)" + channel(0, 1, "rotation") + ", " + channel(1, 2, "rotation") + ", " +
                       channel(2, 1, "translation") + ", " + channel(3, 3, "scale") + ", " + channel(4, 3, "weights") +
                       "]}]";
    return parts;
}

TEST(GltfInBlender, VerticesAreAtTheSamePlacesAtWholeAndHalfFrames) {
    const test::TemporaryFolder folder;
    const std::string path = folder.write("moving.gltf", moving_parts().json()), out = folder.file("places.txt");
    const std::vector<double> frames = {0, 0.5, 1, 5.5, 12, 17.5, 24};
    std::string command = "blender -b --factory-startup --python-exit-code 1 --python " BURIN_SOURCE_FOLDER
                          "/tests/mesh/blender_positions.py -- " +
                          path + " " + out;
    for (const double frame : frames) command += " " + std::to_string(frame);
    ASSERT_EQ(std::system((command + " > " + folder.file("log") + " 2>&1").c_str()), 0)
        << test::read_file(folder.file("log")) << "\nscripts/install-dependencies blender installs it";
    std::map<double, std::vector<glm::dvec3>> places;
    std::ifstream lines(out);
    double frame = 0;
    for (glm::dvec3 p; lines >> frame >> p.x >> p.y >> p.z;) places[frame].push_back(p);
    ASSERT_EQ(places.size(), frames.size());

    AnimationWish wish;
    wish.plays = true;
    const Model model = read_model(path, {}, wish);
    for (const auto& [number, expected] : places) {
        EXPECT_EQ(expected.size(), 36u);
        const ModelMoment moment = model.player->at(number / 24);
        std::vector<glm::dvec3> own;
        for (std::uint32_t i = 0; i < model.objects.size(); ++i) {
            for (const auto& [mesh, surface] : moment.meshes) {
                if (mesh != model.objects[i].mesh) continue;
                for (std::uint32_t v = 0; v < surface.positions.size(); ++v)
                    own.emplace_back(moment.objects[i] * glm::dvec4(surface.position(v), 1));
            }
        }
        ASSERT_EQ(own.size(), expected.size());
        for (const glm::dvec3& p : expected) {
            double nearest = 1e9;
            for (const glm::dvec3& q : own) nearest = std::min(nearest, glm::distance(p, q));
            EXPECT_LT(nearest, 1e-5) << "frame " << number;
        }
    }
}

}  // namespace
}  // namespace burin::gltf_in_blender_test
