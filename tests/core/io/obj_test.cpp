// Valid OBJ files: geometry, normals, materials, and faults that are corrected with a warning.
#include "core/io/obj.h"

#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "core/io/frame_camera.h"
#include "core/io/load_scene.h"
#include "core/io/mtl.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/mesh_properties.h"

using namespace pl;
using pl::test::contains;
using pl::test::TemporaryFolder;

namespace {

constexpr const char* kRedAndLamp =
    "newmtl red\nKd 0.6 0.1 0.2\nnewmtl lamp\nKd 0.1 0.2 0.3\nKe 4 5 6\nPl_two_sided 1\n";

SceneDescription load_obj_text(const std::string& obj, const std::string& mtl = kRedAndLamp) {
    const TemporaryFolder folder;
    folder.write("m.mtl", mtl);
    return load_obj(folder.write("s.obj", obj));
}

bool same_geometry(const SceneDescription& a, const SceneDescription& b) {
    if (a.positions != b.positions || a.normals != b.normals || a.triangles.size() != b.triangles.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.triangles.size(); ++i) {
        if (a.triangles[i].vertex != b.triangles[i].vertex || a.triangles[i].normal != b.triangles[i].normal ||
            a.triangles[i].material != b.triangles[i].material) {
            return false;
        }
    }
    return true;
}

const std::string kQuad = "mtllib m.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\n";

}  // namespace

TEST_CASE("A triangle with its material") {
    const SceneDescription scene = load_obj_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0.5\nusemtl lamp\nf 1 2 3\n");
    REQUIRE(scene.triangles.size() == 1);
    CHECK(scene.positions == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5f}});
    CHECK(scene.triangles[0].vertex == glm::uvec3(0, 1, 2));
    CHECK(scene.triangles[0].normal == glm::uvec3(TriangleDescription::kNoNormal));
    REQUIRE(scene.materials.size() == 2);
    const MaterialDescription& lamp = scene.materials[scene.triangles[0].material];
    CHECK(lamp.name == "lamp");
    CHECK(lamp.albedo == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(lamp.emission == glm::vec3(4, 5, 6));
    CHECK(lamp.two_sided_emission);
    CHECK_FALSE(scene.materials[0].two_sided_emission);
    CHECK(scene.warnings.empty());
}

TEST_CASE("Polygons keep their area, their orientation and their vertices") {
    const SceneDescription quad = load_obj_text(kQuad);
    CHECK(quad.triangles.size() == 2);
    CHECK(quad.positions.size() == 4);
    CHECK(test::area(quad) == Approx(2.0).epsilon(1e-12));
    const SceneDescription pentagon = load_obj_text("v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 3 0\nv -1 1 0\nf 1 2 3 4 5\n");
    CHECK(pentagon.triangles.size() == 3);
    CHECK(test::area(pentagon) == Approx(7.0).epsilon(1e-12));
    const SceneDescription far_l =
        load_obj_text("v 10 10 1\nv 12 10 1\nv 12 11 1\nv 11 11 1\nv 11 12 1\nv 10 12 1\nf 1 2 3 4 5 6\n");
    CHECK(far_l.triangles.size() == 4);
    CHECK(test::area(far_l) == Approx(3.0).epsilon(1e-12));
    for (const TriangleDescription& t : far_l.triangles) {
        CHECK(test::area_vector(far_l, t).z > 0.0);
    }
}

TEST_CASE("Negative indices count back from the face") {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const SceneDescription scene = load_obj_text(vertices + "f -3 -2 -1\n" + "v 5 0 0\n" + "f -1 -3 -2\n");
    REQUIRE(scene.triangles.size() == 2);
    CHECK(scene.triangles[0].vertex == glm::uvec3(0, 1, 2));
    CHECK(scene.triangles[1].vertex == glm::uvec3(3, 1, 2));
}

