// `pathlight convert` from a shell: the new scene has the picture of the old one, to the bit.
#include <filesystem>

#include <nlohmann/json.hpp>

#include "core/io/image.h"
#include "core/io/load_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/forest.h"
#include "tests/support/files/gltf_maker.h"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

using nlohmann::ordered_json;

std::string picture(const TempDir& folder, const std::string& scene, const Arguments& more = {}) {
    const std::string file = folder / "picture.pfm";
    const ProgramResult result =
        run_program(joined({"render", scene, "-o", file, "--size", "16x12", "--spp", "2", "-q", "-t", "1"}, more));
    CAPTURE(scene, result.err);
    REQUIRE(result.code == 0);
    return read_all(file);
}

void convert(const std::string& scene, const std::string& file, const Arguments& more = {}) {
    const ProgramResult result = run_program(joined({"convert", scene, "-o", file}, more));
    CAPTURE(scene, result.err);
    REQUIRE(result.code == 0);
}

/// Converts and compares the pictures.
void check_same(const TempDir& folder, const std::string& scene, const Arguments& opening = {}) {
    CAPTURE(scene);
    std::filesystem::create_directory(folder / "new");
    convert(scene, folder / "new/s.json", opening);
    CHECK(picture(folder, folder / "new/s.json") == picture(folder, scene, opening));
    std::filesystem::remove_all(folder / "new");
}

/// A striped picture whose texels are no codes of 8 bits, and one of codes.
void write_images(const TempDir& folder) {
    LinearImage fine{.width = 4, .height = 2, .pixels = {}};
    ByteImage coarse{.width = 4, .height = 2, .rgb = {}};
    for (int i = 0; i < 8; ++i) {
        fine.pixels.emplace_back(0.1f * static_cast<float>(i), 0.3f, 0.7f);
        for (int k = 0; k < 3; ++k) coarse.rgb.push_back(static_cast<std::uint8_t>(30 * i + 7 * k));
    }
    write_exr(folder / "fine.exr", fine);
    write_png8(folder / "coarse.png", coarse);
}

constexpr const char* kTwoSquares =
    "mtllib m.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv -1 -1 -1\nv 1 -1 1\nvt 0 0\nvt 2 0\nvt 2 2\nvt 0 2\n"
    "vn 0.1 0.2 1\nvn -0.1 0 1\nusemtl painted wall\nf 1/1/1 2/2/2 3/3/1 4/4/1\nusemtl lamp # 1\nf 5 6 4\n"
    "s 1\nusemtl metal\nf 5 6 1\nf 1 6 2\n";

constexpr const char* kMaterials =
    "newmtl painted wall\nKd 0.5 0.6 0.7\nmap_Kd coarse.png\nmap_d -clamp on coarse.png\nnewmtl lamp\nKe 3 2 1\n"
    "map_Ke fine.exr\nnewmtl metal\nPm 1\nKs 0.9 0.8 0.7\nPr 0.4\nmap_Pr fine.exr\n";

}  // namespace

TEST_CASE("convert: an OBJ file with images, normals and a default camera keeps its picture") {
    const TempDir folder;
    write_images(folder);
    write_all(folder / "a.obj", kTwoSquares);
    write_all(folder / "m.mtl", kMaterials);
    check_same(folder, folder / "a.obj");
    write_all(folder / "a.json", R"({"schema": "pathlight.scene/1", "obj": "a.obj", "map_kd": "replace"})");
    check_same(folder, folder / "a.json", {"--up-axis", "z"});
    CHECK(picture(folder, folder / "a.json") != picture(folder, folder / "a.obj"));
}

TEST_CASE("convert: a scene without a light keeps its default light, or its darkness") {
    const TempDir folder;
    write_all(folder / "a.obj", "v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 1 0\nf 1 2 3\nf 1 2 4\n");
    check_same(folder, folder / "a.obj");
    check_same(folder, folder / "a.obj", {"--default-light", "off"});
}

TEST_CASE("convert: a scene file keeps camera, settings, sky, sun and the values of its knobs") {
    const TempDir folder;
    check_same(folder, "textured-room");
    check_same(folder, "lens");
    check_same(folder, "door", {"-D", "opening=20"});
    const ProgramResult result = run_program({"convert", "door", "-o", folder / "d.json"});
    CHECK_THAT(result.err, contains("its knobs are left out"));
}

TEST_CASE("convert: every shipped scene keeps its picture", "[merge]") {
    const TempDir folder;
    for (const std::string& name : list_scenes(find_assets_dir())) check_same(folder, name);
}

