// The parallel reader of simple OBJ texts against the checked reading by the OBJ library: the same to the bit, or none.
#include "core/io/obj_simple.h"

#include <algorithm>
#include <array>
#include <bit>
#include <random>

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/obj.h"
#include "core/io/obj_library.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/bumpy_ball.h"
#include "tests/support/scenes/obj_difference.h"

using namespace pl;

namespace {

namespace fs = std::filesystem;

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

/// Checks the reading by several threads and sizes of chunks; false if the text is not simple for any of them.
bool check_same(const std::string& text) {
    const std::optional<ObjMesh> simple = read_simple_obj(text, 1);
    for (const std::size_t bytes : {std::size_t{1}, std::size_t{7}, std::size_t{64}, std::size_t{1000}, kObjChunk}) {
        // The smallest chunks make one of each line.
        if (text.size() / bytes > 20000) continue;
        const std::optional<ObjMesh> parts = read_simple_obj(text, 3, bytes);
        REQUIRE(parts.has_value() == simple.has_value());
        if (parts) CHECK(test::obj_difference(*parts, *simple).empty());
    }
    if (!simple) return false;
    CHECK(test::obj_difference(*simple, read_any_obj(text, "s.obj")).empty());
    const glm::dvec3 origin(391240.0, -0.125, 1e9);
    const std::optional<ObjMesh> moved = read_simple_obj(text, 2, kObjChunk, origin);
    REQUIRE(moved);
    CHECK(test::obj_difference(*moved, read_any_obj(text, "s.obj", origin)).empty());
    return true;
}

std::vector<fs::path> obj_files() {
    std::vector<fs::path> files;
    for (const fs::path& root :
         {fs::path(PL_SOURCE_DIR) / "assets", fs::path(PL_SOURCE_DIR) / ".." / "shared/scenes"}) {
        std::error_code ignored;
        for (const auto& entry : fs::recursive_directory_iterator(root, ignored))
            if (entry.path().extension() == ".obj") files.push_back(entry.path());
    }
    return files;
}

/// Statements in forms that occur in files and in some that do not.
class RandomObj {
public:
    explicit RandomObj(std::uint32_t seed) : random_(seed) {}

    /// `odds`: of 1000 lines, how many are of a form that is not simple.
    std::string text(int lines, int odds) {
        std::string text;
        for (int i = 0; i < lines; ++i) {
            text += below(1000) < odds ? odd_line() : line();
            text += below(4) == 0 ? "\r\n" : "\n";
        }
        text += kTriangle + "f 1 2 3";
        return below(2) == 0 ? text : text + "\n";
    }

private:
    int below(int n) { return static_cast<int>(random_() % static_cast<std::uint32_t>(n)); }
    template <std::size_t n>
    std::string one_of(const char* const (&words)[n]) {
        return words[below(static_cast<int>(n))];
    }
    std::string blank() { return one_of({" ", " ", " ", "\t", "  ", " \t "}); }
    std::string indent() { return one_of({"", "", "", " ", "\t"}); }

    std::string number() {
        const auto bits = static_cast<std::uint32_t>(random_());
        const double value = std::ldexp(static_cast<double>(bits) - 2147483648.0, below(40) - 50);
        switch (below(8)) {
        case 0: return one_of({"0", "-0", "1", "-1", "0.5", ".25", "3.", "1e3", "1E-2", "2.5e+2", "-.5e1", "00012"});
        case 1: return fmt::format("{:.9g}", value);
        case 2: return fmt::format("{:.17g}", value);
        case 3: return fmt::format("{:.30f}", value);
        case 4: return fmt::format("{}", below(1000));
        // Halfway between two floats, in full.
        case 5:
            return fmt::format("{:.60g}",
                               std::ldexp(2.0 * static_cast<double>(bits >> 8 | 0x800000u) + 1.0, below(40) - 40));
        default: return fmt::format("{:.6f}", value);
        }
    }

    std::string numbers(const std::string& keyword, int count) {
        std::string line = indent() + keyword;
        for (int i = 0; i < count; ++i) line += blank() + number();
        return line + one_of({"", "", " ", "\t"});
    }

    /// An index of an element that is there; the ends of the text give the first three vertices of all kinds.
    std::string index(int count) {
        if (count > 0 && below(2) == 0) return fmt::format("-{}", 1 + below(count));
        return fmt::format("{}", 1 + below(std::max(count, 3)));
    }

    std::string face() {
        std::string line = indent() + "f";
        const int corners = below(3) > 0 ? 3 : 3 + below(5);
        const bool has_uvs = uvs_ > 3 && below(2) == 0;
        const bool has_normals = normals_ > 3 && below(2) == 0;
        for (int i = 0; i < corners; ++i) {
            line += blank() + index(vertices_);
            if (has_uvs) (line += '/') += index(uvs_);
            if (has_normals) (line += has_uvs ? "/" : "//") += index(normals_);
        }
        return line + one_of({"", "", " "});
    }

    std::string name() { return one_of({"a", "b", "my  red", "c\td", "\xE4#1", "", " padded ", "a#b", "e \\ f"}); }

    std::string line() {
        switch (below(14)) {
        case 0: return indent() + one_of({"# comment", "#", "#v 1 2 3", "# ends so \\", ""});
        case 1: return indent() + one_of({"usemtl ", "usemtl\t", "g ", "o "}) + name();
        case 2: return one_of({"s 1", "s off", "l 1 2", "p 1", "vp 0.1", "mg 1 2"});
        case 3: return std::string("mtllib ").append(name());
        case 4: ++normals_; return numbers("vn", 3);
        case 5: ++uvs_; return numbers("vt", 1 + below(3));
        case 6:
        case 7:
        case 8:
        case 9: ++vertices_; return numbers("v", 3);
        default: return face();
        }
    }