TEST_CASE("Groups and objects are merged, vertices may follow their faces") {
    const SceneDescription scene =
        load_obj_text("o a\ng one two\ns 1\nf 1 2 3\ng\no b\ns off\nf 2 4 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n");
    CHECK(scene.triangles.size() == 2);
    CHECK(test::bodies(scene).size() == 1);
    CHECK(scene.warnings.size() == 1);  // no material
}

TEST_CASE("Smooth normals are kept per corner and made unit") {
    const SceneDescription scene = load_obj_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 2\nvn 0 3 4\nvt 0 0\n"
                                                 "f 1//1 2//2 3//1\nf 1/1/-1 3/1/2 4/1/1\nf 1/1 2/1 4/1\n");
    REQUIRE(scene.normals.size() == 2);
    CHECK(scene.normals[0] == glm::vec3(0, 0, 1));
    CHECK(scene.normals[1].y == Approx(0.6));
    CHECK(scene.normals[1].z == Approx(0.8));
    CHECK(scene.triangles[0].normal == glm::uvec3(0, 1, 0));
    CHECK(scene.triangles[1].normal == glm::uvec3(1, 1, 0));
    CHECK(scene.triangles[2].normal == glm::uvec3(TriangleDescription::kNoNormal));
}

TEST_CASE("Normals that are not usable are ignored with one counted warning") {
    const SceneDescription scene =
        load_obj_text("mtllib m.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 0\nvn 0 0 1\n"
                      "f 1//1 2//2 3//2\nf 1//2 2 3//2\nf 1//2 2//2 3//2\n");
    REQUIRE(scene.triangles.size() == 3);
    CHECK(scene.triangles[0].normal == glm::uvec3(TriangleDescription::kNoNormal));
    CHECK(scene.triangles[1].normal == glm::uvec3(TriangleDescription::kNoNormal));
    CHECK(scene.triangles[2].normal == glm::uvec3(1));
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings[0], contains("s.obj:8: normals ignored") && contains("(2 in all)"));
}

TEST_CASE("How lines are written does not matter") {
    const SceneDescription plain = load_obj_text(kQuad);
    const auto rewritten = [](const std::string& end) {
        std::string text;
        for (const char c : kQuad) {
            text += c == '\n' ? end : std::string(1, c);
        }
        return text;
    };
    const auto variant =
        GENERATE_COPY(rewritten("\r\n"), rewritten("\r"), rewritten("  \t\n"), "\xEF\xBB\xBF" + kQuad,
                      "# c\\\n\n   \n\t# d\n" + kQuad,
                      std::string("mtllib m.mtl # here\nv\t0 0  0 # zero\nv 2 0 \\\n 0\nv +2 1. .0e3\nv 0 "
                                  "1e0 1e-400\nusemtl red\n  f 1 2 \\\r\n3 4"));
    const SceneDescription scene = load_obj_text(variant);
    CHECK(same_geometry(scene, plain));
    CHECK(scene.warnings.empty());
}

TEST_CASE("Names of materials may have blanks and any letters") {
    const SceneDescription scene =
        load_obj_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl  my  red \xE4# 1 \nf 1 2 3\n",
                      "newmtl my  red \xE4# 1\nKd 1 0 0\n");
    CHECK(scene.warnings.empty());
    CHECK(scene.materials[scene.triangles[0].material].name == "my  red \xE4# 1");
}

TEST_CASE("Faces without a material get the default one and one warning") {
    struct Case {
        const char* name;
        std::string obj;
        std::string told;
    };
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const Case sample =
        GENERATE_COPY(Case{"no library", triangle + "f 1 2 3\nf 1 3 2\n", "no material given; 2 faces"},
                      Case{"library missing", "mtllib gone.mtl\n" + triangle + "usemtl red\nf 1 2 3\n",
                           "s.obj:1: material file 'gone.mtl' not found"},
                      Case{"material missing", "mtllib m.mtl\n" + triangle + "usemtl rde\nf 1 2 3\n",
                           "s.obj:5: no material 'rde'; 1 faces"},
                      Case{"used before it is named", "mtllib m.mtl\n" + triangle + "f 1 2 3\nusemtl red\n",
                           "no material given; 1 faces"});
    INFO(sample.name);
    const SceneDescription scene = load_obj_text(sample.obj);
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings[0], contains(sample.told));
    CHECK(scene.materials[scene.triangles[0].material].albedo == kDefaultAlbedo);
}

