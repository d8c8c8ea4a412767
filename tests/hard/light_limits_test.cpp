// Lights at their limits: tiny, huge, far, near, edge-on, from behind, without area or power, too many, boxed in.
#include "tests/hard/hard_scenes.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/rectangle_light.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr Estimator kLightSamples{MethodId::Default, true};
constexpr double kAlbedo = static_cast<double>(kGrayFloor);

}  // namespace

TEST_CASE("A receiver in the plane of a lamp gets nothing from it, to the bit", "[hard]") {
    SceneDescription scene = floor_and_lamp(0.5f, 0.0f, 7.0f);  // faces down, in the plane of the floor
    scene.triangles[0].material = scene.triangles[1].material = 0;
    for (const bool two_sided : {false, true}) {
        scene.materials[1].two_sided_emission = two_sided;
        scene.camera = look_at_point({2.0f, 1.0f, 0.3f}, {1.5f, 0.0f, 0.2f});
        const Snapshot picture = picture_of(scene, kLightSamples, 64, 4);
        CHECK(worst_pixel(picture, 0.0) == 0.0);
        CHECK(picture.counters.zero_contribution_paths == picture.counters.paths);
    }
}

// The floor receives light from the lamp only: albedo times radiance, less the directions past its edge.
TEST_CASE("Right under a large lamp the floor is as bright as its albedo says", "[hard]") {
    for (const float height : {1e-3f, 1e-2f}) {
        SceneDescription scene = floor_and_lamp(1.0f, height, 1.0f);
        scene.camera = look_at_point({0.01f * height, 0.5f * height, 0.0f}, Vec3f{0.0f});
        const double covered = 4.0 * parallel_corner_factor(1.0, 1.0, static_cast<double>(height));
        for (const Estimator estimator : {kLightSamples, kEstimators[0], kEstimators[5]}) {
            INFO("height " << height << ", " << estimator);
            // The lamp reflects nothing. One direction in 10 000 misses it, which few pixels see.
            CHECK(pixels_mean(picture_of(scene, estimator, 64, 8), {kAlbedo * covered, 1e-4}, 0.02));
        }
    }
}

TEST_CASE("A lamp a thousandth of a thousandth wide shines by the inverse square", "[hard]") {
    for (const float width : {1e-3f, 1e-6f}) {
        const float radiance = 1.0f / (width * width);
        SceneDescription scene = floor_and_lamp(0.5f * width, 1.0f, radiance);
        scene.camera = look_at_point({1.2f, 0.5f, 0.3f}, {1.0f, 0.0f, 0.0f});
        const double expected = kAlbedo / 3.14159265358979 * 0.5 / 2.0;
        const Snapshot picture = picture_of(scene, kLightSamples, 64, 4);
        INFO("width " << width);
        // Corners of the lamp are rounded to 2^-24: its area to 1e-7 / width.
        CHECK(pixels_mean(picture, {expected, expected * (1e-4 + 2e-7 / static_cast<double>(width))}, 0.01));
        CHECK(count_broken(picture) == 0);
    }
}

TEST_CASE("A lamp a million wide is a bright sky", "[hard]") {
    SceneDescription scene = floor_and_lamp(0.5e6f, 1.0f, 1.0f);
    scene.camera = look_at_point({0.3f, 0.4f, 0.0f}, Vec3f{0.0f});
    for (const Estimator estimator : {kEstimators[0], kLightSamples, kEstimators[4]}) {
        INFO(estimator);
        CHECK(pixels_mean(picture_of(scene, estimator, 64, 16), {kAlbedo, 1e-5}, 0.02));
    }
}

// The point lies a little beside the plane of the lamp, which is nearly edge-on, or touches its edge.
TEST_CASE("Lamps seen nearly edge-on, or touched, give their form factor", "[hard]") {
    for (const float z : {1e-4f, 1e-2f, 3.0f}) {
        LampOverFloor lamp = lamp_beside(0.1f, z);
        lamp.scene.camera.fov_deg = 1e-3f;
        const Snapshot picture = picture_of(lamp.scene, kLightSamples, 64, 64);
        INFO("floor " << z << " before a standing lamp, radiance " << lamp.floor_radiance);
        // The view is 1e-5 wide where it meets the floor.
        CHECK(pixels_mean(picture, {lamp.floor_radiance, 2e-3 * lamp.floor_radiance}, 0.05));
        CHECK(count_broken(picture) == 0);
    }
    for (const float x : {30.0f, 300.0f}) {  // parallel, far aside: both cosines are small
        SceneDescription scene = floor_and_lamp(0.5f, 0.5f, 1e4f);
        for (std::size_t i = 0; i < 4; ++i) scene.positions[i] *= 100.0f;
        scene.camera = look_at_point({x + 0.2f, 0.4f, 0.0f}, {x, 0.0f, 0.0f});
        const auto at = [&](double side) { return parallel_corner_factor(side - static_cast<double>(x), 0.5, 0.5); };
        const double expected = kAlbedo * 1e4 * 2.0 * (at(0.5) - at(-0.5));
        INFO("floor " << x << " beside a lamp, radiance " << expected);
        CHECK(pixels_mean(picture_of(scene, kLightSamples, 64, 8), {expected, 0.005 * expected}, 0.02));
    }
}

TEST_CASE("Behind a lamp of one side it is dark, and no shadow ray is spent", "[hard]") {
    SceneDescription scene = floor_and_lamp(0.5f, 0.5f, 1.0f);
    std::swap(scene.triangles[2].vertex.y, scene.triangles[2].vertex.z);
    std::swap(scene.triangles[3].vertex.y, scene.triangles[3].vertex.z);
    scene.camera = look_at_point({0.9f, 0.4f, 0.0f}, {0.7f, 0.0f, 0.0f});
    const Snapshot picture = picture_of(scene, kLightSamples, 64, 4);
    CHECK(worst_pixel(picture, 0.0) == 0.0);
    CHECK(picture.counters.path.shadow_rays == 0);
}

