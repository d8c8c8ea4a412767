// Surfaces of Mitsuba scenes, adapters around them and media inside of them.
#include "core/io/mitsuba/surfaces.h"

#include <fmt/format.h>

#include "core/io/image.h"
#include "tests/core/io/mitsuba/mitsuba_text.h"

using namespace pl;
using namespace pl::test;

TEST_CASE("mitsuba: surfaces, by reference, inside of adapters, and with the values of the plugins") {
    const SceneDescription scene =
        load_mitsuba_text("<bsdf type=\"twosided\" id=\"wall\"><bsdf type=\"diffuse\"><rgb "
                          "name=\"reflectance\" value=\"0.1, 0.2, 0.3\"/>"
                          "</bsdf></bsdf><shape type=\"rectangle\"><ref id=\"wall\"/></shape><shape "
                          "type=\"cube\"><ref id=\"wall\"/></shape>");
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].name == "wall");
    CHECK(scene.materials[0].albedo == glm::vec3(0.1f, 0.2f, 0.3f));
    const MaterialDescription metal =
        surface("<bsdf type=\"roughconductor\"><float name=\"alpha\" value=\"0.25\"/><rgb name=\"eta\" "
                "value=\"1.65746 0.880369 "
                "0.521229\"/><rgb name=\"k\" value=\"9.22387 6.26952 4.837\"/><rgb name=\"specularReflectance\" "
                "value=\"0.578596\"/><string name=\"distribution\" value=\"ggx\"/></bsdf>");
    CHECK(metal.kind == SurfaceKind::Conductor);
    CHECK(metal.roughness == 0.5f);
    CHECK(metal.specular.x == Approx(0.5369646).epsilon(1e-4));
    CHECK(metal.specular.z == Approx(0.5316769).epsilon(1e-4));
    const MaterialDescription glass = surface("<bsdf type=\"dielectric\"><string name=\"intIOR\" "
                                              "value=\"water\"/><float name=\"extIOR\" value=\"1\"/></bsdf>");
    CHECK(glass.kind == SurfaceKind::Dielectric);
    CHECK(glass.ior == 1.333f);
    const MaterialDescription pane =
        surface("<bsdf type=\"thindielectric\"><float name=\"int_ior\" value=\"1.6\"/><float name=\"ext_ior\" "
                "value=\"1\"/><rgb name=\"specular_transmittance\" value=\"0.5, 1, 0.25\"/></bsdf>");
    CHECK(pane.kind == SurfaceKind::Pane);
    CHECK(pane.ior == 1.6f);
    CHECK(pane.transmission == glm::vec3(0.5f, 1.0f, 0.25f));
    const std::string leather =
        "<bsdf type=\"plastic\"><float name=\"int_ior\" value=\"1.5\"/><float name=\"ext_ior\" "
        "value=\"1\"/><rgb name=\"diffuse_reflectance\" value=\"0.034\"/>";
    CHECK(surface(leather + "</bsdf>").albedo.x == 0.034f);
    // With `nonlinear` the base darkens under its coat.
    CHECK(surface(leather + "<boolean name=\"nonlinear\" value=\"true\"/></bsdf>").albedo.x ==
          Approx(0.01400827).epsilon(0.01));
    CHECK(surface("<bsdf type=\"principled\"><float name=\"metallic\" value=\"1\"/></bsdf>").kind ==
          SurfaceKind::Conductor);
    const SceneDescription odd = load_mitsuba_text("<shape type=\"rectangle\"><bsdf type=\"hair\"/></shape>");
    CHECK(is_told(odd, "surfaces of the type 'hair' are shown as gray"));
    const SceneDescription plain =
        load_mitsuba_text("<shape type=\"rectangle\"><bsdf type=\"normalmap\"><rgb name=\"normalmap\" "
                          "value=\"1\"/><bsdf type=\"diffuse\"/></bsdf></shape>");
    CHECK(is_told(plain, "the texture of 'normalmap' is no image, and is left out"));
}

