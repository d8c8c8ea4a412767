// Paths by batches: the picture of the method `default` to the bit, and the right mean by a sampler from outside.
#include "core/diagnose/batch_tracer.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/error.h"
#include "core/kernel/base/warp.h"
#include "core/scene/pack_scene.h"
#include "core/session/path_settings.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/sessions.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::diagnose;
using namespace pl::test;

namespace {

BatchTracer tracer_of(const SceneDescription& scene, const RenderSettings& settings) {
    return {std::make_shared<const HostScene>(pack_scene(scene)),
            make_camera(settings.camera, settings.width, settings.height), settings.width, settings.height,
            path_settings(settings, MethodId::Default)};
}

/// All directions alike, whatever the surface. `stated` times its density is what it says.
DirectionSampler uniform_sampler(float bsdf_fraction, float stated = 1.0f) {
    constexpr float kDensity = 0.25f * kInvPi;
    return {
        .sample =
            [](std::span<const PathVertex> vertices) {
                std::vector<Vec3f> directions;
                for (const PathVertex& vertex : vertices) {
                    const float z = 1.0f - 2.0f * vertex.uniforms.x;
                    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
                    const float angle = 2.0f * kPi * vertex.uniforms.y;
                    directions.push_back({r * std::cos(angle), r * std::sin(angle), z});
                }
                return directions;
            },
        .pdf = [stated](std::span<const PathVertex> vertices,
                        std::span<const Vec3f>) { return std::vector<float>(vertices.size(), stated * kDensity); },
        .bsdf_fraction = bsdf_fraction};
}

struct MeanAndError {
    double mean = 0.0;
    double error = 0.0;  ///< standard error
};

template <class Values, class Of>
MeanAndError mean_over(const Values& values, Of&& of) {
    double sum = 0.0;
    double squares = 0.0;
    for (const auto& value : values) {
        sum += of(value);
        squares += of(value) * of(value);
    }
    const auto n = static_cast<double>(std::size(values));
    const double mean = sum / n;
    return {mean, std::sqrt((squares / n - mean * mean) / (n - 1.0))};
}

double red(const FilmPixel& pixel) { return static_cast<double>(mean_radiance(pixel).x); }

}  // namespace

TEST_CASE("Batch tracer: without a sampler the first pass has the bits of the method default") {
    for (const char* name : {"cornell", "spheres", "sky"})
        for (const bool light_samples : {false, true}) {
            const SceneDescription scene = shipped_scene(name);
            RenderSettings settings = small_settings(scene, {MethodId::Default, light_samples});
            Session session = make_session(scene, settings);
            render_passes(session, 1);
            BatchTracer tracer = tracer_of(scene, session.settings());
            tracer.trace();
            std::vector<Vec3f> pixels;
            for (const FilmPixel& pixel : tracer.film()) pixels.push_back(mean_radiance(pixel));
            INFO(name << (light_samples ? ", light samples" : ""));
            CHECK(same_bits(pixels, session.snapshot(slot_of(session)).pixels));
        }
}

// In equilibrium everything shows radiance 1, and any direction brings 1. Seed 1, 96 x 64 pixels of 16 samples, 5 standard errors (6e-7):
// an error of 5 % is seen in every case (standard error below 1 %). Twice the density halves what the sampler's share brings.
TEST_CASE("Batch tracer: any sampler gives the right mean, and a wrong density does not") {
    const SceneDescription scene = in_equilibrium(shipped_scene("door"));
    for (const bool light_samples : {false, true})
        for (const float fraction : {0.4f, 0.7f}) {
            RenderSettings settings{.width = 96, .height = 64, .camera = scene.camera, .next_event = light_samples};
            const auto film_mean = [&](float stated) {
                BatchTracer tracer = tracer_of(scene, settings);
                for (int pass = 0; pass < 16; ++pass) tracer.trace(uniform_sampler(fraction, stated));
                return mean_over(tracer.film(), red);
            };
            const MeanAndError right = film_mean(1.0f);
            INFO("light samples " << light_samples << ", BSDF " << fraction << ": " << right.mean << " +- "
                                  << right.error);
            CHECK(right.error < 0.01);
            CHECK(std::fabs(right.mean - 1.0) < 5.0 * right.error);
            const MeanAndError wrong = film_mean(2.0f);
            CHECK(std::fabs(wrong.mean - 1.0) > 5.0 * wrong.error);
        }
}

// As above: incident radiance is 1 from everywhere, in the mean over how paths go on. 8 samples: an error of 13 % is seen.
TEST_CASE("Batch tracer: vertices carry what their path brings back") {
    const SceneDescription scene = in_equilibrium(shipped_scene("door"));
    const RenderSettings settings{.width = 96, .height = 64, .camera = scene.camera, .next_event = false};
    BatchTracer tracer = tracer_of(scene, settings);
    std::vector<PathVertex> vertices;
    for (int pass = 0; pass < 8; ++pass)
        std::ranges::copy_if(tracer.trace(uniform_sampler(0.5f)), std::back_inserter(vertices),
                             [](const PathVertex& vertex) { return vertex.depth == 0; });
    CHECK(vertices.size() > 8 * 6000);  // paths that reach the black lamp end there
    for (const PathVertex& vertex : vertices) {
        REQUIRE(vertex.throughput == Vec3f{1.0f});
        REQUIRE(std::fabs(glm::length(vertex.outgoing) - 1.0f) < 1e-5f);
        REQUIRE(glm::dot(vertex.outgoing, vertex.normal) > 0.0f);
        REQUIRE(vertex.pixel < 96u * 64u);
    }
    std::erase_if(vertices, [](const PathVertex& vertex) { return vertex.pdf == 0.0f; });
    for (const PathVertex& vertex : vertices) {
        const float cosine = std::max(glm::dot(vertex.direction, vertex.normal), 0.0f);
        REQUIRE(vertex.pdf == Approx(0.5f * kInvPi * cosine + 0.125f * kInvPi).epsilon(1e-4));
    }
    const MeanAndError incident =
        mean_over(vertices, [](const PathVertex& vertex) { return static_cast<double>(vertex.incident.x); });
    CHECK(incident.error < 0.025);
    CHECK(std::fabs(incident.mean - 1.0) < 5.0 * incident.error);
}

TEST_CASE("Batch tracer: a direction whose density is 0 is refused, and the film stays") {
    const SceneDescription scene = shipped_scene("door");
    const RenderSettings settings{.width = 16, .height = 16, .camera = scene.camera};
    BatchTracer tracer = tracer_of(scene, settings);
    CHECK_THROWS_AS(tracer.trace(uniform_sampler(0.5f, 0.0f)), Error);
    CHECK(tracer.passes() == 0);
    for (const FilmPixel& pixel : tracer.film()) REQUIRE(pixel.weight == 0);
}
