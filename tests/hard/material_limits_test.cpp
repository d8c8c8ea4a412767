// Materials at their limits: black, white, mirrors face to face, thin glass, glass that is none, roughness at both ends.
#include "core/scene/surface_info.h"
#include "tests/hard/hard_scenes.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/image_scenes.h"

using namespace pl;
using namespace pl::test;

namespace {

MaterialDescription surface(SurfaceKind kind, float roughness, float ior = 1.5f) {
    MaterialDescription material;
    material.name = "surface";
    material.kind = kind;
    material.roughness = roughness;
    material.ior = ior;
    return material;
}

/// A floor of this material under a sky of radiance 1 + 0.5 y, seen from above at 45 degrees.
SceneDescription floor_under_sky(const MaterialDescription& material) {
    SceneDescription scene = plane_scene(0.5f);
    scene.materials = {material};
    scene.environment_map = linear_sky(1.0f, 0.5f);
    scene.camera = look_at_point({0.0f, 1.0f, 1.0f}, Vec3f{0.0f});
    return scene;
}

}  // namespace

TEST_CASE("On black surfaces paths end, in one segment each", "[hard]") {
    BoxLook look;
    const SceneDescription scene = box_scene(look);
    for (const Estimator estimator : kEstimators) {
        const Snapshot picture = picture_of(scene, estimator, 64, 2);
        INFO(estimator);
        CHECK(picture.counters.path.segments == picture.counters.paths);
        CHECK(picture.counters.path.shadow_rays == 0);
        CHECK(worst_pixel(picture, 0.0) == 0.0);
    }
}

// Nothing is absorbed and nothing gets out: the true radiance with emission is infinite. Only the cut at the depth ends paths.
TEST_CASE("White closed rooms end at the net, black without a lamp and finite with one", "[hard]") {
    for (const float emission : {0.0f, 1.0f}) {
        const SceneDescription scene = furnace_scene(emission, 1.0f);
        for (const Estimator estimator : kEstimators) {
            const Snapshot picture = picture_of(scene, estimator, 16, 2, 50);
            INFO("emission " << emission << ", " << estimator);
            CHECK(count_broken(picture) == 0);
            CHECK(picture.counters.path.truncated > 0);
            if (estimator.method == MethodId::Default && !estimator.next_event)
                CHECK(within(worst_pixel(picture, 50.0 * static_cast<double>(emission)),
                             4.0 * 51.0 * 0x1p-24 * 50.0 * static_cast<double>(emission)));
            else
                CHECK(worst_pixel(picture, 0.0) <= 1e4 * static_cast<double>(emission));
        }
    }
}

TEST_CASE("Mirrors all around bounce to the net and bring nothing", "[hard]") {
    SceneDescription scene = furnace_scene(0.0f, 0.0f);
    scene.materials.assign(scene.materials.size(), surface(SurfaceKind::Conductor, 0.0f));
    for (const Estimator estimator : {kEstimators[0], kEstimators[5]}) {
        const Snapshot picture = picture_of(scene, estimator, 16, 1, 10000);
        INFO(estimator);
        CHECK(picture.counters.path.escaped == 0);
        CHECK(picture.counters.path.truncated == picture.counters.paths);
        CHECK(picture.counters.path.segments == 10000 * picture.counters.paths);
        CHECK(worst_pixel(picture, 0.0) == 0.0);
    }
}

// A shell of glass a ten-thousandth thick around air: into glass, out, in, out; nothing may be lost or gained. A few paths
// enter by an edge of the shell and are led along it by thousands of total reflections.
TEST_CASE("Thin shells and nested blocks of clear glass cannot be seen under an even sky", "[hard]") {
    for (const float thickness : {1e-4f, 0.3f}) {
        SceneDescription scene;
        scene.name = "shell";
        scene.materials = {surface(SurfaceKind::Dielectric, 0.0f)};
        const Vec3f low{-1.0f, -0.7f, -1.2f};
        const Vec3f high{1.0f, 0.9f, 0.8f};
        add_box(scene, low, high, false);
        add_box(scene, low + Vec3f{thickness}, high - Vec3f{thickness}, true);
        scene.environment = Vec3f{1.0f};
        scene.camera = {.eye = {1.9f, 1.6f, 3.1f}, .target = {0.0f, 0.0f, 0.0f}, .fov_deg = 40.0f};
        for (const Estimator estimator : {kEstimators[0], kEstimators[1], kEstimators[4]}) {
            const Snapshot picture = picture_of(scene, estimator, 48, 4, 65536);
            INFO("thickness " << thickness << ", " << estimator);
            CHECK(picture.counters.path.truncated == 0);
            CHECK(within(worst_pixel(picture, 1.0), 1e-4));
        }
    }
}

