// The reader of OBJ text: the same to the bit for any number of threads and size of chunks, and however a line is written.
#include "core/io/obj_mesh.h"

#include <algorithm>
#include <bit>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "tests/core/io/obj_text.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/bumpy_ball.h"
#include "tests/support/scenes/obj_difference.h"

using namespace pl;
using pl::test::kThreeVertices;

namespace {

namespace fs = std::filesystem;

struct Reading {
    ObjMesh mesh{};
    std::string refusal{};
};

Reading read(const std::string& text, int threads = 1, std::size_t chunk_bytes = kObjChunk,
             const glm::dvec3& origin = glm::dvec3(0.0)) {
    try {
        return {.mesh = read_obj_text(text, "s.obj", threads, origin, chunk_bytes)};
    } catch (const Error& error) {
        REQUIRE(error.kind() == ErrorKind::Input);
        return {.refusal = error.what()};
    }
}

const glm::dvec3 kFar(391240.0, -0.125, 1e9);

/// Checks the reading by several threads and sizes of chunks; returns the reading of the whole text.
Reading check_same(const std::string& text) {
    Reading whole = read(text);
    const Reading moved = read(text, 1, kObjChunk, kFar);
    for (const std::size_t bytes : {std::size_t{1}, std::size_t{7}, std::size_t{64}, std::size_t{1000}, kObjChunk}) {
        // The smallest chunks make one of each line.
        if (text.size() / bytes > 20000) continue;
        INFO(bytes << " bytes a chunk");
        const Reading parts = read(text, 3, bytes);
        CHECK(parts.refusal == whole.refusal);
        CHECK(test::obj_difference(parts.mesh, whole.mesh).empty());
        CHECK(test::obj_difference(read(text, 2, bytes, kFar).mesh, moved.mesh).empty());
    }
    return whole;
}

/// The numbers of elements and faces get zeros in front, too many digits for the quick ways, and their lines a comment.
std::string in_odd_words(const std::string& text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
    const auto is_end = [](char c) { return c == '\r' || c == '\n'; };
    std::string result;
    bool has_numbers = false;
    char before = '\n';
    char last = '\n';
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (is_end(last)) {
            const std::size_t first = std::min(text.find_first_not_of(" \t", i), text.size() - 1);
            has_numbers = text[first] == 'v' || text[first] == 'f';
        }
        const bool is_first = is_blank(last) || last == '/' || (last == '-' && (is_blank(before) || before == '/'));
        if (has_numbers && is_first && (c == '.' || (c >= '0' && c <= '9'))) result += "0000000000000000";
        if (has_numbers && is_end(c) && !is_end(last)) result += " # c";
        result += c;
        before = last;
        last = c;
    }
    return result;
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

    /// `odds`: of 1000 lines, how many have something to correct or to report.
    std::string text(int lines, int odds) {
        std::string text;
        for (int i = 0; i < lines; ++i) {
            text += below(1000) < odds ? odd_line() : line();
            text += below(4) == 0 ? "\r\n" : "\n";
        }
        text += kThreeVertices + "f 1 2 3";
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

TEST_CASE(
    "Every OBJ file at hand is read without warnings, in chunks as at once, in odd words as by the quick ways") {
    const std::vector<fs::path> files = obj_files();
    CHECK(files.size() >= 20);
    for (const fs::path& path : files) {
        INFO(path);
        const std::string text = read_text_file(path);
        const Reading reading = check_same(text);
        CHECK(reading.refusal.empty());
        CHECK(reading.mesh.warnings.empty());
        CHECK(test::obj_difference(read(in_odd_words(text), 2).mesh, reading.mesh).empty());
    }
}

TEST_CASE("A model of ten thousand triangles is read in chunks as at once") {
    const test::TemporaryFolder folder;
    CHECK(check_same(read_text_file(test::write_bumpy_ball(folder.path(), 51))).mesh.warnings.empty());
}

TEST_CASE("Random texts are read in chunks as at once, in odd words as by the quick ways") {
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        INFO(seed);
        const std::string text = RandomObj(seed).text(300, 0);
        INFO(text);
        const Reading reading = check_same(text);
        CHECK(reading.refusal.empty());
        CHECK(reading.mesh.warnings.empty());
        const std::string odd = in_odd_words(text);
        CHECK(test::obj_difference(read(odd).mesh, reading.mesh).empty());
        CHECK(test::obj_difference(read(odd, 1, kObjChunk, kFar).mesh, read(text, 1, kObjChunk, kFar).mesh).empty());
    }
}

TEST_CASE("Texts with faults are read in chunks as at once, with the same warnings and the same refusals") {
    int plain = 0;
    int warned = 0;
    int refused = 0;
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
        INFO(seed);
        const std::string text = RandomObj(seed).text(40, 25);
        INFO(text);
        const Reading reading = check_same(text);
        ++(!reading.refusal.empty() ? refused : reading.mesh.warnings.empty() ? plain : warned);
    }
    CHECK(plain > 100);
    CHECK(warned > 100);
    CHECK(refused > 10);
}

