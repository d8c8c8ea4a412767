// Scene files, scenes by name, and the folder of the scenes.
#include "core/io/scene_json.h"

#include <algorithm>
#include <cstdlib>

#include "core/io/image.h"
#include "core/io/load_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::input_error;
using pl::test::TemporaryFolder;

namespace {

SceneDescription load_members(const std::string& members) {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl la/mp~\nKe 1 1 1\n");
    folder.write("s.obj", "mtllib m.mtl\nv -1 0 0\nv 1 0 0\nv 0 2 0\nusemtl wall\nf 1 2 3\nusemtl la/mp~\nf 1 3 2\n");
    const std::string text = "{\n\"schema\": \"pathlight.scene/1\",\n\"obj\": \"s.obj\"" + members + "}\n";
    return load_scene(folder.write("scene.json", text).string(), folder.path());
}

std::string refused_members(const std::string& members) {
    return input_error([&] { load_members(members); });
}

}  // namespace

TEST_CASE("A scene file with only the required members frames its geometry") {
    const SceneDescription scene = load_members("");
    CHECK(scene.name == "scene");
    CHECK(scene.summary.empty());
    CHECK(scene.source.filename() == "scene.json");
    CHECK(scene.triangles.size() == 2);
    CHECK(scene.camera.target == glm::vec3(0, 1, 0));
    CHECK(scene.camera.fov_deg == 40.0f);
    CHECK(scene.environment == glm::vec3(0.0f));
    CHECK(scene.settings.empty());
    CHECK(scene.warnings.empty());
}

TEST_CASE("Everything a scene file may say") {
    const SceneDescription scene = load_members(
        ", \"name\": \"Test\", \"summary\": \"two triangles\", \"camera\": {\"eye\": [1, 2, 3], \"target\": [4, 5, "
        "6.5], \"up\": [0, 0, "
        "1], \"fov_deg\": 30,"
        "\"aperture_radius\": 0.25, \"focus_distance\": 2.5, \"shift_x\": 0.5, \"shift_y\": -1}, "
        "\"environment\": {\"radiance\": [0.5, 1, 2],"
        "\"sun\": {\"direction\": [0, 2, 0], \"radiance\": [9, 8, 7], \"angle_deg\": 2}},"
        "\"materials\": {\"wall\": {\"albedo\": [0.1, 0.2, 1], \"surface\": \"plastic\", \"roughness\": 0.5, "
        "\"ior\": 1.25, \"specular\": [1, 0.5, 1], \"transmission\": [0, 0.5, 1]}, \"la/mp~\": {\"emission\": "
        "[7, 8, 9], "
        "\"two_sided_emission\": true}},"
        "\"settings\": {\"spp\": 128, \"nee\": true, \"method\": \"reinforcement\", \"exposure\": -1.5, "
        "\"size\": \"640x480\"}");
    CHECK(scene.name == "Test");
    CHECK(scene.summary == "two triangles");
    CHECK(scene.camera.eye == glm::vec3(1, 2, 3));
    CHECK(scene.camera.target == glm::vec3(4, 5, 6.5f));
    CHECK(scene.camera.up == glm::vec3(0, 0, 1));
    CHECK(scene.camera.fov_deg == 30.0f);
    CHECK(scene.camera.aperture_radius == 0.25f);
    CHECK(scene.camera.focus_distance == 2.5f);
    CHECK(scene.camera.shift == glm::vec2(0.5f, -1.0f));
    CHECK(scene.environment == glm::vec3(0.5f, 1, 2));
    CHECK(scene.sun.direction == glm::vec3(0, 2, 0));
    CHECK(scene.sun.radiance == glm::vec3(9, 8, 7));
    CHECK(scene.sun.angle_deg == 2.0f);
    CHECK(scene.materials[0].albedo == glm::vec3(0.1f, 0.2f, 1));
    CHECK(scene.materials[0].kind == SurfaceKind::Plastic);
    CHECK(scene.materials[0].roughness == 0.5f);
    CHECK(scene.materials[0].ior == 1.25f);
    CHECK(scene.materials[0].specular == glm::vec3(1, 0.5f, 1));
    CHECK(scene.materials[0].transmission == glm::vec3(0, 0.5f, 1));
    CHECK(scene.materials[1].emission == glm::vec3(7, 8, 9));
    CHECK(scene.materials[1].two_sided_emission);
    using Setting = std::pair<std::string, std::string>;
    CHECK(scene.settings ==
          std::vector<Setting>{
              {"spp", "128"}, {"nee", "on"}, {"method", "reinforcement"}, {"exposure", "-1.5"}, {"size", "640x480"}});
}