TEST_CASE("Only faces without a material get the default one") {
    const SceneDescription scene = load_obj_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl lamp\nf 1 "
                                                 "2 3\nusemtl other\nf 1 2 3\nusemtl red\nf 1 2 3\n");
    REQUIRE(scene.materials.size() == 3);
    CHECK(scene.triangles[0].material == 2);
    CHECK(scene.triangles[1].material == 1);
    CHECK(scene.triangles[2].material == 2);
    CHECK(scene.triangles[3].material == 0);
    CHECK(scene.warnings.size() == 1);
}

TEST_CASE("Several libraries, and names of libraries with blanks") {
    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl a\nKd 1 0 0\n");
    folder.write("sub/b c.mtl", "newmtl b\nKd 0 1 0\n");
    const SceneDescription scene =
        load_obj(folder.write("s.obj", "mtllib a.mtl a.mtl\nmtllib sub/b c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 "
                                       "0\nusemtl b\nf 1 2 3\nusemtl a\nf 1 2 3\n"));
    CHECK(scene.warnings.empty());
    CHECK(scene.materials.size() == 2);
    CHECK(scene.triangles[0].material == 1);
}

TEST_CASE("Names in quotes, and names of libraries as programs write them") {
    const TemporaryFolder folder;
    folder.write("model 3d.mtl", "newmtl \"a b\"\nKd 1 0 0\nnewmtl c\nKd 0 1 0\n");
    folder.write("sub/b.mtl", "newmtl d\nKd 0 0 1\n");
    const std::string libraries =
        GENERATE(as<std::string>{}, "mtllib \"model 3d.mtl\"\nmtllib sub\\b.mtl\n",
                 "mtllib \"model 3d.mtl\" 'sub/b.mtl'  # two\n", "mtllib model 3d.mtl sub\\b.mtl \r\n",
                 "mtllib ./sub/b.mtl\t\nmtllib model 3d.mtl # here\n");
    INFO(libraries);
    const std::string faces =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a b\nf 1 2 3\nusemtl \"c\"\nf 1 2 3\nusemtl 'd' # e\nf 1 2 3";
    for (const std::string& text : {libraries + faces, faces + "\n" + libraries}) {
        const SceneDescription scene = load_obj(folder.write("s.obj", text));
        CHECK(scene.warnings.empty());
        REQUIRE(scene.triangles.size() == 3);
        for (int i = 0; i < 3; ++i)
            CHECK(scene.materials.at(scene.triangles[static_cast<std::size_t>(i)].material).albedo[i] == 1.0f);
    }
}

TEST_CASE(
    "A file without the normals and texture points that its faces name is shown without them, with one warning") {
    const SceneDescription scene =
        load_obj_text("mtllib m.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0 0 1\nusemtl red\n"
                      "f 1/1/7 2/2/7 3/3/7 4/4/7\nf 1/1/1 2/2/1 3/3/1\ns 1\nf 1//1 2//1 3//9\n");
    REQUIRE(scene.triangles.size() == 4);
    CHECK(scene.triangles[0].normal == glm::uvec3(TriangleDescription::kNoNormal));
    CHECK(scene.triangles[0].uv == glm::uvec3(TriangleDescription::kNoUv));
    CHECK(scene.triangles[2].normal == glm::uvec3(0));
    CHECK(scene.triangles[3].normal.x != TriangleDescription::kNoNormal);  // of its smoothing group
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings[0],
               contains("s.obj:8: normal index 7 is out of range, the file has 1: this face is shown "
                        "without its normals or texture points (3 in all)"));
}

