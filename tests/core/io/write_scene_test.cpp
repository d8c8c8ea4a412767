// Scene files as written: what is read back is the same, value by value.
#include "core/io/write_scene.h"

#include <cmath>

#include "core/base/error.h"
#include "core/io/image.h"
#include "core/io/load_scene.h"
#include "core/scene/instances.h"
#include "core/scene/scene_hash.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/assets.h"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::input_error;
using pl::test::kAssets;
using pl::test::TemporaryFolder;

namespace {

SceneDescription rewritten(const SceneDescription& scene) {
    const TemporaryFolder folder;
    write_scene(scene, folder.path() / "s.json");
    return load_scene((folder.path() / "s.json").string(), "");
}

/// A lit triangle with a material.
SceneDescription triangle_of(const MaterialDescription& material) {
    SceneDescription scene;
    scene.name = "one";
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1e-7f, 1.0f / 3.0f}};
    scene.uvs = {{0, 0}, {1, 0}, {0, 0.1f}};
    scene.triangles = {{.vertex = {0, 1, 2}, .uv = {0, 1, 2}}};
    scene.materials = {material};
    scene.environment = glm::vec3(0.1f, 0.2f, 0.3f);
    scene.camera = {.eye = {0, 0, 3}, .target = {0, 0, 0}};
    return scene;
}

TextureDescription texture_of(std::vector<glm::vec4> texels, TextureContent content, bool repeats) {
    return {.source = "x",
            .content = content,
            .width = static_cast<std::uint32_t>(texels.size()),
            .height = 1,
            .repeats = repeats,
            .texels = std::move(texels)};
}

}  // namespace

TEST_CASE("write_scene: a shifted picture, and a mirrored one") {
    SceneDescription scene = load_scene("cornell", kAssets);
    scene.camera.shift = {0.5f, -0.25f};
    CHECK(rewritten(scene).camera.shift == scene.camera.shift);
    CHECK_FALSE(rewritten(scene).camera.is_mirrored);
    scene.camera.is_mirrored = true;
    CHECK(rewritten(scene).camera.is_mirrored);
}

TEST_CASE("write_scene: an environment map in axes of its own") {
    SceneDescription scene = triangle_of({.name = "wall", .albedo = glm::vec3(0.5f)});
    scene.environment_map = {.width = 2, .height = 1, .rotation_deg = 20.0f, .texels = {glm::vec3(1), glm::vec3(2)}};
    CHECK(rewritten(scene).environment_map.axes == glm::mat3(1.0f));
    scene.environment_map.axes = glm::mat3(0, 0, 1, 0, 1, 0, 1, 0, 0);
    const SceneDescription read = rewritten(scene);
    CHECK(read.environment_map.axes == scene.environment_map.axes);
    CHECK(scene_hash(read) == scene_hash(scene));
    scene.environment_map.axes[0] = {0, 0, 2};
    CHECK_THROWS_AS(rewritten(scene), Error);
}

TEST_CASE("write_scene: shipped scenes without images have the same hash, camera and settings") {
    for (const std::string& name : list_scenes(kAssets)) {
        CAPTURE(name);
        const SceneDescription scene = load_scene(name, kAssets);
        if (!scene.textures.empty()) continue;
        const SceneDescription read = rewritten(scene);
        CHECK(read.warnings.empty());
        CHECK(scene_hash(read) == scene_hash(scene));
        CHECK(read.camera.eye == scene.camera.eye);
        CHECK(read.camera.focus_distance == scene.camera.focus_distance);
        CHECK(read.up == scene.up);
        CHECK(read.settings.size() == scene.settings.size());
        CHECK(read.name == scene.name);
        CHECK(read.summary == scene.summary);
    }
}

TEST_CASE("write_scene: lights without extent, and lights that are refused") {
    SceneDescription scene = triangle_of({.name = "wall", .albedo = glm::vec3(0.5f)});
    scene.punctual_lights = {{.kind = PunctualKind::Point, .position = {1, 2, 3}, .intensity = {4, 5, 6}},
                             {.kind = PunctualKind::Spot,
                              .position = {1, 2, 3},
                              .direction = {0, -1, 0.5f},
                              .intensity = {4, 5, 6},
                              .inner_deg = 10,
                              .outer_deg = 20.5f,
                              .falloff = SpotFalloff::Angle},
                             {.kind = PunctualKind::Directional, .direction = {0, 0, -1}, .intensity = {0, 0.1f, 0}}};
    const SceneDescription read = rewritten(scene);
    CHECK(read.punctual_lights == scene.punctual_lights);
    CHECK(scene_hash(read) == scene_hash(scene));
    for (int wrong = 0; wrong < 3; ++wrong) {
        SceneDescription bad = scene;
        if (wrong == 0) bad.punctual_lights[0].intensity.x = -1.0f;
        if (wrong == 1) bad.punctual_lights[1].inner_deg = 21.0f;
        if (wrong == 2) bad.punctual_lights[2].direction = glm::vec3(0.0f);
        CHECK_THROWS_AS(rewritten(bad), Error);
    }
}

