// From training samples to tables: exact sums, exact learning rates, and tables that are probabilities also if memory
// is damaged.
#include "core/kernel/guiding/table_update.h"

#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr double kSteps = 16777216.0;  ///< fixed-point steps per unit

/// All probabilities finite, not negative, at least the floor's share, adding up to 1.
bool is_probability(const TestField& field, const DirectionTable& table) {
    const int side = table.cells.side;
    double sum = 0.0;
    float least = 1.0f;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const float p = table.cell_probability(column, row);
            if (!(p >= 0.0f) || !(p <= 1.0f)) return false;
            sum += static_cast<double>(p);
            least = min_of(least, p);
        }
    // Differences of numbers near 1 are off by a roundoff of 1 in the row and in the column.
    const float floor = field.shape.uniform_floor / static_cast<float>(table.cells.count());
    return std::fabs(sum - 1.0) <= 1e-6 && least >= floor * (1.0f - 1e-3f) - 1e-7f && table.row_cdf[side - 1] == 1.0f;
}

void add_records(TestField& field, std::uint32_t cell, std::uint32_t count, float radiance) {
    for (std::uint32_t i = 0; i < count; ++i) record(field.view(), 0, static_cast<int>(cell), radiance);
}

double exact_step(double visits, double fresh, LearningRate rate) {
    if (rate == LearningRate::SampleMean) return fresh / (visits + fresh);
    return 1.0 - std::pow(visits / (visits + fresh), 4.0);
}

}  // namespace

TEST_CASE("Fixed point is exact at its edges") {
    constexpr std::int64_t kMost = std::int64_t{65536} << 24;
    CHECK(to_fixed_point(0.0f, 1.0f) == 0);
    CHECK(to_fixed_point(-0.0f, 1.0f) == 0);
    CHECK(to_fixed_point(-1.0f, 1.0f) == 0);
    CHECK(to_fixed_point(-kInfinity, 1.0f) == 0);
    CHECK(to_fixed_point(kNan, 1.0f) == 0);
    CHECK(to_fixed_point(1e-45f, 1.0f) == 0);
    CHECK(to_fixed_point(0x1p-24f, 1.0f) == 1);
    CHECK(to_fixed_point(1.0f, 1.0f) == 1 << 24);
    CHECK(to_fixed_point(1.0f, 0x1p-100f) == kMost);
    CHECK(to_fixed_point(65536.0f, 1.0f) == kMost);
    CHECK(to_fixed_point(next_float_up(65536.0f), 1.0f) == kMost);
    CHECK(to_fixed_point(3e38f, 1.0f) == kMost);
    CHECK(to_fixed_point(kInfinity, 1.0f) == kMost);
    CHECK(to_fixed_point(3.0f, 4.0f) == 3 << 22);
    // All but one of 2^23 samples of the largest value fit into a sum.
    CHECK(std::numeric_limits<std::int64_t>::max() / kMost == (1 << 23) - 1);
    CHECK(from_fixed_point(5 * (std::int64_t{1} << 24), 2, 4.0f) == 10.0f);
    CHECK(from_fixed_point(0, 7, 4.0f) == 0.0f);
}

TEST_CASE("The order of training samples does not matter") {
    Uniforms random(1);
    std::vector<std::pair<int, float>> records;
    for (int i = 0; i < 5000; ++i)
        records.emplace_back(static_cast<int>(random.below(16)), std::exp2(random.between(-30, 10)));
    TestField forwards(4), backwards(4);
    for (const auto& [cell, radiance] : records) record(forwards.view(), 0, cell, radiance);
    std::reverse(records.begin(), records.end());
    for (const auto& [cell, radiance] : records) record(backwards.view(), 0, cell, radiance);
    CHECK(forwards.tables.pending_sum == backwards.tables.pending_sum);
    forwards.update();
    backwards.update();
    CHECK(forwards.tables.radiance == backwards.tables.radiance);
    CHECK(forwards.tables.column_cdf == backwards.tables.column_cdf);
    CHECK(forwards.tables.pending_sum == LargeArray<std::int64_t>(16, 0));
    CHECK(forwards.tables.pending_count == LargeArray<std::uint32_t>(16, 0));
}

TEST_CASE("Learning rates are exact from the first visit to the last") {
    for (const LearningRate rate : {LearningRate::SampleMean, LearningRate::Forgetful}) {
        CHECK(learning_step(0, 1, rate) == 1.0f);
        CHECK(learning_step(0, 1000, rate) == 1.0f);
        for (const std::uint32_t visits : {1u, 2u, 9u, 100u, 10000u, 1000000u, 16777216u, 4000000000u})
            for (const std::uint32_t fresh : {1u, 2u, 7u, 1000u, 1000000u}) {
                // The exact formula loses digits to its own difference from 1; a double has 29 more than a float.
                const double exact = exact_step(visits, fresh, rate);
                const double step = static_cast<double>(learning_step(visits, fresh, rate));
                REQUIRE(step > 0.0);
                REQUIRE(step <= 1.0);
                REQUIRE(std::fabs(step / exact - 1.0) <= 1e-6);  // about 10 roundoffs
            }
    }
}

