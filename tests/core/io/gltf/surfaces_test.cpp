// glTF materials as the surfaces of the renderer: kinds, numbers, images, holes, and notes.
// Opacities of the vertices of glTF primitives.
#include "core/io/gltf/surfaces.h"

#include <array>
#include <cmath>

#include <stb_image_write.h>

#include "core/io/mtl.h"
#include "core/kernel/shading/absorption.h"
#include "core/kernel/shading/velvet.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/load_gltf.h"
#include "tests/support/files/told.h"

using namespace pl;
using namespace pl::test;
using pl::test::contains;
using pl::test::GltfMaker;
using pl::test::is_told;
using pl::test::load_gltf;

namespace {

SceneDescription load_material(const Json& material) {
    GltfMaker file;
    file.triangle(material);
    return load_gltf(file);
}

/// The only material of a file with this one.
MaterialDescription gltf_surface(const Json& material) {
    const SceneDescription scene = load_material(material);
    REQUIRE(scene.materials.size() == 1);
    return scene.materials[0];
}

Json metal_rough(const Json& members) { return {{"pbrMetallicRoughness", members}}; }
Json extended(const std::string& name, const Json& members) {
    return {{"pbrMetallicRoughness", {{"metallicFactor", 0}}}, {"extensions", {{"KHR_materials_" + name, members}}}};
}

/// Bytes of a PNG file of 2 x 1 texels.
std::string png(const std::array<std::uint8_t, 8>& rgba) {
    std::string bytes;
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    stbi_write_png_to_func(append, &bytes, 2, 1, 4, rgba.data(), 8);
    return bytes;
}

/// A file with a triangle of this material and an image for its textures.
GltfMaker with_image(const Json& material, const std::array<std::uint8_t, 8>& rgba) {
    GltfMaker file;
    file.triangle(material);
    file.root["images"] = {{{"bufferView", file.view(png(rgba))}, {"mimeType", "image/png"}}};
    file.root["textures"] = {{{"source", 0}}};
    return file;
}

}  // namespace

TEST_CASE("gltf materials: metals and plastics by their metalness") {
    const MaterialDescription metal =
        gltf_surface(metal_rough({{"baseColorFactor", {0.9, 0.5, 0.1, 1}}, {"roughnessFactor", 0.25}}));
    CHECK(metal.kind == SurfaceKind::Conductor);
    CHECK(metal.specular == glm::vec3(0.9f, 0.5f, 0.1f));
    CHECK(metal.albedo == glm::vec3(0.0f));
    CHECK(metal.roughness == 0.25f);
    const MaterialDescription plastic = gltf_surface(
        metal_rough({{"baseColorFactor", {0.9, 0.5, 0.1, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.01}}));
    CHECK(plastic.kind == SurfaceKind::Plastic);
    CHECK(plastic.albedo == glm::vec3(0.9f, 0.5f, 0.1f));
    CHECK(plastic.specular == glm::vec3(1.0f));
    CHECK(plastic.ior == 1.5f);
    CHECK(plastic.roughness == 0.0f);
    const SceneDescription half =
        load_material(metal_rough({{"metallicFactor", 0.4}, {"baseColorFactor", {0.9, 0.5, 0.1, 1}}}));
    REQUIRE(half.materials.size() == 2);
    CHECK(half.triangles[0].material == 0);
    CHECK(half.materials[0].kind == SurfaceKind::Plastic);
    CHECK(half.materials[0].albedo == glm::vec3(0.9f, 0.5f, 0.1f));
    CHECK(half.materials[0].blend == BlendDescription{.other = 1, .share = 0.4f});
    CHECK(half.materials[1].kind == SurfaceKind::Conductor);
    CHECK(half.materials[1].specular == glm::vec3(0.9f, 0.5f, 0.1f));
    CHECK(half.warnings.size() == 1);  // of the light that the scene lacks
    CHECK(gltf_surface(Json::object()).kind == SurfaceKind::Conductor);
}

TEST_CASE("gltf materials: triangles without one are of a rough white metal, which is told") {
    GltfMaker file;
    file.triangle();
    const SceneDescription scene = load_gltf(file);
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].kind == SurfaceKind::Conductor);
    CHECK(scene.materials[0].roughness == 1.0f);
    CHECK(is_told(scene, "triangles without a material"));
}

