// Meshes of glTF files that are shown more than once: kept once above a limit, with the triangles of copies.
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/io/kept_meshes.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/load_gltf.h"
#include "tests/support/scenes/copies.h"

using namespace pl;
using pl::test::check_same_triangles;
using pl::test::contains;
using pl::test::expanded;
using pl::test::gltf_refusal;
using pl::test::GltfMaker;
using pl::test::kKeepInstances;
using pl::test::load_gltf;
using pl::test::TemporaryFolder;

namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

/// A mesh of two primitives of different materials: a tilted square with normals, texture coordinates and colors, and a triangle.
int leaf(GltfMaker& file) {
    file.root["materials"] = {{{"name", "green"}}, {{"name", "brown"}, {"doubleSided", true}}};
    const int square = file.vec3({-0.5f, 0.1f, 0, 1, 0, 0.3f, 1.1f, 1, 0, 0, 1.3f, 0.7f});
    const int mesh = file.mesh({{"attributes",
                                 {{"POSITION", square},
                                  {"NORMAL", file.vec3({0, 0.1f, 1, 0.2f, 0, 1, 0.3f, 0.3f, 1, -0.4f, 0, 1})},
                                  {"TEXCOORD_0", file.vec2({0, 0, 1, 0, 1, 1, 0, 1})},
                                  {"COLOR_0", file.vec3({1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5f, 0.5f, 0.25f})}}},
                                {"indices", file.indices({0, 1, 2, 0, 2, 3})},
                                {"material", 0}});
    file.root["meshes"][static_cast<std::size_t>(mesh)]["primitives"].push_back(
        {{"attributes", {{"POSITION", file.vec3({0, 0, 0, 0.2f, 0.1f, -1, 0, 1, -1})}}}, {"material", 1}});
    file.root["meshes"][static_cast<std::size_t>(mesh)]["name"] = "leaf";
    return mesh;
}

/// Checks that the file gives instances above the limit, and the same triangles as below it.
SceneDescription check_kept(const GltfMaker& file, std::size_t meshes, std::size_t instances) {
    const SceneDescription kept = load_gltf(file, kKeepInstances);
    CHECK(kept.meshes.size() == meshes);
    CHECK(kept.instances.size() == instances);
    const SceneDescription copied = load_gltf(file);
    CHECK(copied.meshes.empty());
    CHECK(copied.instances.empty());
    check_same_triangles(expanded(kept), copied);
    return kept;
}

/// Attributes of the extension at a node.
Json instancing(const Json& attributes) { return {{kExtension, {{"attributes", attributes}}}}; }

}  // namespace

TEST_CASE("gltf instances: a mesh of several nodes is kept once and has the triangles of copies") {
    GltfMaker file;
    file.triangle();
    const int mesh = leaf(file);
    const double half = std::sqrt(0.5);
    file.node({{"mesh", mesh}, {"translation", {5, 0.1, -3}}});
    file.node({{"mesh", mesh}, {"rotation", {half, 0, 0, half}}, {"scale", {3, 0.2, 1.7}}});
    file.node({{"mesh", mesh}, {"matrix", {1, 0.3, 0, 0, -0.2, 2, 0.5, 0, 0, 0.1, 1.5, 0, 7, 8, 9, 1}}});
    file.node({{"children", {3, 2}}, {"rotation", {0, 0.6, 0, 0.8}}, {"scale", {2, 1, 3}}});
    const SceneDescription kept = check_kept(file, 1, 3);
    CHECK(direct_triangles(kept) == 1);
    CHECK(kept.triangles.size() == 4);
    CHECK(kept.meshes[0].name == "leaf");
    CHECK(kept.vertex_colors.size() == kept.positions.size());
    // In the mesh's own space, behind everything direct.
    CHECK(kept.positions[kept.triangles[1].vertex.x] == glm::vec3(-0.5f, 0.1f, 0));
}

TEST_CASE("gltf instances: mirrored nodes show a mirror image of the mesh and keep their front") {
    GltfMaker file;
    const int mesh = leaf(file);
    file.node({{"mesh", mesh}, {"translation", {5, 0, 0}}});
    file.node({{"mesh", mesh}, {"scale", {1, -2, 1}}});
    file.node({{"mesh", mesh}, {"scale", {-1, 1, 1.5}}, {"rotation", {0, 0.6, 0, 0.8}}});
    file.node({{"mesh", mesh}, {"scale", {-1, -1, 1}}});
    const SceneDescription kept = check_kept(file, 2, 4);
    CHECK(kept.triangles.size() == 6);
    CHECK(kept.meshes[1].name == "leaf (mirrored)");
}

