// Images on surfaces: values between texels, beyond the border, at absurd coordinates, and holes.
#include "core/kernel/scene/texture.h"

#include "core/kernel/shading/textured.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

/// One triangle with an image of 2 x 2 texels for albedo and opacity.
HostScene painted(bool repeats, float hidden = 0.25f) {
    SceneDescription scene;
    scene.materials.push_back(gray(0.5f));
    scene.materials[0].textures = {.albedo = 0, .opacity = 0};
    scene.textures.push_back({.width = 2,
                              .height = 2,
                              .repeats = repeats,
                              .texels = {{0, 0, 0.5f, 1}, {1, 0, 0.5f, 1}, {0, 1, 0.5f, 1}, {1, 1, 0.5f, hidden}}});
    scene.uvs = {{0, 0}, {1, 0}, {0, 1}};
    add_triangle(scene, Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    scene.triangles[0].uv = {0, 1, 2};
    return pack_scene(scene);
}

}  // namespace

TEST_CASE("Texels are met at their middles, rows go down and v goes up") {
    const HostScene scene = painted(true);
    const Textures textures = scene.view().textures;
    CHECK(sample_image(textures, 0, {0.25f, 0.75f}) == Vec4f{0, 0, 0.5f, 1});
    CHECK(sample_image(textures, 0, {0.75f, 0.75f}) == Vec4f{1, 0, 0.5f, 1});
    CHECK(sample_image(textures, 0, {0.25f, 0.25f}) == Vec4f{0, 1, 0.5f, 1});
    CHECK(sample_image(textures, 0, {0.75f, 0.25f}) == Vec4f{1, 1, 0.5f, 0.25f});
    CHECK(sample_image(textures, 0, {0.5f, 0.75f}) == Vec4f{0.5f, 0, 0.5f, 1});
    CHECK(sample_image(textures, 0, {0.375f, 0.5f}) == Vec4f{0.25f, 0.5f, 0.5f, 1 - 0.25f * 0.5f * 0.75f});
}

TEST_CASE("Beyond the border an image repeats, or its border goes on") {
    const HostScene repeating = painted(true);
    const HostScene clamped = painted(false);
    for (const Vec2f uv : {Vec2f{-0.75f, 1.75f}, Vec2f{3.25f, -2.25f}, Vec2f{0.25f, 0.75f}})
        CHECK(sample_image(repeating.view().textures, 0, uv) == Vec4f{0, 0, 0.5f, 1});
    CHECK(sample_image(repeating.view().textures, 0, {0.0f, 0.75f}).x == 0.5f);  // between the last and the first
    CHECK(sample_image(clamped.view().textures, 0, {0.0f, 0.75f}).x == 0.0f);
    CHECK(sample_image(clamped.view().textures, 0, {-7.0f, 9.0f}) == Vec4f{0, 0, 0.5f, 1});
    CHECK(sample_image(clamped.view().textures, 0, {8.0f, -9.0f}) == Vec4f{1, 1, 0.5f, 0.25f});
}

TEST_CASE("Values are finite for all coordinates") {
    for (const bool repeats : {true, false}) {
        const HostScene scene = painted(repeats);
        for (const float u : {0.0f, -0.0f, 1.0f, -1e-30f, next_float_down(1.0f), next_float_up(1.0f), 1e9f, -3e38f,
                              kInfinity, -kInfinity, kNan})
            for (const float v : {0.0f, 1.0f, -1e-30f, 1e20f, kInfinity, kNan}) {
                const Vec4f value = sample_image(scene.view().textures, 0, {u, v});
                for (int i = 0; i < 4; ++i) CHECK((value[i] >= 0.0f && value[i] <= 1.0f));
            }
    }
}

TEST_CASE("Colors of vertices are interpolated, and multiply the image") {
    constexpr FeatureSet kTextures = features(Feature::Textures);
    HostScene scene = painted(true);
    const Vec3f b{0.5f, 0.25f, 0.25f};
    const MaterialPoint point{.material = 0, .primitive = 0, .triangle = 0, .b = b};
    const Vec3f image = tint_at<kTextures>(scene.view(), point);
    scene.vertex_colors = {{1, 0, 0.5f}, {0, 1, 0.5f}, {0, 0.5f, 0.5f}};
    CHECK(vertex_color_at(scene.view(), 0, b) == Vec3f{0.5f, 0.375f, 0.5f});
    CHECK(tint_at<kTextures>(scene.view(), point) == image * Vec3f{0.5f, 0.375f, 0.5f});
    CHECK(albedo_at<kTextures>(scene.view(), point) == 0.5f * image * Vec3f{0.5f, 0.375f, 0.5f});
    CHECK(tint_at<FeatureSet{}>(scene.view(), point) == Vec3f{1.0f});
    // Weights add up to 1 but for rounding; an albedo stays at most 1.
    scene.vertex_colors.assign(3, Vec3f{1.0f});
    CHECK(tint_at<kTextures>(scene.view(), {0, 0, 0, {0.4000001f, 0.3f, 0.3000001f}}).x <= 1.0f);
}

TEST_CASE("Coordinates follow the corners, and a hole is where opacity is below one half unless it blends") {
    const HostScene scene = painted(true);
    const Textures textures = scene.view().textures;
    const Vec2f uv = uv_at(textures, 0, {0.5f, 0.25f, 0.25f});
    CHECK(uv == Vec2f{0.25f, 0.25f});
    const MaterialOpacity& threshold = scene.opacities[0];
    CHECK(opacity_of(textures, threshold, 0, {0.5f, 0.25f, 0.25f}) == 1.0f);
    CHECK(opacity_of(textures, threshold, 0, {0.0f, 0.75f, 0.25f}) == 0.0f);
    const MaterialOpacity blend{.image = threshold.image, .factor = 0.5f, .blends = 1};
    CHECK(opacity_of(textures, blend, 0, {0.5f, 0.25f, 0.25f}) == 0.5f);
    CHECK(opacity_of(textures, blend, 0, {0.0f, 0.75f, 0.25f}) == 0.125f);
    CHECK(opacity_of(textures, {.factor = 0.3f, .blends = 1}, 0, {0.0f, 0.75f, 0.25f}) == 0.3f);
}
