// Textures of Mitsuba surfaces: images and checkerboards, their transformations, reliefs, radiance.
#include "core/io/mitsuba/textures.h"

#include "core/io/image.h"
#include "tests/core/io/mitsuba/mitsuba_text.h"

using namespace pl;
using namespace pl::test;

namespace {

std::string rectangle(const std::string& content) { return "<shape type=\"rectangle\">" + content + "</shape>"; }

std::string diffuse(const std::string& texture) { return "<bsdf type=\"diffuse\">" + texture + "</bsdf>"; }

std::string bitmap(const std::string& name, const std::string& content, const std::string& file = "i.png") {
    return "<texture type=\"bitmap\" name=\"" + name + "\"><string name=\"filename\" value=\"" + file + "\"/>" +
           content + "</texture>";
}

/// Texture coordinates of the corner at a position.
glm::vec2 uv_at(const SceneDescription& scene, glm::vec3 position) {
    for (const TriangleDescription& t : scene.triangles)
        for (int k = 0; k < 3; ++k)
            if (scene.positions[t.vertex[k]] == position) return scene.uvs[t.uv[k]];
    FAIL("no corner there");
    return {};
}

void write_image(const TemporaryFolder& folder) {
    write_png8(folder.path() / "i.png", {.width = 2, .height = 1, .rgb = {255, 255, 255, 0, 0, 0}});
}

}  // namespace

TEST_CASE("mitsuba textures: coordinates are transformed before the image is turned over") {
    const TemporaryFolder folder;
    write_image(folder);
    // The corner at (-1, 1) has v = 1 in Mitsuba, where the last row of the image is: here 0.
    const SceneDescription plain = load_mitsuba_text(folder, rectangle(diffuse(bitmap("reflectance", ""))));
    CHECK(uv_at(plain, {-1, 1, 0}) == glm::vec2(0.0f, 0.0f));
    const SceneDescription scaled = load_mitsuba_text(
        folder,
        rectangle(diffuse(bitmap("reflectance", "<transform name=\"to_uv\"><scale x=\"3\" y=\"2\"/><translate "
                                                "x=\"0.25\" y=\"0.5\"/></transform>"))));
    CHECK(uv_at(scaled, {-1, -1, 0}) == glm::vec2(0.25f, 0.5f));
    CHECK(uv_at(scaled, {1, 1, 0}) == glm::vec2(3.25f, -1.5f));
    const SceneDescription older = load_mitsuba_text(
        folder, rectangle(diffuse(bitmap("reflectance", "<float name=\"uscale\" value=\"3\"/><float "
                                                        "name=\"vscale\" value=\"2\"/><float name=\"uoffset\" "
                                                        "value=\"0.25\"/><float name=\"voffset\" value=\"0.5\"/>"))));
    CHECK(uv_at(older, {-1, -1, 0}) == glm::vec2(0.25f, 0.5f));
    CHECK(uv_at(older, {1, 1, 0}) == glm::vec2(3.25f, -1.5f));
}

TEST_CASE("mitsuba textures: a transformation is that of its own surface alone, copies of a shape included") {
    const TemporaryFolder folder;
    write_image(folder);
    const std::string twice = "<transform name=\"to_uv\"><scale value=\"2\"/></transform>";
    const SceneDescription scene = load_mitsuba_text(
        folder, "<shape type=\"shapegroup\" id=\"g\">" + rectangle(diffuse(bitmap("reflectance", twice))) +
                    "</shape><shape type=\"instance\"><ref id=\"g\"/></shape><shape type=\"instance\"><ref "
                    "id=\"g\"/></shape>" +
                    rectangle(diffuse(bitmap("reflectance", ""))));
    REQUIRE(scene.triangles.size() == 6);
    for (const TriangleDescription& t : scene.triangles)
        for (int k = 0; k < 3; ++k)
            CHECK(std::abs(scene.uvs[t.uv[k]].x) <= (t.material == scene.triangles[0].material ? 2.0f : 1.0f));
    CHECK(uv_at(scene, {1, -1, 0}).x == 2.0f);
    CHECK(scene.uvs[scene.triangles[4].uv.y].x == 1.0f);
}