// A target that jumps from 1 to 2 after many visits: the share of the jump that each rate has not followed after 40 updates.
TEST_CASE("Rates follow a change at different speeds") {
    const auto left = [](LearningRate rate) {
        TestField field(4);
        field.shape.rate = rate;
        for (int pass = 0; pass < 240; ++pass) {
            add_records(field, 3, 2, pass < 200 ? 1.0f : 2.0f);
            field.update();
        }
        return 2.0f - field.tables.radiance[3];
    };
    CHECK(left(LearningRate::SampleMean) == Approx(200.0 / 240.0).epsilon(1e-3));
    CHECK(left(LearningRate::Forgetful) == Approx(std::pow(200.0 / 240.0, 4.0)).epsilon(1e-3));
}

TEST_CASE("Ten updates give the rational mean") {
    TestField field(4);
    field.shape.rate = LearningRate::SampleMean;
    double sum = 0.0;
    std::uint32_t count = 0;
    for (std::uint32_t pass = 1; pass <= 10; ++pass) {
        const float radiance = static_cast<float>(pass * pass) / 8.0f;
        add_records(field, 5, pass, radiance);
        sum += pass * static_cast<double>(radiance);
        count += pass;
        field.update();
        REQUIRE(field.tables.visits[5] == count);
        const double mean = sum / count;
        REQUIRE(std::fabs(static_cast<double>(field.tables.radiance[5]) / mean - 1.0) <= 4.0 * 0x1p-24 * pass);
    }
    CHECK(field.tables.visits[4] == 0);
    CHECK(field.tables.radiance[4] == 0.0f);
}

// Forgetting (1-a)Q + aX with a = 1/(1+n) in float would be off by 1.4 % here.
TEST_CASE("Ten million visits keep the mean") {
    TestField field(4);
    field.shape.rate = LearningRate::SampleMean;
    TableUpdateView view = field.update_view();
    Uniforms random(2);
    double sum = 0.0;
    for (std::uint32_t visit = 0; visit < 10000000; ++visit) {
        const std::int64_t steps = to_fixed_point(random.next(), 1.0f);
        sum += static_cast<double>(steps) / kSteps;
        view.pending_sum[0] = steps;
        view.pending_count[0] = 1;
        absorb_samples(view, 0);
    }
    CHECK(view.visits[0] == 10000000);
    CHECK(std::fabs(static_cast<double>(view.radiance[0]) / (sum / 1e7) - 1.0) <= 2e-5);
}

TEST_CASE("Learned radiance stays between the least and the greatest target") {
    for (const LearningRate rate : {LearningRate::SampleMean, LearningRate::Forgetful}) {
        TestField field(4);
        field.shape.rate = rate;
        TableUpdateView view = field.update_view();
        Uniforms random(3);
        const float low = 0.3f;
        const float high = 0.300001f;
        for (int pass = 0; pass < 1000000; ++pass) {
            view.pending_count[0] = 1 + random.below(3);
            view.pending_sum[0] = to_fixed_point(random.below(2) == 0 ? low : high, 1.0f) * view.pending_count[0];
            absorb_samples(view, 0);
            // Fixed point cuts off a step; the update rounds twice.
            if (!(view.radiance[0] >= low - 3.0f * 0x1p-24f && view.radiance[0] <= high + 0x1p-24f))
                FAIL("radiance " << view.radiance[0] << " after " << pass << " passes");
        }
        SUCCEED();
    }
}

TEST_CASE("Visits saturate and do not wrap") {
    TestField field(4);
    field.tables.visits[3] = 0xfffffff0u;
    field.tables.radiance[3] = 1.0f;
    add_records(field, 3, 100, 1.0f);
    field.update();
    CHECK(field.tables.visits[3] == 0xffffffffu);
    CHECK(field.tables.radiance[3] == 1.0f);
}

TEST_CASE("Cells without new samples keep every bit") {
    TestField field(4);
    for (float& q : field.tables.radiance) q = 0.1f;
    field.tables.visits.assign(16, 7);
    add_records(field, 2, 3, 5.0f);
    field.update();
    for (std::size_t cell = 0; cell < 16; ++cell)
        if (cell != 2) CHECK(field.tables.radiance[cell] == 0.1f);
    CHECK(field.tables.radiance[2] > 0.1f);
}

