// Malformed files: what can be used is shown, the rest is told with file and line, never a crash. Most effective with sanitizers.
#include <random>
#include <string>
#include <vector>

#include "core/io/load_scene.h"
#include "tests/core/io/obj_text.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::input_error;
using pl::test::kThreeVertices;
using pl::test::loads_or_refuses;
using pl::test::TemporaryFolder;

namespace {

const std::string kMtl =
    "# two\nnewmtl a\nKd 0.5 0.25 1e-1\nKe 0 0 0\nmap_Kd x.png\nnewmtl b c\nKd 1\nKe 4 4 4\nPl_two_sided 1\n"
    "newmtl g\nKd 0 0 0\nKs 0.5 0.5 0.5\nNs 225.5\nNi 1.5\nTf 1 0.9 1\nd 0.5\nillum 7\nPr 0.25\nPm 0\nPl_roughness "
    "0.5\n"
    "map_d -s 1 1 1 -clamp on y z.png\n";
const std::string kObj =
    "# small\r\nmtllib s.mtl\nv 0 0 0\nv 1.5 0 -0\nv 1.5 1e0 0 1\nv 0 1 0 1 0 1\nvn 0 0 1\nvt 0 0\no q\ng x "
    "y\n"
    "usemtl a\ns 1\nf 1//1 2//1 3//1 \\\n4//1\nusemtl b c\nf -4/1 -3/-1 -2/1\nf 1/1/1 2/1/1 3/1/1\nl 1 2\n";
const std::string kJson =
    "{ \"schema\": \"pathlight.scene/1\", \"name\": \"S\", \"obj\": \"s.obj\",\n"
    "  \"camera\": { \"eye\": [0, 0, 5], \"target\": [0.5, 0, 0], \"up\": [0, 1, 0], \"fov_deg\": 40.5,\n"
    "    \"aperture_radius\": 0.1, \"focus_distance\": 1 },\n"
    "  \"environment\": { \"radiance\": [0.1, 0, 1e-3],\n"
    "    \"sun\": { \"direction\": [0, 1, 0.5], \"radiance\": [9, 8, 7], \"angle_deg\": 0.5 } },\n"
    "  \"materials\": { \"g\": { \"surface\": \"plastic\", \"roughness\": 0.5, \"ior\": 1.3, \"albedo_map\": "
    "\"q.png\",\n"
    "      \"wrap\": \"clamp\" }, \"b c\": { \"albedo\": [0.5, 0.5, 0.5], \"two_sided_emission\": false } },\n"
    "  \"settings\": { \"spp\": 16, \"nee\": true, \"method\": \"default\" } }\n";

/// The three files above in a folder; one of them replaced.
class SmallScene {
public:
    SmallScene() {
        for (const auto& [name, text] : {std::pair{"s.obj", kObj}, {"s.mtl", kMtl}, {"s.json", kJson}}) {
            folder_.write(name, text);
        }
    }
    bool try_with(const std::string& name, const std::string& text) const {
        folder_.write(name, text);
        return loads_or_refuses([&] { load_scene((folder_.path() / "s.json").string(), folder_.path()); });
    }

private:
    TemporaryFolder folder_;
};

std::string load_text(const std::string& text) {
    const TemporaryFolder folder;
    const std::string path = folder.write("bad.obj", text).string();
    return input_error([&] { load_scene(path, folder.path()); });
}

struct Loaded {
    std::string told;  ///< all warnings
    std::size_t triangles = 0;
};

Loaded load_with_warnings(const std::string& text) {
    const TemporaryFolder folder;
    const SceneDescription scene = load_scene(folder.write("bad.obj", text).string(), folder.path());
    Loaded loaded{.told = {}, .triangles = scene.triangles.size()};
    for (const std::string& warning : scene.warnings) loaded.told += warning + "\n";
    return loaded;
}

}  // namespace

TEST_CASE("Files truncated at every byte load or are refused") {
    const auto [name, text] =
        GENERATE(table<std::string, std::string>({{"s.obj", kObj}, {"s.mtl", kMtl}, {"s.json", kJson}}));
    const SmallScene scene;
    REQUIRE(scene.try_with(name, text));
    std::size_t loaded = 0;
    for (std::size_t size = 0; size < text.size(); ++size) {
        INFO(name << " cut to " << size << " bytes");
        loaded += scene.try_with(name, text.substr(0, size)) ? 1 : 0;
    }
    if (name == "s.json") {
        CHECK(loaded == 1);  // only the last end of line may be missing
    } else {
        CHECK(loaded > 0);
        CHECK(loaded < text.size());
    }
}

