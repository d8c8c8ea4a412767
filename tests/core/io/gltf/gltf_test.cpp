// glTF files: meshes, nodes, cameras and the sun, notes about content that is left out, and files that are refused.
#include "core/io/gltf/gltf.h"

#include <cmath>

#include "core/scene/pack_scene.h"
#include "core/scene/validate.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/load_gltf.h"
#include "tests/support/files/told.h"

using namespace pl;
using pl::test::contains;
using pl::test::gltf_refusal;
using pl::test::GltfMaker;
using pl::test::input_error;
using pl::test::is_told;
using pl::test::load_gltf;
using pl::test::TemporaryFolder;

namespace {

/// Corners of a triangle of a scene.
std::vector<glm::vec3> corners(const SceneDescription& scene, std::size_t triangle) {
    const glm::uvec3 v = scene.triangles.at(triangle).vertex;
    return {scene.positions[v.x], scene.positions[v.y], scene.positions[v.z]};
}

const std::vector<glm::vec3> kTriangleCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const std::vector<float> kSquareCorners{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

}  // namespace

TEST_CASE("gltf: a file of points alone is refused with the reason") {
    GltfMaker file;
    file.triangle();
    file.root["meshes"][0]["primitives"][0]["mode"] = 0;
    CHECK_THAT(gltf_refusal(file),
               contains("got no triangle with an area; ") && contains("points and lines are left out"));
}

TEST_CASE("gltf: a triangle, as text and as a .glb, of any suffix") {
    GltfMaker file;
    file.triangle();
    for (const std::string& bytes : {file.text(), file.glb(), "\xEF\xBB\xBF" + file.text()}) {
        const SceneDescription scene = load_gltf(bytes);
        REQUIRE(scene.triangles.size() == 1);
        CHECK(corners(scene, 0) == kTriangleCorners);
        CHECK(scene.up == glm::vec3(0, 1, 0));
        CHECK(scene.default_light);
        CHECK(scene.name == "s");
    }
}

TEST_CASE("gltf: meshes that nodes place far from the origin are moved near it in doubles") {
    GltfMaker file;
    file.triangle();
    file.root["nodes"][0]["translation"] = {391234.37, 5820123.81, -3.5};
    const SceneDescription scene = load_gltf(file);
    CHECK(glm::length(scene.origin - glm::dvec3(391235.0, 5820124.0, 0.0)) < 2.0);
    CHECK(scene.origin.z == 0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 wanted = glm::dvec3(kTriangleCorners[i]) + glm::dvec3(391234.37, 5820123.81, -3.5);
        CHECK(glm::length(scene.origin + glm::dvec3(corners(scene, 0)[i]) - wanted) < 1e-6);
    }
    CHECK(is_told(scene, "far from the origin"));
}

TEST_CASE("gltf: meshes so small and far that floats leave them no area are moved, too") {
    GltfMaker file;
    file.triangle();
    file.root["nodes"][0]["translation"] = {1e8, 0.0, 0.0};
    file.root["nodes"][0]["scale"] = {0.5, 0.5, 0.5};
    const SceneDescription scene = load_gltf(file);
    REQUIRE(scene.triangles.size() == 1);
    CHECK(glm::length(scene.origin + glm::dvec3(corners(scene, 0)[1]) - glm::dvec3(1e8, 0.0, 0.0) -
                      0.5 * glm::dvec3(kTriangleCorners[1])) < 1e-6);
}

TEST_CASE("gltf: buffers in files of the folder, with escapes in their names") {
    GltfMaker file;
    file.triangle();
    file.root["buffers"] = {{{"byteLength", file.buffer.size()}, {"uri", "data/my%20buffer.bin"}}};
    const TemporaryFolder folder;
    const auto bin = folder.write("data/my buffer.bin", file.buffer + "more");
    const auto path = folder.write("s.gltf", file.text());
    const SceneDescription scene = load_scene(path.string(), "");
    CHECK(corners(scene, 0) == kTriangleCorners);
    CHECK(scene.files == std::vector<std::filesystem::path>{path, bin});
}

TEST_CASE("gltf: indices, strips and fans have the order of the format") {
    const std::vector<std::vector<glm::vec3>> square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                                                     {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    const auto triangles = [&](Json primitive) {
        GltfMaker file;
        primitive["attributes"]["POSITION"] = file.vec3(kSquareCorners);
        if (primitive.contains("corners")) {
            primitive["indices"] = file.indices(primitive["corners"].get<std::vector<std::uint16_t>>());
            primitive.erase("corners");
        }
        file.node({{"mesh", file.mesh(primitive)}});
        return load_gltf(file);
    };
    const SceneDescription listed = triangles({{"corners", {0, 1, 2, 0, 2, 3}}});
    CHECK(corners(listed, 0) == square[0]);
    CHECK(corners(listed, 1) == square[1]);
    CHECK(listed.positions.size() == 4);
    const SceneDescription fan = triangles({{"mode", 6}});
    REQUIRE(fan.triangles.size() == 2);
    CHECK(corners(fan, 0) == std::vector<glm::vec3>{{1, 0, 0}, {1, 1, 0}, {0, 0, 0}});
    CHECK(corners(fan, 1) == std::vector<glm::vec3>{{1, 1, 0}, {0, 1, 0}, {0, 0, 0}});
    const SceneDescription strip = triangles({{"mode", 5}, {"corners", {0, 1, 3, 2}}});
    REQUIRE(strip.triangles.size() == 2);
    CHECK(corners(strip, 0) == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(corners(strip, 1) == std::vector<glm::vec3>{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
}

TEST_CASE("gltf: strided, quantized and sparse accessors") {
    GltfMaker file;
    // Positions as normalized shorts, each padded to eight bytes.
    const std::vector<std::int16_t> shorts{0, 0, 0, 7, 32767, 0, 0, 7, 0, 32767, 0, 7, -32768, 0, 0, 7};
    const int view = file.view(test::bytes_of(shorts));
    file.root["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 8;
    const int quantized = file.accessor(
        {{"bufferView", view}, {"componentType", 5122}, {"normalized", true}, {"type", "VEC3"}, {"count", 4}});
    const int bytes = file.numbers(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3}, 5121, "SCALAR", 6);
    file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", quantized}}}, {"indices", bytes}})}});
    // Zeros but for the elements 1 and 2.
    const int sparse = file.accessor(
        {{"componentType", 5126},
         {"type", "VEC3"},
         {"count", 3},
         {"sparse",
          {{"count", 2},
           {"indices", {{"bufferView", file.view(test::bytes_of<std::uint8_t>({1, 2}))}, {"componentType", 5121}}},
           {"values", {{"bufferView", file.view(test::bytes_of<float>({1, 0, 0, 0, 1, 0}))}}}}}});
    file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", sparse}}}})}});
    const SceneDescription scene = load_gltf(file);
    REQUIRE(scene.triangles.size() == 3);
    CHECK(corners(scene, 0) == kTriangleCorners);
    CHECK(corners(scene, 1) == std::vector<glm::vec3>{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}});
    CHECK(corners(scene, 2) == kTriangleCorners);
}

TEST_CASE("gltf: nodes move, turn and scale the nodes below them") {
    GltfMaker file;
    file.triangle();
    file.root["nodes"][0]["translation"] = {1, 0, 0};
    const double half = std::sqrt(0.5);
    file.node({{"children", {0}}, {"rotation", {0, 0, half, half}}, {"scale", {2, 3, 1}}});  // 90 degrees about z
    file.node({{"children", {1}}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}});
    const SceneDescription scene = load_gltf(file);
    const std::vector<glm::vec3> expected{{0, 2, 5}, {0, 4, 5}, {-3, 2, 5}};
    for (std::size_t i = 0; i < 3; ++i)
        for (int axis = 0; axis < 3; ++axis)
            CHECK(corners(scene, 0)[i][axis] == Approx(expected[i][axis]).margin(1e-6));
}

TEST_CASE("gltf: each node has its copy of a mesh, a mirrored one with its front in front") {
    GltfMaker file;
    const int mesh = file.mesh({{"attributes",
                                 {{"POSITION", file.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})},
                                  {"NORMAL", file.vec3({0, 0, 2, 0, 0, 2, 0, 0, 0})}}}});
    const int good = file.mesh({{"attributes",
                                 {{"POSITION", file.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})},
                                  {"NORMAL", file.vec3({0, 1, 2, 0, 0, 2, 0, 0, 1})}}}});
    file.node({{"mesh", mesh}});
    file.node({{"mesh", good}, {"scale", {1, 2, 1}}});
    file.node({{"mesh", good}, {"scale", {-1, 1, 1}}});
    const SceneDescription scene = load_gltf(file);
    REQUIRE(scene.triangles.size() == 3);
    CHECK(scene.triangles[0].normal.x == TriangleDescription::kNoNormal);
    CHECK(is_told(scene, "normals of no length are ignored (1 in all)"));
    const glm::vec3 steep = scene.normals[scene.triangles[1].normal.x];
    CHECK(steep.z == Approx(4.0 / std::sqrt(17.0)));
    CHECK(corners(scene, 2) == std::vector<glm::vec3>{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}});
    CHECK(scene.normals[scene.triangles[2].normal.y] == glm::vec3(0, 0, 1));
}