TEST_CASE("The options -s and -o of a material's image move its texture coordinates alone") {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl a\nmap_Kd -o 0.25 0 0 -s 2 3 1 a.png\nnewmtl b\nmap_Kd a.png\n");
    const SceneDescription scene =
        load_obj(folder.write("s.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0.5 1\n"
                                       "usemtl a\nf 1/1 2/2 3/3\nf 3/3 2/2 1/1\nusemtl b\nf 1/1 2/2 3/3\n"));
    REQUIRE(scene.uvs.size() == 6);
    const auto uv = [&](std::size_t triangle, int corner) { return scene.uvs[scene.triangles[triangle].uv[corner]]; };
    CHECK(uv(0, 0) == glm::vec2(0.25f, 0.0f));
    CHECK(uv(0, 1) == glm::vec2(2.25f, 0.0f));
    CHECK(uv(0, 2) == glm::vec2(1.25f, 3.0f));
    CHECK(uv(1, 0) == uv(0, 2));
    CHECK(uv(2, 2) == glm::vec2(0.5f, 1.0f));
}

TEST_CASE("Entries that cannot be used are left out with one counted warning each") {
    const SceneDescription scene =
        load_obj_text("mtllib m.mtl\nusemtl red\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1\nv 2 0 0\n"
                      "f 1 2\nf 3\nf 1 2 4\nf 1 2 2 3\nf 1 1 1\ncurv 1 2\nf 1 2 3\nl 1 2\n");
    CHECK(scene.triangles.size() == 2);  // the last face, and the quad with one corner twice
    CHECK(test::area(scene) == Approx(1.0));
    REQUIRE(scene.warnings.size() == 5);
    CHECK_THAT(scene.warnings[0], contains("s.obj:7: face with fewer than 3 corners left out (2 in all)"));
    CHECK_THAT(scene.warnings[1], contains("s.obj:4: vertex color left out") && contains("(1 in all)"));
    CHECK_THAT(scene.warnings[2], contains("s.obj:3: fourth vertex coordinate left out (2 in all)"));
    CHECK_THAT(scene.warnings[3], contains("s.obj:12: unknown statement 'curv' left out (1 in all)"));
    CHECK_THAT(scene.warnings[4], contains("s.obj:9: triangle without area removed (3 in all)"));
}

TEST_CASE("A tall file keeps every face in place") {
    constexpr std::uint32_t kRows = 100000;
    std::string text = "mtllib m.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\n";
    for (std::uint32_t i = 1; i <= kRows; ++i) {
        const std::string y = std::to_string(i);
        text += "v 0 " + y + " 0\nv 1 " + y + " 0\nf -4 -3 -1 -2\n";
    }
    const SceneDescription scene = load_obj_text(text);
    CHECK(scene.positions.size() == 2 * (kRows + 1));
    CHECK(scene.triangles.size() == 2 * kRows);
    CHECK(test::area(scene) == Approx(static_cast<double>(kRows)).epsilon(1e-12));
    CHECK(test::open_edges(scene.triangles).size() == 2 * kRows + 2);
}

TEST_CASE("A face on one line of a megabyte") {
    std::string text = "mtllib m.mtl\nusemtl red\n";
    std::string face = "f";
    constexpr int kCorners = 1000;
    for (int i = 0; i < kCorners; ++i) {  // a comb: every second corner is inside
        const int x = i < kCorners / 2 ? i : kCorners - 1 - i;
        const int y = i < kCorners / 2 ? -(i % 2) - 1 : (i % 2) + 1;
        text += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
        face += std::string(1000, ' ') + std::to_string(i + 1);
    }
    const SceneDescription scene = load_obj_text(text + face);
    CHECK(scene.warnings.empty());
    CHECK(scene.triangles.size() == kCorners - 2);
    CHECK(test::area(scene) == Approx(3.0 * (kCorners / 2 - 1)).epsilon(1e-9));
}