TEST_CASE("gltf materials: index of refraction, specular amount and its absence") {
    CHECK(gltf_surface(extended("ior", {{"ior", 1.8}})).ior == 1.8f);
    CHECK(gltf_surface(extended("ior", {{"ior", 0}})).ior == kMostIor);
    const MaterialDescription tinted =
        gltf_surface(extended("specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0.5, 0}}}));
    CHECK(tinted.specular == glm::vec3(0.5f, 0.25f, 0.0f));
    const MaterialDescription matte = gltf_surface(extended("specular", {{"specularFactor", 0}}));
    CHECK(matte.kind == SurfaceKind::Diffuse);
    CHECK(matte.albedo == glm::vec3(1.0f));
    CHECK(matte.roughness == 0.0f);
}

TEST_CASE("gltf materials: glass by transmission") {
    Json glass = extended("transmission", {{"transmissionFactor", 1}});
    glass["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 1, 1};
    glass["pbrMetallicRoughness"]["roughnessFactor"] = 0.3;
    glass["extensions"]["KHR_materials_ior"]["ior"] = 1.33;
    SceneDescription scene = load_material(glass);
    CHECK(scene.materials[0].kind == SurfaceKind::Dielectric);
    CHECK(scene.materials[0].transmission == glm::vec3(0.5f, 1.0f, 1.0f));
    CHECK(scene.materials[0].ior == 1.33f);
    CHECK(scene.materials[0].roughness == 0.3f);
    CHECK(is_told(scene, "frosted thin panes"));
    glass["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 1}};
    scene = load_material(glass);
    CHECK_FALSE(is_told(scene, "thin panes"));
    CHECK(scene.materials[0].absorption == glm::vec3(0.0f));
    glass["extensions"]["KHR_materials_ior"]["ior"] = 1.01;
    CHECK(gltf_surface(glass).roughness == 0.0f);
    glass["pbrMetallicRoughness"]["metallicFactor"] = 1;
    CHECK(gltf_surface(glass).kind == SurfaceKind::Conductor);
    glass["extensions"]["KHR_materials_ior"]["ior"] = 1.5;
    for (const double metalness : {0.25, 0.75}) {
        glass["pbrMetallicRoughness"]["metallicFactor"] = metalness;
        const SceneDescription pure = load_material(glass);
        REQUIRE(pure.materials.size() == 1);
        CHECK(pure.materials[0].kind == (metalness < 0.5 ? SurfaceKind::Dielectric : SurfaceKind::Conductor));
        CHECK(is_told(pure, "blends with glass are shown as the component of the larger share"));
    }
    const SceneDescription weak = load_material(extended("transmission", {{"transmissionFactor", 0.2}}));
    CHECK(weak.materials[0].kind == SurfaceKind::Plastic);
    CHECK(is_told(weak, "transmission below one half"));
}

TEST_CASE("gltf materials: glass without an inside is a thin pane") {
    Json glass = extended("transmission", {{"transmissionFactor", 1}});
    glass["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 1, 1, 1};
    glass["pbrMetallicRoughness"]["roughnessFactor"] = 0.01;
    const SceneDescription scene = load_material(glass);
    CHECK(scene.materials[0].kind == SurfaceKind::Pane);
    CHECK(scene.materials[0].transmission == glm::vec3(0.5f, 1.0f, 1.0f));
    CHECK(scene.materials[0].roughness == 0.0f);
    CHECK(scene.materials[0].albedo == glm::vec3(0.0f));
    CHECK_FALSE(is_told(scene, "pane"));
}

TEST_CASE("gltf materials: the inside of glass absorbs") {
    Json glass = extended("transmission", {{"transmissionFactor", 1}});
    glass["extensions"]["KHR_materials_volume"] = {
        {"thicknessFactor", 1}, {"attenuationDistance", 2}, {"attenuationColor", {0.5, 1, 0}}};
    const glm::vec3 absorption = gltf_surface(glass).absorption;
    CHECK(absorption.x == Approx(0.5 * std::log(2.0)).epsilon(1e-6));
    CHECK(absorption.y == 0.0f);
    CHECK(transmittance(absorption.z, 2.0f) == 0.0f);
    glass["extensions"]["KHR_materials_volume"]["attenuationDistance"] = 1e-38;
    CHECK(is_finite(gltf_surface(glass).absorption));
    glass["extensions"]["KHR_materials_volume"]["attenuationDistance"] = 0;
    const SceneDescription odd = load_material(glass);
    CHECK(odd.materials[0].absorption == glm::vec3(0.0f));
    CHECK(is_told(odd, "absorbs within no distance"));
    glass["extensions"]["KHR_materials_volume"] = {{"attenuationDistance", 2}, {"attenuationColor", {0.5, 1, 0}}};
    CHECK(gltf_surface(glass).absorption == glm::vec3(0.0f));  // thin
}

// At a roughness of 0.5 the facets are 0.25 wide, and along the tangent 0.25 + 0.75 times the square of the strength.
TEST_CASE("gltf materials: anisotropy of metals") {
    Json brushed = metal_rough({{"roughnessFactor", 0.5}});
    brushed["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.5}, {"anisotropyRotation", 1.0}};
    const MaterialDescription metal = gltf_surface(brushed);
    CHECK(metal.anisotropy == Approx(1.0 - 0.25 / 0.4375));
    CHECK(square(square(metal.roughness)) == Approx(0.25 * 0.4375));
    CHECK(metal.rotation_deg == Approx(57.29578));
    Json& extension = brushed["extensions"]["KHR_materials_anisotropy"];
    extension["anisotropyTexture"] = {{"index", 0}};
    CHECK(is_told(load_material(brushed), "images of anisotropy are left out"));
    extension = {{"anisotropyStrength", 1}};
    brushed["pbrMetallicRoughness"]["roughnessFactor"] = 0.05;
    const SceneDescription line = load_material(brushed);
    CHECK(line.materials[0].anisotropy == kMostAnisotropy);
    CHECK(is_told(line, "100 times as wide"));
    CHECK_FALSE(is_told(line, "texture coordinates"));
    GltfMaker bare;
    bare.triangle(brushed);
    bare.root["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    CHECK(is_told(load_gltf(bare), "1 triangles are anisotropic but have no texture coordinates"));
    CHECK_FALSE(is_told(load_gltf(bare), "tangents"));
    const auto tangents = bare.numbers(std::vector<float>(12, 1.0f), 5126, "VEC4", 3);
    bare.root["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = tangents;
    CHECK(is_told(load_gltf(bare), "tangents are left out: texture coordinates decide the direction of anisotropy"));
    brushed["pbrMetallicRoughness"] = {{"metallicFactor", 0.25}, {"roughnessFactor", 0.5}};
    const SceneDescription blend = load_material(brushed);
    REQUIRE(blend.materials.size() == 2);
    CHECK(blend.materials[0].anisotropy == 0.0f);
    CHECK(blend.materials[1].anisotropy == Approx(0.75));
    CHECK(is_told(blend, "anisotropy of other surfaces than metals is left out"));
    const SceneDescription plastic = load_material(extended("anisotropy", {{"anisotropyStrength", 0.5}}));
    CHECK(is_told(plastic, "anisotropy of other surfaces than metals is left out"));
    extension["anisotropyStrength"] = 2;
    CHECK(is_told(load_material(brushed), "a number out of the range of the format is moved into it"));
    extension["anisotropyStrength"] = 0;
    CHECK(load_material(brushed).materials[1].roughness == 0.5f);
    CHECK_FALSE(load_material(brushed).materials[1].is_anisotropic());
}

TEST_CASE("gltf materials: a clear coat on dielectrics") {
    const Json coat = extended("clearcoat", {{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 0.2}});
    CHECK(gltf_surface(coat).kind == SurfaceKind::Plastic);
    CHECK(gltf_surface(coat).roughness == 0.2f);
    Json metal = coat;
    metal["pbrMetallicRoughness"]["metallicFactor"] = 1;
    const SceneDescription scene = load_material(metal);
    CHECK(scene.materials[0].roughness == 1.0f);
    CHECK(is_told(scene, "a clear coat on metal"));
    metal["pbrMetallicRoughness"] = {{"metallicFactor", 0.25}, {"roughnessFactor", 0.5}};
    const SceneDescription blend = load_material(metal);
    REQUIRE(blend.materials.size() == 2);
    CHECK(blend.materials[0].roughness == 0.2f);
    CHECK(blend.materials[1].roughness == 0.5f);
    CHECK(is_told(blend, "a clear coat on metal"));
}

TEST_CASE("gltf materials: sheen makes velvet of dielectrics") {
    const Json sheen = {{"sheenColorFactor", {0.9, 0.5, 0.25}}, {"sheenRoughnessFactor", 0.5}};
    Json cloth = extended("sheen", sheen);
    cloth["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"baseColorFactor", {0.1, 0.2, 0.3, 1}}};
    const SceneDescription scene = load_material(cloth);
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].kind == SurfaceKind::Velvet);
    CHECK(scene.materials[0].albedo == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(scene.materials[0].specular == glm::vec3(0.9f, 0.5f, 0.25f));
    CHECK(scene.materials[0].roughness == 0.5f);
    CHECK(is_told(scene, "sheen takes the place of the reflection of its base"));
    Json& extension = cloth["extensions"]["KHR_materials_sheen"];
    extension.erase("sheenRoughnessFactor");
    CHECK(gltf_surface(cloth).roughness == SheenFibers::kLeastRoughness);
    CHECK(is_told(load_material(cloth), "sheen of a roughness below 0.26 is shown as one of 0.26"));
    extension["sheenColorFactor"] = {0, 0, 0};
    CHECK(gltf_surface(cloth).kind == SurfaceKind::Plastic);
    extension["sheenColorTexture"] = {{"index", 0}};
    CHECK(is_told(load_material(cloth), "images of the color of sheen are left out"));
    extension = sheen;
    cloth["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", 1}};
    CHECK(gltf_surface(cloth).kind == SurfaceKind::Plastic);
    CHECK(is_told(load_material(cloth), "sheen under a clear coat is left out"));
    Json metal = extended("sheen", sheen);
    metal["pbrMetallicRoughness"]["metallicFactor"] = 1;
    CHECK(gltf_surface(metal).kind == SurfaceKind::Conductor);
    CHECK(is_told(load_material(metal), "sheen on metal or glass is left out"));
}

TEST_CASE("gltf materials: emission with its strength, on both sides if the surface has two") {
    Json lamp = extended("emissive_strength", {{"emissiveStrength", 20}});
    lamp["emissiveFactor"] = {1, 0.5, 0};
    CHECK(gltf_surface(lamp).emission == glm::vec3(20.0f, 10.0f, 0.0f));
    CHECK_FALSE(gltf_surface(lamp).two_sided_emission);
    lamp["doubleSided"] = true;
    CHECK(gltf_surface(lamp).two_sided_emission);
    CHECK_FALSE(load_material(lamp).default_light);
    // A label lights nothing: the viewer does.
    lamp["extensions"].erase("KHR_materials_emissive_strength");
    const SceneDescription label = load_material(lamp);
    CHECK(label.default_light);
    CHECK(is_told(label, "no light in this scene but surfaces that glow; by default"));
}

TEST_CASE("gltf materials: unlit, specular-glossiness, and content that is left out") {
    const SceneDescription unlit = load_material(extended("unlit", Json::object()));
    CHECK(unlit.materials[0].kind == SurfaceKind::Diffuse);
    CHECK(is_told(unlit, "unlit surfaces are shown as diffuse ones"));
    const Json gloss = {
        {"diffuseFactor", {0.1, 0.2, 0.3, 1}}, {"glossinessFactor", 0.75}, {"specularFactor", {0, 0, 0.1}}};
    const MaterialDescription plastic = gltf_surface(extended("pbrSpecularGlossiness", gloss));
    CHECK(plastic.kind == SurfaceKind::Plastic);
    CHECK(plastic.albedo == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(plastic.roughness == 0.25f);
    Json metal = gloss;
    metal["specularFactor"] = {0.9, 0.8, 0.7};
    CHECK(gltf_surface(extended("pbrSpecularGlossiness", metal)).specular == glm::vec3(0.9f, 0.8f, 0.7f));
    for (const auto& [name, words] :
         {std::pair{"iridescence", "iridescence is left out"}, {"dispersion", "dispersion"}})
        CHECK(is_told(load_material(extended(name, Json::object())), words));
    const SceneDescription wild =
        load_material(metal_rough({{"roughnessFactor", 7}, {"baseColorFactor", {2, 0, 0, 1}}}));
    CHECK(wild.materials[0].roughness == 1.0f);
    CHECK(wild.materials[0].specular == glm::vec3(1.0f, 0.0f, 0.0f));
    CHECK(is_told(wild, "a number out of the range of the format is moved into it (2 in all)"));
}

TEST_CASE("gltf materials: of two with one name both can be told apart") {
    GltfMaker file;
    file.triangle({{"name", "a"}});
    file.triangle({{"name", "a"}});
    file.triangle(Json::object());
    const SceneDescription scene = load_gltf(file);
    CHECK(scene.materials[0].name == "a");
    CHECK(scene.materials[1].name == "a (1)");
    CHECK(scene.materials[2].name == "material 2");
}

TEST_CASE("gltf images: colors are decoded, roughness is green, and coordinates start at the top") {
    const Json info = {{"index", 0}};
    const SceneDescription scene = load_gltf(with_image(
        metal_rough({{"metallicFactor", 0}, {"baseColorTexture", info}, {"metallicRoughnessTexture", info}}),
        {255, 51, 0, 255, 0, 255, 255, 0}));
    const MaterialDescription& material = scene.materials[0];
    REQUIRE(scene.textures.size() == 2);
    const TextureDescription& color = scene.textures[material.textures.albedo];
    CHECK(color.texels[0].x == 1.0f);
    CHECK(color.texels[0].y == Approx(0.0331).epsilon(0.01));
    CHECK(material.textures.opacity == kNoTexture);
    const TextureDescription& rough = scene.textures[material.textures.roughness];
    CHECK(rough.texels[0].x == Approx(0.2));
    CHECK(rough.texels[1].x == 1.0f);
    CHECK(scene.uvs == std::vector<glm::vec2>{{0, 1}, {1, 1}, {0, 0}});
}

TEST_CASE("gltf images: an anisotropic metal has an image of roughness of its own") {
    Json material = metal_rough({{"roughnessFactor", 0.5}, {"metallicRoughnessTexture", {{"index", 0}}}});
    material["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", 0.5}};
    const SceneDescription scene = load_gltf(with_image(material, {0, 255, 255, 255, 0, 255, 255, 255}));
    const MaterialDescription& metal = scene.materials[0];
    CHECK(metal.roughness == 1.0f);
    CHECK(metal.anisotropy == Approx(1.0 - 0.25 / 0.4375));
    CHECK(square(square(scene.textures[metal.textures.roughness].texels[1].x)) == Approx(0.25 * 0.4375));
    CHECK(is_told(scene, "anisotropy with an image of roughness is that of its mean"));
}

TEST_CASE("gltf images: metalness that varies blends metal and plastic") {
    const Json material = metal_rough({{"metallicFactor", 0.5}, {"metallicRoughnessTexture", {{"index", 0}}}});
    const SceneDescription scene = load_gltf(with_image(material, {0, 99, 0, 255, 0, 99, 255, 255}));
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.triangles[0].material == 0);
    const MaterialDescription& base = scene.materials[0];
    CHECK(base.kind == SurfaceKind::Plastic);
    CHECK(base.blend == BlendDescription{.other = 1, .share = 0.5f});
    const TextureDescription& share = scene.textures[base.textures.blend];
    CHECK(share.texels[0].x == 0.0f);
    CHECK(share.texels[1].x == 1.0f);
    CHECK(scene.materials[1].kind == SurfaceKind::Conductor);
    CHECK(scene.materials[1].name == "material 0 (metal)");
    CHECK(scene.materials[1].textures.roughness == base.textures.roughness);
    CHECK(scene.warnings.size() == 1);  // of the light that the scene lacks
    const SceneDescription even = load_gltf(
        with_image(metal_rough({{"metallicRoughnessTexture", {{"index", 0}}}}), {0, 99, 255, 255, 0, 99, 255, 255}));
    REQUIRE(even.materials.size() == 1);
    CHECK(even.materials[0].kind == SurfaceKind::Conductor);
}

TEST_CASE("gltf images: transformations, sets and wrapping of coordinates") {
    const Json info = {
        {"index", 0},
        {"texCoord", 0},
        {"extensions",
         {{"KHR_texture_transform", {{"offset", {0.5, 0.25}}, {"scale", {2, 4}}, {"rotation", std::acos(0.0)}}}}}};
    GltfMaker file = with_image(metal_rough({{"baseColorTexture", info}}), {1, 2, 3, 4, 5, 6, 7, 8});
    file.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33071}}};
    file.root["textures"][0]["sampler"] = 0;
    const SceneDescription scene = load_gltf(file);
    CHECK_FALSE(scene.textures[0].repeats);
    // A quarter turn takes u to -v and v to u; then v is measured from below.
    const std::vector<glm::vec2> expected{{0.5f, 0.75f}, {0.5f, 2.75f}, {4.5f, 0.75f}};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(scene.uvs[i].x == Approx(expected[i].x).margin(1e-6));
        CHECK(scene.uvs[i].y == Approx(expected[i].y).margin(1e-6));
    }
    file.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}, {"texCoord", 1}};
    file.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = file.vec2({0, 1, 0, 1, 0, 1});
    file.root["samplers"][0] = {{"wrapS", 33648}};
    const SceneDescription other = load_gltf(file);
    CHECK(other.uvs[0] == glm::vec2(0.0f, 0.0f));
    CHECK(other.textures[0].repeats);
    CHECK(is_told(other, "mirrored repetition"));
}