TEST_CASE("gltf instances: the limit counts the copies of what is shown more than once") {
    GltfMaker file;
    const int mesh = leaf(file);
    for (int i = 0; i < 3; ++i) file.triangle();  // a mesh each
    for (int i = 0; i < 4; ++i) file.node({{"mesh", mesh}, {"translation", {i, 0, 0}}});
    CHECK(load_gltf(file, {.most_copied_triangles = 12}).instances.empty());
    const SceneDescription kept = load_gltf(file, {.most_copied_triangles = 11});
    CHECK(kept.instances.size() == 4);
    CHECK(kept.meshes.size() == 1);
    CHECK(direct_triangles(kept) == 3);
}

TEST_CASE("gltf instances: meshes that emit, have skins, or are shown once in an orientation are copied") {
    GltfMaker file;
    file.triangle({{"name", "lamp"}, {"emissiveFactor", {1, 1, 1}}});
    file.node({{"mesh", 0}, {"translation", {1, 0, 0}}});
    const int skinned = file.mesh(
        {{"attributes",
          {{"POSITION", file.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})},
           {"JOINTS_0", file.numbers(std::vector<std::uint8_t>(12, 0), 5121, "VEC4", 3)},
           {"WEIGHTS_0", file.numbers(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 3)}}}});
    file.root["skins"] = {{{"joints", {0}}}};
    for (int i = 0; i < 2; ++i) file.node({{"mesh", skinned}, {"skin", 0}});
    file.triangle();
    file.node({{"mesh", 2}, {"scale", {-1, 1, 1}}});
    const SceneDescription scene = load_gltf(file, kKeepInstances);
    CHECK(scene.instances.empty());
    CHECK(scene.meshes.empty());
    CHECK(scene.triangles.size() == 6);
}

TEST_CASE("gltf instances: places that cannot be inverted or are too far away are copied") {
    GltfMaker file;
    const int mesh = leaf(file);
    file.node({{"mesh", mesh}, {"scale", {1, 0, 1}}});
    for (int i = 0; i < 2; ++i) file.node({{"mesh", mesh}, {"translation", {i, 0, 0}}});
    const SceneDescription kept = check_kept(file, 1, 2);
    CHECK(direct_triangles(kept) == 3);
    file.node({{"mesh", mesh}, {"translation", {2e18, 0, 0}}});
    CHECK_THAT(gltf_refusal(file, kKeepInstances), contains("expected coordinates up to 1e+18"));
}

TEST_CASE("gltf instances: triangles without area and normals of no length are left out of the mesh") {
    GltfMaker file;
    const int mesh = file.mesh({{"attributes",
                                 {{"POSITION", file.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0})},
                                  {"NORMAL", file.vec3({0, 0, 2, 0, 0, 2, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1})}}}});
    for (int i = 0; i < 2; ++i) file.node({{"mesh", mesh}, {"translation", {i, 0, 0}}});
    const SceneDescription kept = check_kept(file, 1, 2);
    CHECK(kept.triangles.size() == 1);
    GltfMaker flat;
    const int nothing = flat.mesh({{"attributes", {{"POSITION", flat.vec3({0, 0, 0, 1, 0, 0, 1, 0, 0})}}}});
    flat.triangle();
    for (int i = 0; i < 2; ++i) flat.node({{"mesh", nothing}});
    CHECK(load_gltf(flat, kKeepInstances).meshes.empty());
}

