// Materials that emit by a later choice: their meshes are copied, and the others stay.
#include "core/io/kept_meshes.h"

#include "core/io/load_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/gltf_maker.h"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/copies.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Three meshes of different materials, each in two places, and a triangle of its own.
GltfMaker three_pairs() {
    GltfMaker file;
    for (const char* name : {"a", "lamp", "c", "d"}) file.triangle({{"name", name}});
    for (int mesh = 0; mesh < 3; ++mesh) file.node({{"mesh", mesh}, {"translation", {2 + mesh, 1, 0}}});
    return file;
}

}  // namespace

TEST_CASE("emitting meshes: a scene file or a file of materials that lets a mesh shine makes copies of it") {
    const TemporaryFolder folder;
    folder.write("m.glb", three_pairs().glb());
    const std::string lit = R"({"surface": "diffuse", "albedo": [0.1, 0.2, 0.3], "emission": [1, 1, 1]})";
    const auto scene = folder.write("s.json", R"({"schema": "pathlight.scene/1", "obj": "m.glb",
        "materials": {"lamp": )" + lit + "}}");
    const SceneDescription kept = load_scene(scene.string(), "", {.most_copied_triangles = 0});
    CHECK(kept.meshes.size() == 2);
    CHECK(kept.instances.size() == 4);
    CHECK(direct_triangles(kept) == 3);
    const SceneDescription copied = load_scene(scene.string(), "");
    CHECK_FALSE(copied.default_light);
    // Both in the order of their materials.
    const auto by_material = [](SceneDescription ordered) {
        std::stable_sort(ordered.triangles.begin(), ordered.triangles.end(),
                         [](const auto& a, const auto& b) { return a.material < b.material; });
        return ordered;
    };
    check_same_triangles(by_material(expanded(kept)), by_material(copied));
}

TEST_CASE("emitting meshes: a scene whose meshes do not emit stays as it is") {
    const TemporaryFolder folder;
    SceneDescription scene =
        load_scene(folder.write("m.glb", three_pairs().glb()).string(), "", {.most_copied_triangles = 0});
    REQUIRE(scene.instances.size() == 6);
    copy_emitting_meshes(scene);
    CHECK(scene.instances.size() == 6);
    CHECK(scene.triangles.size() == 4);
    for (MaterialDescription& material : scene.materials) material.emission = glm::vec3(1.0f);
    copy_emitting_meshes(scene);
    CHECK(scene.meshes.empty());
    CHECK(scene.triangles.size() == 7);
}

TEST_CASE("emitting meshes: more copies than can be stored are refused") {
    SceneDescription scene;
    scene.materials.resize(1);
    scene.materials[0].emission = glm::vec3(1.0f);
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.triangles.resize(70000, {.vertex = {0, 1, 2}});
    scene.meshes = {{"tree", 0, 70000}};
    scene.instances.resize(1000);
    CHECK_THAT(input_error([&] { copy_emitting_meshes(scene); }),
               contains("expected at most 67108864 triangles") && contains("'tree'") && contains("got 70070000"));
}
