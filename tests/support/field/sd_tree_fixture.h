// An SD-tree that is trained by hand.
#pragma once

#include "core/fields/place_volumes.h"
#include "core/fields/sd_tree_model.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

/// A training sample at a point, of a direction that was sampled with a density.
struct HandSample {
    Vec3f position;
    Vec3f wi;
    float pdf_sa;
    float target;
};

/// One volume at the origin, which looks up and serves all points; the tree divides [-1,1]^3.
struct TestTree {
    FieldShape shape{.cells = {8},
                     .representation = Representation::SdTree,
                     .corner = Vec3f{-1.0f},
                     .edge = 2.0f,
                     .most_nodes = 1u << 20};
    HostVolumes volumes;
    HostSdTree tree;

    TestTree() {
        SurfacePoint site;
        site.geometric_normal = site.shading_normal = {0.0f, 0.0f, 1.0f};
        volumes.sites = {site};
        volumes.normals = {site.geometric_normal};
        volumes.kd_nodes = build_kd_tree(view_of(std::as_const(volumes.sites)));
        tree = make_arrays<HostSdTree>(shape, 1);
    }

    SdTreeField view() { return field_view(shape, volumes, tree); }
    std::uint32_t leaves() const { return static_cast<std::uint32_t>(tree.first_node.size()); }
    std::size_t nodes() const { return tree.energy.size() / 4; }

    static SurfacePoint point_at(Vec3f position) {
        SurfacePoint point;
        point.position = position;
        point.geometric_normal = point.shading_normal = {0.0f, 0.0f, 1.0f};
        return point;
    }
    void record(const HandSample& sample) {
        const SdTreeField field = view();
        const SdTreeLocation location = field.locate(point_at(sample.position));
        const std::int32_t bin = field.density(location, {}, sample.wi).bin;
        const DirectionSample direction{.wi = sample.wi, .pdf_sa = sample.pdf_sa, .bsdf_pdf_sa = 0.3f, .bin = bin};
        field.record({{field.entry_of(location, direction), 0.3f / sample.pdf_sa}, sample.target}, true);
    }
    void update(int threads = 1) { SdTreeModel::update(shape, volumes, tree, threads); }

    friend bool operator==(const TestTree& a, const TestTree& b) {
        bool same = true;
        zip(a.tree, b.tree, [&](const auto& x, const auto& y) { same = same && x == y; });
        return same;
    }
};

/// Radiance with a peak, whose direction turns with the position.
inline float peaked_radiance(Vec3f position, Vec3f wi) {
    const Vec3f towards = glm::normalize(Vec3f{0.2f, 0.1f, 1.5f} - position);
    const float cosine = max_of(glm::dot(towards, wi), 0.0f);
    return 0.05f + 20.0f * std::pow(cosine, 20.0f);
}

/// Uniform directions at uniform points of the cube.
inline std::vector<HandSample> hand_samples(std::uint32_t count, std::uint64_t seed) {
    Uniforms random(seed);
    std::vector<HandSample> samples;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3f position = random.cube(-1.0f, 1.0f);
        const Vec3f wi = square_to_sphere(random.square());
        samples.push_back({position, wi, kUniformSpherePdf, peaked_radiance(position, wi)});
    }
    return samples;
}

/// Trained in rounds, with an update after each.
inline TestTree trained_tree(int threads = 1, int rounds = 4, std::uint32_t count = 20000) {
    TestTree tree;
    for (int round = 0; round < rounds; ++round) {
        for (const HandSample& sample : hand_samples(count, static_cast<std::uint64_t>(round + 1)))
            tree.record(sample);
        tree.update(threads);
    }
    return tree;
}

}  // namespace pl::test