TEST_CASE("An OBJ alone opens with a camera of its own, named after its file") {
    const TemporaryFolder folder;
    for (const std::string text :
         {"v -3 7 100\nv 5 9 104\nv 0 0.5 90\nf 1 2 3\n", "v 1e-6 0 1000\nv 0 1e-6 1000\nv 0 0 1000\nf 1 2 3\n",
          "v 1e17 0 0\nv 0 1e17 0\nv 0 0 1e17\nf 1 2 3\n"}) {
        const SceneDescription scene = load_scene(folder.write("thing.obj", text).string(), folder.path());
        CHECK(scene.name == "thing");
        CHECK(scene.camera.eye == frame_camera(scene).eye);
    }
}

TEST_CASE("Faces of smoothing groups without normals get the mean normals of those faces, weighted by angles") {
    // A tent over the x axis; the third face is flat, the fourth has normals of its own.
    const std::string tent = "v 0 0 0\nv 4 0 0\nv 4 -1 -1\nv 0 -1 -1\nv 0 1 -1\nv 4 9 0\nvn 1 0 0\n";
    const SceneDescription scene =
        load_obj_text(tent + "s 1\nf 4 3 2 1\ns 7\nf 2 5 1\ns off\nf 1 2 6\ns 1\nf 1//1 2//1 6//1\n");
    REQUIRE(scene.triangles.size() == 5);
    const auto normal_at = [&](std::uint32_t vertex) {
        for (std::size_t i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                if (scene.triangles[i].vertex[k] == vertex) return scene.normals[scene.triangles[i].normal[k]];
        return glm::vec3(0.0f);
    };
    const float half = std::sqrt(0.5f);
    CHECK(glm::length(normal_at(2) - glm::vec3(0, -half, half)) < 1e-6f);  // of the quad alone
    CHECK(glm::length(normal_at(4) - glm::vec3(0, half, half)) < 1e-6f);   // of the triangle alone
    // At 0 both faces have a right angle; at 1 the triangle has a smaller one.
    CHECK(glm::length(normal_at(0) - glm::vec3(0, 0, 1)) < 1e-6f);
    const float angle = std::atan2(std::sqrt(2.0f), 4.0f);
    const float right = std::acos(0.0f);
    const glm::vec3 mixed = glm::normalize(right * glm::vec3(0, -half, half) + angle * glm::vec3(0, half, half));
    CHECK(glm::length(normal_at(1) - mixed) < 1e-6f);
    CHECK(scene.triangles[3].normal.x == TriangleDescription::kNoNormal);
    CHECK(scene.normals[scene.triangles[4].normal.x] == glm::vec3(1, 0, 0));
    for (const char* off : {"s off # flat\n", "s 0\n", "s\n", ""})
        CHECK(load_obj_text(tent + off + "f 1 2 6\n").triangles[0].normal.x == TriangleDescription::kNoNormal);
}

TEST_CASE("The image of Kd: multiplied by Kd, with one warning for defaults of exporters, or alone") {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl a\nKd 0.8 0.8 0.8\nmap_Kd a.png\nnewmtl b\nKd 0.64 0.64 0.64\nmap_Kd a.png\n"
                          "newmtl c\nKd 0.5 0.5 0.5\nmap_Kd a.png\nnewmtl d\nKd 0.8 0.8 0.8\n");
    const auto obj = folder.write("s.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    const auto told = [](const SceneDescription& scene) {
        return std::count_if(scene.warnings.begin(), scene.warnings.end(), [](const std::string& warning) {
            return warning.find("m.mtl:1: the image of map_Kd is multiplied") != std::string::npos &&
                   warning.find("(2 in all)") != std::string::npos;
        });
    };
    const SceneDescription by_text = load_obj(obj);
    CHECK(by_text.materials[0].albedo == glm::vec3(0.8f));
    CHECK(told(by_text) == 1);
    const SceneDescription alone = load_obj(obj, nullptr, MapKd::Replaces);
    for (std::size_t i = 0; i < 3; ++i) CHECK(alone.materials[i].albedo == glm::vec3(1.0f));
    CHECK(alone.materials[3].albedo == glm::vec3(0.8f));
    CHECK(told(alone) == 0);
}

