// Blended surfaces of Mitsuba scenes: chains of materials, whatever the nesting, and the components that are shown instead.
#include "core/io/mitsuba/blends.h"

#include <map>

#include <fmt/format.h>

#include "core/io/image.h"
#include "tests/core/io/mitsuba/mitsuba_text.h"

using namespace pl;
using namespace pl::test;

namespace {

SceneDescription scene_of_surface(const std::string& bsdf) {
    return load_mitsuba_text("<shape type=\"rectangle\">" + bsdf + "</shape>");
}

std::string weight(float value) { return fmt::format("<float name=\"weight\" value=\"{}\"/>", value); }

std::string blend(const std::string& weight, const std::string& first, const std::string& second) {
    return "<bsdf type=\"blendbsdf\">" + weight + first + second + "</bsdf>";
}

std::string paint(float albedo) {
    return fmt::format("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"{}\"/></bsdf>", albedo);
}

/// Shares of the materials of a scene's first triangle, by their albedo.
std::map<float, float> shares_of(const SceneDescription& scene) {
    std::map<float, float> shares;
    float rest = 1.0f;
    const MaterialDescription* material = &scene.materials[scene.triangles[0].material];
    for (;; material = &scene.materials[material->blend.other]) {
        const float share = material->blend.is_any() ? material->blend.share : 0.0f;
        shares[material->albedo.x] += rest * (1.0f - share);
        rest *= share;
        if (!material->blend.is_any()) return shares;
    }
}

}  // namespace

TEST_CASE("mitsuba: a blend has the weight of its second surface, in adapters and by reference") {
    const SceneDescription scene = load_mitsuba_text(
        "<bsdf type=\"twosided\" id=\"worn\">" + blend(weight(0.3f), "<bsdf type=\"conductor\"/>", paint(0.25f)) +
        "</bsdf><shape type=\"rectangle\"><ref id=\"worn\"/></shape><shape type=\"rectangle\"><ref "
        "id=\"worn\"/></shape>");
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].name == "worn");
    CHECK(scene.materials[0].kind == SurfaceKind::Conductor);
    CHECK(scene.materials[0].blend == BlendDescription{.other = 1, .share = 0.3f});
    CHECK(scene.materials[1].name == "worn (part 2)");
    CHECK(scene.materials[1].albedo.x == 0.25f);
    CHECK_FALSE(scene.materials[1].blend.is_any());
    CHECK(scene.triangles.back().material == 0);
    CHECK(scene.warnings.size() == 1);  // of the light that the scene lacks
    CHECK(scene_of_surface(blend(weight(0.0f), paint(0.1f), paint(0.2f))).materials.size() == 1);
    CHECK(scene_of_surface(blend(weight(1.0f), paint(0.1f), paint(0.2f))).materials[0].albedo.x == 0.2f);
    CHECK(scene_of_surface(blend("", paint(0.1f), paint(0.2f))).materials[0].blend.share == 0.5f);
}

TEST_CASE("mitsuba: nested blends have the products of their weights") {
    const std::string left = blend(weight(0.25f), paint(0.1f), paint(0.2f));
    const std::string right = blend(weight(0.75f), paint(0.3f), paint(0.4f));
    const auto first = shares_of(scene_of_surface(blend(weight(0.4f), left, paint(0.5f))));
    CHECK(first.at(0.1f) == Approx(0.6 * 0.75));
    CHECK(first.at(0.2f) == Approx(0.6 * 0.25));
    CHECK(first.at(0.5f) == Approx(0.4));
    const auto both = shares_of(scene_of_surface(blend(weight(0.4f), left, right)));
    CHECK(both.at(0.1f) == Approx(0.6 * 0.75));
    CHECK(both.at(0.2f) == Approx(0.6 * 0.25));
    CHECK(both.at(0.3f) == Approx(0.4 * 0.25));
    CHECK(both.at(0.4f) == Approx(0.4 * 0.75));
}

