// Tables of volumes on a plane that have learned parts of a light by hand, and the network that they teach.
#pragma once

#include "core/fields/neural_model.h"
#include "core/fields/place_volumes.h"
#include "cpu/learning/field_update.h"
#include "cpu/learning/neural_update.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

/// Light that moves over the hemisphere with the place: a peak, in a faint surrounding.
inline float moving_light(Vec3f position, Vec2f square) {
    const Vec2f peak{0.2f + 0.6f * position.x, 0.7f - 0.4f * position.y};
    const Vec2f off = square - peak;
    return 0.2f + 8.0f * std::exp(-30.0f * glm::dot(off, off));
}

/// kRows x kRows volumes on the unit square of the plane z = 0, facing +z.
struct TestNeural {
    static constexpr int kRows = 24;

    FieldShape shape;
    HostVolumes volumes;
    HostNeural field;

    explicit TestNeural(int side = 16) {
        shape = {.cells = {side}, .radiance_unit = 16.0f, .extent = 2.0f, .representation = Representation::Neural};
        for (int i = 0; i < kRows * kRows; ++i) {
            SurfacePoint site;
            site.position = Vec3f{i % kRows, i / kRows, 0} / static_cast<float>(kRows - 1);
            site.geometric_normal = site.shading_normal = {0.0f, 0.0f, 1.0f};
            volumes.sites.push_back(site);
            volumes.normals.push_back(site.geometric_normal);
        }
        volumes.kd_nodes = build_kd_tree(view_of(std::as_const(volumes.sites)));
        field = make_arrays<HostNeural>(shape, volumes.sites.size());
    }

    std::uint32_t count() const { return static_cast<std::uint32_t>(volumes.sites.size()); }
    HostTables& tables() { return field; }
    NeuralField view() { return field_view(shape, volumes, field); }
    /// One volume in seven has no training samples.
    static bool is_held_out(std::uint32_t volume) { return volume % 7 == 3; }

    float light_of(std::uint32_t volume, int cell) const {
        return moving_light(volumes.sites[volume].position, shape.cells.point_in_cell(cell, Vec2f{0.5f}));
    }
    /// A few training samples of each volume that is not held out, in cells by chance.
    void record(std::uint64_t seed, int samples = 12) {
        Uniforms random(seed);
        const auto cells = static_cast<std::uint32_t>(shape.cells.count());
        for (std::uint32_t volume = 0; volume < count(); ++volume)
            for (int i = 0; i < samples; ++i) {
                const std::uint32_t cell = random.below(cells);
                if (is_held_out(volume)) continue;
                const float light = light_of(volume, static_cast<int>(cell));
                field.pending_sum[volume * cells + cell] += to_fixed_point(light, shape.radiance_unit);
                ++field.pending_count[volume * cells + cell];
            }
    }
    void update_tables() {
        for (std::uint32_t volume = 0; volume < count(); ++volume)
            update_volume(update_view(shape, tables()), volume);
    }
    void update(int threads = 1) {
        update_tables();
        update_network(shape, volumes, field, threads);
    }
    /// Rounds of training samples with an update after each.
    void train(int rounds, int threads = 1) {
        for (int round = 0; round < rounds; ++round) {
            record(static_cast<std::uint64_t>(round + 1));
            update(threads);
        }
    }

    static SurfacePoint point_at(Vec3f position, Vec3f normal = {0.0f, 0.0f, 1.0f}) {
        SurfacePoint point;
        point.position = position;
        point.geometric_normal = {0.0f, 0.0f, 1.0f};
        point.shading_normal = glm::normalize(normal);
        return point;
    }

    /// Kullback-Leibler divergence of the mixture at the site of a volume from the light of its cells.
    double divergence(std::uint32_t volume) {
        const NeuralField field_of_view = view();
        const VertexMixture mixture = mixture_of_volume(field_of_view, volume);
        const DirectionCells cells = shape.cells;
        double total = 0.0;
        for (int cell = 0; cell < cells.count(); ++cell) total += static_cast<double>(light_of(volume, cell));
        double sum = 0.0;
        for (int cell = 0; cell < cells.count(); ++cell) {
            const double truth = static_cast<double>(light_of(volume, cell)) / total;
            const Vec3f local = square_to_cosine_hemisphere(cells.point_in_cell(cell, Vec2f{0.5f}));
            const double relative = static_cast<double>(relative_density(field_of_view, volume, mixture, local));
            sum += truth * std::log(truth * cells.count() / relative);
        }
        return sum;
    }
    /// Mean over the volumes that are, or are not, held out.
    double mean_divergence(bool held_out) {
        double sum = 0.0;
        int volumes_taken = 0;
        for (std::uint32_t volume = 0; volume < count(); ++volume) {
            if (is_held_out(volume) != held_out) continue;
            sum += divergence(volume);
            ++volumes_taken;
        }
        return sum / volumes_taken;
    }
};

}  // namespace pl::test
