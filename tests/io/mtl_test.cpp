// MTL files: values, their limits, and what is left out.
#include "core/io/mtl.h"

#include "tests/catch.hpp"
#include "tests/io/input_error.h"
#include "tests/io/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::input_error;
using pl::test::TemporaryFolder;

namespace {

struct Loaded {
    std::vector<MaterialDescription> materials;
    std::vector<std::string> warnings;
};

Loaded load(const std::string& text) {
    const TemporaryFolder folder;
    Loaded result;
    result.materials = load_mtl(folder.write("m.mtl", text), result.warnings);
    return result;
}

}  // namespace

TEST_CASE("Reflectance and emission, in the order of the file") {
    const Loaded loaded = load("\xEF\xBB\xBF# colors\r\nnewmtl b\r\n\tKd 0.1 0.2 0.3\r\nKe 1e1 .5 "
                               "3\r\nnewmtl a\r\nKd 0.25 # gray\r\n");
    REQUIRE(loaded.materials.size() == 2);
    CHECK(loaded.warnings.empty());
    CHECK(loaded.materials[0].name == "b");
    CHECK(loaded.materials[0].albedo == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(loaded.materials[0].emission == glm::vec3(10.0f, 0.5f, 3.0f));
    CHECK(loaded.materials[1].albedo == glm::vec3(0.25f));
    CHECK(loaded.materials[1].emission == glm::vec3(0.0f));
}

TEST_CASE("Reflectance above 1 is clamped with a warning") {
    const Loaded loaded = load("newmtl a\nKd 1.5 1 0.5\n");
    CHECK(loaded.materials[0].albedo == glm::vec3(1.0f, 1.0f, 0.5f));
    REQUIRE(loaded.warnings.size() == 1);
    CHECK_THAT(loaded.warnings[0], contains("m.mtl:2: reflectance above 1"));
}

TEST_CASE("Only the light that reflects nothing is black") {
    const Loaded loaded = load("newmtl lamp\nKe 5 5 5\nnewmtl nothing\nNs 10\n");
    CHECK(loaded.materials[0].albedo == glm::vec3(0.0f));
    CHECK(loaded.materials[1].albedo == kDefaultAlbedo);
    REQUIRE(loaded.warnings.size() == 1);
    CHECK_THAT(loaded.warnings[0], contains("'nothing' has neither Kd nor Ke"));
}

TEST_CASE("Of two materials with one name the first counts") {
    const Loaded loaded =
        load("newmtl a\nKd 0.1 0.1 0.1\nnewmtl a\nKd 0.9 0.9 0.9\nPl_two_sided 1\nnewmtl b\nKd 0.5\n");
    REQUIRE(loaded.materials.size() == 2);
    CHECK(loaded.materials[0].albedo == glm::vec3(0.1f));
    CHECK_FALSE(loaded.materials[0].two_sided_emission);
    CHECK(loaded.materials[1].albedo == glm::vec3(0.5f));
    REQUIRE(loaded.warnings.size() == 1);
    CHECK_THAT(loaded.warnings[0], contains("m.mtl:3: material 'a'"));
}

TEST_CASE("What changes the picture but is not supported is told once, the rest is silent") {
    const Loaded loaded = load("newmtl a\nKd 0.5 0.5 0.5\nKs 1 1 1\nNs 1e9\nNi -1\nillum 2\nd 0.5\nTr "
                               "0\nmap_Kd wood.png\nmap_Kd b.png\nbump c.png\n"
                               "newmtl b\nKd 0.5 0.5 0.5\nd 1\n");
    REQUIRE(loaded.warnings.size() == 1);
    CHECK_THAT(loaded.warnings[0], contains("bump, d, map_Kd"));
    CHECK(load("newmtl a\nKd 0.5 0.5 0.5\nKs 1 1 1\nNs 10\nd 1\nTr 0\nillum 2\n").warnings.empty());
}

TEST_CASE("Values that are wrong are refused with file and line") {
    struct Case {
        std::string line;
        std::string told;
    };
    const Case sample = GENERATE(
        Case{"Kd -0.1 0 0", "at least 0, got '-0.1'"}, Case{"Kd nan 0 0", "got 'nan'"},
        Case{"Kd 0 inf 0", "got 'inf'"}, Case{"Ke 0 0 -3", "got '-3'"}, Case{"Ke 1e39 0 0", "got '1e39'"},
        Case{"Ke 1e400 0 0", "got '1e400'"}, Case{"Kd 1,5 0 0", "got '1,5'"}, Case{"Kd 0x1 0 0", "got '0x1'"},
        Case{"Kd 0.5 0.5", "got 2 words"}, Case{"Kd", "got 0 words"}, Case{"Kd spectral file.rfl", "got 2 words"},
        Case{"Pl_two_sided yes", "expected 0 or 1"}, Case{"newmtl", "expected a name"});
    INFO(sample.line);
    CHECK_THAT(input_error([&] { load("newmtl a\n\n" + sample.line + "\n"); }),
               contains("m.mtl:3: ") && contains(sample.told));
}

TEST_CASE("A color before any material is refused") {
    CHECK_THAT(input_error([] { load("Kd 1 1 1\n"); }), contains("m.mtl:1: 'Kd' before any 'newmtl'"));
}