TEST_CASE("gltf images: holes by the cutoff of the mask, and partial opacity") {
    const Json info = {{"index", 0}};
    Json material = metal_rough({{"baseColorTexture", info}});
    const std::array<std::uint8_t, 8> rgba{255, 255, 255, 51, 255, 255, 255, 255};
    material["alphaMode"] = "MASK";
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 1};
    SceneDescription scene = load_gltf(with_image(material, rgba));
    CHECK(scene.materials[0].textures.opacity == scene.materials[0].textures.albedo);
    CHECK(scene.textures[0].texels[0].w == Approx(0.2));
    CHECK(scene.materials[0].opacity == 1.0f);
    CHECK(scene.materials[0].opacity_rule == OpacityRule::Threshold);
    material["alphaCutoff"] = 0.1;
    scene = load_gltf(with_image(material, rgba));
    CHECK(scene.textures[0].texels[0].w == 1.0f);  // 0.2 is above the cutoff
    material["alphaMode"] = "BLEND";
    material["pbrMetallicRoughness"]["baseColorFactor"][3] = 0.5;
    scene = load_gltf(with_image(material, rgba));
    CHECK(scene.textures[0].texels[0].w == Approx(0.2));
    CHECK(scene.materials[0].textures.opacity == scene.materials[0].textures.albedo);
    CHECK(scene.materials[0].opacity == 0.5f);
    CHECK(scene.materials[0].opacity_rule == OpacityRule::Blend);
    material["alphaMode"] = "HALF";
    CHECK_THAT(test::input_error([&] { load_material(material); }),
               contains("expected OPAQUE, MASK or BLEND, got 'HALF'"));
}

