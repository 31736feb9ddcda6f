#include "abuffer/screen/known_seams.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>
#include <vector>

namespace burin::known_seams_test {
namespace {

/// Long borders through a box, each of a polygon of its own, and some that run along another one.
BorderIndex heap(unsigned seed, std::uint32_t count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    const auto place = [&] { return glm::dvec3(anywhere(random), anywhere(random), anywhere(random)); };
    std::vector<BorderIndex::Segment> segments;
    for (HalfEdge h = 0; h < count; ++h) {
        BorderIndex::Segment s{3 * h, h, place(), place()};
        if (h % 4 == 3) s = {3 * h, h, segments.back().a + 1e-4 * place(), segments.back().b + 1e-4 * place()};
        segments.push_back(s);
    }
    return BorderIndex(std::move(segments));
}

bool is_same(const KnownSeams::Along& along, const BorderIndex& borders, HalfEdge h) {
    BorderIndex::SeamCandidates expected;
    if (along.is_complete != borders.find_along(h, KnownSeams::Along::kFew, expected)) return false;
    const auto found = along.candidates.segments(), listed = expected.segments();
    if (found.size() != listed.size()) return false;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i].half_edge != listed[i].half_edge) return false;
    }
    return true;
}

/// Two meshes share the places of the memory: one forgets what the other one asked for.
TEST(KnownSeams, AreThoseOfTheBorder) {
    const BorderIndex first = heap(1, 2000), second = heap(2, 2000);
    KnownSeams known;
    std::size_t along = 0;
    for (int turn = 0; turn < 2; ++turn) {
        for (const BorderIndex* borders : {&first, &second, &second}) {
            for (HalfEdge h = 0; h < 6000; h += 3) {
                const auto list = known.along(*borders, h);
                ASSERT_TRUE(is_same(*list, *borders, h));
                along += list->candidates.segments().size();
            }
        }
    }
    EXPECT_GT(along, 1000u);
}

TEST(KnownSeams, ThreadsFindTheSame) {
    const BorderIndex borders = heap(3, 3000);
    KnownSeams known;
    std::atomic<int> wrong = 0;
    const auto ask_all = [&] {
        for (HalfEdge h = 0; h < 9000; h += 3) wrong += !is_same(*known.along(borders, h), borders, h);
    };
    std::thread other(ask_all);
    ask_all();
    other.join();
    EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace burin::known_seams_test