TEST_CASE("Glass of index 1 bends nothing, reflects nothing and changes no picture", "[hard]") {
    SceneDescription scene = floor_under_sky(surface(SurfaceKind::Diffuse, 0.0f));
    scene.triangles.clear();
    scene.materials = {surface(SurfaceKind::Dielectric, 0.0f, 1.0f)};
    scene.camera = {.eye = {1.9f, 1.6f, 3.1f}, .target = {0.0f, 0.0f, 0.0f}, .fov_deg = 40.0f};
    add_triangle(scene, Vec3f{1e5f, 1e5f, 1e5f}, Vec3f{1e5f, 1e5f, 1.1e5f}, Vec3f{1.1e5f, 1e5f, 1e5f});
    const Snapshot without = picture_of(scene, kEstimators[0], 32, 1);
    add_box(scene, {-1.0f, -0.7f, -1.2f}, {1.0f, 0.9f, 0.8f}, false);
    const Snapshot with = picture_of(scene, kEstimators[0], 32, 1);
    double worst = 0.0;
    for (std::size_t i = 0; i < with.pixels.size(); ++i)
        worst = std::max(worst, static_cast<double>(max_component(absolute(with.pixels[i] - without.pixels[i]))));
    // Directions are off by a few roundoffs; the map's half floats and its filter make 1e-5 of that.
    CHECK(within(worst, 2e-5));
}

TEST_CASE("Glass whose index is close to 1, or as large as can be, loses nothing", "[hard]") {
    for (const float ior : {1.0f, next_float_up(1.0f), 1.0001f, kMostIor}) {
        SceneDescription scene;
        scene.name = "block";
        scene.materials = {surface(SurfaceKind::Dielectric, 0.0f, ior)};
        add_box(scene, {-1.0f, -0.7f, -1.2f}, {1.0f, 0.9f, 0.8f}, false);
        scene.environment = Vec3f{1.0f};
        scene.camera = {.eye = {1.9f, 1.6f, 3.1f}, .target = {0.0f, 0.0f, 0.0f}, .fov_deg = 40.0f};
        const Snapshot picture = picture_of(scene, kEstimators[1], 48, 4, 4000);
        INFO("index " << ior);
        CHECK(within(worst_pixel(picture, 1.0), 1e-4));
    }
}

// A mirror at 45 degrees shows one direction of the sky: sin 45. Rough ones blur it, which the linear sky hardly shows.
TEST_CASE("Metals that are hardly rough are mirrors", "[hard]") {
    const Vec3f mirror =
        picture_of(floor_under_sky(surface(SurfaceKind::Conductor, 0.0f)), kEstimators[0], 8, 4).pixels[0];
    const double expected = 1.0 + 0.5 * std::sqrt(0.5);
    CHECK(within(static_cast<double>(mirror.y) - expected, 2e-4 * expected));
    for (const float roughness : {1e-3f, 0.01f, 0.05f})
        for (const Estimator estimator : {kEstimators[0], kEstimators[1]}) {
            INFO("roughness " << roughness << ", " << estimator);
            const Snapshot picture =
                picture_of(floor_under_sky(surface(SurfaceKind::Conductor, roughness)), estimator, 32, 16);
            CHECK(pixels_mean(picture, {expected, 2e-3 * expected}, 0.01));
            CHECK(count_broken(picture) == 0);
        }
}

TEST_CASE("Every kind of surface at every limit makes finite pictures by every method", "[hard]") {
    for (const SurfaceInfo& info : kSurfaces)
        for (const float roughness : {0.0f, 1e-6f, 0.29f, 1.0f})
            for (const float color : {0.0f, 1.0f}) {
                SceneDescription scene = shipped_scene("coats");
                for (MaterialDescription& material : scene.materials)
                    if (material.emission == glm::vec3{0.0f}) {
                        material.kind = info.choice.value;
                        material.roughness = roughness;
                        material.albedo = material.specular = material.transmission = glm::vec3{color};
                    }
                for (const Estimator estimator : {kEstimators[1], kEstimators[5]}) {
                    INFO(info.choice.name << ", roughness " << roughness << ", color " << color << ", " << estimator);
                    CHECK(count_broken(picture_of(scene, estimator, 16, 2)) == 0);
                }
            }
}

// A ray behind a hole starts there, so places of hits move by roundoffs of the room's size, and light samples from lamps of
// up to 20 with them: three sheets, two roundings each, of 1000 in 50.
TEST_CASE("Surfaces whose opacity is 0 everywhere cannot be seen", "[hard]") {
    SceneDescription scene = shipped_scene("cornell");
    scene.textures = {{.content = TextureContent::Opacity, .width = 2, .height = 2}};
    scene.textures[0].texels.assign(4, glm::vec4{1.0f, 1.0f, 1.0f, 0.0f});
    scene.materials.push_back(gray());
    const auto clear = static_cast<std::uint32_t>(scene.materials.size() - 1);
    scene.materials[clear].textures.opacity = 0;
    // Sheets across the whole box, in front of the camera too.
    for (const float z : {-400.0f, 100.0f, 300.0f})
        add_own_quad(scene, {Vec3f{-1e3f, -1e3f, z}, {1e3f, -1e3f, z}, {1e3f, 1e3f, z}, {-1e3f, 1e3f, z}}, clear);
    const SceneDescription without = shipped_scene("cornell");
    for (const Estimator estimator : {kEstimators[0], kEstimators[1]}) {
        INFO(estimator);
        const Snapshot seen = picture_of(scene, estimator, 32, 2);
        const Snapshot expected = picture_of(without, estimator, 32, 2);
        double worst = 0.0;
        for (std::size_t i = 0; i < seen.pixels.size(); ++i)
            worst =
                std::max(worst, static_cast<double>(max_component(absolute(seen.pixels[i] - expected.pixels[i]))));
        CHECK(within(worst, 2e-4));
        CHECK(seen.counters.path.segments == expected.counters.path.segments);
        CHECK(seen.counters.path.shadow_rays == expected.counters.path.shadow_rays);
    }
}