TEST_CASE("gltf materials: an even opacity blends, or is that of nothing at all") {
    Json material = metal_rough({{"baseColorFactor", {1, 0, 0, 0.25}}, {"metallicFactor", 0}});
    material["alphaMode"] = "BLEND";
    const MaterialDescription veil = gltf_surface(material);
    CHECK(veil.kind == SurfaceKind::Plastic);
    CHECK(veil.albedo == glm::vec3(1, 0, 0));
    CHECK(veil.opacity == 0.25f);
    CHECK(veil.opacity_rule == OpacityRule::Blend);
    material["alphaMode"] = "OPAQUE";
    CHECK_FALSE(gltf_surface(material).may_have_holes());
    GltfMaker hidden;
    material["alphaMode"] = "MASK";
    hidden.triangle(material);
    material["alphaMode"] = "BLEND";
    material["pbrMetallicRoughness"]["baseColorFactor"][3] = 0;
    hidden.triangle(material);
    hidden.triangle(metal_rough({}));
    CHECK(load_gltf(hidden).triangles.size() == 1);
}

TEST_CASE("gltf: colors of vertices, as floats and as normalized integers, multiply the base color") {
    const auto colored = [](auto values, int component, const std::string& type, std::size_t count = 3) {
        GltfMaker file;
        file.triangle();
        file.triangle(metal_rough({{"metallicFactor", 0}}));
        const int accessor = file.numbers(values, component, type, count);
        file.root["accessors"][accessor]["normalized"] = component != 5126;
        file.root["meshes"][1]["primitives"][0]["attributes"]["COLOR_0"] = accessor;
        return file;
    };
    using Bytes = std::vector<std::uint8_t>;
    using Shorts = std::vector<std::uint16_t>;
    const SceneDescription bytes =
        load_gltf(colored(Bytes{255, 51, 0, 255, 0, 0, 255, 255, 102, 0, 0, 255}, 5121, "VEC4"));
    const std::vector<glm::vec3> expected{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 0.2f, 0}, {0, 0, 1}, {0.4f, 0, 0}};
    CHECK(bytes.vertex_colors == expected);
    CHECK(bytes.materials[bytes.triangles[1].material].albedo == glm::vec3(1.0f));
    CHECK_FALSE(is_told(bytes, "of vertices"));
    const SceneDescription shorts =
        load_gltf(colored(Shorts{65535, 13107, 0, 0, 0, 65535, 26214, 0, 0, 0}, 5123, "VEC3"));
    CHECK(shorts.vertex_colors == expected);
    const SceneDescription floats =
        load_gltf(colored(std::vector<float>{1, 0.2f, -1, 0, 0, 3, 0.4f, 0, 0}, 5126, "VEC3"));
    CHECK(floats.vertex_colors == expected);
    CHECK(is_told(floats, "colors of vertices outside of [0, 1] are moved into it"));
    CHECK_FALSE(is_told(load_gltf(colored(Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, 5121, "VEC4")), "opacities"));
    CHECK(load_gltf(colored(Bytes(12, 255), 5121, "VEC4")).vertex_colors.empty());
    CHECK_THAT(test::input_error([&] { load_gltf(colored(Bytes(12, 9), 5121, "VEC4", 2)); }),
               contains("expected one element for each of the 3 vertices, got 2"));
    CHECK_THROWS_AS(load_gltf(colored(std::vector<float>(6), 5126, "VEC2")), Error);
}

