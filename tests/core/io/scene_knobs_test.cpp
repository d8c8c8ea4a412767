// Knobs of scene files: the vertices that they move and those that stay, and refusals of wrong ones.
#include "core/io/scene_knobs.h"

#include <algorithm>

#include "core/io/load_scene.h"
#include "core/scene/scene_hash.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/assets.h"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::error_message;
using pl::test::input_error;
using pl::test::kAssets;
using pl::test::TemporaryFolder;

namespace {

/// Two triangles that share nothing, a third that shares a vertex with the second; only the first has normals.
constexpr const char* kLeafAndFrame =
    "mtllib m.mtl\nusemtl wall\nv 0 0 0\nv 2 0 0\nv 0 2 0\nvn 0 0 1\nvn 1 0 0\n"
    "g leaf\nf 1//1 2//1 3//1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 7 7 7\ng frame\nf 4 5 6\no corner\nf 4 5 7\n";

SceneDescription load_knob(const std::string& knob, const ParameterTexts& asked = {}) {
    const TemporaryFolder folder;
    folder.write("m.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0.5 0.25 0.5\nKe 1 1 1\n");
    folder.write("s.obj", kLeafAndFrame);
    const std::string text = "{\"schema\": \"pathlight.scene/1\", \"obj\": \"s.obj\",\n\"knobs\": {\n" + knob + "}}";
    return load_scene(folder.write("scene.json", text).string(), folder.path(), {.parameters = asked});
}

/// A knob "k" from -10 to 10 with default 1, with this effect.
std::string knob_that(const std::string& does) {
    return R"("k": {"default": 1, "range": [-10, 10], "does": "turn it",)"
           "\n" +
           does + "}";
}

std::string refused_knob(const std::string& does) {
    return input_error([&] { load_knob(knob_that(does)); });
}

bool near(const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b) < 1e-6f; }

}  // namespace

TEST_CASE("A knob moves its groups along a direction, and nothing else") {
    const std::string knob = knob_that(R"("moves": [{"groups": ["leaf"], "by": [0, 0.5, -1]}])");
    const SceneDescription rest = load_knob(knob);
    const SceneDescription moved = load_knob(knob, {{"k", "3"}});
    for (std::size_t i = 0; i < 3; ++i) CHECK(moved.positions[i] == rest.positions[i] + glm::vec3(0, 1, -2));
    for (std::size_t i = 3; i < 7; ++i) CHECK(moved.positions[i] == rest.positions[i]);
    CHECK(moved.normals == rest.normals);
    REQUIRE(moved.knobs.size() == 1);
    CHECK(moved.knobs[0].name == "k");
    CHECK(moved.knobs[0].does == "turn it");
    CHECK(moved.knobs[0].value == 3.0f);
    CHECK(moved.knobs[0].default_value == 1.0f);
    CHECK(moved.knobs[0].low == -10.0f);
    CHECK(moved.knobs[0].high == 10.0f);
    CHECK(scene_hash(moved) != scene_hash(rest));
}

TEST_CASE("A knob turns its groups about an axis, with their normals") {
    const std::string knob =
        knob_that(R"("turns": [{"groups": ["leaf"], "about": [1, 0, 0], "axis": [0, 3, 0], "by_deg": 10}])");
    const SceneDescription turned = load_knob(knob, {{"k", "10"}});  // by 90 degrees
    CHECK(near(turned.positions[0], {1, 0, 1}));
    CHECK(near(turned.positions[1], {1, 0, -1}));
    CHECK(near(turned.positions[2], {1, 2, 1}));
    CHECK(near(turned.normals[0], {1, 0, 0}));
    CHECK(turned.normals[1] == glm::vec3(1, 0, 0));  // no corner of the group uses it
    CHECK(turned.positions[3] == glm::vec3(5, 0, 0));
}

TEST_CASE("A knob scales its groups about a point, with their normals") {
    const std::string knob = knob_that(R"("scales": [{"groups": ["leaf"], "about": [2, 0, 0], "by": [0.05, 0, 0]}])");
    const SceneDescription scaled = load_knob(knob, {{"k", "-9"}});  // to one half
    CHECK(near(scaled.positions[0], {1, 0, 0}));
    CHECK(scaled.positions[1] == glm::vec3(2, 0, 0));
    CHECK(near(scaled.positions[2], {1, 2, 0}));
    CHECK(scaled.normals[0] == glm::vec3(0, 0, 1));
}

TEST_CASE("A knob is the albedo of its materials") {
    const std::string knob = R"("k": {"default": 0.5, "range": [0, 0.9], "does": "gray", "albedo": ["wall"]})";
    CHECK(load_knob(knob).materials[0].albedo == glm::vec3(0.5f));
    const SceneDescription bright = load_knob(knob, {{"k", "0.75"}});
    CHECK(bright.materials[0].albedo == glm::vec3(0.75f));
    CHECK(bright.materials[1].albedo == glm::vec3(0.5f, 0.25f, 0.5f));
}