TEST_CASE("write_scene: normals keep bits that dividing by the length would change") {
    SceneDescription scene = triangle_of({.name = "wall", .albedo = glm::vec3(0.5f)});
    for (int i = 0; i < 300; ++i) {
        const double angle = 0.37 * i;
        scene.normals.emplace_back(
            glm::dvec3(std::cos(angle) * std::sin(0.1 * i), std::sin(angle) * std::sin(0.1 * i), std::cos(0.1 * i)));
    }
    scene.triangles[0].normal = {7, 8, 9};
    const SceneDescription read = rewritten(scene);
    CHECK(read.normals == scene.normals);
    CHECK(read.triangles[0].normal == scene.triangles[0].normal);
    CHECK(read.positions == scene.positions);
    CHECK(read.uvs == scene.uvs);
}

TEST_CASE("write_scene: each use of an image has its channels, its bits and its border") {
    MaterialDescription material{
        .name = "m", .albedo = glm::vec3(0.8f), .kind = SurfaceKind::Plastic, .roughness = 0.5f};
    material.emission = glm::vec3(2.0f);
    material.textures = {.albedo = 0, .roughness = 1, .emission = 2, .opacity = 0};
    SceneDescription scene = triangle_of(material);
    // The opacity lies in the alpha channel of the color, as of glTF files.
    scene.textures = {texture_of({{0.1f, 0.2f, 0.3f, 0.25f}, {1, 0, 1, 0.75f}}, TextureContent::Color, false),
                      texture_of({{128.0f / 255.0f, 0, 0.5f, 1}, {1, 1, 1, 1}}, TextureContent::Number, true),
                      texture_of({{100.0f, 0, 0, 1}, {0, 1e-5f, 0, 1}}, TextureContent::Color, true)};
    const SceneDescription read = rewritten(scene);
    const TextureUse& use = read.materials[0].textures;
    REQUIRE(read.textures.size() == 4);
    const auto texel = [&](std::uint32_t texture, std::size_t i) { return read.textures[texture].texels[i]; };
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(glm::vec3(texel(use.albedo, i)) == glm::vec3(scene.textures[0].texels[i]));
        CHECK(texel(use.opacity, i).w == scene.textures[0].texels[i].w);
        CHECK(texel(use.roughness, i).x == scene.textures[1].texels[i].x);
        CHECK(glm::vec3(texel(use.emission, i)) == glm::vec3(scene.textures[2].texels[i]));
    }
    CHECK_FALSE(read.textures[use.albedo].repeats);
    CHECK_FALSE(read.textures[use.opacity].repeats);
    CHECK(read.textures[use.roughness].repeats);
    CHECK(read.textures[use.roughness].source.extension() == ".png");
    CHECK(read.textures[use.emission].source.extension() == ".exr");
}

TEST_CASE("write_scene: vertices keep the bits of their colors, and an image without enough of them is refused") {
    SceneDescription scene = triangle_of({.name = "m", .albedo = glm::vec3(0.8f)});
    scene.vertex_colors = {{0.1f, 1.0f / 3.0f, 1.0f}, {0, 1e-7f, 0.5f}, {1, 1, 1}};
    const SceneDescription read = rewritten(scene);
    CHECK(read.vertex_colors == scene.vertex_colors);
    CHECK(scene_hash(read) == scene_hash(scene));
    scene.vertex_colors.clear();
    CHECK(scene_hash(read) != scene_hash(scene));

    const TemporaryFolder folder;
    folder.write("a.obj", "v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
    const auto with = [&](const std::string& image) {
        return folder
            .write("s.json", R"({"schema": "pathlight.scene/1", "obj": "a.obj", "vertex_colors": ")" + image + "\"}")
            .string();
    };
    write_pfm(folder.path() / "two.pfm", {.width = 2, .height = 1, .pixels = {glm::vec3(1), glm::vec3(0)}});
    CHECK_THAT(input_error([&] { load_scene(with("two.pfm"), ""); }),
               contains("expected an image with a texel for each of 3 vertices, got 2"));
    CHECK_THAT(input_error([&] { load_scene(with("../two.pfm"), ""); }), contains("in the folder of the scene"));
    CHECK_THAT(input_error([&] { load_scene(with("none.pfm"), ""); }), contains("none.pfm"));
    write_pfm(folder.path() / "bright.pfm", {.width = 2, .height = 2, .pixels = std::vector(4, glm::vec3(7.0f))});
    CHECK_THAT(input_error([&] { load_scene(with("bright.pfm"), ""); }), contains("is not within [0, 1] (3 such)"));
}

