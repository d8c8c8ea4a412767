// Instances of Mitsuba scenes: groups that are kept once above a limit, with the triangles of copies.
#include "core/io/mitsuba/instances.h"

#include "core/io/image.h"
#include "tests/core/io/mitsuba/mitsuba_text.h"
#include "tests/support/scenes/copies.h"

using namespace pl;
using namespace pl::test;

namespace {

SceneDescription load(const TemporaryFolder& folder, const std::string& content, const LoadSettings& asked) {
    return load_scene(folder.write("s.xml", scene_of(content)).string(), "", asked);
}

std::string group(const std::string& id, const std::string& shapes) {
    return "<shape type=\"shapegroup\" id=\"" + id + "\">" + shapes + "</shape>";
}
std::string instance(const std::string& id, const std::string& place) {
    return "<shape type=\"instance\"><ref id=\"" + id + "\"/><transform name=\"to_world\">" + place +
           "</transform></shape>";
}

/// Checks that there are instances above the limit, and the same triangles as below it.
SceneDescription check_kept(const std::string& content, std::size_t meshes, std::size_t instances) {
    const TemporaryFolder folder;
    folder.write("m.ply",
                 "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                 "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
                 "property list uchar int vertex_indices\nend_header\n0 0 0 255 51 0\n1 0 0.5 0 0 255\n"
                 "1 1 0 102 0 0\n0 1 0.3 9 9 9\n3 0 1 2\n3 0 2 3\n");
    const SceneDescription kept = load(folder, content, kKeepInstances);
    CHECK(kept.meshes.size() == meshes);
    CHECK(kept.instances.size() == instances);
    const SceneDescription copied = load(folder, content, {});
    CHECK(copied.instances.empty());
    CHECK(copied.materials == kept.materials);
    check_same_triangles(expanded(kept), copied);
    return kept;
}

const std::string kPainted = "<shape type=\"ply\"><string name=\"filename\" value=\"m.ply\"/><bsdf type=\"diffuse\">"
                             "<texture type=\"mesh_attribute\" name=\"reflectance\">"
                             "<string name=\"name\" value=\"vertex_color\"/></texture></bsdf></shape>";
const std::string kBall =
    "<shape type=\"sphere\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"0.2\"/></bsdf>"
    "</shape>";

}  // namespace

TEST_CASE("mitsuba instances: a group of several instances is kept once and has the triangles of copies") {
    const SceneDescription kept =
        check_kept(kSquare + group("g", kPainted + kBall) + "<shape type=\"cube\"/>" +
                       instance("g", "<translate x=\"5\"/>") + instance("g", "<scale x=\"2\" y=\"0.3\" z=\"1\"/>") +
                       instance("g", "<rotate x=\"1\" y=\"2\" angle=\"40\"/><translate z=\"-7\"/>"),
                   1, 3);
    CHECK(direct_triangles(kept) == 14);
    CHECK(kept.triangles.size() == 14 + 2 + 65024);
    CHECK(kept.meshes[0].name == "g");
    CHECK(kept.vertex_colors.size() == kept.positions.size());
}

TEST_CASE("mitsuba instances: mirrored ones show a mirror image of the group and keep their front") {
    const SceneDescription kept = check_kept(
        group("g", kBall + kSquare) + instance("g", "<translate x=\"5\"/>") + instance("g", "<scale x=\"-2\"/>") +
            instance("g", "<rotate y=\"1\" angle=\"20\"/><scale z=\"-1\"/>") + instance("g", "<scale value=\"2\"/>"),
        2, 4);
    CHECK(kept.triangles.size() == 2 * (65024 + 2));
    CHECK(kept.meshes[1].name == "g (mirrored)");
}