TEST_CASE("gltf: a skin is in the pose of its joints") {
    GltfMaker file;
    const int mesh = file.mesh(
        {{"attributes",
          {{"POSITION", file.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})},
           {"JOINTS_0", file.numbers(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0}, 5121, "VEC4", 3)},
           {"WEIGHTS_0", file.numbers(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 3)}}}});
    file.root["skins"] = {{{"joints", {1, 2}}}};
    file.node({{"mesh", mesh}, {"skin", 0}, {"translation", {100, 0, 0}}});
    file.node({{"translation", {0, 0, 1}}});
    file.node({{"translation", {0, 5, 0}}});
    CHECK(corners(load_gltf(file), 0) == std::vector<glm::vec3>{{0, 0, 1}, {1, 0, 1}, {0, 6, 0}});
    file.root["skins"][0]["joints"] = {1};
    CHECK_THAT(gltf_refusal(file), contains("JOINTS_0") && contains("expected joints below 1, got 1 at vertex 2"));
}

TEST_CASE("gltf: the scene that the file shows, without it all roots") {
    GltfMaker file;
    file.triangle();
    file.triangle();
    file.triangle();
    CHECK(load_gltf(file).triangles.size() == 3);
    file.root["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1, 2}}}};
    CHECK(load_gltf(file).triangles.size() == 1);
    file.root["scene"] = 1;
    CHECK(load_gltf(file).triangles.size() == 2);
}

TEST_CASE("gltf: cameras can be chosen by name and number, and set the shape of the picture") {
    GltfMaker file;
    file.triangle();
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"aspectRatio", 1.5}}}},
                            {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}}}},
                            {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}}}}};
    file.node({{"name", "front"}, {"camera", 0}, {"translation", {0, 0, 5}}});
    file.node({{"name", "side"},
               {"camera", 1},
               {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}},
               {"translation", {7, 0, 0}}});
    file.node({{"camera", 2}});
    const SceneDescription scene = load_gltf(file);
    REQUIRE(scene.cameras.size() == 2);
    CHECK(is_told(scene, "cameras without perspective"));
    CHECK(scene.chosen_camera == 1);
    CHECK(scene.camera.eye == glm::vec3(0, 0, 5));
    CHECK(scene.camera.target == glm::vec3(0, 0, 0));
    CHECK(scene.camera.fov_deg == Approx(28.6479));
    CHECK(scene.setting("size") == "768x512");
    for (const char* name : {"side", "2"}) {
        const SceneDescription chosen = load_gltf(file, {.camera = name});
        CHECK(chosen.camera.eye == glm::vec3(7, 0, 0));
        CHECK(chosen.camera.target.x < 7.0f);
        CHECK(chosen.setting("size").empty());
    }
    CHECK_THAT(test::error_message(ErrorKind::Usage, [&] { load_gltf(file, {.camera = "top"}); }),
               contains("--camera top") && contains("1 'front', 2 'side'"));
    file.root["cameras"][0]["perspective"]["yfov"] = 4;
    CHECK_THAT(gltf_refusal(file), contains("cameras/0/perspective/yfov") && contains("got 4"));
}

