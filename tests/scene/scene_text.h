#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/scene_description.h"
#include "tests/support/temporary_folder.h"

namespace burin::test {

/// A scene file whose content is given as text, in a folder of its own.
class SceneText {
  public:
    explicit SceneText(std::string_view text) : path_(folder_.write("scene.toml", text)) {}

    const TemporaryFolder& folder() const { return folder_; }
    SceneDescription read(const std::vector<Override>& overrides = {}) const {
        return read_scene_file(path_, overrides);
    }
    Scene load(const std::vector<Override>& overrides = {}) const { return load_scene(read(overrides)); }

    /// The message of the InputError that reading gives, with the file called "scene.toml"; empty
    /// if there is none.
    std::string error() const {
        try {
            read();
        } catch (const InputError& error) {
            const std::string message = error.what();
            const std::string folder = folder_.path() + "/";
            return message.starts_with(folder) ? message.substr(folder.size()) : message;
        }
        return {};
    }
    /// The message of the UsageError that an override gives.
    std::string usage_error(const std::string& key, const std::string& value) const {
        try {
            read({{key, value}});
        } catch (const UsageError& error) {
            return error.what();
        }
        return {};
    }

  private:
    TemporaryFolder folder_;
    std::string path_;
};

inline SceneDescription described(std::string_view text) { return SceneText(text).read(); }
inline Scene loaded(std::string_view text) { return SceneText(text).load(); }

constexpr const char* kBox = "[[object]]\nshape = \"box\"\n";

struct Bounds {
    glm::dvec3 low{1e300}, high{-1e300};
};
inline Bounds bounds_of(const Scene& scene) {
    Bounds bounds;
    for_each_point(scene_points(scene), [&](const glm::dvec3& p) {
        bounds.low = glm::min(bounds.low, p);
        bounds.high = glm::max(bounds.high, p);
    });
    return bounds;
}

inline void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
    EXPECT_LE(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

}  // namespace burin::test