TEST_CASE("A clear sky is a map and a sun, around the axis that the file says") {
    const SceneDescription scene = load_members(
        ", \"environment\": {\"sky\": {\"sun_direction\": [3, 4, 0], \"sun_scale\": 2, \"turbidity\": 5}}");
    CHECK(scene.environment_map.texels.size() == 512 * 256);
    CHECK(scene.environment_map.texels[192 * 512] == glm::vec3(0.0f));
    CHECK(scene.sun.direction == glm::vec3(0.6f, 0.8f, 0.0f));
    CHECK(scene.sun.radiance.y > 2e4f);
    const SceneDescription upright = load_members(", \"environment\": {\"sky\": {\"up\": [0, 0, 2], \"scale\": 0}}");
    CHECK(upright.environment_map.texels.empty());
    CHECK(upright.sun.direction == glm::vec3(0, 0, 1));
}

TEST_CASE("A part of a camera completes the framing one") {
    const SceneDescription wide = load_members(", \"camera\": {\"fov_deg\": 90}");
    CHECK(wide.camera.fov_deg == 90.0f);
    CHECK(wide.camera.target == glm::vec3(0, 1, 0));
    CHECK(wide.camera.eye.z < load_members("").camera.eye.z);
    CHECK(load_members(", \"camera\": {\"eye\": [0, 1, 50]}").camera.target == glm::vec3(0, 1, 0));
}

TEST_CASE("An up vector along the view is replaced with a warning") {
    const SceneDescription scene = load_members(", \"camera\": {\"eye\": [0, 9, 0], \"target\": [0, 0, 0]}");
    CHECK(scene.camera.up == glm::vec3(0, 0, -1));
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings[0], contains("up vector"));
}

TEST_CASE("Points of a scene file are in the coordinates of a mesh far from the origin") {
    const TemporaryFolder folder;
    folder.write("s.obj",
                 "o a\nv 391234.37 5820123.81 30\nv 391234.57 5820123.81 30\nv 391234.57 5820133.81 30\nf 1 2 3\n");
    const SceneDescription scene = load_scene(
        folder
            .write("s.json",
                   "{\"schema\": \"pathlight.scene/1\", \"obj\": \"s.obj\", \"camera\": {\"eye\": [391234.4, "
                   "5820120.7, 60], \"target\": [391234.5, 5820128.3, 30]}, \"cameras\": [{\"eye\": [391234.25, "
                   "5820120.5, 60]}], \"lights\": [{\"type\": \"point\", \"intensity\": [1, 1, 1], "
                   "\"position\": [391234.4, 5820124.6, 40]}], \"knobs\": {\"k\": {\"default\": 0, \"range\": [0, "
                   "1], \"does\": \"grows\", \"scales\": [{\"groups\": [\"a\"], \"about\": [391234.37, "
                   "5820123.81, 30], \"by\": [1, 0, 0]}]}}}")
            .string(),
        folder.path(), {.parameters = {{"k", "1"}}});
    const auto place = [&](const glm::vec3& point) { return scene.origin + glm::dvec3(point); };
    const auto is_near = [&](const glm::vec3& point, const glm::dvec3& wanted) {
        return glm::length(place(point) - wanted) < 1e-5;
    };
    CHECK(scene.origin.x > 391000.0);
    CHECK(is_near(scene.camera.eye, {391234.4, 5820120.7, 60.0}));
    CHECK(is_near(scene.camera.target, {391234.5, 5820128.3, 30.0}));
    CHECK(is_near(scene.cameras.at(0).camera.eye, {391234.25, 5820120.5, 60.0}));
    CHECK(is_near(scene.punctual_lights.at(0).position, {391234.4, 5820124.6, 40.0}));
    CHECK(is_near(scene.positions.at(0), {391234.37, 5820123.81, 30.0}));
    CHECK(is_near(scene.positions.at(1), {391234.77, 5820123.81, 30.0}));
    CHECK(std::count_if(scene.warnings.begin(), scene.warnings.end(), [](const std::string& warning) {
              return warning.find("far from the origin") != std::string::npos;
          }) == 1);
}