TEST_CASE("mitsuba: glass that is less dense than what is around it is the other side of one that is denser") {
    const auto cube = [](const std::string& inside, const std::string& outside) {
        return load_mitsuba_text("<shape type=\"cube\"><bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"" +
                                 inside + "\"/><float name=\"ext_ior\" value=\"" + outside + "\"/></bsdf></shape>");
    };
    const auto first_corner = [](const SceneDescription& scene) {
        return scene.positions[scene.triangles[0].vertex.x];
    };
    const SceneDescription bubble = cube("1", "1.5");
    const SceneDescription glass = cube("1.5", "1");
    CHECK(bubble.materials[0].ior == glass.materials[0].ior);
    const auto normal = [](const SceneDescription& scene) {
        const glm::uvec3 v = scene.triangles[0].vertex;
        return glm::cross(scene.positions[v.y] - scene.positions[v.x], scene.positions[v.z] - scene.positions[v.x]);
    };
    CHECK(glm::dot(normal(glass), first_corner(glass)) > 0.0f);
    CHECK(glm::dot(normal(bubble), first_corner(bubble)) < 0.0f);
    CHECK_FALSE(is_told(bubble, "index of refraction"));
    CHECK(surface("<bsdf type=\"dielectric\"><string name=\"int_ior\" value=\"pyrex\"/><float name=\"ext_ior\" "
                  "value=\"1\"/></bsdf>")
              .ior == 1.47f);
}

// A mean width of 0.2 either way.
TEST_CASE("mitsuba: anisotropic metals, and others that are shown as isotropic") {
    const auto metal = [](const char* type, float along_u, float along_v) {
        return fmt::format("<bsdf type=\"{}\"><string name=\"distribution\" value=\"ggx\"/><float name=\"alpha_u\" "
                           "value=\"{}\"/><float name=\"alpha_v\" value=\"{}\"/></bsdf>",
                           type, along_u, along_v);
    };
    const MaterialDescription along = surface(metal("roughconductor", 0.4f, 0.1f));
    CHECK(square(along.roughness) == Approx(0.2));
    CHECK(along.anisotropy == Approx(0.75));
    CHECK(along.rotation_deg == 0.0f);
    const MaterialDescription across = surface(metal("roughconductor", 0.1f, 0.4f));
    CHECK(square(across.roughness) == Approx(0.2));
    CHECK(across.anisotropy == Approx(0.75));
    CHECK(across.rotation_deg == 90.0f);
    CHECK(surface(metal("roughconductor", 0.25f, 0.25f)).roughness == 0.5f);
    CHECK_FALSE(surface(metal("roughconductor", 0.25f, 0.25f)).is_anisotropic());
    const auto shape = [](const std::string& bsdf) { return "<shape type=\"rectangle\">" + bsdf + "</shape>"; };
    const SceneDescription line = load_mitsuba_text(shape(metal("roughconductor", 0.4f, 0.0f)));
    CHECK(line.materials[0].anisotropy == kMostAnisotropy);
    CHECK(is_told(line, "100 times as wide"));
    const SceneDescription glass = load_mitsuba_text(shape(metal("roughdielectric", 0.4f, 0.1f)));
    CHECK(glass.materials[0].anisotropy == 0.0f);
    CHECK(square(glass.materials[0].roughness) == Approx(0.2));
    CHECK(is_told(glass, "anisotropic facets of glass and coats are shown as isotropic ones"));
    const MaterialDescription principled =
        surface("<bsdf type=\"principled\"><float name=\"metallic\" value=\"1\"/><float name=\"roughness\" "
                "value=\"0.4\"/><float name=\"anisotropic\" value=\"0.5\"/></bsdf>");
    CHECK(principled.roughness == 0.4f);
    CHECK(principled.anisotropy == Approx(0.45));
}

