// The default light: which scenes lack a light, and the sky that they get.
#include "core/scene/default_light.h"

#include <algorithm>

#include "core/scene/pack_scene.h"
#include "core/scene/scene_hash.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A box without light, seen along -z.
SceneDescription dark_box() {
    SceneDescription scene;
    scene.materials = {gray(), gray()};
    scene.materials[1].name = "unused";
    add_box(scene, Vec3f{-1.0f}, Vec3f{1.0f}, false);
    scene.camera.eye = {0.0f, 0.0f, 5.0f};
    return scene;
}

TextureDescription one_texel(float value) {
    return {.source = {}, .width = 1, .height = 1, .texels = {glm::vec4(value)}};
}

Vec3f radiance_from(const SceneDescription& scene, Vec3f direction) {
    return map_radiance(pack_scene(scene).view().far_lights.map, glm::normalize(direction));
}

/// Radiance of a white Lambert reflector: the mean of incident radiance, weighted by the cosine, over 128 x 256 directions.
double white_radiance(const SceneDescription& scene, Vec3f normal) {
    const HostScene packed = pack_scene(scene);
    double sum = 0.0;
    constexpr int kRows = 128;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < 2 * kRows; ++column) {
            const double theta = 3.14159265358979 * (row + 0.5) / kRows;
            const double phi = 3.14159265358979 * (column + 0.5) / kRows;
            const Vec3f w{Vec3d{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)}};
            const auto cosine = static_cast<double>(std::max(0.0f, glm::dot(w, normal)));
            sum += static_cast<double>(luminance(map_radiance(packed.view().far_lights.map, w))) * cosine *
                   std::sin(theta);
        }
    return sum * 3.14159265358979 / (kRows * kRows);
}

}  // namespace

TEST_CASE("A scene has its own light if a triangle, the environment, its map or the sun emits") {
    CHECK(light_of(dark_box()) == SceneLight::None);

    SceneDescription lamp = dark_box();
    lamp.materials[0].emission = {0.0f, 0.0f, 1e-6f};
    CHECK(light_of(lamp) == SceneLight::Own);

    SceneDescription sky = dark_box();
    sky.environment = {0.0f, 0.5f, 0.0f};
    CHECK(light_of(sky) == SceneLight::Own);

    SceneDescription sun = dark_box();
    sun.sun.radiance = Vec3f{1.0f};
    CHECK(light_of(sun) == SceneLight::Own);

    SceneDescription map = dark_box();
    map.environment_map = {.source = {}, .width = 2, .height = 1, .texels = {Vec3f{0.0f}, Vec3f{0.0f}}};
    CHECK(light_of(map) == SceneLight::None);
    map.environment_map.texels[1].x = 1.0f;
    CHECK(light_of(map) == SceneLight::Own);
}

TEST_CASE("A lamp that no triangle has, or whose emission map is black, is no light") {
    SceneDescription unused = dark_box();
    unused.materials[1].emission = Vec3f{100.0f};
    CHECK(light_of(unused) == SceneLight::None);
    unused.triangles.back().material = 1;
    CHECK(light_of(unused) == SceneLight::Own);

    SceneDescription textured = dark_box();
    textured.materials[0].emission = Vec3f{1.0f};
    textured.materials[0].textures.emission = 0;
    textured.textures = {one_texel(0.0f)};
    CHECK(light_of(textured) == SceneLight::None);
    textured.textures = {one_texel(0.5f)};
    CHECK(light_of(textured) == SceneLight::Own);
}

TEST_CASE("What is a light here has light samples in the packed scene, and the other way round") {
    Uniforms random(5);
    int lit = 0;
    for (int i = 0; i < 40; ++i) {
        SceneDescription scene = dark_box();
        if (random.below(4) == 0) scene.materials[0].emission = Vec3f{1.0f};
        if (random.below(4) == 0) scene.materials[1].emission = Vec3f{1.0f};
        if (random.below(4) == 0) scene.sun.radiance = Vec3f{1.0f};
        if (random.below(4) == 0) {
            scene.textures = {one_texel(random.below(2) == 0 ? 0.0f : 1.0f)};
            scene.materials[0].textures.emission = 0;
        }
        const HostScene packed = pack_scene(scene);
        const bool is_sampled = !packed.lights.empty() || packed.far_probability > 0.0f;
        CHECK((light_of(scene) == SceneLight::Own) == is_sampled);
        lit += is_sampled ? 1 : 0;
    }
    CHECK(lit > 5);
    CHECK(lit < 35);
}