TEST_CASE("Unknown keys are answered with the nearest known one, with file and line") {
    CHECK_THAT(refused_members(",\n\n\"camra\": {}"),
               contains("scene.json:5: 'camra': unknown key, did you mean 'camera'?"));
    CHECK_THAT(refused_members(",\n\"camera\": {\n\"fov\": 3}"),
               contains("scene.json:5: 'camera/fov': unknown key, did you mean 'fov_deg'?"));
    CHECK_THAT(refused_members(",\"environment\": {\n\"radience\": [1,1,1]}"),
               contains("scene.json:4: ") && contains("did you mean 'radiance'?"));
    CHECK_THAT(refused_members(",\"materials\": {\"wall\": {\n\"Albedo\": [1,1,1]}}"),
               contains("scene.json:4: ") && contains("did you mean 'albedo'?"));
    CHECK_THAT(refused_members(",\"materials\": {\n\"wal\": {}}"),
               contains("scene.json:4: ") && contains("did you mean 'wall'?"));
    CHECK_THAT(refused_members(",\"settings\": {\n\n\"max_depth\": 3}"),
               contains("scene.json:5: ") && contains("did you mean 'max-depth'?"));
}

TEST_CASE("Values of a wrong type or range are refused with file and line") {
    struct Case {
        std::string members;
        std::string told;
    };
    const Case sample = GENERATE(
        Case{"\"map_kd\": \"add\"", "expected one of multiply, replace, got 'add'"},
        Case{"\"name\": 3", "expected a text in quotes, got '3'"}, Case{"\"camera\": []", "expected an object"},
        Case{"\"camera\": {\"eye\": [1, 2]}", "expected three numbers"},
        Case{"\"camera\": {\"eye\": [1, 2, \"3\"]}", "expected three numbers"},
        Case{"\"camera\": {\"eye\": [1, 2, 1e39]}", "expected three numbers"},
        Case{"\"camera\": {\"eye\": 7}", "expected three numbers"},
        Case{"\"camera\": {\"fov_deg\": \"wide\"}", "expected a number"},
        Case{"\"camera\": {\"fov_deg\": 0}", "an angle between 0 and 180 degrees"},
        Case{"\"camera\": {\"fov_deg\": 180}", "an angle between 0 and 180 degrees"},
        Case{"\"camera\": {\"fov_deg\": -20}", "an angle between 0 and 180 degrees"},
        Case{"\"camera\": {\"eye\": [1, 1, 1], \"target\": [1, 1, 1]}", "same point"},
        Case{"\"camera\": {\"aperture_radius\": -0.1}", "at least 0"},
        Case{"\"camera\": {\"focus_distance\": 0}", "above 0"},
        Case{"\"environment\": {\"map\": \"../sky.hdr\"}", "in the folder of the scene"},
        Case{"\"environment\": {\"map\": \"\"}", "in the folder of the scene"},
        Case{"\"environment\": {\"scale\": -2}", "at least 0"},
        Case{"\"environment\": {\"axes\": [[1, 0, 0], [0, 1, 0]]}", "three directions"},
        Case{"\"environment\": {\"rotation_deg\": \"left\"}", "expected a number"},
        Case{"\"environment\": {\"sun\": {\"direction\": [0, 0, 0]}}", "no length"},
        Case{"\"environment\": {\"sun\": {\"angle_deg\": 0}}", "within [0.01, 180]"},
        Case{"\"environment\": {\"sun\": {\"radiance\": [1, 1, -1]}}", "at least 0"},
        Case{"\"environment\": {\"sky\": {\"turbidity\": 0.5}}", "within [1, 10]"},
        Case{"\"environment\": {\"sky\": {\"sun_direction\": [0, 0, 0]}}", "no length"},
        Case{"\"environment\": {\"sky\": {\"albedo\": [2, 0, 0]}}", "within [0, 1]"},
        Case{"\"environment\": {\"sky\": {}, \"sun\": {}}", "expected a sky or /environment/sun, got both"},
        Case{"\"materials\": {\"wall\": {\"surface\": \"metal\"}}", "expected one of diffuse, conductor"},
        Case{"\"materials\": {\"wall\": {\"roughness\": 2}}", "within [0, 1]"},
        Case{"\"materials\": {\"wall\": {\"ior\": 0.5}}", "within [1, 4]"},
        Case{"\"materials\": {\"wall\": {\"specular\": [0, 0, 2]}}", "within [0, 1]"},
        Case{"\"materials\": {\"wall\": {\"wrap\": \"mirror\"}}", "expected repeat or clamp"},
        Case{"\"materials\": {\"wall\": {\"albedo_map\": \"/etc/x.png\"}}", "in the folder of the scene"},
        Case{"\"materials\": {\"wall\": {\"anisotropy\": 1}}", "expected a number within [0, 0.99], got 1"},
        Case{"\"materials\": {\"wall\": {\"rotation_deg\": \"left\"}}", "expected a number"},
        Case{"\"materials\": {\"wall\": {\"blend\": 1}}", "expected an object"},
        Case{"\"materials\": {\"wall\": {\"blend\": {\"share\": 0.5}}}",
             "expected 'with', the name of a material, got none"},
        Case{"\"materials\": {\"wall\": {\"blend\": {\"with\": \"well\"}}}", "did you mean 'wall'?"},
        Case{"\"materials\": {\"wall\": {\"blend\": {\"with\": \"wall\"}}}",
             "expected at most 8 blends in a row, got more, or a circle"},
        Case{"\"materials\": {\"wall\": {\"blend\": {\"with\": \"wall\", \"share\": 1.5}}}",
             "expected a number within [0, 1], got 1.5"},
        Case{"\"materials\": {\"wall\": {\"surface\": \"dielectric\", \"blend\": {\"with\": \"wall\"}}}",
             "expected no solid glass in a blend, got 'wall'"},
        Case{"\"environment\": {\"radiance\": [0, -1, 0]}", "at least 0"},
        Case{"\"materials\": 1", "expected an object"}, Case{"\"materials\": {\"wall\": 1}", "expected an object"},
        Case{"\"materials\": {\"wall\": {\"albedo\": [2, 0, 0]}}", "within [0, 1]"},
        Case{"\"materials\": {\"wall\": {\"albedo\": [-1, 0, 0]}}", "at least 0"},
        Case{"\"materials\": {\"wall\": {\"two_sided_emission\": 1}}", "expected true or false"},
        Case{"\"settings\": 5", "expected an object"},
        Case{"\"settings\": {\"spp\": [64]}", "expected a number, a text, true or false"},
        Case{"\"settings\": {\"spp\": null}", "expected a number"},
        Case{"\"name\": \"a\", \"name\": \"b\"", "key 'name' is given twice"},
        Case{"\"obj\": \"t.obj\"", "given twice"}, Case{"\"camera\": {\"fov_deg\": 1e400}", "not valid JSON"},
        Case{"\"name\": \"\xff\"", "not valid JSON"}, Case{"\"camera\": {\"eye\": [NaN, 0, 0]}", "not valid JSON"},
        Case{"// comment", "not valid JSON"});
    INFO(sample.members);
    CHECK_THAT(refused_members(",\n" + sample.members), contains("scene.json:4: ") && contains(sample.told));
}

