// Emission that the camera sees, in pixels that the border of a lamp crosses.
#include "core/kernel/integrator/camera_emission.h"

#include "core/base/host_array.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/statistics/moments.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::uint32_t kSide = 3;
constexpr float kRadiance = 4.0f;
/// Share of the middle column of pixels that the lamp covers; all of the left one, nothing of the right one.
constexpr double kCovered = 0.65;

/// A lamp that only emits in the plane z = -1, left of x = `border`, before a camera that sees x from -1 to 1 there.
HostScene lamp_before_camera(float border = 0.1f) {
    SceneDescription scene;
    scene.materials = {{.name = "lamp", .emission = Vec3f{kRadiance}, .two_sided_emission = true}};
    std::uint32_t v[4];
    const Vec3f corners[] = {{-9, -9, -1}, {border, -9, -1}, {border, 9, -1}, {-9, 9, -1}};
    for (int i = 0; i < 4; ++i) v[i] = add_vertex(scene, corners[i]);
    add_quad(scene, v[0], v[1], v[2], v[3], 0);
    return pack_scene(scene);
}
CameraDescription camera_ahead() {
    return {.eye = Vec3f{0.0f}, .target = Vec3f{0.0f, 0.0f, -1.0f}, .fov_deg = 90.0f};
}

/// Film after `passes`, with or without further camera rays.
HostArray<FilmPixel> render(const HostScene& scene, std::uint64_t seed, std::uint32_t passes, bool refines) {
    const SceneView view = scene.view();
    const BvhIntersector intersector{view};
    SingleRays<FeatureSet{}, BvhIntersector> rays{view, intersector};
    const PathSettings settings{.seed = seed};
    const Camera camera = make_camera(camera_ahead(), kSide, kSide);
    HostArray<FilmPixel> pixels(kSide * kSide);
    const FilmView film{view_of(pixels), kSide, kSide};
    PathCounters counters;
    for (std::uint32_t sample = 0; sample < passes; ++sample) {
        const PixelGrid grid{kSide, kSide, sample};
        for (std::uint32_t pixel = 0; pixel < pixels.size(); ++pixel) {
            auto state = begin_path<FeatureSet{}, DefaultMethod>(camera, settings, grid, pixel);
            trace_path<FeatureSet{}>(PathContext<DefaultMethod>{view, DefaultMethod{}, settings}, intersector, state,
                                     counters);
            accumulate(film, pixel, state.radiance, sample);
            if (refines) refine_emission<FeatureSet{}>({camera, settings, grid, sample + 1}, view, rays, film, pixel);
        }
    }
    return pixels;
}

}  // namespace

TEST_CASE("Values of emission differ by more than a tenth") {
    const EmissionSeen two = EmissionSeen::of(2.0f);
    CHECK(two.luminance() == 2.0f);
    CHECK_FALSE(two.differs_from(EmissionSeen::of(2.1f)));
    CHECK_FALSE(two.differs_from(EmissionSeen::of(1.9f)));
    CHECK(two.differs_from(EmissionSeen::of(2.3f)));
    CHECK(two.differs_from(EmissionSeen::of(0.0f)));
    CHECK_FALSE(two.differs_from(EmissionSeen{}));  // nothing seen yet
    CHECK_FALSE(EmissionSeen{}.differs_from(two));
    CHECK_FALSE(EmissionSeen::of(0.0f).differs_from(EmissionSeen::of(0.0f)));
    CHECK(EmissionSeen::of(0.0f).differs_from(EmissionSeen::of(1e-20f)));
    CHECK_FALSE(EmissionSeen::of(3e38f).differs_from(EmissionSeen::of(3e38f)));
}

// Of 32 samples, seeds 1 to 400: the mean over seeds is that of the covered share by five standard errors, and the variance
// falls by more than 20.
TEST_CASE("Further camera rays keep the mean of a pixel that a lamp's border crosses, and remove its noise") {
    const HostScene scene = lamp_before_camera();
    const double truth = kCovered * static_cast<double>(kRadiance);
    Moments plain;
    Moments refined;
    Moments halves[2];
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        plain.add(static_cast<double>(mean_radiance(render(scene, seed, 32, false)[4]).x));
        const FilmPixel pixel = render(scene, seed, 32, true)[4];
        refined.add(static_cast<double>(mean_radiance(pixel).x));
        for (int half = 0; half < 2; ++half) halves[half].add(static_cast<double>(half_mean(pixel, half == 1).x));
    }
    const auto is_true = [&](const Moments& means) {
        return std::fabs(means.mean() - truth) <
               5.0 * std::sqrt(means.variance() / static_cast<double>(means.count()));
    };
    CHECK(is_true(plain));
    CHECK(is_true(refined));
    CHECK(is_true(halves[0]));
    CHECK(is_true(halves[1]));
    CHECK(20.0 * refined.variance() < plain.variance());
}

// A random ray would see so thin a part of a lamp, or so thin a gap beside it, once in 250 times.
TEST_CASE("A lamp's border near the edge of a pixel is found in the third pass") {
    for (const float covered : {0.004f, 0.996f}) {
        const HostScene scene = lamp_before_camera((2.0f * covered - 1.0f) / 3.0f);
        for (std::uint64_t seed = 1; seed <= 50; ++seed) CHECK(render(scene, seed, 3, true)[4].emission.varies == 1);
    }
}

TEST_CASE("Pixels that no border of a lamp crosses keep every bit") {
    const HostScene scene = lamp_before_camera();
    const HostArray<FilmPixel> plain = render(scene, 7, 16, false);
    const HostArray<FilmPixel> refined = render(scene, 7, 16, true);
    for (const std::size_t row : {0u, 1u, 2u}) {
        CHECK(refined[kSide * row + 1].emission.varies == 1);
        for (const std::size_t column : {0u, 2u}) {
            CHECK(refined[kSide * row + column].emission.varies == 0);
            CHECK(refined[kSide * row + column].sum == plain[kSide * row + column].sum);
            CHECK(refined[kSide * row + column].second_sum == plain[kSide * row + column].second_sum);
        }
    }
}
