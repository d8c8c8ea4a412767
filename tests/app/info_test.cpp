// `pathlight info` and `pathlight devices` from a shell.
#include <nlohmann/json.hpp>

#include "tests/support/catch.hpp"
#include "tests/support/files/forest.h"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::ordered_json;

}  // namespace

TEST_CASE("info lists the contents of the scene and the effects it needs, and why") {
    const ProgramResult cornell = run_program({"info", "cornell", "--nee", "off", "--json"});
    const ordered_json box = ordered_json::parse(lines_of(cornell.out).back());
    CHECK(box["triangles"] > 10);
    CHECK(box["lights"] == 2);
    CHECK(box["materials"].size() == 4);
    CHECK(box["camera"]["eye"] == ordered_json::array({278.0, 273.0, -800.0}));
    CHECK(box["effects_needed"].empty());

    const TempDir folder;
    write_all(folder / "a.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nvn 0 0 1\nvn 0.1 0 1\nf 1//1 2//1 3//2\n");
    write_all(folder / "a.json",
              R"({"schema": "pathlight.scene/1", "obj": "a.obj", "environment": {"radiance": [1, 2, 3]}})");
    const ProgramResult both = run_program({"info", folder / "a.json", "--nee", "off", "--json"});
    const ordered_json effects = ordered_json::parse(lines_of(both.out).back())["effects_needed"];
    REQUIRE(effects.size() == 2);
    CHECK(effects[0]["name"] == "smooth-normals");
    CHECK_THAT(effects[0]["reason"].get<std::string>(), contains("1 triangles"));
    CHECK(effects[1]["name"] == "environment");
    CHECK_THAT(effects[1]["reason"].get<std::string>(), contains("1,2,3"));
    CHECK_THAT(run_program({"info", folder / "a.json"}).out, contains("environment: ") && contains("kernel"));
}

TEST_CASE("info describes metals and glass by what they are") {
    const TempDir folder;
    write_all(folder / "m.mtl",
              "newmtl gold\nKd 0 0 0\nKs 1 0.75 0.25\nillum 3\nPr 0.5\nnewmtl pane\nillum 4\nNi 1.5\nTf 1 0.5 1\n"
              "newmtl lacquer\nKd 0.5 0.25 0\nPc 1\nnewmtl wall\nKd 0.5 0.5 0.5\n");
    write_all(folder / "a.obj", "mtllib m.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nusemtl gold\nf 1 2 3\n");
    const std::string text = run_program({"info", folder / "a.obj", "-q"}).out;
    CHECK_THAT(text, contains("gold: metal, reflects 1,0.75,0.25, roughness 0.5, emits 0,0,0\n"));
    CHECK_THAT(text, contains("pane: glass of ior 1.5, transmits 1,0.5,1, smooth, emits 0,0,0\n"));
    CHECK_THAT(text, contains("lacquer: reflects 0.5,0.25,0 under a coat of ior 1.5, smooth, emits 0,0,0\n"));
    CHECK_THAT(text, contains("wall: reflects 0.5,0.5,0.5, emits 0,0,0\n"));
    write_all(folder / "a.json", R"({"schema": "pathlight.scene/1", "obj": "a.obj",
        "materials": {"gold": {"blend": {"with": "wall", "share": 0.4}}}})");
    const std::string worn = run_program({"info", folder / "a.json", "-q"}).out;
    CHECK_THAT(worn, contains("gold: metal, reflects 1,0.75,0.25, roughness 0.5, blend of 0.4 wall, emits 0,0,0\n"));
    CHECK_THAT(worn, contains("blends: of 1 material: gold\n"));
    write_all(folder / "a.json", R"({"schema": "pathlight.scene/1", "obj": "a.obj",
        "materials": {"gold": {"anisotropy": 0.75, "rotation_deg": 30}}})");
    const std::string brushed = run_program({"info", folder / "a.json", "-q"}).out;
    CHECK_THAT(brushed,
               contains("gold: metal, reflects 1,0.75,0.25, roughness 0.5, anisotropy 0.75 at 30 degrees, "));
    CHECK_THAT(brushed, contains("anisotropy: of 1 material: gold\n"));
    write_all(folder / "a.json", R"({"schema": "pathlight.scene/1", "obj": "a.obj",
        "materials": {"wall": {"surface": "velvet", "specular": [1, 0.5, 0], "roughness": 0.5}}})");
    const std::string cloth = run_program({"info", folder / "a.json", "-q"}).out;
    CHECK_THAT(cloth, contains("wall: reflects 0.5,0.5,0.5 under a sheen of 1,0.5,0, roughness 0.5, emits 0,0,0\n"));
    CHECK_THAT(cloth, contains("velvet: of 1 material: wall\n"));
    const ProgramResult record = run_program({"info", folder / "a.obj", "--json"});
    const ordered_json gold = ordered_json::parse(lines_of(record.out).back())["materials"][0];
    CHECK(gold["surface"] == "conductor");
    CHECK(gold["specular"] == ordered_json::array({1.0, 0.75, 0.25}));
    CHECK(gold["roughness"] == 0.5);
}

TEST_CASE("info tells the triangles of meshes that are kept once, and those of all instances") {
    const TempDir folder;
    write_all(folder / "a.glb", forest().glb());
    CHECK_THAT(run_program({"info", folder / "a.glb", "-q"}).out,
               contains("triangles  1 directly, 8000 of 1 mesh shown by 10000 instances: 80000001 in all\n"));
    const ordered_json record =
        ordered_json::parse(lines_of(run_program({"info", folder / "a.glb", "--json"}).out).back());
    CHECK(record["triangles"] == 8001);
    CHECK(record["meshes"] == 1);
    CHECK(record["instances"] == 10000);
    CHECK(record["shown_triangles"] == 80000001);
    const ProgramResult cornell = run_program({"info", "cornell", "--json"});
    const ordered_json box = ordered_json::parse(lines_of(cornell.out).back());
    CHECK_FALSE(box.contains("instances"));
    CHECK_FALSE(box.contains("shown_triangles"));
    CHECK_THAT(run_program({"info", "cornell"}).out, contains("triangles  32\n"));
}

TEST_CASE("devices lists the back ends, and why one is missing") {
    const ProgramResult result = run_program({"devices", "--json"});
    const std::vector<std::string> lines = lines_of(result.out);
    REQUIRE(lines.size() >= 2);
    const ordered_json cpu = ordered_json::parse(lines[0]);
    CHECK(cpu["backend"] == "cpu");
    CHECK(cpu["available"] == true);
    // One line for every GPU, or one with the reason for having none.
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const ordered_json cuda = ordered_json::parse(lines[i]);
        CHECK(cuda["backend"] == "cuda");
        CHECK(cuda["available"] == cuda["reason"].is_null());
        if (cuda["available"] == false) CHECK_FALSE(cuda["reason"].get<std::string>().empty());
        if (lines.size() > 2) CHECK_FALSE(cuda["device"].is_null());
    }
}

}  // namespace pl::test