TEST_CASE("gltf instances: EXT_mesh_gpu_instancing places a node's mesh, copied or kept") {
    GltfMaker file;
    file.root["extensionsUsed"] = {kExtension};
    const int mesh = leaf(file);
    const int moves = file.vec3({0, 0, 0, 4, 0, 0, 0, 5, 0.5f});
    // Halves of a turn as normalized integers.
    const int turns = file.accessor({{"bufferView", file.view(test::bytes_of<std::int16_t>(
                                                        {0, 0, 0, 32767, 23170, 0, 0, 23170, 0, 32767, 0, 0}))},
                                     {"componentType", 5122},
                                     {"normalized", true},
                                     {"type", "VEC4"},
                                     {"count", 3}});
    const int scales = file.vec3({1, 1, 1, 2, 0.5f, 1, 0.7f, 0.7f, 0.7f});
    const int ids = file.numbers(std::vector<float>{1, 2, 3}, 5126, "SCALAR", 3);
    file.node(
        {{"mesh", mesh},
         {"translation", {0, 0, -2}},
         {"rotation", {0, 0.6, 0, 0.8}},
         {"extensions", instancing({{"TRANSLATION", moves}, {"ROTATION", turns}, {"SCALE", scales}, {"_ID", ids}})}});
    const SceneDescription kept = check_kept(file, 1, 3);
    CHECK(kept.triangles.size() == 3);
    for (const std::string& warning : kept.warnings) CHECK(warning.find("extension") == std::string::npos);
    // Move, turn and scale as a node below does.
    GltfMaker nodes;
    const int same = leaf(nodes);
    nodes.node({{"translation", {0, 0, -2}}, {"rotation", {0, 0.6, 0, 0.8}}, {"children", {1, 2, 3}}});
    const double half = std::sqrt(0.5);
    nodes.node({{"mesh", same}});
    nodes.node(
        {{"mesh", same}, {"translation", {4, 0, 0}}, {"rotation", {half, 0, 0, half}}, {"scale", {2, 0.5, 1}}});
    nodes.node(
        {{"mesh", same}, {"translation", {0, 5, 0.5}}, {"rotation", {0, 1, 0, 0}}, {"scale", {0.7, 0.7, 0.7}}});
    check_same_triangles(load_gltf(file), load_gltf(nodes));
}

TEST_CASE("gltf instances: EXT_mesh_gpu_instancing with attributes of its own alone, and beside a skin, shows the "
          "mesh once") {
    GltfMaker file;
    file.triangle();
    file.root["nodes"][0]["extensions"] =
        instancing({{"_ID", file.numbers(std::vector<float>{1, 2}, 5126, "SCALAR", 2)}});
    CHECK(load_gltf(file).triangles.size() == 1);
    file.root["nodes"][0]["extensions"] = instancing({{"TRANSLATION", file.vec3({0, 0, 0, 1, 0, 0})}});
    CHECK(load_gltf(file).triangles.size() == 2);
    file.root["skins"] = {{{"joints", {0}}}};
    file.root["nodes"][0]["skin"] = 0;
    const SceneDescription skinned = load_gltf(file, kKeepInstances);
    CHECK(skinned.triangles.size() == 1);
    CHECK(std::any_of(skinned.warnings.begin(), skinned.warnings.end(), [](const std::string& warning) {
        return warning.find("instances of meshes with skins are left out") != std::string::npos;
    }));
}

TEST_CASE("gltf instances: damaged places are refused with file, place, expected and got", "[hard]") {
    struct Case {
        const char* told;
        std::function<void(GltfMaker&, Json& attributes)> damage;
    };
    const std::vector<Case> cases = {
        {"expected an index into the", [](GltfMaker&, Json& a) { a["TRANSLATION"] = 99; }},
        {"attributes/SCALE': expected an element for each of 2 instances, got 1",
         [](GltfMaker& f, Json& a) {
             a["SCALE"] = f.vec3({1, 1, 1});
         }},
        {"expected VEC4 for this use, got 'VEC3'",
         [](GltfMaker& f, Json& a) {
             a["ROTATION"] = f.vec3({0, 0, 0, 1, 1, 1});
         }},
        {"attributes/ROTATION': expected unit quaternions, got one of no length at instance 1",
         [](GltfMaker& f, Json& a) {
             a["ROTATION"] = f.numbers(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 0}, 5126, "VEC4", 2);
         }},
        {"expected finite numbers, got nan",
         [](GltfMaker& f, Json& a) {
             a["SCALE"] = f.vec3({1, 1, NAN, 1, 1, 1});
         }},
        {"expected at most 67108864 instances, got 4000000000",
         [](GltfMaker& f, Json& a) {
             f.root["accessors"][a["TRANSLATION"].get<std::size_t>()]["count"] = 4000000000u;
         }},
        {"elements without a buffer view, got 60000000",
         [](GltfMaker& f, Json& a) {
             a["TRANSLATION"] = f.accessor({{"componentType", 5126}, {"type", "VEC3"}, {"count", 60000000}});
         }},
        {"bytes of its buffer view, got 3 elements",
         [](GltfMaker& f, Json& a) { f.root["accessors"][a["TRANSLATION"].get<std::size_t>()]["count"] = 3; }},
    };
    for (const Case& broken : cases) {
        GltfMaker file;
        file.triangle();
        Json attributes{{"TRANSLATION", file.vec3({0, 0, 0, 1, 0, 0})}};
        broken.damage(file, attributes);
        file.root["nodes"][0]["extensions"] = instancing(attributes);
        INFO(broken.told);
        CHECK_THAT(gltf_refusal(file), contains("s.gltf") && contains(broken.told));
        CHECK_THAT(gltf_refusal(file, kKeepInstances), contains(broken.told));
    }
}