TEST_CASE("Both sides of a lamp of two sides shine alike", "[hard]") {
    for (const float side : {1.0f, -1.0f}) {
        SceneDescription scene = lamp_above(0.1f, 0.05f).scene;
        scene.materials[1].two_sided_emission = true;
        for (glm::vec3& position : scene.positions) position.y *= side;  // the order of the corners keeps the front
        scene.camera.eye.y *= side;
        INFO("side " << side);
        CHECK(pixels_mean(picture_of(scene, kLightSamples, 64, 16), {lamp_above(0.1f, 0.05f).floor_radiance, 1e-6},
                          0.02));
    }
}

TEST_CASE("Lamps without area or power change no bit", "[hard]") {
    SceneDescription scene = floor_and_lamp(0.5f, 0.5f, 1.0f);
    scene.camera = {.eye = {0.0f, 0.4f, 2.0f}, .target = {0.0f, 0.1f, 0.0f}};
    const Snapshot plain = picture_of(scene, kLightSamples, 32, 2);
    scene.materials.push_back({.name = "sliver", .emission = Vec3f{1e6f}});
    add_triangle(scene, Vec3f{0, 1, 0}, Vec3f{0.5f, 1, 0}, Vec3f{1, 1, 0}, 2);  // collinear
    add_triangle(scene, Vec3f{0, 2, 0}, Vec3f{0, 2, 0}, Vec3f{1, 2, 0}, 2);     // two corners in one place
    const Snapshot with = picture_of(scene, kLightSamples, 32, 2);
    CHECK(with.pixels == plain.pixels);

    SceneDescription dark = floor_and_lamp(0.5f, 0.5f, 0.0f);
    dark.camera = scene.camera;
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(worst_pixel(picture_of(dark, estimator, 32, 2), 0.0) == 0.0);
    }
}

// 20 000 lamps in a ceiling whose powers span 24 decades: only the brightest ones count, and the sum comes out.
TEST_CASE("Many lamps whose powers span 24 decades give the light of the bright ones", "[hard]") {
    SceneDescription scene = floor_and_lamp(0.5f, 0.5f, 1.0f);
    scene.triangles.resize(2);
    scene.materials.resize(1);
    Uniforms random(43);
    for (int decade = -12; decade <= 0; ++decade)
        scene.materials.push_back({.name = "lamp " + std::to_string(decade),
                                   .emission = Vec3f{static_cast<float>(std::pow(100.0, decade))}});
    double expected = 0.0;
    constexpr int kSide = 100;
    for (int i = 0; i < kSide * kSide; ++i) {
        const float s = 1.0f / kSide;
        const float x = -0.5f + s * static_cast<float>(i % kSide);
        const float z = -0.5f + s * static_cast<float>(i / kSide);
        const std::uint32_t material = 1 + random.below(13);
        add_own_quad(scene, {Vec3f{x, 0.5f, z}, {x + s, 0.5f, z}, {x + s, 0.5f, z + s}, {x, 0.5f, z + s}}, material);
        const auto corner = [&](float a, float b) {
            return parallel_corner_factor(static_cast<double>(a), static_cast<double>(b), 0.5);
        };
        expected += static_cast<double>(scene.materials[material].emission.x) *
                    (corner(x + s, z + s) - corner(x, z + s) - corner(x + s, z) + corner(x, z));
    }
    scene.camera = look_at_point({0.3f, 0.3f, 0.1f}, Vec3f{0.0f});
    const Snapshot picture = picture_of(scene, kLightSamples, 64, 8);
    CHECK(pixels_mean(picture, {kAlbedo * expected, 1e-3 * kAlbedo * expected}, 0.03));
    CHECK(count_broken(picture) == 0);
}

TEST_CASE("A lamp in a closed box leaves it black outside", "[hard]") {
    SceneDescription scene = floor_and_lamp(10.0f, 20.0f, 0.0f);  // dark: only a floor to render
    scene.materials.push_back({.name = "bright", .emission = Vec3f{1e6f}});
    add_box(scene, {-0.5f, 0.1f, -0.5f}, {0.5f, 1.1f, 0.5f}, false);
    add_own_quad(scene, {Vec3f{-0.4f, 1.0f, -0.4f}, {0.4f, 1.0f, -0.4f}, {0.4f, 1.0f, 0.4f}, {-0.4f, 1.0f, 0.4f}}, 2);
    scene.camera = {.eye = {2.0f, 1.5f, 2.5f}, .target = {0.0f, 0.4f, 0.0f}};
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        const Snapshot picture = picture_of(scene, estimator, 128, 4);
        CHECK(worst_pixel(picture, 0.0) == 0.0);
    }
}

TEST_CASE("Emission up to 1e30 stays finite", "[hard]") {
    for (const float emission : {1e8f, 1e30f}) {
        const SceneDescription scene = furnace_scene(0.5f * emission, 0.5f);
        for (const Estimator estimator : {kEstimators[0], kEstimators[1], kEstimators[4]}) {
            INFO(emission << ", " << estimator);
            const Snapshot picture = picture_of(scene, estimator, 32, 8);
            CHECK(count_broken(picture) == 0);
            CHECK(pixels_mean(picture, {static_cast<double>(emission), 1e-6 * static_cast<double>(emission)}, 0.1));
        }
    }
}