TEST_CASE("mitsuba: images are weights, of the second surface and of a blend that comes first") {
    const TemporaryFolder folder;
    write_png8(folder.path() / "w.png", {.width = 2, .height = 1, .rgb = {255, 255, 255, 51, 51, 51}});
    const std::string image = "<texture type=\"bitmap\" name=\"weight\"><string name=\"filename\" value=\"w.png\"/>"
                              "<boolean name=\"raw\" value=\"true\"/></texture>";
    const auto load = [&](const std::string& bsdf) {
        return load_mitsuba_text(folder, "<shape type=\"rectangle\">" + bsdf + "</shape>");
    };
    const SceneDescription scene = load(blend(image, paint(0.1f), paint(0.2f)));
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].blend.share == 1.0f);
    REQUIRE(scene.materials[0].textures.blend == 0);
    CHECK(scene.textures[0].texels[0].x == Approx(1.0));
    CHECK(scene.textures[0].texels[1].x == Approx(0.2));
    const std::string pair = blend(weight(0.5f), paint(0.3f), paint(0.4f));
    const SceneDescription swapped = load(blend(image, pair, paint(0.2f)));
    REQUIRE(swapped.materials.size() == 3);
    CHECK(swapped.materials[0].albedo.x == 0.2f);
    CHECK(swapped.materials[1].albedo.x == 0.3f);
    CHECK(swapped.materials[1].blend.share == 0.5f);
    CHECK(swapped.textures[swapped.materials[0].textures.blend].texels[1].x == Approx(0.8));
    const SceneDescription two = load(blend(image, pair, blend(weight(0.5f), paint(0.1f), paint(0.2f))));
    REQUIRE(two.materials.size() == 2);
    CHECK(two.materials[0].albedo.x == 0.1f);
    CHECK(is_told(two, "blends of two blends by an image are shown as the component of the larger share"));
}

TEST_CASE("mitsuba: masks and reliefs around a blend, and those of its first surface, are those of all") {
    const auto masked = [](const std::string& inside) {
        return "<bsdf type=\"mask\"><float name=\"opacity\" value=\"0.25\"/>" + inside + "</bsdf>";
    };
    const SceneDescription around = scene_of_surface(masked(blend(weight(0.4f), paint(0.1f), paint(0.2f))));
    REQUIRE(around.materials.size() == 2);
    CHECK(around.materials[0].opacity == 0.25f);
    CHECK(around.materials[1].opacity == 1.0f);
    CHECK(around.warnings.size() == 1);
    const std::string pair = blend(weight(0.4f), paint(0.1f), paint(0.2f));
    const SceneDescription inside = scene_of_surface(blend(weight(0.5f), masked(pair), paint(0.3f)));
    REQUIRE(inside.materials.size() == 3);
    CHECK(inside.materials[0].albedo.x == 0.3f);
    CHECK(inside.materials[0].opacity == 0.25f);
    CHECK(inside.materials[1].opacity == 1.0f);
    CHECK(is_told(inside, "masks and reliefs of one of two blended surfaces are those of the first"));
}

TEST_CASE("mitsuba: blends with glass, and endless ones, are shown otherwise or refused") {
    for (const float share : {0.3f, 0.7f}) {
        const SceneDescription scene =
            scene_of_surface(blend(weight(share), "<bsdf type=\"dielectric\"/>", paint(0.2f)));
        REQUIRE(scene.materials.size() == 1);
        CHECK(scene.materials[0].kind == (share < 0.5f ? SurfaceKind::Dielectric : SurfaceKind::Diffuse));
        CHECK(is_told(scene, "blends with glass are shown as the component of the larger share"));
    }
    std::string many = paint(0.1f);
    for (int i = 0; i < 9; ++i) many = blend(weight(0.25f), paint(0.2f), many);
    CHECK_THAT(refusal("<shape type=\"rectangle\">" + many + "</shape>"), contains("at most 8 blends"));
    CHECK_THAT(refusal("<shape type=\"rectangle\"><bsdf type=\"blendbsdf\">" + paint(0.1f) + "</bsdf></shape>"),
               contains("blendbsdf: expected two surfaces inside, got 1"));
    CHECK_THAT(refusal("<bsdf type=\"blendbsdf\" id=\"a\"><ref id=\"a\"/>" + paint(0.1f) +
                       "</bsdf><shape type=\"rectangle\"><ref id=\"a\"/></shape>"),
               contains("or a circle"));
}

TEST_CASE("mitsuba: a principled surface blends plastic and metal by its metallic") {
    const auto principled = [](const std::string& values) {
        return scene_of_surface("<bsdf type=\"principled\"><rgb name=\"base_color\" value=\"0.9, 0.5, 0.1\"/>" +
                                values + "</bsdf>");
    };
    const SceneDescription scene = principled("<float name=\"metallic\" value=\"0.25\"/>");
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.materials[0].kind == SurfaceKind::Plastic);
    CHECK(scene.materials[0].albedo == glm::vec3(0.9f, 0.5f, 0.1f));
    CHECK(scene.materials[0].blend == BlendDescription{.other = 1, .share = 0.25f});
    CHECK(scene.materials[1].kind == SurfaceKind::Conductor);
    CHECK(scene.materials[1].specular == glm::vec3(0.9f, 0.5f, 0.1f));
    const SceneDescription glass =
        principled("<float name=\"metallic\" value=\"0.25\"/><float name=\"spec_trans\" value=\"1\"/>");
    REQUIRE(glass.materials.size() == 1);
    CHECK(glass.materials[0].kind == SurfaceKind::Dielectric);
    CHECK(is_told(glass, "blends with glass"));
}
