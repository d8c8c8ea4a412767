// Files are read and written in the same way in every locale.
#include <clocale>
#include <cstring>
#include <locale>

#include "core/io/files.h"
#include "core/io/image.h"
#include "core/io/load_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::TemporaryFolder;

namespace {

/// "1.234,5"
class CommaPunctuation : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

/// A scene and a picture, read and written, byte by byte.
std::string outcome() {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl a\nKd 0.125 0.3 0.7\nKe 1.5 2500.25 0\n");
    folder.write("s.obj", "mtllib m.mtl\nv 0.1 -1234.5 1e-3\nv 1.75 0 0\nv 0 2.125 0\nvn 0.6 0.8 0\nusemtl "
                          "a\nf 1//1 2//1 3//1\n");
    const std::string json =
        "{\"schema\": \"pathlight.scene/1\", \"obj\": \"s.obj\", \"camera\": {\"eye\": [0.5, 1.25, 3000.75],"
        "\"fov_deg\": 33.3}, \"settings\": {\"exposure\": 0.5, \"spp\": 4096}}";
    const SceneDescription scene = load_scene(folder.write("s.json", json).string(), folder.path());
    std::string result;
    const auto add = [&](const glm::vec3& v) { result.append(reinterpret_cast<const char*>(&v), sizeof(v)); };
    for (const glm::vec3& p : scene.positions) {
        add(p);
    }
    add(scene.normals.at(0));
    add(scene.materials.at(0).albedo);
    add(scene.materials.at(0).emission);
    add(scene.camera.eye);
    add(glm::vec3(scene.camera.fov_deg));
    for (const auto& [name, value] : scene.settings) {
        result += name + "=" + value + "\n";
    }
    const LinearImage image{.width = 1200, .height = 1, .pixels = std::vector<glm::vec3>(1200, glm::vec3(0.5f))};
    write_pfm(folder.path() / "a.pfm", image);
    write_exr(folder.path() / "a.exr", image, {{"x", "1.5"}});
    return result + read_file(folder.path() / "a.pfm") + read_file(folder.path() / "a.exr");
}

}  // namespace

TEST_CASE("A locale of C++ with decimal commas changes nothing") {
    const std::string expected = outcome();
    const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaPunctuation));
    const std::string got = outcome();
    std::locale::global(before);
    const bool same = got == expected;  // bytes: not to be printed
    CHECK(same);
}

TEST_CASE("A locale of C with decimal commas changes nothing") {
    const std::string expected = outcome();
    const std::string before = std::setlocale(LC_ALL, nullptr);
    bool found = false;
    for (const char* name :
         {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "fr_FR.utf8", "es_ES.UTF-8", "it_IT.UTF-8"}) {
        found = found || std::setlocale(LC_ALL, name) != nullptr;
    }
    if (!found || *std::localeconv()->decimal_point != ',') {
        std::setlocale(LC_ALL, before.c_str());
        WARN("no locale with decimal commas is installed: not tested");
        return;
    }
    const std::string got = outcome();
    std::setlocale(LC_ALL, before.c_str());
    const bool same = got == expected;  // bytes: not to be printed
    CHECK(same);
}
