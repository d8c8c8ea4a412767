#include "core/kernel/base/indexed_cdf.h"

#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/sampling_rule.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Two distributions of multiples of 1/8, with entries without probability; the index is counted entry by entry.
struct TwoDistributions {
    std::vector<float> values;
    std::vector<std::int32_t> index;
    IndexedCdf cdf;

    TwoDistributions(std::uint32_t count, std::uint32_t buckets, test::Uniforms& random) {
        for (int i = 0; i < 2; ++i) {
            std::vector<float> one(count);
            for (float& value : one) value = static_cast<float>(random.below(8)) / 8.0f;
            std::ranges::sort(one);
            one.back() = 1.0f;
            for (std::uint32_t bucket = 0; bucket <= buckets; ++bucket) {
                const float begin = static_cast<float>(bucket) / static_cast<float>(buckets);
                index.push_back(static_cast<std::int32_t>(
                    std::count_if(one.begin(), one.end() - 1, [&](float value) { return value <= begin; })));
            }
            values.insert(values.end(), one.begin(), one.end());
        }
        cdf = {{values.data(), 2 * count}, {index.data(), 2 * (buckets + 1)}, count, buckets};
    }
};

}  // namespace

TEST_CASE("Sampling a distribution finds the interval of a number, and its position there") {
    test::Uniforms random(2);
    for (std::uint32_t count = 1; count <= 70; ++count) {
        for (const std::uint32_t buckets : {1u, 4u, 32u}) {
            const TwoDistributions two(count, buckets, random);
            for (const std::int32_t distribution : {0, 1}) {
                const auto begin = two.values.begin() + distribution * static_cast<std::int32_t>(count);
                for (const float u : {0.0f, 0.03125f, 0.124f, 0.125f, 0.3f, 0.5f, 0.874f, 0.875f, kAlmostOne}) {
                    const auto entry = std::upper_bound(begin, begin + count - 1, u) - begin;
                    const float start = entry == 0 ? 0.0f : begin[entry - 1];
                    const CdfSampleOf<One> sample = sample_cdf<One>(two.cdf, distribution, u);
                    CHECK(sample.entry == entry);
                    CHECK(sample.position == (u - start) / (begin[entry] - start));
                }
            }
        }
    }
}