TEST_CASE("gltf: punctual lights, in watts if Blender wrote them in lumens") {
    GltfMaker file;
    file.triangle();
    Json& lights = file.root["extensions"]["KHR_lights_punctual"]["lights"];
    lights = {{{"type", "area"}},
              {{"type", "directional"}, {"intensity", 683}, {"color", {1, 0.5, 0}}},
              {{"type", "point"}, {"range", 3}},
              {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}}};
    const auto shown = [](int light) {
        return Json{{"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}};
    };
    file.node(shown(0));
    CHECK(load_gltf(file).default_light);
    for (const int light : {1, 2, 3}) file.node(shown(light));
    const SceneDescription scene = load_gltf(file);
    CHECK_FALSE(scene.default_light);
    CHECK(is_told(scene, "lights of the type area are left out (1 in all)"));
    CHECK(is_told(scene, "ranges of lights are left out"));
    REQUIRE(scene.punctual_lights.size() == 3);
    CHECK(scene.punctual_lights[0].kind == PunctualKind::Directional);
    CHECK(scene.punctual_lights[0].direction == glm::vec3(0, 0, -1));
    CHECK(scene.punctual_lights[0].intensity == glm::vec3(683.0f, 341.5f, 0.0f));
    CHECK(scene.punctual_lights[1].kind == PunctualKind::Point);
    CHECK(scene.punctual_lights[1].position == glm::vec3(1, 2, 3));
    CHECK(scene.punctual_lights[1].intensity == glm::vec3(1.0f));
    CHECK(scene.punctual_lights[2].kind == PunctualKind::Spot);
    CHECK(scene.punctual_lights[2].outer_deg == Approx(0.5f * 57.29578f));
    lights[1]["intensity"] = -1;
    CHECK_THAT(input_error([&] { load_gltf(file); }), contains("an intensity of at least 0"));
    lights[1]["intensity"] = 683;
    file.root["asset"]["generator"] = "Khronos glTF Blender I/O v4.2.70";
    CHECK(load_gltf(file).punctual_lights[0].intensity.x == Approx(1.0));
}

TEST_CASE("gltf: spots have hard edges, and cones as wide as the formula allows") {
    struct Case {
        double inner, outer;
        float inner_deg, outer_deg;
        bool is_told;
    };
    const float kDegrees = glm::degrees(1.0f);
    for (const Case& one :
         {Case{0.5, 0.5, 0.5f * kDegrees, 0.5f * kDegrees, false}, Case{0.0, 2.0, 0.0f, 2.0f * kDegrees, false},
          Case{0.0, 4.0, 0.0f, 180.0f, true}, Case{1.0, 0.5, 0.5f * kDegrees, 0.5f * kDegrees, true},
          Case{-1.0, 0.5, 0.0f, 0.5f * kDegrees, true}}) {
        INFO(one.inner << " " << one.outer);
        GltfMaker file;
        file.triangle();
        file.root["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "spot"}, {"spot", {{"innerConeAngle", one.inner}, {"outerConeAngle", one.outer}}}}};
        file.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        const SceneDescription scene = load_gltf(file);
        REQUIRE(scene.punctual_lights.size() == 1);
        CHECK(scene.punctual_lights[0].inner_deg == Approx(one.inner_deg));
        CHECK(scene.punctual_lights[0].outer_deg == Approx(one.outer_deg));
        CHECK(is_told(scene, "cones of spots are moved") == one.is_told);
        CHECK_NOTHROW(validate_scene(scene));
        const HostScene packed = pack_scene(scene);
        REQUIRE(packed.delta_lights.size() == 1);
        const DeltaLight& light = packed.delta_lights[0];
        CHECK(std::isfinite(light.slope));
        CHECK(std::isfinite(light.offset));
    }
}

TEST_CASE("gltf: a spot without a cone is left out") {
    GltfMaker file;
    file.triangle();
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0}, {"outerConeAngle", 0}}}}};
    file.node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    const SceneDescription scene = load_gltf(file);
    CHECK(scene.punctual_lights.empty());
    CHECK(is_told(scene, "spots without a cone are left out"));
}