TEST_CASE("The frame of a scene file is checked") {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& text) {
        const std::string path = folder.write("f.json", text).string();
        return input_error([&] { load_scene(path, folder.path()); });
    };
    CHECK_THAT(message(""), contains("f.json:1: not valid JSON"));
    CHECK_THAT(message("[]"), contains("f.json:1: expected an object"));
    CHECK_THAT(message("{}"), contains("f.json:1: 'schema': expected \"pathlight.scene/1\", got none"));
    CHECK_THAT(message("{\n\"schema\": \"pathlight.scene/2\"}"),
               contains("f.json:2: 'schema': expected \"pathlight.scene/1\", got \"pathlight.scene/2\""));
    CHECK_THAT(message("{\n\"schema\": \"pathlight.scene/1\"}"),
               contains("'obj': expected the name of an OBJ or glTF file"));
    CHECK_THAT(message("{\"schema\": \"pathlight.scene/1\", \"obj\": \"gone.obj\"}"),
               contains("gone.obj: cannot be read: no such file"));
    CHECK_THAT(message("{\"schema\": \"pathlight.scene/1\"} {}"), contains("f.json:1: not valid JSON"));
    CHECK_THAT(message(std::string(100000, '[')), contains("f.json:1: nested deeper than 64 levels"));
}