TEST_CASE("mitsuba: the sheen of a principled surface without another reflection is that of velvet") {
    const std::string cloth = "<bsdf type=\"principled\"><rgb name=\"base_color\" value=\"0.5, 0.25, 0\"/><float "
                              "name=\"sheen\" value=\"0.6\"/>";
    const std::string dull = cloth + "<float name=\"specular\" value=\"0\"/>";
    const MaterialDescription velvet = surface(dull + "</bsdf>");
    CHECK(velvet.kind == SurfaceKind::Velvet);
    CHECK(velvet.albedo == glm::vec3(0.5f, 0.25f, 0.0f));
    CHECK(velvet.specular.x == Approx(0.1));
    CHECK(velvet.specular.z == Approx(0.1));
    const MaterialDescription tinted = surface(dull + "<float name=\"sheen_tint\" value=\"1\"/></bsdf>");
    CHECK(tinted.specular.x == Approx(2.0f * tinted.specular.y));
    CHECK(luminance(tinted.specular) == Approx(0.1));
    CHECK(tinted.specular.z == 0.0f);
    const SceneDescription shiny = load_mitsuba_text("<shape type=\"rectangle\">" + cloth + "</bsdf></shape>");
    CHECK(shiny.materials[0].kind == SurfaceKind::Plastic);
    CHECK(is_told(shiny, "the sheen of principled surfaces whose specular is not 0 is left out"));
}

TEST_CASE("mitsuba: the inside of glass absorbs, by name or in its place, and other media are told") {
    const auto shape = [](const std::string& inside, const std::string& bsdf = "dielectric") {
        return "<shape type=\"cube\"><bsdf type=\"" + bsdf + "\"/>" + inside + "</shape>";
    };
    const std::string ink = "<rgb name=\"sigma_t\" value=\"1, 2, 0\"/><float name=\"scale\" value=\"0.5\"/><rgb "
                            "name=\"albedo\" value=\"0\"/></medium>";
    const std::string inside = "<medium type=\"homogeneous\" name=\"interior\">" + ink;
    const SceneDescription scene =
        load_mitsuba_text("<medium type=\"homogeneous\" id=\"ink\">" + ink + shape(inside) + shape("") +
                          shape("<ref name=\"interior\" id=\"ink\"/>"));
    REQUIRE(scene.materials.size() == 3);
    CHECK(scene.materials[0].absorption == glm::vec3(0.5f, 1.0f, 0.0f));
    CHECK(scene.materials[1].absorption == glm::vec3(0.0f));
    CHECK(scene.materials[2].absorption == glm::vec3(0.5f, 1.0f, 0.0f));
    CHECK(scene.warnings.size() == 1);  // of the light that the scene lacks
    const SceneDescription older = load_mitsuba_text(shape("<medium type=\"homogeneous\" name=\"interior\"><spectrum "
                                                           "name=\"sigmaA\" value=\"0.25\"/></medium>"));
    CHECK(older.materials[0].absorption == glm::vec3(0.25f));
    const SceneDescription milk = load_mitsuba_text(shape("<medium type=\"homogeneous\" name=\"interior\"/>"));
    CHECK(milk.materials[0].absorption == glm::vec3(0.0f));
    CHECK(is_told(milk, "media that scatter light"));
    CHECK(is_told(load_mitsuba_text(shape("<medium type=\"heterogeneous\" name=\"interior\"/>")),
                  "and those that vary"));
    CHECK(is_told(load_mitsuba_text(shape(inside, "plastic")),
                  "media inside of other surfaces than glass are left out"));
    CHECK(is_told(load_mitsuba_text(shape("<medium type=\"homogeneous\" name=\"exterior\"/>")),
                  "media outside of shapes"));
    CHECK_THAT(refusal(shape("<medium type=\"homogeneous\" name=\"interior\"><rgb name=\"sigma_a\" value=\"1\"/>"
                             "<float name=\"scale\" value=\"-2\"/></medium>")),
               contains("expected an absorption of at least 0, got -2 -2 -2"));
}

TEST_CASE("mitsuba: a normal map is that of the surface inside") {
    const TemporaryFolder folder;
    write_png8(folder.path() / "n.png", {.width = 1, .height = 1, .rgb = {255, 51, 0}});
    const SceneDescription scene = load_mitsuba_text(
        folder, "<shape type=\"rectangle\"><bsdf type=\"twosided\"><bsdf type=\"normalmap\">"
                "<texture name=\"normalmap\" type=\"bitmap\"><string name=\"filename\" value=\"n.png\"/></texture>"
                "<bsdf type=\"diffuse\"/></bsdf></bsdf></shape>" +
                    kSquare);
    CHECK(scene.materials[scene.triangles.front().material].textures.normal == 0);
    CHECK(scene.materials[scene.triangles.front().material].normal_green == NormalGreen::Left);
    CHECK(scene.materials[scene.triangles.back().material].textures.normal == kNoTexture);
    REQUIRE(scene.textures.size() == 1);
    CHECK(scene.textures[0].texels[0].y == Approx(0.2));
    CHECK_FALSE(is_told(scene, "normalmap"));
}

