// Choices at loading: the default light, the vertical axis. And the collection of files that were broken once:
// tests/corpus/refused must be refused with file and line or reason, tests/corpus/accepted must load. A new file only has
// to be put there.
#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/io/load_scene.h"
#include "core/io/scene_materials.h"
#include "core/scene/scene_hash.h"
#include "tests/core/io/obj_text.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::kThreeVertices;
using pl::test::TemporaryFolder;

namespace {

const std::string kTriangleFile = kThreeVertices + "f 1 2 3\n";

std::vector<std::filesystem::path> scenes_in(const std::string& folder) {
    std::vector<std::filesystem::path> result;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(PL_SOURCE_DIR) + "/tests/corpus/" + folder)) {
        const std::string suffix = entry.path().extension().string();
        if (suffix == ".obj" || suffix == ".json") {
            result.push_back(entry.path());
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace

TEST_CASE("Corpus: files to be refused") {
    const auto paths = scenes_in("refused");
    CHECK(paths.size() >= 10);
    for (const auto& path : paths) {
        INFO(path);
        CHECK_THAT(test::input_error([&] { load_scene(path.string(), ""); }), contains(path.stem().string()));
    }
}

TEST_CASE("A scene names the files that it was read from, and those that are missing") {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nKe 1 1 1\n");
    const auto obj = folder.write("a.obj", "mtllib m.mtl\nmtllib none.mtl\nusemtl wall\n" + kTriangleFile);
    const auto json = folder.write("s.json", R"({"schema": "pathlight.scene/1", "obj": "a.obj"})");
    const std::vector<std::filesystem::path> expected{obj, folder.path() / "m.mtl", folder.path() / "none.mtl", json};
    CHECK(load_scene(json.string(), "").files == expected);
}

TEST_CASE("A file of materials replaces the values of the scene to the bit, and is checked") {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nKe 1 1 1\nnewmtl lamp\nKd 0 0 0\nKe 3 2 1\n");
    const auto obj = folder.write("a.obj", "mtllib m.mtl\nusemtl wall\n" + kTriangleFile).string();
    SceneDescription edited = load_scene(obj, "");
    edited.materials[0] = {.name = "wall",
                           .albedo = {0.1f, 0.2f, 1.0f / 3.0f},
                           .emission = {0.7f, 0.0f, 12.3f},
                           .two_sided_emission = true,
                           .kind = SurfaceKind::Plastic,
                           .roughness = 0.3f,
                           .ior = 1.7f,
                           .specular = {0.9f, 0.8f, 0.7f},
                           .transmission = {0.6f, 0.5f, 0.4f},
                           .absorption = {0.1f, 0.0f, 7.0f},
                           .opacity = 0.3f,
                           .opacity_rule = OpacityRule::Blend};
    const auto file = folder.path() / "edits.json";
    write_material_file(file, edited.materials);
    const SceneDescription again = load_scene(obj, "", {.materials = file});
    CHECK(again.materials == edited.materials);
    CHECK(again.files.back() == file);
    folder.write("edits.json", R"({"schema": "pathlight.materials/1", "materials": {"well": {}}})");
    CHECK_THAT(test::input_error([&] { load_scene(obj, "", {.materials = file}); }),
               contains("edits.json:1") && contains("did you mean 'wall'?"));
    folder.write("edits.json", R"({"schema": "pathlight.scene/1", "materials": {}})");
    CHECK_THAT(test::input_error([&] { load_scene(obj, "", {.materials = file}); }),
               contains("expected \"pathlight.materials/1\""));
}

TEST_CASE("A file without light opens with the default light, and says so") {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nKe 0 0 0\nnewmtl lamp\nKe 1 1 1\n");
    const auto path = folder.write("a.obj", "mtllib m.mtl\nusemtl wall\n" + kTriangleFile).string();
    const SceneDescription lit = load_scene(path, "");
    CHECK(lit.default_light);
    CHECK(lit.environment_map.texels.size() > 1000);
    REQUIRE(lit.warnings.size() == 1);
    CHECK_THAT(lit.warnings[0],
               contains("a.obj: no light in this scene; by default: a sky") && contains("--default-light off"));

    const SceneDescription dark = load_scene(path, "", {.default_light = false});
    CHECK_FALSE(dark.default_light);
    CHECK(dark.environment_map.texels.empty());
    REQUIRE(dark.warnings.size() == 1);
    CHECK_THAT(dark.warnings[0], contains("no light in this scene: the picture is black"));
    CHECK(scene_hash(dark) != scene_hash(lit));

    // A scene file alike, where only its own setting or the caller's choice is off.
    const auto json = [&](const std::string& members) {
        return folder.write("s.json", R"({"schema": "pathlight.scene/1", "obj": "a.obj")" + members + "}").string();
    };
    CHECK(scene_hash(load_scene(json(""), "")) == scene_hash(lit));
    const std::string off = R"(, "settings": {"default-light": false})";
    CHECK_FALSE(load_scene(json(off), "").default_light);
    CHECK(load_scene(json(off), "", {.default_light = true}).default_light);
}

TEST_CASE("A scene with a light of any kind keeps every bit, whatever is chosen for those without") {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl lamp\nKe 1 1 1\n");
    folder.write("dark.obj", "mtllib m.mtl\nusemtl wall\n" + kTriangleFile);
    const std::string scene = R"({"schema": "pathlight.scene/1", "obj": "dark.obj", "environment": )";
    for (const auto& path : {folder.write("lamp.obj", "mtllib m.mtl\nusemtl lamp\n" + kTriangleFile),
                             folder.write("sky.json", scene + R"({"radiance": [0, 0, 1]}})"),
                             folder.write("sun.json", scene + R"({"sun": {"radiance": [1, 1, 1]}}})")}) {
        const SceneDescription on = load_scene(path.string(), "", {.default_light = true});
        CHECK_FALSE(on.default_light);
        CHECK(on.environment_map.texels.empty());
        CHECK(scene_hash(on) == scene_hash(load_scene(path.string(), "", {.default_light = false})));
        CHECK(on.warnings.empty());
    }
}

TEST_CASE("The vertical axis: as chosen, else of the scene file's camera, else guessed") {
    const glm::vec3 y{0, 1, 0};
    const glm::vec3 z{0, 0, 1};
    const TemporaryFolder folder;
    // A floor for which z is up.
    folder.write("m.mtl", "newmtl wall\nKd 0.5 0.5 0.5\n");
    const auto obj =
        folder.write("a.obj", "mtllib m.mtl\nusemtl wall\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n").string();
    CHECK(load_scene(obj, "").camera.up == z);
    CHECK(load_scene(obj, "", {.up_axis = UpAxis::Y}).camera.up == y);
    CHECK(load_scene(obj, "", {.up_axis = UpAxis::Auto}).camera.up == z);

    const auto with = [&](const std::string& members, const LoadSettings& asked = {}) {
        const auto text = R"({"schema": "pathlight.scene/1", "obj": "a.obj", )" + members + "}";
        return load_scene(folder.write("s.json", text).string(), "", asked);
    };
    CHECK(with(R"("settings": {"up-axis": "x"})").up == glm::vec3(1, 0, 0));
    CHECK(with(R"("settings": {"up-axis": "x"})", {.up_axis = UpAxis::Auto}).up == z);
    CHECK(with(R"("camera": {"fov_deg": 30})").camera.up == z);
    // A camera of the file keeps what it always was; its up vector tells the default light.
    CHECK(with(R"("camera": {"eye": [0, 0, 5]})").camera.up == y);
    CHECK(with(R"("camera": {"eye": [0, 0, 5], "up": [0.1, -1, 0]})").up == -y);
    const SceneDescription given = with(R"("camera": {"eye": [0, 0, 5], "up": [0, 1, 0]})", {.up_axis = UpAxis::Z});
    CHECK(given.camera.up == y);
    CHECK(given.up == z);
}

TEST_CASE("Corpus: files to be loaded") {
    const auto paths = scenes_in("accepted");
    CHECK(paths.size() >= 5);
    for (const auto& path : paths) {
        INFO(path);
        CHECK_FALSE(load_scene(path.string(), "").triangles.empty());
    }
}

TEST_CASE("Files of any size are shown whole: tiny ones keep their faces, lengths are scaled by a power of two") {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nKe 1 1 1\n");
    for (const auto& [size, exponent] : {std::pair{"e-15", 49}, {"e-9", 29}, {"e8", 0}, {"e10", -34}, {"e17", -57}}) {
        const std::string s = size;
        folder.write("a.obj", "mtllib m.mtl\nusemtl wall\nv 0 0 0\nv 1" + s + " 0 0\nv 0 1" + s + " 0\nv 0 0 2" + s +
                                  "\nv 0 0.001" + s + " 0\nv 0.001" + s + " 0 0\nf 1 2 3\nf 1 3 4\nf 1 5 6\n");
        const auto json = folder.write(
            "s.json", R"({"schema": "pathlight.scene/1", "obj": "a.obj", "camera": {"eye": [0, 0, 5)" + s + R"(]}})");
        const SceneDescription scene = load_scene(json.string(), "");
        INFO("1" << s);
        CHECK(scene.triangles.size() == 3);
        const double factor = std::ldexp(std::stod("1" + s), exponent);
        CHECK(static_cast<double>(scene.positions[1].x) == Approx(factor).epsilon(1e-6));
        CHECK(static_cast<double>(scene.camera.eye.z) == Approx(5.0 * factor).epsilon(1e-6));
        CHECK(scene.warnings.empty() == (exponent == 0));
    }
}

TEST_CASE("Faces on a line have no area, whatever their size") {
    const TemporaryFolder folder;
    for (const std::string size : {"e-15", "e-9", "e-2", "", "e9"}) {
        const auto obj = folder.write("a.obj", "v 0 0 0\nv 1" + size + " 1" + size + " 0\nv 2" + size + " 2" + size +
                                                   " 0\nf 1 2 3\nf 1 1 2\n");
        CHECK_THAT(test::input_error([&] { load_scene(obj.string(), ""); }), contains("no face has an area"));
    }
}