TEST_CASE("write_scene: blends keep the material, the share and the image, and change the hash") {
    SceneDescription scene = triangle_of({.name = "paint", .albedo = glm::vec3(0.8f)});
    scene.materials.push_back({.name = "paint", .kind = SurfaceKind::Conductor});
    scene.materials.push_back({.name = "rust", .albedo = {0.4f, 0.1f, 0.0f}});
    scene.materials[0].blend = {.other = 1, .share = 0.3f};
    scene.materials[0].textures.blend = 0;
    scene.materials[1].blend = {.other = 2, .share = 1.0f};
    scene.textures = {texture_of({{128.0f / 255.0f, 0, 0, 1}, {1, 1, 1, 1}}, TextureContent::Number, false)};
    const SceneDescription read = rewritten(scene);
    REQUIRE(read.materials.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) CHECK(read.materials[i].blend == scene.materials[i].blend);
    REQUIRE(read.materials[0].textures.blend == 0);
    CHECK(read.textures[0].texels[0].x == scene.textures[0].texels[0].x);
    CHECK_FALSE(read.textures[0].repeats);
    const std::string hash = scene_hash(read);
    scene.materials[1].blend.share = 0.5f;
    CHECK(scene_hash(scene) != hash);
    scene.materials[1].blend = {};
    CHECK(scene_hash(scene) != hash);
}

TEST_CASE("write_scene: anisotropy keeps its numbers and the texture coordinates, and changes the hash") {
    SceneDescription scene = triangle_of({.name = "brushed",
                                          .kind = SurfaceKind::Conductor,
                                          .roughness = 0.5f,
                                          .anisotropy = 0.75f,
                                          .rotation_deg = 30.0f});
    scene.uvs = {{0, 0}, {1, 0}, {0.5f, 1}};
    scene.triangles[0].uv = {0, 1, 2};
    const SceneDescription read = rewritten(scene);
    CHECK(read.materials[0].anisotropy == 0.75f);
    CHECK(read.materials[0].rotation_deg == 30.0f);
    CHECK(read.uvs == scene.uvs);
    const std::string hash = scene_hash(read);
    for (const auto& edit : {+[](SceneDescription& s) { s.materials[0].anisotropy = 0.5f; },
                             +[](SceneDescription& s) { s.materials[0].rotation_deg = 60.0f; },
                             +[](SceneDescription& s) {
                                 s.uvs[1] = {0, 1};
                             }}) {
        SceneDescription other = read;
        edit(other);
        CHECK(scene_hash(other) != hash);
    }
    // Of other surfaces it is nothing.
    scene.materials[0].kind = SurfaceKind::Plastic;
    const std::string plastic = scene_hash(scene);
    scene.materials[0].anisotropy = 0.5f;
    CHECK(scene_hash(scene) == plastic);
}

TEST_CASE("write_scene: opacities keep their number, image and rule") {
    for (const OpacityRule rule : {OpacityRule::Threshold, OpacityRule::Blend}) {
        MaterialDescription material{.name = "m", .albedo = glm::vec3(0.8f)};
        material.textures.opacity = 0;
        material.opacity = 0.3f;
        material.opacity_rule = rule;
        SceneDescription scene = triangle_of(material);
        scene.textures = {
            texture_of({{1, 1, 1, 128.0f / 255.0f}, {1, 1, 1, 51.0f / 255.0f}}, TextureContent::Opacity, true)};
        const SceneDescription read = rewritten(scene);
        REQUIRE(read.materials[0].textures.opacity == 0);
        CHECK(read.textures[0].texels[1].w == scene.textures[0].texels[1].w);
        CHECK(read.materials[0].opacity == 0.3f);
        CHECK(read.materials[0].opacity_rule == rule);
    }
}

TEST_CASE("write_scene: normal maps keep all channels and their strength") {
    MaterialDescription material{.name = "m", .albedo = glm::vec3(0.8f)};
    material.textures.normal = 0;
    material.normal_strength = 0.3f;
    material.normal_green = NormalGreen::Left;
    SceneDescription scene = triangle_of(material);
    scene.textures = {
        texture_of({{128.0f / 255.0f, 0, 1, 1}, {1, 51.0f / 255.0f, 0, 1}}, TextureContent::Normal, true)};
    const SceneDescription read = rewritten(scene);
    REQUIRE(read.materials[0].textures.normal == 0);
    CHECK(read.materials[0].normal_strength == 0.3f);
    CHECK(read.materials[0].normal_green == NormalGreen::Left);
    CHECK(read.textures[0].content == TextureContent::Normal);
    CHECK(read.textures[0].texels == scene.textures[0].texels);
    CHECK(read.textures[0].source.extension() == ".png");
}

