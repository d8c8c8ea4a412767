// Surfaces that absorb nothing under an even sky: whatever directions they scatter to, their radiance is the sky's. Glass is
// invisible, pixel by pixel; rough surfaces are on the mean.
#include "core/scene/surface_info.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"
#include "tests/support/session/sessions.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A block that fills most of the picture, under a sky of radiance 1: of the first of some materials.
SceneDescription block_under_sky(std::vector<MaterialDescription> materials) {
    SceneDescription scene;
    scene.name = "block";
    scene.materials = std::move(materials);
    add_box(scene, Vec3f{-1.0f, -0.7f, -1.2f}, Vec3f{1.0f, 0.9f, 0.8f}, false);
    scene.environment = Vec3f{1.0f};
    scene.camera = {.eye = {1.9f, 1.6f, 3.1f}, .target = {0.0f, 0.0f, 0.0f}, .fov_deg = 40.0f};
    return scene;
}

MaterialDescription lossless(SurfaceKind kind, float roughness) {
    MaterialDescription material;
    material.name = "lossless";
    material.kind = kind;
    material.roughness = roughness;
    material.albedo = glm::vec3{kind == SurfaceKind::Plastic ? 1.0f : 0.0f};
    return material;
}

constexpr int kSide = 48;

std::vector<Vec3f> picture_of(std::vector<MaterialDescription> materials, Estimator estimator, std::uint32_t passes) {
    const SceneDescription scene = block_under_sky(std::move(materials));
    Session session = make_session(scene, quick_learner(scene, estimator, kSide, 1));
    render_passes(session, passes);
    return session.snapshot(slot_of(session)).pixels;
}

std::vector<MaterialDescription> lossless_blend() {
    std::vector<MaterialDescription> materials{lossless(SurfaceKind::Conductor, 0.0f),
                                               lossless(SurfaceKind::Pane, 0.0f), gray(1.0f)};
    materials[0].blend = {.other = 1, .share = 0.6f};
    materials[1].blend = {.other = 2, .share = 0.5f};
    return materials;
}

int wrong_values(const std::vector<Vec3f>& picture) {
    int wrong = 0;
    for (const Vec3f& pixel : picture)
        for (int c = 0; c < 3; ++c) wrong += std::fabs(pixel[c] - 1.0f) < 2e-5f ? 0 : 1;
    return wrong;
}

}  // namespace

// Each interface rounds some ten times, a path through the block meets a few.
TEST_CASE("Clear glass, thin panes and perfect mirrors cannot be seen under an even sky") {
    for (const SurfaceKind kind : {SurfaceKind::Dielectric, SurfaceKind::Pane, SurfaceKind::Conductor})
        for (const Estimator estimator : kEstimators) {
            INFO(name_of(kind) << ", " << estimator);
            CHECK(wrong_values(picture_of({lossless(kind, 0.0f)}, estimator, 4)) == 0);
        }
}

TEST_CASE("A blend of a perfect mirror, a thin pane and a white wall cannot be seen under an even sky") {
    for (const Estimator estimator : {kEstimators[0], kEstimators[1]}) {
        INFO(estimator);
        CHECK(wrong_values(picture_of(lossless_blend(), estimator, 4)) == 0);
    }
}

namespace {

/// S1 on the mean over the block's pixels, of 64 passes as independent batches: tables of directional albedos are off by
/// less than 0.05 %, an error of 2 % would be found.
void check_that_nothing_is_lost(const std::vector<MaterialDescription>& materials) {
    for (const Estimator estimator : {kEstimators[0], kEstimators[2], kEstimators[5]}) {
        const SceneDescription scene = block_under_sky(materials);
        Session session = make_session(scene, quick_learner(scene, estimator, kSide, 1));
        Moments batches;
        std::vector<Vec3d> before(kSide * kSide, Vec3d{0.0});
        for (int batch = 0; batch < 64; ++batch) {
            render_passes(session, 1);
            const std::vector<Vec3d> after = film_sums(session);
            double sum = 0.0;
            for (std::size_t i = 0; i < after.size(); ++i) sum += (after[i] - before[i]).y;
            batches.add(sum / (kSide * kSide));
            before = after;
        }
        INFO("kind " << static_cast<int>(materials[0].kind) << ", roughness " << materials[0].roughness << ", "
                     << estimator);
        CHECK(mean_equals(batches, {1.0, 5e-4}, 0.02));
    }
}
void check_that_nothing_is_lost(SurfaceKind kind, float roughness) {
    check_that_nothing_is_lost({lossless(kind, roughness)});
}

constexpr SurfaceKind kRoughKinds[] = {SurfaceKind::Dielectric, SurfaceKind::Conductor, SurfaceKind::Plastic};

}  // namespace

TEST_CASE("A blend that absorbs nothing cannot be seen on the mean, by guided paths too") {
    check_that_nothing_is_lost(lossless_blend());
}
TEST_CASE("Rough surfaces that absorb nothing cannot be seen on the mean") {
    for (const SurfaceKind kind : kRoughKinds) check_that_nothing_is_lost(kind, 0.5f);
}
TEST_CASE("Smooth coats, nearly smooth and very rough surfaces that absorb nothing cannot be seen on the mean",
          "[merge]") {
    check_that_nothing_is_lost(SurfaceKind::Plastic, 0.0f);
    for (const SurfaceKind kind : kRoughKinds)
        for (const float roughness : {0.2f, 1.0f}) check_that_nothing_is_lost(kind, roughness);
}