TEST_CASE("Scenes are found by name, and the nearest name is told") {
    const std::filesystem::path assets = std::filesystem::path(PL_SOURCE_DIR) / "assets";
    const std::vector<std::string> names = list_scenes(assets);
    for (const char* shipped : {"cornell", "door", "furnace"}) {
        CHECK(std::find(names.begin(), names.end(), shipped) != names.end());
    }
    CHECK_THAT(input_error([&] { load_scene("cornel", assets); }),
               contains("no scene 'cornel', did you mean 'cornell'?"));
    CHECK_THAT(input_error([&] { load_scene("", assets); }), contains("no scene ''"));
    CHECK_THAT(input_error([&] { load_scene("../scenes/door/door", assets); }), contains("no scene"));
    CHECK(list_scenes("no such folder").empty());
}

TEST_CASE("The assets are found from anywhere, and where the environment says") {
    const std::filesystem::path start = std::filesystem::current_path();
    const TemporaryFolder folder;
    std::filesystem::current_path(folder.path());
    CHECK(std::filesystem::equivalent(find_assets_dir(), std::filesystem::path(PL_SOURCE_DIR) / "assets"));
    std::filesystem::create_directories(folder.path() / "mine/scenes");
    ::setenv("PATHLIGHT_ASSETS", (folder.path() / "mine").c_str(), 1);
    CHECK(find_assets_dir() == folder.path() / "mine");
    ::setenv("PATHLIGHT_ASSETS", (folder.path() / "gone").c_str(), 1);
    CHECK_THAT(input_error([] { find_assets_dir(); }), contains("PATHLIGHT_ASSETS=") && contains("gone"));
    ::unsetenv("PATHLIGHT_ASSETS");
    std::filesystem::current_path(start);
}