TEST_CASE("Groups that share vertices move together or not at all") {
    CHECK_THAT(refused_knob(R"("moves": [{"groups": ["frame"], "by": [1, 0, 0]}])"),
               contains("scene.json:4: ") && contains("vertex 4 is also used by group 'corner'"));
    const SceneDescription moved =
        load_knob(knob_that(R"("moves": [{"groups": ["frame", "corner"], "by": [1, 0, 0]}])"), {{"k", "2"}});
    CHECK(moved.positions[3] == glm::vec3(6, 0, 0));
    CHECK(moved.positions[6] == glm::vec3(8, 7, 7));
    CHECK(moved.positions[0] == glm::vec3(0, 0, 0));
}

TEST_CASE("Knobs that are wrong in the file are refused with file and line") {
    struct Case {
        std::string does;
        std::string told;
    };
    const Case sample = GENERATE(
        Case{R"("move": [])", "unknown key, did you mean 'moves'?"}, Case{R"("moves": [])", "the knob does nothing"},
        Case{R"("moves": {})", "expected an array"}, Case{R"("moves": [3])", "expected an object"},
        Case{R"("moves": [{}])", "with 'groups'"}, Case{R"("moves": [{"groups": "leaf"}])", "expected texts"},
        Case{R"("moves": [{"groups": ["leaf"]}])", "expected 'by'"},
        Case{R"("moves": [{"groups": ["leef"], "by": [1, 0, 0]}])", "no group 'leef', did you mean 'leaf'?"},
        Case{R"("turns": [{"groups": ["leaf"], "about": [0, 0, 0], "axis": [0, 0, 0], "by_deg": 1}])",
             "expected a direction"},
        Case{R"("turns": [{"groups": ["leaf"], "about": [0, 0, 0], "axis": [0, 1, 0]}])", "expected 'by_deg'"},
        Case{R"("turns": [{"groups": ["leaf"], "about": [0, 0, 0], "by": [0, 1, 0]}])",
             "unknown key. Known are: groups"},
        Case{R"("scales": [{"groups": ["leaf"], "about": [0, 0, 0], "by": [0.5, 0, 0]}])", "nothing is left"},
        Case{R"("albedo": ["wall"])", "expected the default to be the albedo"},
        Case{R"("albedo": ["floor"])", "no material 'floor'"});
    INFO(sample.does);
    const std::string message = refused_knob(sample.does);
    CHECK_THAT(message, contains("scene.json:") && contains(sample.told));
}

TEST_CASE("The frame of a knob is checked") {
    const auto message = [](const std::string& knob) { return input_error([&] { load_knob(knob); }); };
    const std::string tail = R"("does": "", "moves": [{"groups": ["leaf"], "by": [1, 0, 0]}]})";
    CHECK_THAT(message(R"("k": {"default": 1, )" + tail), contains("expected 'default', 'range'"));
    CHECK_THAT(message(R"("k": {"default": 3, "range": [1, 2], )" + tail),
               contains("expected a number within [1, 2]"));
    CHECK_THAT(message(R"("k": {"default": 1, "range": [2, 1], )" + tail), contains("low below high"));
    CHECK_THAT(message(R"("k": {"default": 1, "range": [0, 1, 2], )" + tail), contains("two numbers"));
    CHECK_THAT(message(R"("a=b": {"default": 1, "range": [0, 2], )" + tail), contains("without '='"));
    CHECK_THAT(message(R"("k": 3)"), contains("expected an object"));
    CHECK_THAT(message(R"("k": {"default": 0.5, "range": [0, 2], "does": "", "albedo": ["wall"]})"),
               contains("expected a range within [0, 1]"));
}

TEST_CASE("Values that a knob does not take, and knobs that are not there, are errors of usage") {
    const std::string knob = knob_that(R"("moves": [{"groups": ["leaf"], "by": [1, 0, 0]}])");
    const auto message = [&](const ParameterTexts& asked) {
        return error_message(ErrorKind::Usage, [&] { load_knob(knob, asked); });
    };
    CHECK_THAT(message({{"k", "10.5"}}), contains("-D k: expected a number from -10 to 10 (turn it), got '10.5'"));
    CHECK_THAT(message({{"k", "1"}, {"k", "-11"}}), contains("got '-11'"));
    for (const char* text : {"", "wide", "nan", "inf", "1 ", "0x1", "1,5"}) {
        INFO(text);
        CHECK_THAT(message({{"k", text}}), contains("expected a number from -10 to 10"));
    };
    CHECK_THAT(message({{"knob", "1"}}), contains("no such knob. Known are: k"));
    CHECK_THAT(error_message(ErrorKind::Usage,
                             [] {
                                 load_scene("furnace", kAssets, {.parameters = {{"k", "1"}}});
                             }),
               contains("it has none"));
    CHECK(load_knob(knob, {{"k", "10"}}).knobs[0].value == 10.0f);
    CHECK(load_knob(knob, {{"k", "20"}, {"k", "4"}}).knobs[0].value == 4.0f);  // the last one counts
}