TEST_CASE("A line means the same in all its forms") {
    struct Case {
        std::string odd;
        std::string plain;
    };
    const Case sample = GENERATE(
        Case{"v 1 +2 3", "v 1 2 3"}, Case{"v 1 2 1e-400", "v 1 2 0"}, Case{"v 1 2 3 # c", "v 1 2 3"},
        Case{"v 1 \\\n2 \\\r\n3", "v 1 2 3\n\n"}, Case{"\\\nv 1 2 3", "v 1 2 3\n"}, Case{"f +1 2 3", "f 1 2 3"},
        Case{"f 1// 2/ 3", "f 1 2 3"}, Case{"f 1/1/ 2/1/ 3/1/", "f 1/1 2/1 3/1"}, Case{"vt 1 2 x", "vt 1 2"},
        Case{"f 1 2 3 #4", "f 1 2 3"}, Case{"usemtl a\rg b\r\r", "usemtl a\ng b\n"}, Case{"s 1 \\\n", "s 1\n"},
        Case{"# c \\", "#"}, Case{"usemtl \"a  b\" # c", "usemtl a  b"}, Case{"usemtl a\tb", "usemtl a b"});
    INFO(sample.odd);
    const auto around = [](const std::string& line) { return kThreeVertices + "vt 0 0\n" + line + "\nf 1 2 3\n"; };
    const Reading odd = check_same(around(sample.odd));
    CHECK(odd.mesh.warnings.empty());
    CHECK(test::obj_difference(odd.mesh, read(around(sample.plain)).mesh).empty());
}

TEST_CASE("A fault is told by the words of the face that has it") {
    const Reading reading = check_same(kThreeVertices + "vn 0 0 1\nf 9 2 3//x\nf 1//y 2 3\nf 1 2 3//1\n");
    CHECK(
        reading.mesh.warnings ==
        std::vector<std::string>{
            "s.obj:5: vertex index 9 is out of range, the file has 3: this face is left out (1 in all)",
            "s.obj:6: face corner '1//y': 'y' is not an index of a normal: this face is shown without its normals or "
            "texture points (1 in all)"});
}

TEST_CASE("Elements that a later chunk leaves out are missing to the faces before") {
    const Reading reading =
        check_same("f 1 2 3\nf 4 2 3\nf 1 2 3//1\nf 5 2 3\n" + kThreeVertices + "v 1 nan 0\nvn 0\n");
    CHECK(reading.mesh.warnings ==
          std::vector<std::string>{
              "s.obj:8: 'v': expected finite numbers up to 1e18, got 'nan': this vertex is left out (1 in all)",
              "s.obj:9: 'vn': expected 3 numbers, got 1: this normal is left out (1 in all)",
              "s.obj:2: vertex 4 is left out: this face is left out (2 in all)",
              "s.obj:3: normal 1 is left out: this face is shown without its normals or texture points (1 in all)"});
}

TEST_CASE("The first control character of a text is told, in whichever chunk") {
    const Reading reading = check_same(kThreeVertices + "f 1 2 3\n# a \\\nv 1 \\\n2 \x02 3\ng \x01\n");
    CHECK(reading.refusal == "s.obj:7: control character 0x02: this is not a text file");
}