TEST_CASE("gltf: compressed meshes are named, whether or not the file says that they need an extension") {
    for (const bool is_draco : {true, false}) {
        GltfMaker file;
        file.triangle();
        const char* const name = is_draco ? "KHR_draco_mesh_compression" : "EXT_meshopt_compression";
        file.root["extensionsUsed"] = Json::array({name});
        CHECK_NOTHROW(load_gltf(file));
        Json& holder = is_draco ? file.root["meshes"][0]["primitives"][0] : file.root["bufferViews"][0];
        holder["extensions"][name] = Json::object();
        // Both kinds may have the meshes without compression, too.
        CHECK_NOTHROW(load_gltf(file));
        if (is_draco) {
            file.root["accessors"][0].erase("bufferView");
        } else {
            file.root["buffers"] = {Json::parse(file.text())["buffers"][0], {{"byteLength", 1000}}};
            file.root["bufferViews"][0]["buffer"] = 1;
        }
        CHECK_THAT(input_error([&] { load_gltf(file); }),
                   contains(std::string("got meshes compressed by ") + (is_draco ? "Draco (KHR_" : "meshopt (EXT_")));
    }
}

TEST_CASE("gltf: content without a counterpart is told once for each kind") {
    GltfMaker file;
    file.triangle();
    file.root["meshes"][0]["primitives"].push_back({{"mode", 1}, {"attributes", {{"POSITION", 0}}}});
    file.root["meshes"][0]["primitives"].push_back({{"mode", 0}, {"attributes", {{"POSITION", 0}}}});
    file.root["animations"] = {{{"channels", Json::array()}, {"samplers", Json::array()}}};
    file.root["extensionsUsed"] = {"EXT_lights_image_based", "KHR_texture_transform"};
    const SceneDescription scene = load_gltf(file);
    CHECK(is_told(scene, "'meshes/0/primitives/1': points and lines are left out (2 in all)"));
    CHECK(is_told(scene, "animations are left out"));
    CHECK(is_told(scene, "the extension EXT_lights_image_based is left out"));
    CHECK_FALSE(is_told(scene, "KHR_texture_transform"));
}