TEST_CASE("Environment maps are scaled, and one that cannot be read is refused") {
    const TemporaryFolder folder;
    folder.write("s.obj", "v -1 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
    write_pfm(folder.path() / "sky.pfm", {.width = 2, .height = 1, .pixels = {glm::vec3(1, 2, 3), glm::vec3(0.5f)}});
    const auto load_with = [&](const std::string& environment) {
        const std::string text =
            "{\"schema\": \"pathlight.scene/1\", \"obj\": \"s.obj\", \"environment\": " + environment + "}";
        return load_scene(folder.write("scene.json", text).string(), folder.path());
    };
    const SceneDescription scene = load_with("{\"map\": \"sky.pfm\", \"scale\": 2, \"rotation_deg\": 90}");
    CHECK(scene.environment_map.width == 2);
    CHECK(scene.environment_map.height == 1);
    CHECK(scene.environment_map.rotation_deg == 90.0f);
    CHECK(scene.environment_map.texels == std::vector<glm::vec3>{{2, 4, 6}, {1, 1, 1}});
    CHECK_THAT(input_error([&] { load_with("{\"map\": \"gone.hdr\"}"); }), contains("gone.hdr"));
    CHECK_THAT(input_error([&] { load_with("{\"map\": \"s.obj\"}"); }), contains("expected an image"));
}

TEST_CASE("Textures that a scene file names, and triangles without texture points") {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl wall\nKd 0.5 0.5 0.5\n");
    folder.write("s.obj", "mtllib m.mtl\nusemtl wall\nv -1 0 0\nv 1 0 0\nv 0 2 0\nvt 0.25 0.5\nvt 1 0 0\nvt 2\n"
                          "f 1/1 2/2 3/3\nf 1/1 3/3 2\n");
    write_png8(folder.path() / "t.png", {.width = 1, .height = 1, .rgb = {255, 188, 0}});
    const std::string text =
        "{\"schema\": \"pathlight.scene/1\", \"obj\": \"s.obj\", \"materials\": {\"wall\": "
        "{\"albedo_map\": \"t.png\", \"wrap\": \"clamp\"}}, \"environment\": {\"radiance\": [1, 1, 1]}}";
    const SceneDescription scene = load_scene(folder.write("scene.json", text).string(), folder.path());
    REQUIRE(scene.textures.size() == 1);
    CHECK_FALSE(scene.textures[0].repeats);
    CHECK(scene.materials[0].textures.albedo == 0);
    CHECK(scene.uvs == std::vector<glm::vec2>{{0.25f, 0.5f}, {1, 0}, {2, 0}});
    CHECK(scene.triangles[0].uv == glm::uvec3(0, 1, 2));
    CHECK(scene.triangles[1].uv == glm::uvec3(TriangleDescription::kNoUv));
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings[0], contains("1 triangles have a texture but no texture coordinates"));
}

TEST_CASE("The opacity of a material blends if it is partial, unless the file says otherwise") {
    const auto wall = [](const std::string& members) {
        return load_members(", \"materials\": {\"wall\": {" + members + "}}").materials[0];
    };
    CHECK(wall("").opacity == 1.0f);
    CHECK(wall("").opacity_rule == OpacityRule::Threshold);
    CHECK(wall("\"opacity\": 0.25").opacity == 0.25f);
    CHECK(wall("\"opacity\": 0.25").opacity_rule == OpacityRule::Blend);
    CHECK(wall("\"opacity\": 1").opacity_rule == OpacityRule::Threshold);
    CHECK(wall("\"opacity\": 0.25, \"opacity_rule\": \"threshold\"").opacity_rule == OpacityRule::Threshold);
    CHECK(wall("\"opacity_rule\": \"blend\"").opacity_rule == OpacityRule::Blend);
    const auto refused_wall = [](const std::string& members) {
        return refused_members(", \"materials\": {\"wall\": {" + members + "}}");
    };
    CHECK_THAT(refused_wall("\"opacity\": 1.5"), contains("opacity") && contains("within [0, 1], got 1.5"));
    CHECK_THAT(refused_wall("\"opacity\": -0.5"), contains("within [0, 1], got -0.5"));
    CHECK_THAT(refused_wall("\"opacity\": \"half\""), contains("opacity"));
    CHECK_THAT(refused_wall("\"opacity_rule\": \"half\""), contains("expected one of threshold, blend, got 'half'"));
}