TEST_CASE("mitsuba: masks are the opacity of the surface inside, and multiply") {
    const auto mask = [](const std::string& opacity, const std::string& inside = "<bsdf type=\"diffuse\"/>") {
        return "<bsdf type=\"mask\">" + opacity + inside + "</bsdf>";
    };
    const std::string half = "<float name=\"opacity\" value=\"0.5\"/>";
    const MaterialDescription veil = surface(mask("<float name=\"opacity\" value=\"0.75\"/>"));
    CHECK(veil.opacity == 0.75f);
    CHECK(veil.opacity_rule == OpacityRule::Blend);
    CHECK(veil.albedo == glm::vec3(0.5f));
    CHECK(surface(mask("")).opacity == 0.5f);
    CHECK(surface(mask("<rgb name=\"opacity\" value=\"0.25, 0.25, 0.25\"/>")).opacity == Approx(0.25));
    CHECK(surface(mask(half, "<bsdf type=\"twosided\">" + mask(half) + "</bsdf>")).opacity == 0.25f);
    CHECK(surface(mask("<float name=\"opacity\" value=\"7\"/>")).opacity == 1.0f);
    CHECK_FALSE(surface("<bsdf type=\"diffuse\"/>").may_have_holes());

    const TemporaryFolder folder;
    write_png8(folder.path() / "a.png", {.width = 2, .height = 1, .rgb = {128, 128, 128, 0, 255, 0}});
    const auto image = [](const std::string& more) {
        return "<texture name=\"opacity\" type=\"bitmap\"><string name=\"filename\" value=\"a.png\"/>" + more +
               "</texture>";
    };
    const auto seen = [&](const std::string& bsdf) {
        return load_mitsuba_text(folder, "<shape type=\"rectangle\">" + bsdf + "</shape>");
    };
    const SceneDescription decoded = seen(mask(image("")));
    REQUIRE(decoded.materials[0].textures.opacity == 0);
    CHECK(decoded.materials[0].opacity == 1.0f);
    CHECK(decoded.textures[0].texels[0].w == Approx(0.2159).epsilon(1e-3));
    CHECK(decoded.textures[0].texels[1].w == Approx(0.7152).epsilon(1e-3));
    const SceneDescription raw = seen(mask(image("<boolean name=\"raw\" value=\"true\"/>")));
    CHECK(raw.textures[0].texels[0].w == Approx(128.0 / 255.0));
    CHECK(is_told(seen(mask(image(""), mask(image("")))), "further ones inside of others, are left out"));
    CHECK(is_told(seen(mask("<texture name=\"opacity\" type=\"checkerboard\"/>")), "opacities that are no image"));
    CHECK(is_told(load_mitsuba_text("<shape type=\"rectangle\">" + mask(half) + "<emitter type=\"area\"/></shape>"),
                  "the light of shapes with a mask is masked, too"));
    CHECK_THAT(refusal("<shape type=\"rectangle\"><bsdf type=\"mask\"/></shape>"),
               contains("mask: expected a surface inside, got none"));
}

TEST_CASE("mitsuba: surfaces that begin in the same line are different ones") {
    const auto square = [](const std::string& color) {
        return "<shape type=\"rectangle\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"" + color +
               "\"/></bsdf></shape>";
    };
    const SceneDescription scene = load_mitsuba_text(square("0.1") + square("0.2") + kSquare + kSquare);
    REQUIRE(scene.materials.size() == 3);
    CHECK(scene.materials[0].albedo == glm::vec3(0.1f));
    CHECK(scene.materials[1].albedo == glm::vec3(0.2f));
    CHECK(scene.triangles[2].material == 1);
    CHECK(scene.triangles[6].material == 2);
}