TEST_CASE("gltf: a scene file may name one, with materials and knobs by the names of materials and nodes") {
    GltfMaker file;
    file.triangle({{"name", "wall"}});
    const TemporaryFolder folder;
    folder.write("m.glb", file.glb());
    const auto json = folder.write("s.json", R"({"schema": "pathlight.scene/1", "obj": "m.glb",
        "materials": {"wall": {"surface": "diffuse", "albedo": [0.1, 0.2, 0.3], "emission": [1, 1, 1]}}})");
    const SceneDescription scene = load_scene(json.string(), "");
    CHECK(scene.materials.at(0).albedo == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK_FALSE(scene.default_light);
}

TEST_CASE("gltf: broken files are refused with place, expected and got", "[hard]") {
    struct Case {
        std::string pointer;
        Json value;
        std::string told;
    };
    const std::vector<Case> cases = {
        {"/asset/version", "1.0", "'asset/version': expected glTF of version 2, got '1.0'"},
        {"/extensionsRequired", Json::array({"KHR_draco_mesh_compression"}), "expected meshes without compression"},
        {"/nodes/0/mesh", 3, "'nodes/0/mesh': expected an index into the 1 meshes, got 3"},
        {"/nodes/0/mesh", -1, "got -1"},
        {"/nodes/0/mesh", "x", "expected a whole number"},
        {"/nodes/0/mesh", 0.5, "expected a whole number"},
        {"/nodes/0/children", Json::array({0}), "expected a tree of nodes, got a circle"},
        {"/nodes/0/rotation", Json::array({0, 0, 0, 0}), "expected a unit quaternion"},
        {"/nodes/0/matrix", Json::array({1, 2}), "expected an array of 16 numbers"},
        {"/nodes/0/scale", Json::array({1e30, 1, 1}), "expected coordinates up to 1e+18"},
        {"/scenes", Json::array({{{"nodes", {0, 0}}}}), "expected nodes without parents, each once"},
        {"/accessors/0/bufferView", 9, "expected an index into the 2 bufferViews, got 9"},
        {"/accessors/0/count", 4, "expected at most the 36 bytes of its buffer view, got 4 elements up to byte 48"},
        {"/accessors/0/count", 4000000000u, "expected at most 134217728 vertices and corners in the file"},
        {"/accessors/0/count", 1e300, "expected a whole number"},
        {"/accessors/0/count", 0, "within [1,"},
        {"/accessors/0/componentType", 5124, "got 5124"},
        {"/accessors/0/type", "VEC4", "expected VEC3 for this use, got 'VEC4'"},
        {"/accessors/0/byteOffset", 4, "expected at most the 36 bytes"},
        {"/accessors/1/count", 2, "expected one element for each of the 3 vertices, got 2"},
        {"/bufferViews/0/byteLength", 100000, "expected a part of the"},
        {"/bufferViews/0/byteOffset", 18446744073709551615u, "expected a whole number"},
        {"/bufferViews/0/byteStride", 1, "within [4, 252]"},
        {"/buffers", Json::array({{{"byteLength", 60}}}), "expected a 'uri'"},
        {"/buffers", Json::array({{{"byteLength", 60}, {"uri", "data:;base64,AAAA"}}}),
         "expected at most the 3 bytes"},
        {"/buffers", Json::array({{{"byteLength", 60}, {"uri", "data:;base64,A*AA"}}}), "expected \"data:TYPE"},
        {"/buffers", Json::array({{{"byteLength", 60}, {"uri", "../x.bin"}}}), "in the folder of the scene"},
        {"/buffers", Json::array({{{"byteLength", 60}, {"uri", "%2e%2e/x.bin"}}}), "in the folder of the scene"},
        {"/buffers", Json::array({{{"byteLength", 60}, {"uri", "/etc/hostname"}}}), "in the folder of the scene"},
        {"/buffers", Json::array({{{"byteLength", 60}, {"uri", "http://a/b"}}}), "in the folder of the scene"},
        {"/buffers", Json::array({{{"byteLength", 60}, {"uri", "none.bin"}}}), "none.bin"},
        {"/meshes/0/primitives/0/mode", 7, "within [0, 6]"},
        {"/meshes/0/primitives/0/material", 0, "expected an index into the 0 materials, got 0"},
        {"/meshes/0/primitives/0/mode", 1, "no triangle with an area"},
        {"/meshes", Json::object(), "expected an array"},
    };
    for (const Case& broken : cases) {
        GltfMaker file;
        file.triangle();
        Json text = Json::parse(file.text());
        text[Json::json_pointer(broken.pointer)] = broken.value;
        INFO(broken.pointer << " " << broken.value.dump());
        CHECK_THAT(gltf_refusal(text.dump(1)), contains("s.gltf") || contains("none.bin"));
        CHECK_THAT(gltf_refusal(text.dump(1)), contains(broken.told));
    }
}