TEST_CASE("Bad numbers in memory are taken for nothing learned") {
    const float bad_values[] = {kNan, kInfinity, -kInfinity, -1.0f, -1e38f, 3e38f, 1e38f, 1e-45f};
    for (const float bad : bad_values)
        for (std::size_t cell = 0; cell <= 256; ++cell) {  // each alone, then all together
            TestField field(16);
            for (std::size_t i = 0; i < 256; ++i) {
                field.tables.radiance[i] = cell == 256 || cell == i ? bad : 0.5f;
                field.tables.visits[i] = 10;
            }
            field.update();
            if (!is_probability(field, field.table())) FAIL("value " << bad << " in cell " << cell);
            // ... and the next training sample heals the cell.
            const std::uint32_t healed = static_cast<std::uint32_t>(cell % 256);
            add_records(field, healed, 1, 0.5f);
            field.update();
            if (!(field.tables.radiance[healed] >= 0.0f && field.tables.radiance[healed] < kInfinity))
                FAIL("value " << bad << " stays in cell " << cell);
        }
    SUCCEED();
}

TEST_CASE("Every table that can be learned is a probability with its floor") {
    for (const float floor : {0.0f, 0.05f, 1.0f})
        for (const NamedWeights& hard : hard_weights(16)) {
            TestField field(16);
            field.shape.uniform_floor = floor;
            for (std::size_t i = 0; i < 256; ++i)
                for (int k = 0; k < 3; ++k) record(field.view(), 0, static_cast<int>(i), hard.weights[i]);
            field.update();
            INFO(hard.name << ", floor " << floor);
            CHECK(is_probability(field, field.table()));
        }
}

// A thousandth of the radiance in one cell, and none in the others: both keep their chance.
TEST_CASE("Dim cells next to a bright one stay possible") {
    TestField field(16);
    field.shape.radiance_unit = 0x1p27f;
    for (int cell = 0; cell < 256; ++cell)
        for (int k = 0; k < 100; ++k) record(field.view(), 0, cell, cell == 100 ? 1e8f : 1e-8f);
    field.update();
    CHECK(is_probability(field, field.table()));
    const float least = field.table().cell_probability(15, 15);
    CHECK(least >= 0.05f / 256.0f * 0.999f);
    CHECK(field.table().cell_probability(100 % 16, 100 / 16) > 0.8f);
}

TEST_CASE("With many visits the table follows the learned radiance and with none it is uniform") {
    TestField field(4);
    field.shape.uniform_floor = 0.0f;
    for (int cell = 0; cell < 16; ++cell)
        for (int k = 0; k < 100000; ++k) record(field.view(), 0, cell, static_cast<float>(cell + 1));
    field.update();
    for (int cell = 0; cell < 16; ++cell)  // the prior of 2 visits has a share of 2e-5
        CHECK(field.table().cell_probability(cell % 4, cell / 4) ==
              Approx(static_cast<float>(cell + 1) / 136.0f).epsilon(1e-3));
    TestField empty(4);
    empty.update();
    for (int cell = 0; cell < 16; ++cell)
        CHECK(empty.table().cell_probability(cell % 4, cell / 4) == Approx(1.0f / 16.0f));
    CHECK(empty.tables.mean_radiance[0] == 0.0f);
}

// 256 additions and a division: 200 roundoffs are plenty.
TEST_CASE("The mean radiance is that of the visited cells") {
    TestField field(16);
    Uniforms random(4);
    double sum = 0.0;
    int visited = 0;
    for (std::size_t cell = 0; cell < 256; ++cell) {
        if (random.below(3) == 0) continue;
        field.tables.visits[cell] = 1 + random.below(100);
        field.tables.radiance[cell] = random.next();
        sum += static_cast<double>(field.tables.radiance[cell]);
        ++visited;
    }
    field.update();
    CHECK(std::fabs(static_cast<double>(field.tables.mean_radiance[0]) / (sum / visited) - 1.0) <= 200.0 * 0x1p-24);
}

TEST_CASE("Volumes are updated independently") {
    TestField together(4, {Vec3f{0, 0, 1}, Vec3f{0, 0, -1}});
    TestField alone(4);
    for (int cell = 0; cell < 16; ++cell) {
        record(together.view(), 0, cell, 100.0f);
        record(together.view(), 1, cell, static_cast<float>(cell));
        record(alone.view(), 0, cell, static_cast<float>(cell));
    }
    together.update();
    alone.update();
    CHECK(std::equal(alone.tables.column_cdf.begin(), alone.tables.column_cdf.end(),
                     together.tables.column_cdf.begin() + 16));
    CHECK(together.tables.mean_radiance[1] == alone.tables.mean_radiance[0]);
}
