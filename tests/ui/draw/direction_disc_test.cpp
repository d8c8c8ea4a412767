#include <cmath>

#include "core/kernel/base/frame.h"
#include "core/kernel/base/rng.h"
#include "core/kernel/guiding/direction_cells.h"
#include "tests/support/catch.hpp"
#include "ui/draw/direction_disc.h"

using namespace pl;
using namespace pl::ui;

namespace {

VolumeInspection some_volume(int side) {
    VolumeInspection volume;
    volume.volume = 3;
    volume.position = {0.2f, -0.3f, 0.1f};
    volume.normal = glm::normalize(Vec3f{0.3f, 0.9f, -0.2f});
    volume.side = side;
    const int cells = side * side;
    for (int i = 0; i < cells; ++i) {
        volume.radiance.push_back(static_cast<float>(i));
        volume.probability.push_back(1.0f / static_cast<float>(cells));
        volume.visits.push_back(i % 2 == 0 ? 4u : 0u);
    }
    return volume;
}

double fan_area(const CellFan& fan) {
    double area = 0.0;
    for (int i = 0; i < kCellBorderPoints; ++i) {
        const Vec2f a = fan[static_cast<std::size_t>(1 + i)] - fan[0];
        const Vec2f b = fan[static_cast<std::size_t>(1 + (i + 1) % kCellBorderPoints)] - fan[0];
        area += 0.5 * static_cast<double>(a.x * b.y - a.y * b.x);
    }
    return area;
}

}  // namespace

TEST_CASE("Direction disk: cells have equal areas, share borders and know their number") {
    for (const int side : {2, 8, 16}) {
        const std::vector<CellFan> fans = make_cell_fans(side);
        const DirectionCells cells{side};
        REQUIRE(static_cast<int>(fans.size()) == cells.count());
        double total = 0.0;
        for (int cell = 0; cell < cells.count(); ++cell) {
            const CellFan& fan = fans[static_cast<std::size_t>(cell)];
            CHECK(cells.cell_of(disk_to_square(fan[0])) == cell);
            const double area = fan_area(fan);
            CHECK(area > 0.0);
            total += area;
            if (side >= 8) CHECK(area == Approx(static_cast<double>(kPi) / cells.count()).epsilon(0.03));
        }
        // Only the outer border is an arc cut short by chords: 8 side chords of angle a lose a share a^2/6.
        const double angle = 2.0 * static_cast<double>(kPi) / (8.0 * side);
        CHECK(total == Approx(static_cast<double>(kPi) * (1.0 - angle * angle / 6.0)).epsilon(1.0e-3));
    }
    const std::vector<CellFan> fans = make_cell_fans(4);
    CHECK(fans[0][3] == fans[1][1]);  // right lower corner of a cell is left lower corner of the next
    CHECK(fans[0][5] == fans[5][1]);
}

TEST_CASE("Hemisphere: directions above the cells' disk are unit and on the volume's side") {
    const VolumeInspection volume = some_volume(8);
    for (const Vec2f disk : {Vec2f{0.0f, 0.0f}, Vec2f{0.5f, -0.3f}, Vec2f{-0.9f, 0.2f}}) {
        const Vec3f direction = direction_of(volume, disk);
        CHECK_THAT(glm::length(direction), WithinAbs(1.0f, 1.0e-5f));
        const Vec3f local = make_frame(volume.normal).to_local(direction);
        CHECK_THAT(local.x, WithinAbs(disk.x, 1.0e-5f));
        CHECK_THAT(local.y, WithinAbs(disk.y, 1.0e-5f));
        CHECK(local.z > 0.0f);
    }
}

TEST_CASE("Cell values: one per cell, and their positions in a range") {
    const VolumeInspection volume = some_volume(4);
    const std::vector<float> values = cell_values(volume, CellQuantity::Radiance);
    REQUIRE(values.size() == 16);
    CHECK(values[7] == 7.0f);
    CHECK(cell_values(volume, CellQuantity::Visits)[2] == 4.0f);
    const std::vector<float> positions = positions_in({ColorScale::Linear, 0.0f, 15.0f}, values);
    CHECK(positions[0] == 0.0f);
    CHECK(positions[15] == 1.0f);
    CHECK_THAT(positions[3], WithinAbs(0.2f, 1.0e-6f));
}

TEST_CASE("Table summary: uniform and one-cell tables have the entropies they must have") {
    VolumeInspection volume = some_volume(4);
    TableSummary summary = summarize(volume);
    CHECK(summary.entropy_bits == Approx(4.0));
    CHECK(summary.effective_cells == Approx(16.0));
    CHECK(summary.peak == Approx(1.0));
    CHECK(summary.visits == 32);
    CHECK(summary.empty_cells == 8);
    volume.probability.assign(16, 0.0f);
    volume.probability[5] = 1.0f;
    summary = summarize(volume);
    CHECK(summary.entropy_bits == Approx(0.0).margin(1e-12));
    CHECK(summary.peak == Approx(16.0));
}

TEST_CASE("Color map: the one of heat maps") {
    CHECK(map_color(0.0f) == 0xff51172bu);
    CHECK(map_color(1.0f) == 0xff7aebf8u);
    CHECK(map_color(2.0f) == map_color(1.0f));
    CHECK(map_color(0.5f, 10) >> 24 == 10);
}