TEST_CASE("convert: a glTF file keeps pictures and listed cameras") {
    const TempDir folder;
    ByteImage image{.width = 2, .height = 2, .rgb = std::vector<std::uint8_t>(12, 120)};
    GltfMaker file;
    file.root["images"] = {{{"uri", "data:image/png;base64," + base64(encode_png8(image))}}};
    file.root["textures"] = {{{"source", 0}}};
    file.triangle({{"name", "hot \\ # \"metal\""},
                   {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"roughnessFactor", 0.3}}},
                   {"emissiveFactor", {0.5, 0.5, 1}}});
    file.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"aspectRatio", 2}}}}};
    file.node({{"name", "front"}, {"camera", 0}, {"translation", {0, 0, 5}}});
    file.node({{"name", "far"}, {"camera", 0}, {"translation", {0, 0, 9}}});
    write_all(folder / "a.glb", file.glb());
    check_same(folder, folder / "a.glb");
    check_same(folder, folder / "a.glb", {"--camera", "far"});

    convert(folder / "a.glb", folder / "s.json", {"--camera", "2"});
    const ProgramResult info = run_program({"info", folder / "s.json", "--json"});
    const ordered_json cameras = ordered_json::parse(lines_of(info.out).back())["cameras"];
    CHECK(cameras == ordered_json::array({"far", "front"}));
    CHECK(picture(folder, folder / "s.json", {"--camera", "front"}) == picture(folder, folder / "a.glb"));
}

TEST_CASE("convert: a Mitsuba file keeps its picture, its size and its sky") {
    const TempDir folder;
    write_images(folder);
    write_all(
        folder / "a.xml",
        "<scene version='3.0.0'><sensor type='thinlens'><float name='fov' value='50'/>"
        "<float name='aperture_radius' value='0.1'/><float name='focus_distance' value='4'/>"
        "<transform name='to_world'><lookat origin='1,1,5' target='0,0,0' up='0,1,0'/></transform>"
        "<film type='hdrfilm'><integer name='width' value='20'/><integer name='height' value='10'/></film></sensor>"
        "<emitter type='envmap'><string name='filename' value='fine.exr'/></emitter>"
        "<shape type='sphere'><bsdf type='roughplastic'><float name='alpha' value='0.1'/></bsdf></shape>"
        "<shape type='rectangle'><bsdf type='diffuse'><texture name='reflectance' type='bitmap'>"
        "<string name='filename' value='coarse.png'/></texture></bsdf></shape></scene>");
    check_same(folder, folder / "a.xml");
    convert(folder / "a.xml", folder / "s.json");
    CHECK(load_scene(folder / "s.json", "").setting("size") == "20x10");
}

TEST_CASE("convert: it says what it has written, and overwrites nothing") {
    const TempDir folder;
    const ProgramResult first = run_program({"convert", "cornell", "-o", folder / "a.json", "--json"});
    REQUIRE(first.code == 0);
    const ordered_json event = ordered_json::parse(lines_of(first.out).back());
    CHECK(event["event"] == "convert");
    CHECK(event["triangles"] == 32);
    CHECK(event["images"] == 0);
    CHECK(folder.names() == std::vector<std::string>{"a-parts", "a.json"});
    const std::string before = read_all(folder / "a.json");

    const ProgramResult again = run_program({"convert", "door", "-o", folder / "a.json"});
    CHECK(again.code == 2);
    CHECK_THAT(again.err, contains("a.json: expected a new name, got one that is taken"));
    CHECK(read_all(folder / "a.json") == before);
    std::filesystem::remove(folder / "a.json");
    CHECK_THAT(run_program({"convert", "door", "-o", folder / "a.json"}).err,
               contains("a-parts: expected a new name"));
    CHECK(folder.names() == std::vector<std::string>{"a-parts"});
}

TEST_CASE("convert: wrong names and unwritable places leave nothing behind") {
    const TempDir folder;
    CHECK(run_program({"convert", "cornell", "-o", folder / "a.obj"}).code == 2);
    CHECK(run_program({"convert", "cornell"}).code == 2);
    CHECK(run_program({"convert", "-o", folder / "a.json"}).code == 2);
    CHECK(run_program({"convert", folder / "none.obj", "-o", folder / "a.json"}).code == 3);
    CHECK(run_program({"convert", "cornell", "-o", folder / "none/a.json"}).code == 1);
    CHECK(folder.names().empty());
}

TEST_CASE("convert: a scene of more copies than a scene file may have is refused, and nothing is written") {
    const TempDir folder;
    write_all(folder / "a.glb", forest().glb());
    const ProgramResult result = run_program({"convert", folder / "a.glb", "-o", folder / "s.json"});
    CHECK(result.code == 3);
    CHECK_THAT(result.err, contains("a.glb: scene files hold no instances") && contains("got 80000001"));
    CHECK(folder.names() == std::vector<std::string>{"a.glb"});
}

}  // namespace pl::test