TEST_CASE("mitsuba textures: values that are raw, or of another gamma, are not decoded from sRGB") {
    const TemporaryFolder folder;
    write_png8(folder.path() / "i.png", {.width = 1, .height = 1, .rgb = {128, 128, 128}});
    const std::string raw = rectangle(diffuse(bitmap("reflectance", "<boolean name=\"raw\" value=\"true\"/>")));
    const std::string decoded = rectangle(diffuse(bitmap("reflectance", "")));
    const auto gamma = [](const std::string& value) {
        return rectangle(diffuse(bitmap("reflectance", "<float name=\"gamma\" value=\"" + value + "\"/>")));
    };
    const SceneDescription scene =
        load_mitsuba_text(folder, raw + decoded + raw + gamma("2.2") + gamma("1") + gamma("-1"));
    REQUIRE(scene.textures.size() == 3);
    const auto shown = [&](std::size_t shape) {
        return scene.textures[scene.materials[scene.triangles[2 * shape].material].textures.albedo].texels[0].x;
    };
    const float code = 128.0f / 255.0f;
    CHECK(shown(0) == Approx(code));
    CHECK(shown(1) == Approx(0.21586f).epsilon(1e-4));
    CHECK(shown(2) == Approx(code));
    CHECK(shown(3) == Approx(std::pow(code, 2.2f)));
    CHECK(shown(4) == Approx(code));
    CHECK(shown(5) == shown(1));
    CHECK(is_told(
        load_mitsuba_text(
            folder, rectangle(diffuse(bitmap(
                        "reflectance", "<string name=\"wrap_mode\" value=\"mirror\"/><string name=\"filter_type\" "
                                       "value=\"nearest\"/>")))),
        "'mirror' of textures is shown as repeat"));
}

TEST_CASE("mitsuba textures: a checkerboard is an image of four squares") {
    const TemporaryFolder folder;
    const SceneDescription scene = load_mitsuba_text(
        folder, rectangle(diffuse("<texture type=\"checkerboard\" name=\"reflectance\"><rgb name=\"color0\" "
                                  "value=\"0.5, 0.25, 0.125\"/><transform name=\"to_uv\"><scale value=\"8\"/>"
                                  "</transform></texture>")));
    REQUIRE(scene.textures.size() == 1);
    const TextureDescription& image = scene.textures[0];
    CHECK(scene.materials[0].textures.albedo == 0);
    CHECK(scene.materials[0].albedo == glm::vec3(1.0f));
    CHECK(image.repeats);
    const glm::vec4 first(0.5f, 0.25f, 0.125f, 1.0f);
    const glm::vec4 second(0.2f, 0.2f, 0.2f, 1.0f);
    const std::uint32_t half = kCheckerTexels / 2;
    CHECK(image.texels[0] == first);
    CHECK(image.texels[half] == second);
    CHECK(image.texels[half * kCheckerTexels] == second);
    CHECK(image.texels[half * kCheckerTexels + half] == first);
    CHECK(uv_at(scene, {1, -1, 0}).x == 8.0f);
    CHECK(scene.warnings.size() == 1);  // of the light that the scene lacks
    CHECK(is_told(load_mitsuba_text(folder, rectangle(diffuse("<texture type=\"noise\" name=\"reflectance\"/>"))),
                  "textures of the type 'noise' are shown as one color"));
}

