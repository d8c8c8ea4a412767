// Sets of effects, and which compiled set serves a needed one.
#include "core/kernel/base/features.h"

#include <bit>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr std::uint32_t kSubsets = 1u << (sizeof(kAllFeatures) / sizeof(kAllFeatures[0]));

}  // namespace

TEST_CASE("Features are single and distinct bits") {
    std::uint32_t all = 0;
    for (const Feature feature : kAllFeatures) {
        const auto bits = static_cast<std::uint32_t>(feature);
        CHECK(std::has_single_bit(bits));
        CHECK((all & bits) == 0);
        all |= bits;
        CHECK(FeatureSet{}.with(feature).has(feature));
        CHECK_FALSE(FeatureSet{}.has(feature));
    }
    CHECK(all == kSubsets - 1);
}

TEST_CASE("The compiled set that is chosen covers the need and no smaller one does") {
    for (std::uint32_t bits = 0; bits < kSubsets; ++bits) {
        const FeatureSet needed{bits};
        const FeatureSet chosen = kCompiledSets[smallest_superset(needed)];
        CHECK(chosen.covers(needed));
        for (const FeatureSet other : kCompiledSets)
            if (other.covers(needed)) CHECK(std::popcount(other.bits) >= std::popcount(chosen.bits));
    }
}

TEST_CASE("Compiled sets are chosen for themselves") {
    for (int i = 0; i < kCompiledSetCount; ++i) CHECK(smallest_superset(kCompiledSets[i]) == i);
}

TEST_CASE("Covering is inclusion") {
    std::uint32_t wrong = 0;  // one assertion for all pairs: they are many
    for (std::uint32_t a = 0; a < kSubsets; ++a)
        for (std::uint32_t b = 0; b < kSubsets; ++b)
            wrong += FeatureSet{a}.covers(FeatureSet{b}) == ((a | b) == a) ? 0u : 1u;
    CHECK(wrong == 0);
}