TEST_CASE("The default light is a sky above a dull ground, with the sun over the left shoulder of the camera") {
    const Vec3f up = GENERATE(Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1), Vec3f(0, -1, 0));
    const Vec3f back = GENERATE(Vec3f(0.8f, 0.6f, 0), Vec3f(0, 0.6f, 0.8f), Vec3f(0.6f, 0, -0.8f));
    SceneDescription scene = dark_box();
    scene.up = up;
    scene.camera.eye = 5.0f * back;
    add_default_light(scene);
    CHECK(light_of(scene) == SceneLight::Default);

    const Vec3f level = glm::normalize(back - glm::dot(back, up) * up);
    const Vec3f left = glm::cross(level, up);
    const Vec3f sun = 0.766f * up + 0.643f * glm::normalize(level + left);  // 50 degrees high
    CHECK(luminance(radiance_from(scene, sun)) > 4.5f);
    CHECK(luminance(radiance_from(scene, sun + 0.6f * left)) < 2.5f);
    CHECK(luminance(radiance_from(scene, -up)) == Approx(0.22).margin(0.01));
    const Vec3f away = -level - left;  // from the sun
    const float horizon = luminance(radiance_from(scene, away + 0.25f * up));
    CHECK(horizon > 1.2f * luminance(radiance_from(scene, 0.5f * away + up)));
    CHECK(horizon < 0.8f);
}

TEST_CASE("A white surface in the default light is white where it faces the sun, and gray in the shade") {
    SceneDescription scene = dark_box();
    add_default_light(scene);
    double most = 0.0;
    double least = 10.0;
    for (const Vec3f normal : {Vec3f(-0.4545f, 0.766f, 0.4545f), Vec3f(0, 1, 0), Vec3f(0, 0, 1), Vec3f(0, 0, -1),
                               Vec3f(1, 0, 0), Vec3f(-1, 0, 0), Vec3f(0, -1, 0)}) {
        const double radiance = white_radiance(scene, normal);
        most = std::max(most, radiance);
        least = std::min(least, radiance);
    }
    CHECK(most > 0.9);
    CHECK(most < 1.02);
    CHECK(least > 0.2);
    CHECK(least < 0.3);
}

TEST_CASE("The default light is the same every time, and finite where the camera looks straight down") {
    SceneDescription first = dark_box();
    SceneDescription second = dark_box();
    add_default_light(first);
    add_default_light(second);
    CHECK(scene_hash(first) == scene_hash(second));
    CHECK(scene_hash(first) != scene_hash(dark_box()));

    SceneDescription above = dark_box();
    above.camera.eye = {0.0f, 5.0f, 0.0f};
    add_default_light(above);
    const auto& texels = above.environment_map.texels;
    CHECK(std::all_of(texels.begin(), texels.end(), [](const Vec3f& texel) { return is_finite(texel); }));
    CHECK(luminance(radiance_from(above, {-0.4545f, 0.766f, 0.4545f})) > 4.5f);  // as for a camera at the front
}

TEST_CASE("The light in words and names") {
    SceneDescription scene = dark_box();
    CHECK(name_of(light_of(scene)) == "none");
    CHECK(light_text(scene) == "none: every picture is black");
    scene.up = {0.0f, 0.0f, 1.0f};
    add_default_light(scene);
    CHECK(name_of(light_of(scene)) == "default");
    CHECK(light_text(scene) == "default: a sky with a soft sun, +z is up");
    scene.default_light = false;
    CHECK(name_of(light_of(scene)) == "scene");
    CHECK(light_text(scene) == "the scene's own");
}
