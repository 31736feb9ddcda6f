#include "base/model_budget.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace burin {
namespace {

constexpr std::uint64_t kGiga = std::uint64_t{1} << 30;

std::string refusal(ModelBudget& budget, std::uint64_t bytes) {
    try {
        budget.add(bytes, "object 'ball'");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(ModelBudget, CountsUpToItsLimitAndNoFurther) {
    ModelBudget budget(3 * kGiga);
    EXPECT_EQ(refusal(budget, kGiga), "");
    EXPECT_EQ(refusal(budget, 2 * kGiga), "");
    EXPECT_EQ(budget.counted_bytes(), 3 * kGiga);
    EXPECT_NE(refusal(budget, 1), "");
    EXPECT_EQ(budget.counted_bytes(), 3 * kGiga);
}

TEST(ModelBudget, SaysWhatNeedsHowMuchAndWhichOptionAllowsIt) {
    ModelBudget budget(2 * kGiga, "--memory-model");
    EXPECT_EQ(refusal(budget, 33 * kGiga),
              "object 'ball' needs about 33 GB, more than the 2.0 GB that --memory-model allows; "
              "make it simpler, or give "
              "--memory-model 34G");
    budget.add(kGiga, "another");
    EXPECT_EQ(refusal(budget, kGiga + kGiga / 2),
              "object 'ball' needs about 1.5 GB, with what was counted before 2.5 GB, more than "
              "the 2.0 GB that --memory-model "
              "allows; make it simpler, or give --memory-model 2561M");
}

TEST(ModelBudget, NamesNoOptionWhereThereIsNone) {
    ModelBudget budget(2 * kGiga);
    EXPECT_EQ(refusal(budget, 33 * kGiga),
              "object 'ball' needs about 33 GB, more than the 2.0 GB that models may take; make it simpler");
}

TEST(ModelBudget, DoesNotWrapAround) {
    ModelBudget budget(UINT64_MAX - 1);
    budget.add(UINT64_MAX - 1, "first");
    EXPECT_NE(refusal(budget, 2), "");
    EXPECT_NE(refusal(budget, UINT64_MAX), "");
    EXPECT_EQ(saturating_product(std::uint64_t{1} << 40, std::uint64_t{1} << 40), UINT64_MAX);
    EXPECT_EQ(saturating_product(0, UINT64_MAX), 0u);
    EXPECT_EQ(saturating_product(3, 5), 15u);
}

TEST(SizeText, HasTwoDigitsOrMore) {
    EXPECT_EQ(size_text(0), "0 bytes");
    EXPECT_EQ(size_text(1536), "1.5 KB");
    EXPECT_EQ(size_text(700 << 20), "700 MB");
    EXPECT_EQ(size_text(std::uint64_t{5} << 40), "5.0 TB");
}

}  // namespace
}  // namespace burin