TEST_CASE("Files with random damage load or are refused") {
    const auto [name, text] =
        GENERATE(table<std::string, std::string>({{"s.obj", kObj}, {"s.mtl", kMtl}, {"s.json", kJson}}));
    const SmallScene scene;
    std::mt19937 random(20240501);
    const std::string alphabet = "0123456789-+.eE/ \t\n\r#\\fvnusemtl\"{}[],:\x80\xff";
    std::size_t loaded = 0;
    constexpr int kTrials = 600;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::string damaged = text;
        for (auto edits = 1 + random() % 3; edits > 0; --edits) {
            const std::size_t at = random() % damaged.size();
            const char letter = alphabet[random() % alphabet.size()];
            switch (random() % 3) {
            case 0: damaged[at] = letter; break;
            case 1: damaged.insert(at, 1 + random() % 12, letter); break;
            default: damaged.erase(at, 1 + random() % 20);
            }
        }
        INFO(name << ":\n" << damaged);
        loaded += scene.try_with(name, damaged) ? 1 : 0;
    }
    CHECK(loaded < kTrials);
}

TEST_CASE("A face with an index that is none is left out, or shown without normals and texture, with file and line") {
    struct Case {
        std::string corner;
        std::string told;
        bool is_shown;
    };
    const Case sample = GENERATE(
        Case{"0", "vertex index 0, indices start at 1", false},
        Case{"4", "vertex index 4 is out of range, the file has 3", false},
        Case{"-4", "vertex index -4 is out of range, 3 precede the face", false},
        Case{"2147483646", "vertex index 2147483646 is out", false},
        Case{"2147483647", "vertex index 2147483647 is out", false},
        Case{"2147483648", "vertex index 2147483648 is out", false}, Case{"-2147483649", "-2147483649 is out", false},
        Case{"4294967297", "vertex index 4294967297 is out", false},
        Case{"99999999999", "vertex index 99999999999 is out", false},
        Case{"99999999999999999999999", "is not an index of a vertex", false},
        Case{"1.5", "'1.5' is not an index", false}, Case{"x", "'x' is not an index", false},
        Case{"+-1", "'+-1' is not an index", false}, Case{"/1", "expected a face corner", false},
        Case{"0x1", "'0x1' is not an index", false}, Case{"1//0", "normal index 0", true},
        Case{"1//2", "normal index 2 is out of range, the file has 1", true},
        Case{"1//-2", "normal index -2 is out", true},
        Case{"1/1", "texture point index 1 is out of range, the file has 0", true},
        Case{"1/99999999999/1", "texture point index 99999999999", true},
        Case{"1/1/1/1", "'1/1' is not an index of a normal", true});
    INFO(sample.corner);
    const Loaded loaded = load_with_warnings("# three\n\n" + kThreeVertices + "vn 0 0 1\nf 1 2 3\nf 3 2 \\\n" +
                                             sample.corner + "\nf 1 2 3\n");
    CHECK_THAT(loaded.told,
               contains("bad.obj:8: ") && contains(sample.told) &&
                   contains(sample.is_shown ? ": this face is shown without its normals or texture points (1 in all)"
                                            : ": this face is left out (1 in all)"));
    CHECK(loaded.triangles == (sample.is_shown ? 3 : 2));
    CHECK_THAT(load_text(kThreeVertices + "f 1 2 4\n"),
               contains("bad.obj: no faces") && contains("bad.obj:4: vertex index 4"));
}

TEST_CASE("The first index that points past the last vertex is named") {
    const Loaded loaded = load_with_warnings("f 1 2 3\nf 1 2 9\nf 1 2 7\nf 3 2 4\n" + kThreeVertices);
    CHECK_THAT(loaded.told, contains("bad.obj:2: vertex index 9") && contains("this face is left out (3 in all)"));
    CHECK(loaded.triangles == 1);
}

TEST_CASE("A corner may end with slashes without an index") {
    const std::string face =
        GENERATE(as<std::string>{}, "f 1// 2// 3//", "f 1/ 2/ 3/", "f 1/1/ 2/1/ 3/1/", "f 1//1 2// 3/1/");
    INFO(face);
    const Loaded loaded = load_with_warnings(kThreeVertices + "vt 0 0\nvn 0 0 1\n" + face + "\n");
    CHECK(loaded.triangles == 1);
    CHECK_THAT(loaded.told, !contains("left out"));
}

TEST_CASE("Numbers that are none leave out their element and the faces that use it, with file and line") {
    const std::string word =
        GENERATE(as<std::string>{}, "nan", "NaN", "-nan", "inf", "-infinity", "1e400", "-1e39", "1,5", "0x10", "1e",
                 "+-1", "--1", "1.2.3", "abc", "1e18000000000000000000000", "2e18", "1;", "'1'");
    INFO(word);
    const std::string keyword = GENERATE("v", "vn", "vt");
    const Loaded loaded = load_with_warnings(kThreeVertices + "\r\n" + keyword + " 0 " + word +
                                             " 0\nf 1 2 3\nf 1 4 2\nf 1//1 2//1 3//1\nf 1/1 2/1 3/1\n");
    CHECK_THAT(loaded.told, contains("bad.obj:5: '" + keyword + "'") && contains("got '" + word + "': this ") &&
                                contains("is left out (1 in all)"));
    CHECK(loaded.triangles == 3);
}