TEST_CASE(
    "mitsuba instances: copies are in the order of the file among other shapes, with one limit for all groups") {
    const std::string lamp = "<shape type=\"rectangle\"><emitter type=\"area\"/></shape>";
    const std::string content = group("a", kSquare) + group("b", "<shape type=\"cube\"/>") + group("lamp", lamp) +
                                lamp + instance("a", "<translate x=\"1\"/>") + "<shape type=\"cube\"/>" +
                                instance("b", "<translate x=\"2\"/>") + instance("a", "<translate x=\"3\"/>") +
                                instance("lamp", "<translate x=\"4\"/>") + instance("lamp", "<translate x=\"5\"/>") +
                                instance("b", "<translate x=\"6\"/>") + kSquare;
    const TemporaryFolder folder;
    const SceneDescription copied = load(folder, content, {.most_copied_triangles = 2 * 2 + 2 * 12});
    REQUIRE(copied.triangles.size() == 2 + 2 + 12 + 12 + 2 + 2 + 2 + 12 + 2);
    const std::vector<std::pair<std::size_t, float>> order{{0, -1}, {2, 0},  {16, 1}, {28, 2},
                                                           {30, 3}, {32, 4}, {34, 5}};
    for (const auto& [triangle, left] : order) {
        float least = INFINITY;
        for (int k = 0; k < 3; ++k) least = std::min(least, copied.positions[copied.triangles[triangle].vertex[k]].x);
        INFO(triangle);
        CHECK(least >= left);
        CHECK(least <= left + 2.0f);
    }
    const SceneDescription kept = load(folder, content, {.most_copied_triangles = 2 * 2 + 2 * 12 - 1});
    CHECK(kept.meshes.size() == 2);
    CHECK(kept.instances.size() == 4);
    CHECK(direct_triangles(kept) == 2 + 12 + 2 + 2 + 2);
    CHECK(complaints_about_instances(kept).empty());
}

TEST_CASE("mitsuba instances: groups shown once, and places that cannot be inverted, are copied") {
    const TemporaryFolder folder;
    const SceneDescription once = load(folder, group("g", kSquare) + instance("g", ""), kKeepInstances);
    CHECK(once.instances.empty());
    const SceneDescription flat = load(folder,
                                       group("g", kSquare) + instance("g", "<scale x=\"1\" y=\"1\" z=\"0\"/>") +
                                           instance("g", "") + instance("g", "<translate z=\"1\"/>"),
                                       kKeepInstances);
    CHECK(flat.instances.size() == 2);
    CHECK(direct_triangles(flat) == 2);
}

TEST_CASE("mitsuba instances: a relief rises by the mean scale of its instances") {
    const TemporaryFolder folder;
    ByteImage image{.width = 2, .height = 2, .rgb = std::vector<std::uint8_t>(12, 0)};
    image.rgb[0] = image.rgb[1] = image.rgb[2] = 255;
    write_png8(folder.path() / "h.png", image);
    const std::string bumpy =
        "<shape type=\"rectangle\"><bsdf type=\"bumpmap\"><texture type=\"bitmap\">"
        "<string name=\"filename\" value=\"h.png\"/></texture><bsdf type=\"diffuse\"/></bsdf></shape>";
    const std::string content =
        group("g", bumpy) + instance("g", "<scale value=\"2\"/>") + instance("g", "<scale value=\"6\"/>");
    const SceneDescription copied = load(folder, content, {});
    const SceneDescription kept = load(folder, content, kKeepInstances);
    REQUIRE(kept.instances.size() == 2);
    REQUIRE(copied.textures.size() == 1);
    for (std::size_t i = 0; i < copied.textures[0].texels.size(); ++i)
        CHECK(glm::distance(kept.textures[0].texels[i], copied.textures[0].texels[i]) < 1e-6f);
    CHECK(is_told(kept, "mean scale"));
    CHECK(is_told(copied, "mean scale"));
}

TEST_CASE("mitsuba instances: more triangles than can be numbered, or copied, are refused at their instance",
          "[hard]") {
    // Each ball has 16128 triangles, each lamp 224.
    std::string balls;
    for (int i = 0; i < 20; ++i) balls += kBall;
    std::string lamps, instances;
    for (int i = 0; i < 20; ++i) lamps += "<shape type=\"sphere\"><emitter type=\"area\"/></shape>";
    for (int i = 0; i < 16000; ++i) instances += "<shape type=\"instance\"><ref id=\"g\"/></shape>\n";
    CHECK_THAT(refusal(group("g", balls) + "\n" + instances),
               contains("s.xml:13318") &&
                   contains("expected at most 4294967294 triangles with those of every instance"));
    instances.resize(instances.size() / 16000 * 15000);
    CHECK_THAT(refusal(group("g", lamps) + instances),
               contains("expected at most 67108864 triangles in the scene, with all copies of shapes"));
}
