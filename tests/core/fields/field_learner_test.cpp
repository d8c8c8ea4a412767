// Cells that a learner returns in the place of what an update of tables makes of them.
#include "core/fields/field_learner.h"
#include "core/fields/field_model.h"
#include "core/kernel/guiding/update_volume.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/session/same_bits.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::uint32_t kVolumes = 5;
constexpr FieldShape kShape{.cells = {.side = 8}, .radiance_unit = 4.0f};
constexpr float kShare = kUniformShare / 64.0f;  // that each of 64 cells keeps

/// Tables that have learned a little, with new training samples in half of the cells.
HostTables some_tables() {
    HostTables tables = tables_of(make_field(kShape, kVolumes, Representation::Table));
    Uniforms random(7);
    for (std::size_t cell = 0; cell < tables.radiance.size(); ++cell) {
        tables.radiance[cell] = random.next();
        tables.visits[cell] = static_cast<std::uint32_t>(20.0f * random.next());
        if (random.next() < 0.5f) continue;
        tables.pending_count[cell] = 1 + static_cast<std::uint32_t>(3.0f * random.next());
        tables.pending_sum[cell] = static_cast<std::int64_t>(1.0e7f * random.next());
    }
    return tables;
}

HostTables updated(HostTables tables) {
    const TableUpdateView field = update_view(kShape, tables);
    for (std::uint32_t volume = 0; volume < kVolumes; ++volume) update_volume(field, volume);
    return tables;
}

HostTables after_answer(const LearnedCells& cells) {
    HostTables tables = updated(some_tables());
    require_cells(kShape, kVolumes, cells);
    take_cells(kShape, tables, cells);
    return tables;
}

LearnedCells equal_cells(float value) { return {.values = std::vector<float>(kVolumes * 64, value)}; }

/// The unnormalized probabilities of the table's own update.
LearnedCells own_weights() {
    HostTables tables = some_tables();
    const TableUpdateView field = update_view(kShape, tables);
    for (std::uint32_t cell = 0; cell < kVolumes * 64; ++cell) absorb_samples(field, cell);
    for (std::uint32_t volume = 0; volume < kVolumes; ++volume) update_means(field, volume);
    for (std::uint32_t row = 0; row < kVolumes * 8; ++row) weigh_row(field, row);
    return {.values = {tables.column_cdf.begin(), tables.column_cdf.end()}};
}

/// A probability is the difference of two cumulative ones in [0, 1], which are rounded to 2^-24.
Approx probability(float value) { return Approx(value).margin(2.0e-7); }

float probability_of(HostTables& tables, std::uint32_t volume, int cell) {
    const HostVolumes none;
    return TableModel::inspector(TableModel::view(kShape, none, tables)).probability(volume, cell);
}

}  // namespace

TEST_CASE("A learner that returns the table's own probabilities or radiance changes no bit") {
    const HostTables own = updated(some_tables());
    CHECK(same_bits(after_answer(own_weights()), own));
    CHECK(same_bits(after_answer({.are_radiance = true, .values = {own.radiance.begin(), own.radiance.end()}}), own));
}

TEST_CASE("Whatever a learner returns, each cell keeps its uniform share") {
    LearnedCells peak = equal_cells(0.0f);
    peak.values[70] = 1.0e38f;
    HostTables tables = after_answer(peak);
    CHECK(probability_of(tables, 1, 6) == probability(1.0f - kUniformShare + kShare));
    CHECK(probability_of(tables, 1, 7) == probability(kShare));
    // No light at all, and a sum that is not finite, are the uniform distribution.
    for (const float value : {0.0f, 3.0e38f, 1.0e-40f}) {
        tables = after_answer(equal_cells(value));
        for (int cell = 0; cell < 64; ++cell) CHECK(probability_of(tables, 3, cell) == probability(1.0f / 64.0f));
    }
    peak.are_radiance = true;
    tables = after_answer(peak);
    for (int cell = 0; cell < 64; ++cell) CHECK(probability_of(tables, 1, cell) >= probability(kShare));
}

TEST_CASE("Numbers of a learner that are none of a distribution are refused with their place") {
    for (const auto& [value, text] : {std::pair{-1.0f, "-1"}, {kInfinity, "inf"}, {std::nanf(""), "nan"}}) {
        LearnedCells cells = equal_cells(1.0f);
        cells.values[2 * 64 + 17] = value;
        const std::string message = input_error([&] { require_cells(kShape, kVolumes, cells); });
        CHECK(
            message ==
            std::string("learner, probabilities of volume 2, cell 17: expected a finite number of at least 0, got ") +
                text);
    }
    LearnedCells cells{.are_radiance = true, .values = std::vector<float>(64)};
    CHECK(input_error([&] { require_cells(kShape, kVolumes, cells); }) ==
          "learner, radiance: expected 5 volumes of 64 cells, 320 numbers, got 64");
}