TEST_CASE("Vertices with too few numbers are refused") {
    CHECK_THAT(load_text("v 1 2\n"), contains("bad.obj:1: 'v': expected 3 numbers, got 2"));
    CHECK_THAT(load_text("v 1 2 3\nvn\n"), contains("bad.obj:2: 'vn': expected 3 numbers, got 0"));
}

TEST_CASE("Numbers of many digits keep their value") {
    const TemporaryFolder folder;
    const std::string zeros(400, '0');
    const std::string text = "v 1" + zeros + "e-400 0." + zeros + "1 0" + zeros + "2\nv 5 0 0\nv 0 5 0\nf 1 2 3\n";
    const SceneDescription scene = load_scene(folder.write("s.obj", text).string(), folder.path());
    CHECK(scene.positions[0] == glm::vec3(1.0f, 0.0f, 2.0f));
}

TEST_CASE("Files without faces are refused") {
    const std::string text =
        GENERATE(as<std::string>{}, "", "\n", "# nothing\n", "\xEF\xBB\xBF", "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
                 "v 0 0 0\nv 1 0 0\nf 1 2\n", "some other text\n");
    CHECK_THAT(load_text(text), contains("bad.obj: no faces"));
}

TEST_CASE("Files whose faces have no area are refused") {
    CHECK_THAT(load_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n"), contains("bad.obj: no face has an area"));
}

TEST_CASE("Binary files are refused at their first control character") {
    using namespace std::string_literals;
    CHECK_THAT(load_text(kThreeVertices + "f 1 2 3\n\0\n"s), contains("bad.obj:5: control character 0x00"));
    CHECK_THAT(load_text("\x7f"
                         "ELF\x02\x01"),
               contains("bad.obj:1: control character 0x7f"));
}

TEST_CASE("Large faces are triangulated, larger ones refused") {
    std::string face = "f";
    for (int i = 0; i < 65537; ++i) {
        face += " 1";
    }
    CHECK_THAT(load_text(kThreeVertices + face), contains("bad.obj:4: a face with 65537 corners"));
}

TEST_CASE("Missing files and folders in place of files are named") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "dir.obj");
    std::filesystem::create_directories(folder.path() / "dir.json");
    const auto message = [&](const std::string& name) {
        return input_error([&] { load_scene((folder.path() / name).string(), folder.path()); });
    };
    CHECK_THAT(message("gone.obj"), contains("gone.obj: cannot be read: no such file"));
    CHECK_THAT(message("gone.json"), contains("gone.json: cannot be read: no such file"));
    CHECK_THAT(message("dir.obj"), contains("dir.obj: cannot be read: it is a directory"));
    CHECK_THAT(message("dir.json"), contains("dir.json: cannot be read: it is a directory"));
    CHECK_THAT(
        message("."),
        contains("expected an .obj, .gltf, .glb or Mitsuba .xml file, a scene .json file or the name of a scene"));
    CHECK_THAT(input_error([&] { load_scene("/dev/null", folder.path()); }), contains("/dev/null: expected an .obj"));
}

TEST_CASE("Material libraries outside of the scene's folder are not read, but one of their name in it is") {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl m\nKd 1 0 0\n");
    const std::string library = GENERATE(as<std::string>{}, "../m.mtl", "/etc/passwd", "sub/../../m.mtl",
                                         "n.mtl ../m.mtl", "C:\\m.mtl", "\"..\\m.mtl\"");
    INFO(library);
    const std::string text = "mtllib " + library + "\nusemtl m\n" + kThreeVertices + "f 1 2 3\n";
    const auto load = [&](const std::string& name) {
        const SceneDescription scene = load_scene(folder.write(name, text).string(), folder.path());
        CHECK(scene.triangles.size() == 1);
        std::string told;
        for (const std::string& warning : scene.warnings) told += warning + "\n";
        return std::pair(scene.materials.at(scene.triangles[0].material).name, told);
    };
    const auto [outside, told] = load("sub/s.obj");
    CHECK(outside == "default");
    CHECK_THAT(told, contains("s.obj:1: material file") && contains("is outside of the scene's folder"));
    const auto [inside, told_inside] = load("s.obj");
    CHECK(inside == (library == "/etc/passwd" ? "default" : "m"));
    CHECK_THAT(told_inside, contains("s.obj:1: material file"));
}

TEST_CASE("A material library that is no text is told, and the scene shown") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "d.mtl");
    folder.write("b.mtl", "newmtl a\x01");
    const auto told = [&](const std::string& library) {
        const std::string text = "mtllib " + library + "\n" + kThreeVertices + "f 1 2 3\n";
        return load_scene(folder.write("s.obj", text).string(), folder.path()).warnings.at(0);
    };
    CHECK_THAT(told("d.mtl"), contains("material file 'd.mtl' not found; 1 faces are shown in the default color"));
    CHECK_THAT(told("b.mtl"), contains("b.mtl:1: control character 0x01") && contains("; 1 faces are shown"));
}