// Fifteen digits or fewer, whose value is exact only as a fraction.
TEST_CASE("Short decimals are the float of the nearest double") {
    std::mt19937_64 random(11);
    std::string text;
    std::vector<float> expected;
    for (int i = 0; i < 30000; ++i) {
        std::string digits =
            fmt::format("{:0{}d}", random() % 1000000000000000u, 1 + static_cast<int>(random() % 15));
        digits.resize(std::min<std::size_t>(digits.size(), 1 + random() % 15));
        digits.insert(random() % (digits.size() + 1), ".");
        if (random() % 2 == 0) digits.insert(0, "-");
        text += (i % 3 == 0 ? "\nv " : " ") + digits;
        expected.push_back(static_cast<float>(std::strtod(digits.c_str(), nullptr)));
    }
    const ObjMesh mesh = read_obj_text(text + "\n" + kThreeVertices + "f -3 -2 -1\n", "s.obj", 2);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        wrong += std::bit_cast<std::uint32_t>(mesh.positions[i / 3][static_cast<int>(i % 3)]) !=
                         std::bit_cast<std::uint32_t>(expected[i])
                     ? 1
                     : 0;
    CHECK(wrong == 0);
}

// Long decimals next to the middle of two floats.
TEST_CASE("Coordinates are rounded correctly, whichever way a line takes") {
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
    simple += "\n" + kThreeVertices + "f -3 -2 -1\n";
    for (const std::string& text : {simple, in_odd_words(simple)}) {
        const ObjMesh mesh = read_obj_text(text, "s.obj", 2);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            wrong += mesh.positions[i / 3][static_cast<int>(i % 3)] != expected[i] ? 1 : 0;
        CHECK(wrong == 0);
    }
}

// The peer takes several times as long, and rounds numbers less well.
TEST_CASE("Files of exporters have the elements and faces that tinyobjloader finds") {
    const test::TemporaryFolder folder;
    std::vector<fs::path> files = obj_files();
    files.push_back(test::write_bumpy_ball(folder.path(), 21));
    const auto is_near = [](float a, float b) { return std::abs(a - b) <= 1e-6f * std::max(1.0f, std::abs(b)); };
    const auto check_numbers = [&](const float* ours, std::size_t count, const std::vector<float>& theirs) {
        REQUIRE(count == theirs.size());
        CHECK((count == 0 || std::equal(ours, ours + count, theirs.begin(), is_near)));
    };
    for (const fs::path& path : files) {
        INFO(path);
        const std::string text = read_text_file(path);
        const ObjMesh mesh = read_obj_text(text, path, 2);
        tinyobj::attrib_t elements;
        std::vector<tinyobj::shape_t> shapes;
        std::vector<tinyobj::material_t> materials;
        std::string warnings;
        std::string errors;
        std::istringstream stream(text);
        REQUIRE(tinyobj::LoadObj(&elements, &shapes, &materials, &warnings, &errors, &stream, nullptr, false));
        check_numbers(&mesh.positions[0].x, 3 * mesh.positions.size(), elements.vertices);
        check_numbers(mesh.normals.empty() ? nullptr : &mesh.normals[0].x, 3 * mesh.normals.size(), elements.normals);
        check_numbers(mesh.uvs.empty() ? nullptr : &mesh.uvs[0].x, 2 * mesh.uvs.size(), elements.texcoords);
        const test::FlatFaces faces(mesh);
        std::vector<std::uint32_t> corner_counts;
        std::vector<ObjCorner> corners;
        for (const tinyobj::shape_t& shape : shapes) {
            for (const auto count : shape.mesh.num_face_vertices) corner_counts.push_back(count);
            for (const tinyobj::index_t& index : shape.mesh.indices)  // -1 for none, as kNone
                corners.push_back({static_cast<std::uint32_t>(index.vertex_index),
                                   static_cast<std::uint32_t>(index.normal_index),
                                   static_cast<std::uint32_t>(index.texcoord_index)});
        }
        CHECK(faces.corner_counts == corner_counts);
        CHECK(test::same_bytes(faces.corners, corners));
    }
}
