// A mixture of lobes that is trained by hand.
#pragma once

#include "core/fields/mixture_fit.h"
#include "core/fields/place_volumes.h"
#include "tests/support/scenes/shapes.h"

namespace pl::test {

/// A training sample at a point of the surface z = 0, of a direction that was sampled with a density.
struct LobeSample {
    Vec3f wi;
    float pdf_sa;
    float target;
    Vec3f position{0.0f};
    float distance = 0.0f;
};

/// One volume at the origin, which looks up and serves all points; its normal is +z, so that its frame is the world's.
struct TestLobes {
    FieldShape shape{.cells = {8}, .extent = 2.0f, .representation = Representation::Lobes};
    HostVolumes volumes;
    HostLobes lobes;

    TestLobes() {
        volumes.sites = {point_at(Vec3f{0.0f})};
        volumes.normals = {volumes.sites[0].geometric_normal};
        volumes.kd_nodes = build_kd_tree(view_of(std::as_const(volumes.sites)));
        lobes = make_arrays<HostLobes>(shape, 1);
    }

    LobeField view() { return field_view(shape, volumes, lobes); }
    LobeLocation at(Vec3f position = Vec3f{0.0f}) { return view().locate(point_at(position)); }

    static SurfacePoint point_at(Vec3f position) {
        SurfacePoint point;
        point.position = position;
        point.geometric_normal = point.shading_normal = {0.0f, 0.0f, 1.0f};
        return point;
    }
    void record(const LobeSample& sample) {
        const LobeField field = view();
        const LobeLocation location = field.locate(point_at(sample.position));
        const std::int32_t bin = field.density(location, {}, sample.wi).bin;
        const DirectionSample direction{.wi = sample.wi, .pdf_sa = sample.pdf_sa, .bsdf_pdf_sa = 0.3f, .bin = bin};
        field.record({{field.entry_of(location, direction), 0.3f / sample.pdf_sa, sample.distance}, sample.target},
                     true);
    }
    void update(int threads = 1) { LobeModel::update(shape, volumes, lobes, threads); }

    friend bool operator==(const TestLobes& a, const TestLobes& b) {
        bool same = true;
        zip(a.lobes, b.lobes, [&](const auto& x, const auto& y) { same = same && x == y; });
        return same;
    }
};

/// The two peaks of the light that fixtures learn.
inline const Vec3f kSharpPeak = glm::normalize(Vec3f{0.5f, 0.2f, 0.8f});
inline const Vec3f kWidePeak = glm::normalize(Vec3f{-0.6f, 0.3f, 0.5f});

inline float two_peaks(Vec3f wi) {
    return 0.05f + 40.0f * std::exp(200.0f * (glm::dot(wi, kSharpPeak) - 1.0f)) +
           2.0f * std::exp(8.0f * (glm::dot(wi, kWidePeak) - 1.0f));
}

/// Uniform directions above the surface.
inline std::vector<LobeSample> lobe_samples(std::uint32_t count, std::uint64_t seed) {
    Uniforms random(seed);
    std::vector<LobeSample> samples;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3f wi = square_to_sphere({0.5f + 0.5f * random.next(), random.next()});
        samples.push_back({wi, 2.0f * kUniformSpherePdf, two_peaks(wi)});
    }
    return samples;
}

/// Trained in rounds, with an update after each.
inline TestLobes trained_lobes(int threads = 1, int rounds = 16, std::uint32_t count = 2000) {
    TestLobes lobes;
    for (int round = 0; round < rounds; ++round) {
        for (const LobeSample& sample : lobe_samples(count, static_cast<std::uint64_t>(round + 1)))
            lobes.record(sample);
        lobes.update(threads);
    }
    return lobes;
}

}  // namespace pl::test
