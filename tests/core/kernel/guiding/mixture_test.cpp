// The share of BSDF sampling that a volume learns.
#include "core/kernel/guiding/mixture.h"

#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"

using namespace pl;
using namespace pl::test;

namespace {

void record_light(TestField& field, float bsdf_ratio, float radiance) {
    const TableField view = field.view();
    record_mixture(view, 0, bsdf_ratio, light_weight(view, 0, bsdf_ratio, radiance));
}

/// A hemisphere in two halves: their probabilities by BSDF and table, and their incident radiance.
struct TwoHalves {
    double bsdf[2] = {0.5, 0.5};
    double table[2] = {0.5, 0.5};
    double radiance[2] = {1.0, 1.0};

    double density(double a, int half) const { return a * bsdf[half] + (1.0 - a) * table[half]; }
    double mean_radiance() const { return bsdf[0] * radiance[0] + bsdf[1] * radiance[1]; }

    /// The share with the least divergence, by bisection of its derivative.
    double best_share() const {
        double low = kMinBsdfFraction;
        double high = kMaxBsdfFraction;
        for (int i = 0; i < 60; ++i) {
            const double a = 0.5 * (low + high);
            double slope = 0.0;
            for (int half = 0; half < 2; ++half)
                slope -= bsdf[half] * radiance[half] * (bsdf[half] - table[half]) / density(a, half);
            (slope < 0.0 ? low : high) = a;
        }
        return 0.5 * (low + high);
    }
};

/// Passes of training samples drawn from the present mixture.
void learn(TestField& field, const TwoHalves& halves, int passes, int records, Uniforms& random) {
    for (int pass = 0; pass < passes; ++pass) {
        field.tables.mean_radiance[0] = static_cast<float>(halves.mean_radiance());
        const double a = static_cast<double>(field.tables.bsdf_fraction[0]);
        for (int i = 0; i < records; ++i) {
            const int half = static_cast<double>(random.next()) < halves.density(a, 0) ? 0 : 1;
            record_light(field, static_cast<float>(halves.bsdf[half] / halves.density(a, half)),
                         static_cast<float>(halves.radiance[half]));
        }
        move_mixture(field.update_view(), 0);
    }
}

}  // namespace

TEST_CASE("A volume without training samples has the BSDF fraction one half") {
    TestField field(4);
    CHECK(field.tables.bsdf_fraction[0] == kInitialBsdfFraction);
    field.update();
    CHECK(field.tables.bsdf_fraction[0] == kInitialBsdfFraction);
    record_light(field, 0.1f, 1.0f);  // but the expected radiance is 0: no scale
    field.update();
    CHECK(field.tables.bsdf_fraction[0] == kInitialBsdfFraction);
}

// Power: fractions range from 0.1 to 0.9 over the cases, the tolerance is 0.02. The steps of the last ten updates
// count for two thirds, 10^5 samples: their error is below 0.005.
TEST_CASE("The BSDF fraction converges to the least divergence") {
    Uniforms random(1);
    const TwoHalves cases[] = {
        {.table = {0.9, 0.1}, .radiance = {1.8, 0.2}},    // the table is right
        {.table = {0.1, 0.9}, .radiance = {1.8, 0.2}},    // it is upside down
        {.table = {0.98, 0.02}, .radiance = {1.5, 0.5}},  // too narrow
        {.table = {0.8, 0.2}, .radiance = {1.3, 0.7}},   {.table = {0.95, 0.05}, .radiance = {1.1, 0.9}},
    };
    for (const TwoHalves& halves : cases) {
        TestField field(4);
        learn(field, halves, 60, 10000, random);
        INFO("table " << halves.table[0] << ", radiance " << halves.radiance[0]);
        CHECK(static_cast<double>(field.tables.bsdf_fraction[0]) == Approx(halves.best_share()).margin(0.02));
    }
}

TEST_CASE("A few training samples hardly move the BSDF fraction and many do") {
    Uniforms random(2);
    const TwoHalves wrong{.table = {0.1, 0.9}, .radiance = {1.8, 0.2}};
    TestField few(4);
    learn(few, wrong, 1, 2, random);
    CHECK(std::fabs(few.tables.bsdf_fraction[0] - kInitialBsdfFraction) < 0.1f);
    TestField many(4);
    learn(many, wrong, 3, 1000, random);
    CHECK(many.tables.bsdf_fraction[0] > 0.8f);
}

TEST_CASE("The order of training samples does not move the BSDF fraction by a bit") {
    Uniforms random(3);
    std::vector<Vec2f> records;
    for (int i = 0; i < 1000; ++i) records.push_back({random.between(0.01f, 10.0f), random.between(0.0f, 100.0f)});
    TestField forward(4);
    TestField backward(4);
    forward.tables.mean_radiance[0] = backward.tables.mean_radiance[0] = 1.0f;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const Vec2f first = records[i];
        const Vec2f last = records[records.size() - 1 - i];
        record_light(forward, first.x, first.y);
        record_light(backward, last.x, last.y);
    }
    move_mixture(forward.update_view(), 0);
    move_mixture(backward.update_view(), 0);
    CHECK(forward.tables.bsdf_fraction[0] == backward.tables.bsdf_fraction[0]);
    CHECK(forward.tables.bsdf_fraction[0] != kInitialBsdfFraction);
}

TEST_CASE("Bad and huge numbers leave a BSDF fraction in its range") {
    for (const float ratio : {0.0f, 1.0f, 10.0f})
        for (const float radiance : {kNan, kInfinity, -1.0f, 0.0f, 3e38f}) {
            TestField field(4);
            field.tables.mean_radiance[0] = 1e-30f;
            for (int i = 0; i < 10000; ++i) record_light(field, ratio, radiance);
            CHECK(field.tables.pending_curvature[0] >= 0);
            move_mixture(field.update_view(), 0);
            INFO("ratio " << ratio << ", radiance " << radiance);
            CHECK(field.tables.bsdf_fraction[0] >= kMinBsdfFraction);
            CHECK(field.tables.bsdf_fraction[0] <= kMaxBsdfFraction);
            CHECK(field.tables.pending_slope[0] == 0);
            CHECK(field.tables.pending_curvature[0] == 0);
        }
}
