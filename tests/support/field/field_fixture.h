// Learned fields of a few volumes, filled by hand.
#pragma once

#include <algorithm>
#include <functional>

#include "core/fields/place_volumes.h"
#include "core/fields/table_model.h"
#include "core/kernel/guiding/direction_table.h"
#include "core/kernel/guiding/update_volume.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

/// Field whose volumes stand at the origin and look along given normals.
struct TestField {
    FieldShape shape;
    HostVolumes volumes;
    HostTables tables;

    explicit TestField(int side, const std::vector<Vec3f>& normals = {Vec3f{0, 0, 1}}) : shape{.cells = {side}} {
        for (const Vec3f normal : normals) {
            SurfacePoint site;
            site.geometric_normal = site.shading_normal = normal;
            volumes.sites.push_back(site);
            volumes.normals.push_back(normal);
        }
        volumes.kd_nodes = build_kd_tree(view_of(std::as_const(volumes.sites)));
        tables = make_arrays<HostTables>(shape, normals.size());
    }

    TableField view() { return field_view(shape, volumes, tables); }
    TableUpdateView update_view() { return pl::update_view(shape, tables); }
    DirectionTable table(std::int32_t volume = 0) { return DirectionTable(view(), volume); }

    /// Sampling tables of a volume made of weights, [row][column], without the uniform share of an update.
    void set_weights(const std::vector<float>& weights, std::size_t volume = 0) {
        const auto side = static_cast<std::size_t>(shape.cells.side);
        float* columns = tables.column_cdf.data() + volume * side * side;
        float* rows = tables.row_cdf.data() + volume * side;
        std::copy(weights.begin(), weights.end(), columns);
        for (std::size_t row = 0; row < side; ++row)
            rows[row] = accumulate_cdf(columns + row * side, shape.cells.side);
        accumulate_cdf(rows, shape.cells.side);
    }

    void update() {
        for (std::uint32_t volume = 0; volume < volumes.sites.size(); ++volume) update_volume(update_view(), volume);
    }
};

struct NamedWeights {
    const char* name;
    std::vector<float> weights;
};

/// Tables made to be hard: almost all zero, jumping between neighbours, covering many orders of magnitude.
inline std::vector<NamedWeights> hard_weights(int side) {
    Uniforms random(7);
    const auto fill = [side](const std::function<float(int, int)>& weight) {
        std::vector<float> weights;
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) weights.push_back(weight(row, column));
        return weights;
    };
    const auto one_hot = [&](int hot_row, int hot_column) {
        return fill([=](int row, int column) { return row == hot_row && column == hot_column ? 1.0f : 0.0f; });
    };
    return {
        {"uniform", fill([](int, int) { return 1.0f; })},
        {"random", fill([&](int, int) { return random.next(); })},
        {"one cell in the middle", one_hot(side / 2, side / 2)},
        {"one cell in the corner", one_hot(0, 0)},
        {"one cell at the last edge", one_hot(side - 1, side / 3)},
        {"checkerboard", fill([](int row, int column) { return static_cast<float>((row + column) % 2); })},
        {"zeros first and last", fill([side](int row, int column) {
             return row == 0 || row == side - 1 || column == 0 || column == side - 1 ? 0.0f : 1.0f;
         })},
        {"one row", fill([side](int row, int) { return row == side - 1 ? 1.0f : 0.0f; })},
        {"runs of zeros", fill([&](int, int) { return random.below(4) == 0 ? random.next() : 0.0f; })},
        {"eight orders of magnitude", fill([&](int, int) { return std::pow(10.0f, random.between(-6, 2)); })},
        {"nothing learned", fill([](int, int) { return 0.0f; })},
    };
}

}  // namespace pl::test