TEST_CASE("gltf: indices beyond the vertices, numbers that are none, and giant counts are refused", "[hard]") {
    GltfMaker indices;
    indices.node({{"mesh", indices.mesh({{"attributes", {{"POSITION", indices.vec3(kSquareCorners)}}},
                                         {"indices", indices.indices({0, 1, 4})}})}});
    CHECK_THAT(gltf_refusal(indices),
               contains("expected indices below 4, the number of vertices, got 4 at corner 2"));

    GltfMaker nan;
    nan.node({{"mesh", nan.mesh({{"attributes", {{"POSITION", nan.vec3({0, 0, 0, 1, 0, NAN, 0, 1, 0})}}}})}});
    CHECK_THAT(gltf_refusal(nan), contains("'accessors/0': expected finite numbers, got nan as component 5"));

    GltfMaker zeros;
    const int giant = zeros.accessor({{"componentType", 5126}, {"type", "VEC3"}, {"count", 4000000000u}});
    zeros.node({{"mesh", zeros.mesh({{"attributes", {{"POSITION", giant}}}})}});
    CHECK_THAT(gltf_refusal(zeros), contains("expected at most"));
    zeros.root["accessors"][0]["count"] = 100000000;
    CHECK_THAT(gltf_refusal(zeros), contains("elements without a buffer view, got 100000000"));

    GltfMaker parents;
    parents.triangle();
    parents.node({{"children", {0}}});
    parents.node({{"children", {0}}});
    CHECK_THAT(gltf_refusal(parents), contains("'nodes/2/children/0': expected a node without another parent"));

    GltfMaker sparse;
    sparse.triangle();
    sparse.root["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", sparse.view(test::bytes_of<std::uint8_t>({3}))}, {"componentType", 5121}}},
        {"values", {{"bufferView", sparse.view(test::bytes_of<float>({1, 0, 0}))}}}};
    CHECK_THAT(gltf_refusal(sparse), contains("expected indices below 3, got 3"));
}

TEST_CASE("gltf: a chain of a hundred thousand nodes is no depth of recursion", "[hard]") {
    GltfMaker file;
    file.triangle();
    Json nodes = file.root["nodes"];
    for (int i = 0; i < 100000; ++i) nodes.push_back({{"children", {i}}});
    file.root["nodes"] = nodes;
    CHECK(load_gltf(file).triangles.size() == 1);
}

TEST_CASE("gltf: a .glb that is cut or lies about its length is refused with the byte", "[hard]") {
    GltfMaker file;
    file.triangle();
    const std::string glb = file.glb();
    for (const std::size_t size : {4, 11, 12, 19, 40})
        CHECK_THAT(gltf_refusal(glb.substr(0, size)), contains("byte "));
    CHECK_THAT(gltf_refusal(glb.substr(0, glb.size() - 4)), contains("byte 8: the header says"));
    std::string other = glb;
    other[4] = 1;
    CHECK_THAT(gltf_refusal(other), contains("byte 4: expected version 2 of the container, got 1"));
    other = glb;
    other[16] = 'X';
    CHECK_THAT(gltf_refusal(other), contains("byte 16: expected a JSON chunk first"));
    other = glb;
    other[15] = '\x7f';
    CHECK_THAT(gltf_refusal(other), contains("byte 20: expected a chunk of"));
}
