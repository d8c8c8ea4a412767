// The fixed point of Expected Sarsa with light samples, on two cases solved by hand.
#include "core/kernel/methods/targets/expected_sarsa.h"

#include <algorithm>

#include "core/kernel/guiding/update_volume.h"
#include "core/kernel/shading/lights.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::size_t kTargetSide = 4;
constexpr std::size_t kLamp = 0;  ///< cell from which a lamp shines; light samples always choose it
constexpr std::size_t kSky = 15;  ///< cell from which light comes that light samples do not know

/// Probability of a cell by the sampling tables.
float share_of(const HostTables& tables, std::size_t cell) {
    const auto step = [](const auto& cdf, std::size_t first, std::size_t i) {
        return cdf[first + i] - (i > 0 ? cdf[first + i - 1] : 0.0f);
    };
    const std::size_t row = cell / kTargetSide;
    return step(tables.row_cdf, 0, row) * step(tables.column_cdf, row * kTargetSide, cell % kTargetSide);
}

/// Shares of the two cells after training by targets w L_e, w = q / (q + p_light), as paths bring that the table alone
/// scatters. All cells are equally large in projected solid angle, so densities are probabilities of cells.
std::pair<float, float> learned_shares(float lamp_radiance, float sky_radiance) {
    constexpr std::uint32_t kVisits = 1000000;  // so that the prior of the volume's mean vanishes
    TestField field(kTargetSide, {Vec3f{0, 0, 1}});
    field.shape.uniform_floor = 0.0f;
    field.shape.rate = LearningRate::SampleMean;
    field.update();
    const auto train = [&](std::size_t cell, float emitted, float light_pdf) {
        const float weight = balance_weight(share_of(field.tables, cell), light_pdf);
        field.tables.pending_sum[cell] = kVisits * to_fixed_point(weight * emitted, field.shape.radiance_unit);
        field.tables.pending_count[cell] = kVisits;
    };
    for (int update = 0; update < 400; ++update) {
        std::ranges::fill(field.tables.visits, 19 * kVisits);  // a step of 1/20, with which shares settle
        for (std::size_t cell = 0; cell < kTargetSide * kTargetSide; ++cell) train(cell, 0.0f, 0.0f);
        train(kLamp, lamp_radiance, 1.0f);
        train(kSky, sky_radiance, 0.0f);
        field.update();
    }
    return {share_of(field.tables, kLamp), share_of(field.tables, kSky)};
}

}  // namespace

// q = max(0, c L - p_light) in each cell, and the shares add up to 1: lamp 16 and sky 8 give (16 c - 1) + 8 c = 1, c = 1/12.
TEST_CASE("With light samples tables leave to them what these bring") {
    const auto [lamp, sky] = learned_shares(16.0f, 8.0f);
    CHECK(lamp == Approx(1.0f / 3.0f).margin(2e-3f));
    CHECK(sky == Approx(2.0f / 3.0f).margin(2e-3f));
}

// Lamp 16 and sky 24: 40 c = 2 would make 16 c - 1 negative, so that all goes to the sky.
TEST_CASE("Tables never aim where light samples do better") {
    const auto [lamp, sky] = learned_shares(16.0f, 24.0f);
    CHECK(lamp < 2e-3f);
    CHECK(sky > 0.998f);
}