TEST_CASE("gltf images: one that cannot be read is shown as checkers, one outside of the folder refused", "[hard]") {
    GltfMaker file = with_image(metal_rough({{"baseColorTexture", {{"index", 0}}}}), {1, 2, 3, 4, 5, 6, 7, 8});
    file.root["images"][0] = {{"uri", "none.png"}};
    const SceneDescription scene = load_gltf(file);
    CHECK(is_told(scene, "none.png"));
    CHECK(is_told(scene, "shown as checkers"));
    CHECK(scene.textures[0].texels[0] == glm::vec4(1, 0, 1, 1));
    file.root["images"][0] = {{"uri", "data:image/png;base64,iVBORw0KGgo="}};
    CHECK(is_told(load_gltf(file), "shown as checkers"));
    file.root["images"][0] = {{"uri", "../none.png"}};
    CHECK_THAT(test::input_error([&] { load_gltf(file); }),
               contains("'images/0/uri': expected data or a file in the folder"));
    file.root["textures"][0]["source"] = 5;
    CHECK_THAT(test::input_error([&] { load_gltf(file); }), contains("expected an index into the 1 images, got 5"));
}

TEST_CASE("gltf images: normal maps are linear, with their scale") {
    Json material = metal_rough({{"metallicFactor", 0}});
    material["normalTexture"] = {{"index", 0}, {"scale", 0.5}};
    const SceneDescription scene = load_gltf(with_image(material, {255, 51, 0, 255, 0, 255, 255, 0}));
    REQUIRE(scene.textures.size() == 1);
    CHECK(scene.materials[0].textures.normal == 0);
    CHECK(scene.materials[0].normal_strength == 0.5f);
    CHECK(scene.textures[0].texels[0].y == Approx(0.2));
    CHECK(scene.textures[0].content == TextureContent::Normal);
    CHECK_FALSE(is_told(scene, "normal"));
    material["normalTexture"]["scale"] = -1;
    const SceneDescription odd = load_gltf(with_image(material, {255, 51, 0, 255, 0, 255, 255, 0}));
    CHECK(odd.materials[0].normal_strength == 0.0f);
    CHECK(is_told(odd, "out of the range"));
}

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