    std::string odd_line() {
        ++odd_;
        return one_of({"v 1 2",
                       "v 1 2 3 4",
                       "v 1 2 3 0.5 0.5 0.5",
                       "v 1 +2 3",
                       "v 1 2 3 # c",
                       "v 1 2 nan",
                       "v 1 inf 3",
                       "v 1e400 2 3",
                       "v 1e-400 2 3",
                       "v 2e18 0 0",
                       "v 1 2 \\\n3",
                       "v 1 2 3x",
                       "v 0x1 2 3",
                       "vn 1 2",
                       "vt",
                       "vt 1 2 3 4",
                       "f 1 2",
                       "f 1",
                       "f",
                       "f 1 2 0",
                       "f 1 2 3/",
                       "f 1// 2// 3//",
                       "f 1 2 99999999",
                       "f 1 2 -99999999",
                       "f 1 2 4294967299",
                       "f +1 2 3",
                       "f 1 2 3 # c",
                       "f 1/1/1/1 2 3",
                       "f 1 2 \\\n3",
                       "f 1/ 2 3",
                       "f a b c",
                       "curv 1 2",
                       "usemtl a\\\nb",
                       "usemtl a\rg b",
                       "g a\x01",
                       "# a\x7f",
                       "s 1 \\",
                       "v",
                       "vnn 1 2 3",
                       "\\",
                       "usemtl x \\ ",
                       "v 1 2 3\r",
                       "\xEF\xBB\xBF"});
    }

    std::mt19937 random_;
    int vertices_ = 0;
    int normals_ = 0;
    int uvs_ = 0;
    int odd_ = 0;
};

}  // namespace

TEST_CASE("Every OBJ file at hand is read in parallel as by the library") {
    const std::vector<fs::path> files = obj_files();
    CHECK(files.size() >= 20);
    for (const fs::path& path : files) {
        INFO(path);
        CHECK(check_same(read_text_file(path)));
    }
}

TEST_CASE("A model of ten thousand triangles is read in parallel as by the library") {
    const test::TemporaryFolder folder;
    CHECK(check_same(read_text_file(test::write_bumpy_ball(folder.path(), 51))));
}

TEST_CASE("Random simple texts are read in parallel as by the library") {
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        INFO(seed);
        const std::string text = RandomObj(seed).text(300, 0);
        INFO(text);
        CHECK(check_same(text));
    }
}

TEST_CASE("Texts with odd statements are read in parallel as by the library, or not at all") {
    int simple = 0;
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
        INFO(seed);
        const std::string text = RandomObj(seed).text(40, 25);
        INFO(text);
        try {
            simple += check_same(text) ? 1 : 0;
        } catch (const std::runtime_error& error) {
            FAIL(error.what());
        }
    }
    CHECK(simple > 100);
    CHECK(simple < 900);
}

TEST_CASE("What needs a message is left to the library's reader") {
    const std::string line = GENERATE(
        as<std::string>{}, "v 1 2", "v 1 2 3 1", "v 1 2 nan", "v 1 2 1e19", "v 1 2 1e-400", "vn 1 2", "vt", "f 1 2",
        "f 1 2 4", "f 1 2 -4", "f 1 2 0", "f 1 2 3/", "f 1/1 2 3", "f 1//1 2 3", "f 1 2 2147483648", "bevel on",
        "usemtl a\\", "g \x01", "# \x7f", "v 1 2 +3", "f 1 2 3 # c", "\r\r", "usemtl a\rf 1 2 3");
    INFO(line);
    CHECK_FALSE(read_simple_obj(kTriangle + line + "\nf 1 2 3\n", 1));
    CHECK_FALSE(read_simple_obj(kTriangle + "f 1 2 3\n" + line + "\n", 2, 8));
}

TEST_CASE("Texts without faces are not simple") {
    for (const std::string text : {"", "\n", "# nothing", "v 0 0 0\n"}) CHECK_FALSE(read_simple_obj(text, 2));
}

// Long decimals next to the middle of two floats, which the library alone rounds the wrong way.
TEST_CASE("Coordinates are rounded correctly, whichever reader takes them") {
    std::mt19937 random(7);
    std::string simple;
    std::vector<float> expected;
    for (int i = 0; i < 3000; ++i) {
        const auto bits = static_cast<std::uint32_t>(0x20000000u + random() % 0x38000000u);
        const auto low = std::bit_cast<float>(bits);
        const float high = std::bit_cast<float>(bits + 1u);
        const double middle = 0.5 * static_cast<double>(low) + 0.5 * static_cast<double>(high);
        const bool is_above = random() % 2 == 0;
        const double value = std::nextafter(middle, is_above ? 2.0 * middle : 0.0);
        simple += (i % 3 == 0 ? "\nv " : " ") + fmt::format("{:.17g}", value);
        expected.push_back(is_above ? high : low);
    }
    simple += "\n" + kTriangle + "f -3 -2 -1\n";
    const std::string odd = "# continued\ns 1 \\\n\n" + simple;
    REQUIRE(read_simple_obj(simple, 2));
    REQUIRE_FALSE(read_simple_obj(odd, 2));
    for (const ObjMesh& mesh : {*read_simple_obj(simple, 2), read_any_obj(odd, "s.obj")}) {
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            wrong += mesh.positions[i / 3][static_cast<int>(i % 3)] != expected[i] ? 1 : 0;
        CHECK(wrong == 0);
    }
}
