// Smooth normals that lean away from their surface, up to 89 degrees: no light is gained, and none comes through walls.
#include "core/scene/surface_info.h"
#include "tests/hard/hard_scenes.h"
#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::test;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Every triangle gets one shading normal, leaning by so much from its front towards one of its corners.
SceneDescription leaning(SceneDescription scene, double degrees) {
    for (TriangleDescription& triangle : scene.triangles) {
        const Vec3d a{scene.positions[triangle.vertex.x]};
        const Vec3d b{scene.positions[triangle.vertex.y]};
        const Vec3d c{scene.positions[triangle.vertex.z]};
        const Vec3d normal = glm::normalize(glm::cross(b - a, c - a));
        const Vec3d along = glm::normalize(b - a);
        scene.normals.emplace_back(std::cos(degrees * kDegree) * normal + std::sin(degrees * kDegree) * along);
        triangle.normal = glm::uvec3{static_cast<std::uint32_t>(scene.normals.size() - 1)};
    }
    return scene;
}

MaterialDescription white(SurfaceKind kind, float roughness) {
    MaterialDescription material;
    material.name = "white";
    material.kind = kind;
    material.albedo = Vec3f{1.0f};
    material.roughness = roughness;
    return material;
}

/// A floor of one surface under an even sky, seen at 45 degrees from two sides and from above.
SceneDescription floor_under_even_sky(const MaterialDescription& material, double degrees, int view) {
    SceneDescription scene;
    scene.name = "floor";
    scene.materials = {material};
    add_own_quad(scene, {Vec3f{-10, 0, -10}, {-10, 0, 10}, {10, 0, 10}, {10, 0, -10}}, 0);
    scene.environment = Vec3f{1.0f};
    constexpr Vec3f kEyes[]{{0.3f, 1.0f, 1.0f}, {0.3f, 1.0f, -1.0f}, {0.1f, 2.0f, 0.2f}};
    scene.camera = look_at_point(kEyes[view], {0.1f, 0.0f, 0.2f});
    return leaning(std::move(scene), degrees);
}

/// Lambert's law about a normal that leans by theta sees (1 + cos theta)/2 of an even sky, the rest is below the floor.
/// Rule S1 over pixels; all samples of a pixel see one point.
void check_lambert(std::uint32_t passes, double delta) {
    for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.0})
        for (const Estimator estimator : kEstimators) {
            const SceneDescription scene = floor_under_even_sky(white(SurfaceKind::Diffuse, 0.0f), degrees, 0);
            const Snapshot picture = picture_of(scene, estimator, 64, passes);
            INFO(degrees << " degrees, " << estimator);
            CHECK(pixels_mean(picture, {0.5 * (1.0 + std::cos(degrees * kDegree)), 1e-6}, delta));
            CHECK(count_broken(picture) == 0);
        }
}

/// One-sided: no more than the even sky's own radiance comes back, but for noise and a thousandth.
void check_nothing_gained(const std::vector<double>& leans, std::uint32_t passes, double delta) {
    for (const MaterialDescription& material :
         {white(SurfaceKind::Conductor, 0.3f), white(SurfaceKind::Conductor, 1.0f), white(SurfaceKind::Plastic, 0.3f),
          white(SurfaceKind::Conductor, 0.0f), white(SurfaceKind::Dielectric, 0.3f)})
        for (const double degrees : leans)
            for (int view = 0; view < 3; ++view)
                for (const Estimator estimator : {kEstimators[0], kEstimators[4]}) {
                    const SceneDescription scene = floor_under_even_sky(material, degrees, view);
                    const Snapshot picture = picture_of(scene, estimator, 64, passes);
                    Moments pixels;
                    for (const Vec3f& pixel : picture.pixels) pixels.add(static_cast<double>(pixel.y));
                    INFO(name_of(material.kind) << ", roughness " << material.roughness << ", " << degrees
                                                << " degrees, view " << view << ", " << estimator);
                    CHECK(pixels.mean() <= 1.001 + kZAlpha * pixels.standard_error());
                    CHECK(pixels.standard_error() <= resolving_error(delta));
                    CHECK(count_broken(picture) == 0);
                }
}

}  // namespace

// Seed 1. 4096 pixels of 20 paths, resolves 4.5 % of the least value, 0.51.
TEST_CASE("Smooth normals that lean up to 89 degrees see their share of an even sky", "[hard]") {
    check_lambert(20, 0.045);
}
// 1.05e6 paths each, 31 million in all; resolves 1.1 %.
TEST_CASE("Smooth normals that lean up to 89 degrees see their share of an even sky, finely", "[hard][nightly]") {
    check_lambert(256, 0.011);
}
TEST_CASE("No surface gains light by normals that lean", "[hard]") { check_nothing_gained({89.0}, 4, 0.06); }
TEST_CASE("No surface gains light by normals that lean, finely", "[hard][nightly]") {
    check_nothing_gained({30.0, 60.0, 89.0}, 64, 0.015);
}

// 0 paths of 36 864 get out or see the bright sky around the box.
TEST_CASE("No light comes through walls whose normals lean", "[hard]") {
    for (const SurfaceKind kind : {SurfaceKind::Diffuse, SurfaceKind::Plastic, SurfaceKind::Conductor})
        for (const double degrees : {45.0, 89.0}) {
            SceneDescription scene = furnace_scene(0.0f, 0.9f);
            scene.materials.assign(scene.materials.size(), white(kind, 0.4f));
            for (MaterialDescription& material : scene.materials) material.albedo = Vec3f{0.9f};
            scene.environment = Vec3f{1000.0f};
            for (const Estimator estimator : kEstimators) {
                const Snapshot picture = picture_of(leaning(scene, degrees), estimator, 32, 1);
                INFO(name_of(kind) << ", " << degrees << " degrees, " << estimator);
                CHECK(picture.counters.path.escaped == 0);
                CHECK(worst_pixel(picture, 0.0) == 0.0);
            }
        }
}