TEST_CASE("A material without a name is that of a usemtl without one") {
    const SceneDescription scene =
        load_obj_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl\nf 1 2 3\n", "newmtl\nKd 0.1 0.2 0.3\n");
    CHECK(scene.materials.at(scene.triangles.at(0).material).albedo == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(scene.warnings.empty());
}

TEST_CASE("Geometry far from the origin keeps its shape: it is moved in doubles, with one warning") {
    const std::string rest = "usemtl red\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nv 0 0 0\n";
    const auto house = [&](double x, double y, const std::string& sign) {
        std::string text = "mtllib m.mtl\n";
        for (const glm::dvec2 corner : {glm::dvec2(0.37, 0.81), {0.57, 0.81}, {0.57, 10.81}, {0.37, 10.81}})
            text += fmt::format("v {}{:.3f} {:.3f} 30\n", sign, x + corner.x, y + corner.y);
        return load_obj_text(text + rest);
    };
    for (const std::string sign : {"", "+"}) {  // read as usual, and word by word
        const SceneDescription scene = house(391234.0, 5820123.0, sign);
        CHECK(scene.origin.x == Approx(391234.0).margin(8.0));
        CHECK(scene.origin.y == Approx(5820123.0).margin(16.0));
        CHECK(scene.origin.z == 0.0);
        REQUIRE(scene.triangles.size() == 2);
        CHECK(test::area(scene) == Approx(2.0).epsilon(1e-6));
        CHECK((scene.positions[1].x - scene.positions[0].x) == Approx(0.2f).epsilon(1e-5));
        CHECK(scene.origin.x + static_cast<double>(scene.positions[0].x) == Approx(391234.37).epsilon(1e-12));
        CHECK(scene.positions[0].z == 30.0f);
        CHECK(scene.normals[0] == glm::vec3(0, 0, 1));
        REQUIRE(scene.warnings.size() == 1);
        CHECK_THAT(scene.warnings[0], contains("s.obj: far from the origin, moved by"));
        // Near the origin every bit is kept.
        const SceneDescription near = house(0.0, 0.0, sign);
        CHECK(near.origin == glm::dvec3(0.0));
        CHECK(near.positions[0] == glm::vec3(0.37f, 0.81f, 30.0f));
        CHECK(near.warnings.empty());
    }
}

TEST_CASE("Files in UTF-16 are read, of either order of bytes", "[hard]") {
    const auto wide = [](const std::string& text, bool is_little) {
        std::string bytes = is_little ? "\xFF\xFE" : "\xFE\xFF";
        for (const char c : text) (bytes += is_little ? c : '\0') += is_little ? '\0' : c;
        return bytes;
    };
    const std::string text = "mtllib m.mtl\r\nv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nusemtl red\r\nf 1 2 3\r\n";
    for (const bool is_little : {true, false}) {
        const SceneDescription scene = load_obj_text(wide(text, is_little), wide(kRedAndLamp, !is_little));
        CHECK(scene.materials.at(scene.triangles.at(0).material).albedo == glm::vec3(0.6f, 0.1f, 0.2f));
    }
    CHECK_THAT(test::input_error([&] { load_obj_text(wide(text, true) + "x"); }),
               contains("UTF-16") && contains("even number"));
    CHECK_THAT(test::input_error([&] { load_obj_text(wide(text, true) + "\x01\xD8"); }),
               contains("half a character at byte"));
}
