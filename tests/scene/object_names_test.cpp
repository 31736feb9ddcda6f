#include "scene/object_names.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"

namespace burin {
namespace {

TEST(ObjectNames, MeanPartsAndInstances) {
    const ObjectNames names({"engine", "tree", "a/b"});
    for (const char* object :
         {"engine", "engine/piston", "engine#2", "engine/piston#2", "tree", "a/b", "a/b/c", "a/b#1"}) {
        EXPECT_TRUE(names.mean(object)) << object;
    }
    for (const char* object : {"", "engines", "engin", "a", "a/c", "a/", "piston/engine", "/engine"})
        EXPECT_FALSE(names.mean(object)) << object;
    EXPECT_FALSE(ObjectNames({}).mean("engine"));
    EXPECT_TRUE(ObjectNames({""}).mean(""));
}

TEST(ObjectNames, AreWhatComparingEachWithEachFinds) {
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        test::Random random(seed);
        const auto name = [&] {
            std::string text;
            for (int i = random.integer(0, 5); i > 0; --i) text += "ab/#"[random.integer(0, 3)];
            return text;
        };
        std::vector<std::string> names;
        for (int i = random.integer(0, 6); i > 0; --i) names.push_back(name());
        const std::string object = name();
        bool expected = false;
        for (const std::string& n : names) {
            expected = expected || (object.starts_with(n) &&
                                    (object.size() == n.size() || object[n.size()] == '/' || object[n.size()] == '#'));
        }
        EXPECT_EQ(ObjectNames(names).mean(object), expected) << object;
    }
}

}  // namespace
}  // namespace burin
