// A network for vertices over volumes on a plane, taught by tables that have learned parts of a light by hand.
#pragma once

#include "cpu/neural_vertex_update.h"
#include "tests/support/field/neural_fixture.h"

namespace pl::test {

struct TestNeuralVertex {
    TestNeural plane;  ///< its volumes, light and tables; not its network
    HostNeuralVertex field;

    explicit TestNeuralVertex(int side = 16) : plane(side) {
        plane.shape.representation = Representation::NeuralVertex;
        field = make_neural_vertex(plane.shape, plane.volumes.sites.size());
    }

    NeuralVertexField view() { return field_view(plane.shape, plane.volumes, field); }
    void update(int threads = 1) {
        plane.update_tables();
        static_cast<HostTables&>(field) = plane.tables();
        update_vertex_network(plane.shape, plane.volumes, field, threads);
    }
    /// Rounds of training samples with an update after each.
    void train(int rounds, int threads = 1) {
        for (int round = 0; round < rounds; ++round) {
            plane.record(static_cast<std::uint64_t>(round + 1));
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
        const NeuralVertexField field_of_view = view();
        const VertexMixture mixture = mixture_of_volume(field_of_view, volume);
        const DirectionCells cells = plane.shape.cells;
        double total = 0.0;
        for (int cell = 0; cell < cells.count(); ++cell) total += static_cast<double>(plane.light_of(volume, cell));
        double sum = 0.0;
        for (int cell = 0; cell < cells.count(); ++cell) {
            const double truth = static_cast<double>(plane.light_of(volume, cell)) / total;
            const Vec3f local = square_to_cosine_hemisphere(cells.point_in_cell(cell, Vec2f{0.5f}));
            const double relative = static_cast<double>(relative_density(field_of_view, volume, mixture, local));
            sum += truth * std::log(truth * cells.count() / relative);
        }
        return sum;
    }
    /// Mean over the volumes that are, or are not, held out.
    double mean_divergence(bool held_out) {
        double sum = 0.0;
        int taken = 0;
        for (std::uint32_t volume = 0; volume < plane.count(); ++volume) {
            if (TestNeural::is_held_out(volume) != held_out) continue;
            sum += divergence(volume);
            ++taken;
        }
        return sum / taken;
    }
};

}  // namespace pl::test
