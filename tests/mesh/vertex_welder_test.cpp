#include "mesh/vertex_welder.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "tests/support/random.h"

namespace burin {
namespace {

using test::Random;

TEST(WeldVertices, AgreesWithAMap) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const int places = seed % 2 == 0 ? 2 : 20;
        std::vector<glm::vec3> positions(static_cast<std::size_t>(random.integer(0, seed % 25 == 0 ? 20000 : 300)));
        for (glm::vec3& p : positions) {
            for (int axis = 0; axis < 3; ++axis)
                p[axis] = 0.1f * static_cast<float>(random.integer(-places, places)) + 0.0f;
        }
        std::map<std::array<float, 3>, std::uint32_t> first;
        std::vector<std::uint32_t> expected;
        for (std::uint32_t v = 0; v < positions.size(); ++v) {
            const glm::vec3& p = positions[v];
            expected.push_back(first.try_emplace({p.x, p.y, p.z}, v).first->second);
        }
        ASSERT_EQ(weld_vertices(positions), expected) << "seed " << seed;
    }
}

}  // namespace
}  // namespace burin