TEST_CASE("gltf instances: ten thousand of a mesh of a hundred thousand triangles are stored as one", "[hard]") {
    GltfMaker file;
    constexpr int kTriangles = 100000;
    std::vector<float> positions;
    for (int i = 0; i < kTriangles + 2; ++i) {
        const float x = static_cast<float>(i);
        positions.insert(positions.end(), {x, static_cast<float>(i % 2), 0.1f * static_cast<float>(i % 7)});
    }
    const int mesh = file.mesh({{"attributes", {{"POSITION", file.vec3(positions)}}}, {"mode", 5}});
    std::vector<float> moves;
    for (int i = 0; i < 10000; ++i)
        moves.insert(moves.end(), {static_cast<float>(i % 100), static_cast<float>(i / 100), 0});
    file.node({{"mesh", mesh}, {"extensions", instancing({{"TRANSLATION", file.vec3(moves)}})}});
    const SceneDescription scene = load_gltf(file);
    CHECK(scene.triangles.size() == kTriangles);
    CHECK(scene.positions.size() == kTriangles + 2);
    CHECK(scene.meshes.size() == 1);
    CHECK(scene.instances.size() == 10000);
    CHECK(shown_triangles(scene) == 1000000000);
    CHECK(complaints_about_instances(scene).empty());
}

TEST_CASE("gltf instances: more triangles than can be numbered, or copied, are refused at their node", "[hard]") {
    GltfMaker file;
    std::vector<float> positions;
    for (int i = 0; i < 66002; ++i) {
        const float x = static_cast<float>(i);
        positions.insert(positions.end(), {x, static_cast<float>(i % 2), 0});
    }
    const int mesh = file.mesh({{"attributes", {{"POSITION", file.vec3(positions)}}}, {"mode", 5}});
    const int moves = file.vec3(std::vector<float>(3 * 66000, 1.0f));
    file.node({{"mesh", mesh}});
    file.node({{"mesh", mesh}, {"extensions", instancing({{"TRANSLATION", moves}})}});
    CHECK_THAT(gltf_refusal(file),
               contains("'nodes/1': expected at most 4294967294 triangles with those of every instance, "
                        "got 4356066000 and more"));
    file.root["materials"] = {{{"emissiveFactor", {1, 0, 0}}}};
    file.root["meshes"][0]["primitives"][0]["material"] = 0;
    file.root["nodes"].erase(0);
    file.root["accessors"][static_cast<std::size_t>(moves)]["count"] = 1100;
    CHECK_THAT(gltf_refusal(file),
               contains("'nodes/0': expected at most 67108864 triangles in the scene, with all copies"));
}

TEST_CASE("gltf instances: a scene file with knobs has copies, which its groups move") {
    GltfMaker file;
    const int mesh = leaf(file);
    for (int i = 0; i < 2; ++i)
        file.node({{"mesh", mesh}, {"name", "n" + std::to_string(i)}, {"translation", {i, 0, 0}}});
    const TemporaryFolder folder;
    folder.write("m.glb", file.glb());
    const auto opened = [&](const std::string& more) {
        const auto path = folder.write("s.json", R"({"schema": "pathlight.scene/1", "obj": "m.glb")" + more + "}");
        return load_scene(path.string(), "", kKeepInstances);
    };
    CHECK(opened("").instances.size() == 2);
    const SceneDescription knobs = opened(R"(, "knobs": {"lift": {"default": 0, "range": [0, 1], "does": "x",
        "moves": [{"groups": ["n1"], "by": [0, 1, 0]}]}})");
    CHECK(knobs.instances.empty());
    CHECK(knobs.triangles.size() == 6);
}
