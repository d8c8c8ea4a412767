// Opacities of the vertices of glTF primitives.
#include "core/io/gltf/vertex_opacity.h"

#include <array>

#include <stb_image_write.h>

#include "tests/support/catch.hpp"
#include "tests/support/files/load_gltf.h"
#include "tests/support/files/told.h"

using namespace pl;
using namespace pl::test;

namespace {

Json material_of(const char* mode, float alpha) {
    return {{"name", "veil"},
            {"alphaMode", mode},
            {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}, {"metallicFactor", 0}}}};
}

/// A further triangle of the first material whose vertices have these opacities, and a color.
void add_triangle(GltfMaker& file, const std::array<float, 3>& opacities) {
    std::vector<float> colors;
    for (const float opacity : opacities) colors.insert(colors.end(), {1.0f, 0.5f, 0.0f, opacity});
    const int positions = file.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int uvs = file.vec2({0, 0, 1, 0, 0, 1});
    const int color = file.numbers(colors, 5126, "VEC4", 3);
    file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}, {"COLOR_0", color}}},
                                   {"material", 0}})}});
}

/// A triangle for each list of opacities, beside one without.
SceneDescription scene_with(const Json& material, const std::vector<std::array<float, 3>>& triangles) {
    GltfMaker file;
    file.triangle(material);
    for (const std::array<float, 3>& opacities : triangles) add_triangle(file, opacities);
    return load_gltf(file);
}

const MaterialDescription& material_at(const SceneDescription& scene, std::size_t triangle) {
    return scene.materials[scene.triangles.at(triangle).material];
}

constexpr std::array<float, 3> even(float opacity) { return {opacity, opacity, opacity}; }

}  // namespace

TEST_CASE("gltf vertex opacities: an even one is that of a copy of the material, one for each opacity") {
    const SceneDescription scene =
        scene_with(material_of("BLEND", 0.5f), {even(0.5f), even(0.25f), even(0.5f), even(1.0f), even(0.0f)});
    REQUIRE(scene.triangles.size() == 5);  // without the one that is not there
    CHECK(scene.materials.size() == 3);
    const float expected[] = {0.5f, 0.25f, 0.125f, 0.25f, 0.5f};
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(material_at(scene, i).opacity == expected[i]);
        CHECK(material_at(scene, i).opacity_rule == OpacityRule::Blend);
    }
    CHECK(material_at(scene, 1).name == "veil (opacity 0.5)");
    CHECK(scene.triangles[1].material == scene.triangles[3].material);
    CHECK(scene.triangles[0].material == scene.triangles[4].material);
    CHECK(scene.vertex_colors.at(scene.triangles[1].vertex.x) == glm::vec3(1.0f, 0.5f, 0.0f));
    CHECK_FALSE(is_told(scene, "opacities"));
}

TEST_CASE("gltf vertex opacities: ones that differ within a primitive are left out, opaque surfaces have none") {
    const std::array<float, 3> differing = {0.5f, 0.5f, 0.75f};
    const SceneDescription scene = scene_with(material_of("BLEND", 0.5f), {differing});
    CHECK(scene.materials.size() == 1);
    CHECK(material_at(scene, 1).opacity == 0.5f);
    CHECK(is_told(scene, "opacities of vertices that differ within a primitive are left out"));
    for (const std::array<float, 3>& opacities : {differing, even(0.5f), even(0.0f)}) {
        const SceneDescription opaque = scene_with(material_of("OPAQUE", 0.5f), {opacities});
        CHECK(opaque.triangles.size() == 2);
        CHECK_FALSE(material_at(opaque, 1).may_have_holes());
        CHECK_FALSE(is_told(opaque, "opacities"));
    }
}

TEST_CASE("gltf vertex opacities: a cutoff without an image shows or hides a primitive") {
    Json material = material_of("MASK", 0.5f);
    material["alphaCutoff"] = 0.25f;
    // Solid from opacities of 0.5 of the vertices on.
    const SceneDescription scene =
        scene_with(material, {even(0.5f), {0.6f, 0.7f, 1.0f}, even(0.49f), {0.0f, 0.2f, 0.4f}});
    CHECK(scene.triangles.size() == 3);
    CHECK(scene.materials.size() == 1);
    CHECK_FALSE(is_told(scene, "opacities"));
    const SceneDescription both = scene_with(material, {{0.4f, 0.5f, 0.6f}});
    CHECK(both.triangles.size() == 2);
    CHECK(is_told(both, "opacities of vertices on both sides of a cutoff are left out"));
    material["alphaCutoff"] = 0.0f;
    CHECK(scene_with(material, {even(0.0f), {0.0f, 0.5f, 1.0f}}).triangles.size() == 3);
}

TEST_CASE("gltf vertex opacities: a cutoff above 1 cuts everything away") {
    for (const float alpha : {0.5f, 1.0f}) {
        Json material = material_of("MASK", alpha);
        material["alphaCutoff"] = 1.5f;
        GltfMaker file;
        file.triangle(material);
        file.triangle();
        const SceneDescription scene = load_gltf(file);
        CHECK(scene.triangles.size() == 1);
        CHECK(is_told(scene, "surfaces with an alphaCutoff above 1 are cut away"));
    }
}

TEST_CASE("gltf vertex opacities: a cutoff of an image is met by the product of both") {
    Json material = material_of("MASK", 1.0f);
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    const auto load = [&] {
        GltfMaker file;
        std::string png;
        const std::array<std::uint8_t, 4> texel = {255, 255, 255, 153};
        const auto append = [](void* to, void* data, int size) {
            static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
        };
        stbi_write_png_to_func(append, &png, 1, 1, 4, texel.data(), 4);
        file.root["images"] = {{{"uri", "data:image/png;base64," + base64(png)}}};
        file.root["textures"] = {{{"source", 0}}};
        file.triangle(material);
        add_triangle(file, even(0.75f));
        return load_gltf(file);
    };
    const SceneDescription scene = load();
    const MaterialDescription& scaled = material_at(scene, 1);
    CHECK(scaled.opacity == 0.75f);
    CHECK(scaled.opacity_rule == OpacityRule::Threshold);
    CHECK(scaled.textures.opacity == material_at(scene, 0).textures.opacity);
    CHECK_FALSE(is_told(scene, "opacities of vertices"));
    // Texels of 0.6 are opaque under a cutoff of 0.25 already.
    material["alphaCutoff"] = 0.25f;
    CHECK(is_told(load(), "opacities of vertices are left out where an image is cut off below half of its opacity"));
}