TEST_CASE("write_scene: names of materials become different, and fit for all three files") {
    SceneDescription scene = triangle_of({.name = "a"});
    for (const char* name : {"a", "", " two  blanks ", "#x\\", "line\nfeed", "latin \xe9", "Gr\xc3\xbcn"})
        scene.materials.push_back({.name = name, .albedo = glm::vec3(0.5f)});
    const std::vector<std::string> names = material_names(scene);
    CHECK(names == std::vector<std::string>{"a", "a (2)", "material", "_two _blanks_", "_x_", "line_feed", "latin _",
                                            "Gr\xc3\xbcn"});
    const SceneDescription read = rewritten(scene);
    REQUIRE(read.materials.size() == names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        CHECK(read.materials[i].name == names[i]);
        CHECK(read.materials[i].albedo == scene.materials[i].albedo);
    }
}

TEST_CASE("write_scene: vertical axes that the camera does not tell are kept") {
    for (const glm::vec3 up : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)}) {
        SceneDescription scene = triangle_of({.name = "a", .albedo = glm::vec3(0.5f)});
        scene.up = up;
        CHECK(rewritten(scene).up == up);
    }
}

TEST_CASE("a scene file lists cameras, of which the first is shown unless it has one of its own") {
    const TemporaryFolder folder;
    folder.write("a.obj", "v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
    const auto load = [&](const std::string& members, const LoadSettings& asked = {}) {
        const std::string text = "{\"schema\": \"pathlight.scene/1\", \"obj\": \"a.obj\"" + members + "}";
        return load_scene(folder.write("s.json", text).string(), "", asked);
    };
    const std::string list = ", \"cameras\": [{\"name\": \"one\", \"eye\": [0, 1, 5], \"aspect\": 2}, {\"eye\": [0, "
                             "1, 9], \"fov_deg\": 20}]";
    const SceneDescription first = load(list);
    CHECK(first.chosen_camera == 1);
    CHECK(first.camera.eye == glm::vec3(0, 1, 5));
    CHECK(first.setting("size") == "1024x512");
    CHECK(first.cameras[1].name == "camera 2");
    CHECK(load(list, {.camera = "2"}).camera.fov_deg == 20.0f);
    CHECK(load(list + ", \"camera\": {\"eye\": [0, 1, 7]}").camera.eye == glm::vec3(0, 1, 7));
    CHECK_THROWS_AS(load(", \"cameras\": [{\"eye\": [0, 0, 1], \"target\": [0, 0, 1]}]"), Error);
    CHECK_THROWS_AS(load(", \"cameras\": [{\"aspect\": -1}]"), Error);
    CHECK_THROWS_AS(load(", \"cameras\": [{\"nam\": \"x\"}]"), Error);
    CHECK_THROWS_AS(load(", \"normals\": \"flat\""), Error);
}

TEST_CASE("write_scene: instances are written as copies, with the corners and normals that they have") {
    SceneDescription scene = triangle_of({.name = "wall", .albedo = glm::vec3(0.5f)});
    scene.positions.insert(scene.positions.end(), {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
    scene.normals = {{0, 0, 1}, glm::normalize(glm::vec3(0.1f, 0.2f, 1))};
    scene.triangles.push_back({.vertex = {3, 4, 5}, .normal = {0, 1, 0}, .uv = {0, 1, 2}});
    scene.meshes = {{"leaf", 1, 1}};
    scene.instances = {{0, glm::mat4x3(2, 0.1f, 0, 0, 3, 0.3f, 0.5f, 0, 1, 5, 6, 7)}, {0, glm::mat4x3(1.0f)}};
    const SceneDescription read = rewritten(scene);
    SceneDescription copied = scene;
    expand_instances(copied);
    REQUIRE(read.triangles.size() == 3);
    CHECK(read.meshes.empty());
    CHECK(read.positions == copied.positions);
    CHECK(read.normals == copied.normals);
    CHECK(scene_hash(read) == scene_hash(copied));
}

TEST_CASE("write_scene: more copies than a scene file may have are refused, and nothing is written") {
    SceneDescription scene = triangle_of({.name = "wall"});
    scene.triangles.resize(70000, scene.triangles[0]);
    scene.meshes = {{"leaf", 0, 70000}};
    scene.instances.resize(1000);
    const TemporaryFolder folder;
    CHECK_THAT(input_error([&] { write_scene(scene, folder.path() / "s.json"); }),
               contains("scene files hold no instances") && contains("at most 67108864") && contains("got 70000000"));
    CHECK(std::filesystem::is_empty(folder.path()));
}
