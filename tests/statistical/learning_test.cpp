// What learning is for: fewer paths without light, and less noise from the same number of samples. These compare
// noise levels, so the means are not judged here.
#include "tests/catch.hpp"
#include "tests/statistical/sessions.h"
#include "tests/statistical/shipped_scenes.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kSide = 128;
constexpr std::uint32_t kSamples = 64;

struct Outcome {
    std::vector<Vec3f> pixels;
    double zero_share = 0.0;  ///< of paths that brought no light
};

Outcome render(const SceneDescription& scene, Estimator estimator, std::uint64_t seed) {
    RenderSettings settings = settings_for(scene, estimator, kSide, kSide);
    settings.seed = seed;
    Session session = make_session(scene, settings);
    render_passes(session, kSamples);
    Snapshot snapshot = session.snapshot();
    return {std::move(snapshot.pixels), static_cast<double>(snapshot.counters.zero_contribution_paths) /
                                            static_cast<double>(snapshot.counters.paths)};
}

/// Mean squared error in luminance, from two independent renderings of which neither is the truth.
double mean_squared_error(const Outcome& a, const Outcome& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        sum += 0.5 * std::pow(static_cast<double>(luminance(a.pixels[i]) - luminance(b.pixels[i])), 2);
    return sum / static_cast<double>(a.pixels.size());
}

}  // namespace

// 64 samples of 128 x 128 pixels, seeds 1 and 2.
TEST_CASE("Guided methods have less noise than default path tracing on the door ajar") {
    const SceneDescription scene = shipped_scene("door");
    const Outcome plain = render(scene, {MethodId::Default, false}, 1);
    const double plain_error = mean_squared_error(plain, render(scene, {MethodId::Default, false}, 2));
    for (const MethodId method : {MethodId::Precomputed, MethodId::Reinforcement}) {
        const Outcome guided = render(scene, {method, false}, 1);
        const double error = mean_squared_error(guided, render(scene, {method, false}, 2));
        WARN(info_of(method).name << ": error of default " << plain_error / error
                                  << " times as large, paths without light " << guided.zero_share << " against "
                                  << plain.zero_share);
        CHECK(error < plain_error / 3.0);
        // A map that does not learn from what it brings leaves half to the BSDF, and so more paths in the dark.
        CHECK(guided.zero_share <= plain.zero_share / (info_of(method).learns ? 5.0 : 2.0));
    }
}
