// Sizes of a learned field, its radiance unit and its empty tables.
#include "core/fields/place_volumes.h"
#include "core/fields/table_model.h"

#include "core/fields/volume_grid.h"
#include "core/kernel/guiding/direction_table.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

float unit_for(Vec3f emission, Vec3f environment = Vec3f{0.0f}) {
    SceneDescription scene;
    scene.materials.push_back(gray());
    scene.materials[0].emission = emission;
    scene.environment = environment;
    add_triangle(scene, Vec3f{0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    return make_field_shape(pack_scene(scene), {}).radiance_unit;
}

/// Gray whose luminance is exactly a power of two, in float.
Vec3f of_luminance(float y) {
    float g = y;
    while (luminance(Vec3f{g}) > y) g = next_float_down(g);
    while (luminance(Vec3f{g}) < y) g = next_float_up(g);
    return Vec3f{g};
}

}  // namespace

TEST_CASE("The number of volumes follows the budget up to the default") {
    FieldSettings settings;
    settings.budget_megabytes = 1.0;
    settings.bins = 256;
    const int affordable = volume_count(settings);
    CHECK(affordable == static_cast<int>(1e6 / static_cast<double>(bytes_per_volume(256))));
    settings.budget_megabytes = 1e6;
    CHECK(volume_count(settings) == kDefaultVolumes);
    settings.budget_megabytes = 1e-9;
    CHECK(volume_count(settings) == 1);
    settings.volumes = 12345;  // a given number goes before the budget
    CHECK(volume_count(settings) == 12345);
    CHECK(bytes_per_volume(1024) > bytes_per_volume(256));
}

TEST_CASE("A light tree's clusters take their part of the budget") {
    FieldSettings settings;
    settings.budget_megabytes = 1.0;
    settings.bins = 256;
    // Per cluster: the sum of a pass in fixed point, the mean irradiance and the cumulative probability.
    CHECK(bytes_per_volume(256, 32) == bytes_per_volume(256) + 32 * (sizeof(std::int64_t) + 2 * sizeof(float)));
    CHECK(volume_count(settings, 32) == static_cast<int>(1e6 / static_cast<double>(bytes_per_volume(256, 32))));
    CHECK(volume_count(settings, 32) < volume_count(settings));
    const auto placed = static_cast<std::size_t>(volume_count(settings, 32));
    CHECK(most_refined_volumes(settings, placed, 32) == placed);
    CHECK(most_refined_volumes(settings, placed) > placed);
}

TEST_CASE("Bytes are those of the arrays") {
    SceneDescription description;
    description.materials.push_back(gray());
    add_box(description, Vec3f{-1}, Vec3f{1}, true);
    const HostScene scene = pack_scene(description);
    for (const int bins : {4, 16, 256, 1024}) {
        FieldSettings settings;
        settings.volumes = 50;
        settings.bins = bins;
        HostVolumes volumes = place_volumes(scene, settings);
        const HostTables tables = make_arrays<HostTables>(make_field_shape(scene, settings), volumes.sites.size());
        const std::size_t without_grid = bytes_per_volume(bins) - kGridBytesPerVolume;
        CHECK(volume_bytes(volumes) + field_bytes(tables) == volumes.sites.size() * without_grid);
        CHECK(volume_bytes(volumes) + field_bytes(tables) ==
              volume_bytes(volumes) + volumes.sites.size() * table_bytes(bins));
        const std::size_t before = volume_bytes(volumes);
        volumes.grid = build_volume_grid(scene, volumes, 1);
        CHECK(volume_bytes(volumes) > before);
        CHECK(volume_bytes(volumes) + field_bytes(tables) <=
              volumes.sites.size() * bytes_per_volume(bins) + scene.triangles.size() * kGridBytesPerTriangle);
    }
}

TEST_CASE("The radiance unit is the power of two at or above the brightest light") {
    CHECK(unit_for(Vec3f{0.0f}) == 1.0f);
    CHECK(unit_for(of_luminance(1.0f)) == 1.0f);
    CHECK(unit_for(of_luminance(next_float_up(1.0f))) == 2.0f);
    CHECK(unit_for(of_luminance(0.3f)) == 0.5f);
    CHECK(unit_for(of_luminance(1000.0f)) == 1024.0f);
    CHECK(unit_for(Vec3f{0.0f}, of_luminance(5.0f)) == 8.0f);
    CHECK(unit_for(of_luminance(9.0f), of_luminance(5.0f)) == 16.0f);
    // The largest training sample stays finite, and the smallest unit can be divided by.
    CHECK(unit_for(Vec3f{1e38f}) * kMaxRecordedUnits < kInfinity);
    CHECK(1.0f / unit_for(Vec3f{1e-44f}) < kInfinity);
}

TEST_CASE("Unused materials do not decide the unit") {
    SceneDescription scene;
    scene.materials = {gray(), gray()};
    scene.materials[1].emission = Vec3f{1e6f};
    add_triangle(scene, Vec3f{0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    CHECK(make_field_shape(pack_scene(scene), {}).radiance_unit == 1.0f);
}

TEST_CASE("Empty tables sample uniformly and end in exactly 1") {
    for (const int bins : {4, 9, 144, 256, 1024}) {
        FieldSettings settings;
        settings.bins = bins;
        const FieldShape shape = make_field_shape(pack_scene(SceneDescription{}), settings);
        REQUIRE(shape.cells.count() == bins);
        HostTables tables = make_arrays<HostTables>(shape, 3);
        const HostVolumes volumes;
        const TableField field = field_view(shape, volumes, tables);
        for (std::int32_t volume = 0; volume < 3; ++volume) {
            const DirectionTable table(field, volume);
            const auto side = shape.cells.side;
            CHECK(table.row_cdf[side - 1] == 1.0f);
            for (int row = 0; row < side; ++row) {
                CHECK(table.column_cdf[row * side + side - 1] == 1.0f);
                for (int column = 0; column < side; ++column)
                    REQUIRE(std::fabs(table.cell_probability(column, row) * static_cast<float>(bins) - 1.0f) < 1e-5f);
            }
        }
        CHECK(tables.mean_radiance == LargeArray<float>(3, 0.0f));
        CHECK(tables.pending_sum == LargeArray<std::int64_t>(static_cast<std::size_t>(3 * bins), 0));
    }
}
