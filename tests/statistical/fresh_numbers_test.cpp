// Pictures of learners against closed forms, over many seeds, while their tables change: numbers that depend on what the tables were
// trained by show as a bias, which grows with the samples (docs/notebook/2026-11-29-fresh-numbers.md).
#include "tests/support/catch.hpp"
#include "tests/support/scenes/image_scenes.h"
#include "tests/support/scenes/rectangle_light.h"
#include "tests/support/session/sessions.h"

using namespace pl;
using namespace pl::test;

namespace {

struct KnownScene {
    const char* name;
    SceneDescription scene;
    double radiance = 0.0;  ///< of every pixel
};

/// Radiance of a plane under a sky: the sky's mean over the azimuth is linear between the middles of rows.
double radiance_under(const EnvironmentMapDescription& sky, double albedo) {
    constexpr int kSteps = 100'000;
    constexpr double kHalfTurn = 3.14159265358979324;
    const auto mean_of_row = [&](std::uint32_t row) {
        double sum = 0.0;
        for (std::uint32_t i = 0; i < sky.width; ++i) sum += static_cast<double>(sky.texels[row * sky.width + i].x);
        return sum / sky.width;
    };
    double radiance = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double angle = 0.5 * kHalfTurn * (i + 0.5) / kSteps;
        const double at = std::max(angle / kHalfTurn * sky.height - 0.5, 0.0);
        const auto row = static_cast<std::uint32_t>(at);
        const double part = at - row;
        radiance += ((1.0 - part) * mean_of_row(row) + part * mean_of_row(row + 1)) * std::sin(2.0 * angle);
    }
    return albedo * radiance * 0.5 * kHalfTurn / kSteps;
}

/// A plane under a dark sky with a bright patch, which it alone sees.
KnownScene plane_under_patch() {
    KnownScene known{"patch", plane_scene(0.5f)};
    known.scene.camera.fov_deg = 10.0f;
    EnvironmentMapDescription& sky = known.scene.environment_map;
    sky = {.width = 64, .height = 32, .texels = std::vector(64 * 32, glm::vec3(0.05f))};
    for (std::size_t row = 4; row < 8; ++row)
        for (std::size_t column = 10; column < 14; ++column) sky.texels[row * 64 + column] = glm::vec3(40.0f);
    known.radiance = radiance_under(sky, 0.5);
    return known;
}

/// A floor under a lamp that is a strip.
KnownScene floor_under_strip() {
    const LampOverFloor lamp = lamp_strip();
    return {"strip", lamp.scene, lamp.floor_radiance};
}

/// All emits and reflects; pixels see other places of it.
KnownScene furnace() { return {"furnace", furnace_scene(0.5f, 0.5f), 1.0}; }

struct Learner {
    const char* name;
    Representation representation;
    bool next_event;
    GuidingRule guiding = GuidingRule::Always;
};

constexpr Learner kLearners[] = {{"table", Representation::Table, false},
                                 {"table", Representation::Table, true},
                                 {"table", Representation::Table, true, GuidingRule::Paying},
                                 {"sd-tree", Representation::SdTree, false},
                                 {"sd-tree", Representation::SdTree, true},
                                 {"lobes", Representation::Lobes, false},
                                 {"lobes", Representation::Lobes, true},
                                 {"neural", Representation::Neural, false},
                                 {"neural", Representation::Neural, true}};

struct Effort {
    int side;  ///< of the picture
    std::uint32_t passes;
    std::uint64_t seeds;
    double delta;  ///< relative difference that is resolved
};

/// Rule S1 on the means of pictures, one for each seed.
Decision judge(const KnownScene& known, const Learner& learner, const Effort& effort) {
    Moments means;
    for (std::uint64_t seed = 1; seed <= effort.seeds; ++seed) {
        RenderSettings settings =
            settings_for(known.scene, {MethodId::Reinforcement, learner.next_event}, effort.side, effort.side);
        settings.seed = seed;
        settings.guiding = learner.guiding;
        settings.field.representation = learner.representation;
        Session session = make_session(known.scene, settings);
        render_passes(session, effort.passes);
        const Snapshot snapshot = session.snapshot(slot_of(session));
        CHECK(snapshot.counters.invalid_samples == 0);
        Moments pixels;
        for (const Vec3f& pixel : snapshot.pixels) pixels.add(static_cast<double>(pixel.x + pixel.y + pixel.z) / 3.0);
        means.add(pixels.mean());
    }
    return mean_equals(means, {known.radiance, 1.0e-6}, effort.delta);
}

void check(const KnownScene& known, const Learner& learner, const Effort& effort) {
    INFO(known.name << ", " << learner.name << (learner.next_event ? ", light samples" : "")
                    << (learner.guiding == GuidingRule::Paying ? ", as chosen" : ""));
    CHECK(judge(known, learner, effort));
}

}  // namespace

bool has_table_or_lobes(const Learner& learner) { return learner.representation != Representation::Neural; }

/// 0.02 % are five standard errors.
constexpr double kNightly = 0.0002 / 5.0 * (kZAlpha + kZBeta);

/// Passes by which 64 pictures of 64 x 64 pixels resolve 0.1 % under a patch.
std::uint32_t passes_for(const Learner& learner) {
    if (learner.next_event) return 48;
    return learner.representation == Representation::SdTree ? 288 : 96;
}

/// Seeds by which pictures of 64 x 64 pixels after 256 passes resolve 0.02 % under a patch.
std::uint64_t seeds_for(const Learner& learner) {
    return learner.representation == Representation::SdTree && !learner.next_event ? 500 : 320;
}

// Seeds 1 to 64, alpha 1e-6 per decision. An SD-tree was off by 0.3 % after 256 passes while its numbers went on through updates. The
// network, which is slower, is in the nightly tier.
TEST_CASE("Pictures of learners under a bright patch have no bias of 0.1 % while tables change") {
    const KnownScene patch = plane_under_patch();
    for (const Learner& learner : kLearners)
        if (has_table_or_lobes(learner)) check(patch, learner, {64, passes_for(learner), 64, 0.001});
}
TEST_CASE("Pictures of learners under a bright patch have no bias of 0.02 % while tables change", "[nightly]") {
    const KnownScene patch = plane_under_patch();
    for (const Learner& learner : kLearners) check(patch, learner, {64, 256, seeds_for(learner), kNightly});
}

// 12 x 12 pixels: a pixel's own samples are a large part of those that train its tables. Seeds 1 to 100, in the nightly tier 1 to 600
// and, for the strip, whose pictures are noisier, 1 to 3000.
TEST_CASE("Small pictures of learners in a furnace have no bias of 0.1 % while tables change") {
    for (const Learner& learner : {kLearners[0], kLearners[3], kLearners[5]})
        check(furnace(), learner, {12, 256, 100, 0.001});
}
TEST_CASE("Small pictures of learners in a furnace and under a strip of light have no bias of 0.02 %", "[nightly]") {
    for (const Learner& learner : {kLearners[0], kLearners[3], kLearners[5]}) {
        check(furnace(), learner, {12, 256, 600, kNightly});
        check(floor_under_strip(), learner, {12, 1024, 3000, kNightly});
    }
}