TEST_CASE("mitsuba textures: a bump map rises in world units, by the scale of its coordinates") {
    const TemporaryFolder folder;
    // Half a height over half of the width: from black to a gray that sRGB decodes to 0.2140.
    write_png8(folder.path() / "i.png",
               {.width = 4, .height = 1, .rgb = {0, 0, 0, 0, 0, 0, 127, 127, 127, 127, 127, 127}});
    const auto slope = [&](const std::string& raw, const std::string& scale, const std::string& shape) {
        const SceneDescription scene = load_mitsuba_text(
            folder, "<shape type=\"rectangle\"><transform name=\"to_world\"><scale " + shape +
                        "/></transform><bsdf type=\"bumpmap\"><float name=\"scale\" value=\"" + scale + "\"/>" +
                        bitmap("arbitrary", raw) + diffuse("") + "</bsdf></shape>");
        REQUIRE(scene.materials[0].textures.normal != kNoTexture);
        CHECK(scene.materials[0].normal_green == NormalGreen::Up);
        CHECK_FALSE(is_told(scene, "bump"));
        const glm::vec4 texel = scene.textures[scene.materials[0].textures.normal].texels[1];
        const glm::vec3 normal = 2.0f * glm::vec3(texel) - 1.0f;
        return -normal.x / normal.z;
    };
    const std::string raw = "<boolean name=\"raw\" value=\"true\"/>";
    // The rectangle is 2 wide, so that two texels are 1.
    CHECK(slope(raw, "1", "value=\"1\"") == Approx(127.0 / 255.0).epsilon(1e-3));
    CHECK(slope("", "1", "value=\"1\"") == Approx(0.2122).epsilon(1e-3));
    CHECK(slope(raw, "3", "value=\"1\"") == Approx(3.0 * 127.0 / 255.0).epsilon(1e-3));
    CHECK(slope(raw, "1", "x=\"4\" y=\"1\" z=\"1\"") == Approx(0.25 * 127.0 / 255.0).epsilon(1e-3));
    CHECK(slope(raw, "1", "x=\"1\" y=\"4\" z=\"1\"") == Approx(127.0 / 255.0).epsilon(1e-3));
    CHECK(slope(raw + "<transform name=\"to_uv\"><scale x=\"2\" y=\"1\"/></transform>", "1", "value=\"1\"") ==
          Approx(2.0 * 127.0 / 255.0).epsilon(1e-3));
}

TEST_CASE("mitsuba textures: where the coordinates of a bump map are uneven its mean scale is told") {
    const TemporaryFolder folder;
    write_image(folder);
    const std::string bumpy = "<bsdf type=\"bumpmap\" id=\"b\">" + bitmap("arbitrary", "") + diffuse("") + "</bsdf>";
    const SceneDescription scene =
        load_mitsuba_text(folder, bumpy + rectangle("<ref id=\"b\"/>") +
                                      "<shape type=\"rectangle\"><transform name=\"to_world\"><scale "
                                      "value=\"5\"/></transform><ref id=\"b\"/></shape>");
    CHECK(is_told(scene, "bump maps are shown by the mean scale"));
    CHECK(is_told(load_mitsuba_text(folder, rectangle("<bsdf type=\"bumpmap\">" + diffuse("") + "</bsdf>")),
                  "the texture of 'bumpmap' is no image"));
    CHECK(is_told(load_mitsuba_text(folder, rectangle("<bsdf type=\"bumpmap\">" +
                                                      bitmap("arbitrary", "<float name=\"uscale\" value=\"2\"/>") +
                                                      diffuse(bitmap("reflectance", "")) + "</bsdf>")),
                  "share that of its color"));
}

TEST_CASE("mitsuba textures: an image of radiance") {
    const TemporaryFolder folder;
    write_image(folder);
    const SceneDescription scene = load_mitsuba_text(
        folder, rectangle("<emitter type=\"area\">" + bitmap("radiance", "<float name=\"uscale\" value=\"2\"/>") +
                          "</emitter>") +
                    rectangle("<emitter type=\"area\"><texture type=\"noise\" name=\"radiance\"/></emitter>"));
    const MaterialDescription& shining = scene.materials[scene.triangles[0].material];
    CHECK(shining.emission == glm::vec3(1.0f));
    CHECK(shining.textures.emission == 0);
    CHECK(shining.albedo == glm::vec3(0.0f));
    CHECK(scene.textures[0].texels[1] == glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
    CHECK(uv_at(scene, {1, -1, 0}).x == 2.0f);
    CHECK(scene.materials[scene.triangles[2].material].textures.emission == kNoTexture);
    CHECK(is_told(scene, "textures of radiance other than images are shown as 1"));
}
