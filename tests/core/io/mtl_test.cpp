// MTL files: values, their limits, their meaning, and entries that are left out.
#include "core/io/mtl.h"

#include <cmath>

#include "core/io/image.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::input_error;
using pl::test::TemporaryFolder;

namespace {

SceneDescription load_mtl_text(const std::string& text) {
    const TemporaryFolder folder;
    SceneDescription scene;
    load_mtl(folder.write("m.mtl", text), scene);
    return scene;
}

/// The only material of a file with these lines.
MaterialDescription material(const std::string& lines) { return load_mtl_text("newmtl a\n" + lines).materials.at(0); }

}  // namespace

TEST_CASE("Reflectance and emission, in the order of the file") {
    const SceneDescription loaded = load_mtl_text("\xEF\xBB\xBF# colors\r\nnewmtl b\r\n\tKd 0.1 0.2 0.3\r\nKe 1e1 .5 "
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
    const SceneDescription loaded = load_mtl_text("newmtl a\nKd 1.5 1 0.5\n");
    CHECK(loaded.materials[0].albedo == glm::vec3(1.0f, 1.0f, 0.5f));
    REQUIRE(loaded.warnings.size() == 1);
    CHECK_THAT(loaded.warnings[0], contains("m.mtl:2: reflectance above 1"));
}

TEST_CASE("Only the light that reflects nothing is black") {
    const SceneDescription loaded = load_mtl_text("newmtl lamp\nKe 5 5 5\nnewmtl nothing\nNs 10\n");
    CHECK(loaded.materials[0].albedo == glm::vec3(0.0f));
    CHECK(loaded.materials[1].albedo == kDefaultAlbedo);
    REQUIRE(loaded.warnings.size() == 1);
    CHECK_THAT(loaded.warnings[0], contains("'nothing' has neither Kd nor Ke"));
}

TEST_CASE("Of two materials with one name the first counts") {
    const SceneDescription loaded =
        load_mtl_text("newmtl a\nKd 0.1 0.1 0.1\nnewmtl a\nKd 0.9 0.9 0.9\nPl_two_sided 1\nnewmtl b\nKd 0.5\n");
    REQUIRE(loaded.materials.size() == 2);
    CHECK(loaded.materials[0].albedo == glm::vec3(0.1f));
    CHECK_FALSE(loaded.materials[0].two_sided_emission);
    CHECK(loaded.materials[1].albedo == glm::vec3(0.5f));
    REQUIRE(loaded.warnings.size() == 1);
    CHECK_THAT(loaded.warnings[0], contains("m.mtl:3: material 'a'"));
}

TEST_CASE("Unsupported entries that change the picture are told once, the rest is silent") {
    const SceneDescription loaded =
        load_mtl_text("newmtl a\nKd 0.5 0.5 0.5\ndisp c.png\nmap_Ks d.png\nmap_Ka e.png\nKa 1 1 1\n"
                      "newmtl b\nKd 0.5 0.5 0.5\ndisp f.png\n");
    REQUIRE(loaded.warnings.size() == 1);
    CHECK_THAT(loaded.warnings[0], contains("not supported: disp, map_Ks"));
    CHECK(load_mtl_text("newmtl a\nKd 0.5 0.5 0.5\nKs 1 1 1\nNs 10\nd 1\nTr 0\nillum 2\n").warnings.empty());
}

TEST_CASE("Values that are wrong are left out with file and line") {
    struct Case {
        std::string line;
        std::string told;
    };
    const Case sample =
        GENERATE(Case{"Kd -0.1 0 0", "at least 0, got '-0.1'"}, Case{"Kd nan 0 0", "got 'nan'"},
                 Case{"Kd 0 inf 0", "got 'inf'"}, Case{"Ke 0 0 -3", "got '-3'"}, Case{"Ke 1e39 0 0", "got '1e39'"},
                 Case{"Ke 1e400 0 0", "got '1e400'"}, Case{"Kd 1,5 0 0", "got '1,5'"},
                 Case{"Kd 0x1 0 0", "got '0x1'"}, Case{"Kd 0.5 0.5", "got 2 words"}, Case{"Kd", "got 0 words"},
                 Case{"Kd spectral file.rfl", "got 2 words"}, Case{"Pl_two_sided yes", "expected 0 or 1"},
                 Case{"Pl_surface metal", "diffuse, conductor, dielectric, plastic"},
                 Case{"Pl_roughness 1.5", "within [0, 1]"}, Case{"Pl_ior 0.9", "within [1, 4]"},
                 Case{"Pl_ior nan", "within [1, 4]"}, Case{"Pl_rough 1", "unknown key 'Pl_rough'"},
                 Case{"Kt 1 1 1", "unknown key 'Kt'"}, Case{"Ps 0.5", "not supported: Ps"});
    INFO(sample.line);
    const SceneDescription loaded = load_mtl_text("newmtl a\n\n" + sample.line + "\nnewmtl b\nKd 0.25\n");
    std::string all;
    for (const std::string& warning : loaded.warnings) all += warning + "\n";
    CHECK_THAT(all, contains("m.mtl:") && contains(sample.told));
    CHECK(loaded.materials.at(1).albedo == glm::vec3(0.25f));
}

TEST_CASE("A value before any material is left out") {
    const SceneDescription loaded = load_mtl_text("Kd 1 1 1\nNs 3\nnewmtl a\nKd 0.5\n");
    CHECK(loaded.materials.at(0).albedo == glm::vec3(0.5f));
    REQUIRE(loaded.warnings.size() == 1);
    CHECK_THAT(loaded.warnings[0], contains("m.mtl:1: 'Kd' before any 'newmtl': left out (2 in all)"));
}

TEST_CASE("Keys in letters of any size, and zeros of parts that are not there") {
    const SceneDescription loaded =
        load_mtl_text("NEWMTL a\nKD 0.1 0.2 0.3\nke 1 1 1\nNI 1.4\nks 0.5\nNS 225\nILLUM 2\n"
                      "pl_Two_Sided 1\nPs 0\nPcr 0.03\naniso 0.0\nunheard 0 0 0\n");
    CHECK(loaded.warnings.empty());
    const MaterialDescription& material = loaded.materials.at(0);
    CHECK(material.kind == SurfaceKind::Plastic);
    CHECK(material.albedo == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(material.emission == glm::vec3(1.0f));
    CHECK(material.two_sided_emission);
    CHECK(material.ior == 1.4f);
}

TEST_CASE("Tr is 1 - d, but d itself in files where it says 1 of a surface that is no glass") {
    struct Case {
        std::string text;
        std::vector<float> opacities;
    };
    const Case sample = GENERATE(Case{"newmtl a\nKd 1\nTr 1.000000\nillum 2\nNs 0\n", {1.0f}},
                                 Case{"newmtl a\nKd 1\nTr 1\nnewmtl b\nKd 1\nTr 0.25\n", {1.0f, 0.25f}},
                                 Case{"newmtl a\nKd 1\nTr 1\nnewmtl b\nKd 1\nd 0.5\nTr 0.5\n", {1.0f, 0.5f}},
                                 Case{"newmtl a\nKd 1\nd 1\nTr 1\nnewmtl b\nKd 1\nTr 0.25\n", {1.0f, 0.75f}},
                                 Case{"newmtl a\nKd 1\nTr 1\nnewmtl b\nKd 1\nTr 0\n", {0.0f, 1.0f}},
                                 Case{"newmtl a\nKd 1\nTr 1\nNi 1.5\nnewmtl b\nKd 1\nTr 0.25\n", {1.0f, 0.75f}},
                                 Case{"newmtl a\nKd 1\nTr 0\n", {1.0f}}, Case{"newmtl a\nKd 1\nTr 0.25\n", {0.75f}});
    INFO(sample.text);
    const SceneDescription loaded = load_mtl_text(sample.text);
    for (std::size_t i = 0; i < sample.opacities.size(); ++i)
        CHECK(loaded.materials.at(i).opacity == sample.opacities[i]);
    CHECK(load_mtl_text("newmtl a\nKd 1\nTr 1\nNi 1.5\n").materials.at(0).kind == SurfaceKind::Dielectric);
    CHECK_THAT(load_mtl_text("newmtl a\nKd 1\nTr 1\n").warnings.at(0),
               contains("m.mtl:1: Tr 1 is opaque in this file"));
}

TEST_CASE("Numbers of other programs that cannot be meant are told once and left out") {
    const SceneDescription loaded =
        load_mtl_text("newmtl a\nKd 0.5\nKs 0.5 nan 1\nNs -3\nNi 0\nd 7\nillum 77\nPr x\nPm\nNi -1\n");
    CHECK(loaded.materials[0].kind == SurfaceKind::Diffuse);
    CHECK(loaded.warnings.size() == 7);
    for (const std::string& warning : loaded.warnings)
        CHECK_THAT(warning, contains("an implausible value is ignored"));
    CHECK_THAT(loaded.warnings[1], contains("m.mtl:5: 'Ni'") && contains("(2 in all)"));
}

TEST_CASE("The table of illumination models") {
    struct Case {
        std::string lines;
        SurfaceKind kind;
    };
    const std::string both = "Kd 0.5 0.5 0.5\nKs 0.5 0.5 0.5\nNs 225\n";
    const Case sample = GENERATE_COPY(
        Case{"Kd 0.5\n", SurfaceKind::Diffuse}, Case{"Kd 0.5\nillum 2\nKs 0 0 0\nNs 10\n", SurfaceKind::Diffuse},
        Case{both + "illum 0\n", SurfaceKind::Diffuse}, Case{both + "illum 1\n", SurfaceKind::Diffuse},
        Case{both + "illum 2\n", SurfaceKind::Plastic}, Case{both, SurfaceKind::Plastic},
        Case{"Kd 0.5\nKs 1 1 1\n", SurfaceKind::Diffuse},  // no exponent: unknown width
        Case{both + "illum 3\n", SurfaceKind::Conductor}, Case{both + "illum 5\n", SurfaceKind::Conductor},
        Case{both + "illum 8\n", SurfaceKind::Conductor},
        Case{"Kd 0.8\nKs 0.1\nNs 10\nillum 3\n", SurfaceKind::Plastic},
        Case{"Kd 0.8\nKs 0 0 0\nNs 10\nillum 3\n", SurfaceKind::Diffuse},
        Case{"Kd 0.8\nillum 4\n", SurfaceKind::Dielectric}, Case{"Kd 0.8\nillum 6\n", SurfaceKind::Dielectric},
        Case{"Kd 0.8\nillum 7\n", SurfaceKind::Dielectric}, Case{"Kd 0.8\nillum 9\n", SurfaceKind::Dielectric},
        Case{"Kd 0.8\nd 0.5\nNi 1.5\n", SurfaceKind::Dielectric},
        Case{"Kd 0.8\nTr 0.5\nTf 1 1 1\n", SurfaceKind::Dielectric},
        Case{"Kd 0.8\nd 1\nNi 1.5\nTf 1 1 1\n", SurfaceKind::Diffuse},
        Case{"Kd 0.8\nd 0.5\nNi 1\n", SurfaceKind::Diffuse}, Case{"Kd 0.8\nPm 1\n", SurfaceKind::Conductor},
        Case{both + "Pm 0\n", SurfaceKind::Plastic}, Case{"Kd 0.8\nPc 1\n", SurfaceKind::Plastic},
        Case{both + "illum 7\nPl_surface diffuse\n", SurfaceKind::Diffuse},
        Case{"Kd 0.8\nPl_surface dielectric\n", SurfaceKind::Dielectric},
        Case{"Kd 0.8\nd 0.5\nPl_surface pane\n", SurfaceKind::Pane},
        Case{"Kd 0.8\nKs 0.5 0.5 0.5\nPl_surface velvet\n", SurfaceKind::Velvet});
    INFO(sample.lines);
    CHECK(material(sample.lines).kind == sample.kind);
}

TEST_CASE("Numbers and colors of surfaces") {
    const MaterialDescription plastic = material("Kd 0.1 0.2 0.3\nKs 0.2 0.4 0.4\nNs 225\nNi 1.4\nillum 2\n");
    CHECK(plastic.albedo == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(plastic.specular == glm::vec3(0.5f, 1.0f, 1.0f));
    CHECK(plastic.roughness == Approx(std::pow(2.0 / 227.0, 0.25)));
    CHECK(plastic.ior == 1.4f);
    CHECK(material("Kd 0.1\nKs 0.5\nNs 225\nNi 1\n").ior == 1.5f);
    CHECK(material("Kd 0.1\nKs 0.5\nNs 225\nPr 0.25\n").roughness == 0.25f);
    CHECK(material("Kd 0.1\nKs 0.5\nNs 225\nPr 0.25\nPl_roughness 0.5\n").roughness == 0.5f);
    CHECK(material("Kd 0.1\nKs 0.5\nPr 0.02\n").roughness == 0.0f);

    const MaterialDescription mirror = material("Kd 0.1 0.1 0.1\nKs 0.9 0.8 0.7\nNs 1000\nillum 5\n");
    CHECK(mirror.specular == glm::vec3(0.9f, 0.8f, 0.7f));
    CHECK(mirror.roughness == 0.0f);
    CHECK(mirror.albedo == glm::vec3(0.0f));
    const MaterialDescription gold = material("Kd 1 0.8 0.3\nKs 0.5\nPm 1\nPr 0.3\n");
    CHECK(gold.specular == glm::vec3(1.0f, 0.8f, 0.3f));
    CHECK(gold.roughness == 0.3f);

    const MaterialDescription glass = material("Kd 0.1\nKs 1\nNs 96\nNi 1.33\nTf 0.9 1 1\nillum 7\n");
    CHECK(glass.roughness == 0.0f);
    CHECK(glass.ior == 1.33f);
    CHECK(glass.transmission == glm::vec3(0.9f, 1.0f, 1.0f));
    CHECK(glass.specular == glm::vec3(1.0f));
    CHECK(material("Kd 0.1\nillum 7\n").ior == 1.5f);
    CHECK(material("Kd 0.1\nNi 1\nillum 7\n").ior == 1.0f);
    CHECK(material("Kd 0.1\nPr 0.5\nNi 1\nillum 7\n").roughness == 0.0f);
}

TEST_CASE("Transparency without refraction is a partial opacity") {
    const MaterialDescription veil = material("Kd 0.5\nd 0.25\n");
    CHECK(veil.opacity == 0.25f);
    CHECK(veil.opacity_rule == OpacityRule::Blend);
    CHECK(material("Kd 0.5\nTr 0.25\n").opacity == 0.75f);
    CHECK(material("Kd 0.5\nd 1\n").opacity_rule == OpacityRule::Threshold);
    for (const char* glass : {"Kd 0.5\nd 0.5\nNi 1.5\n", "Kd 0.5\nd 0.5\nTf 1 1 1\n", "Kd 0.5\nd 0\nillum 7\n"}) {
        INFO(glass);
        CHECK(material(glass).kind == SurfaceKind::Dielectric);
        CHECK_FALSE(material(glass).may_have_holes());
    }
    CHECK(load_mtl_text("newmtl a\nKd 0.5\nd 0.5\n").warnings.empty());
    const SceneDescription invisible = load_mtl_text("newmtl a\nKd 0.5\nd 0\n");
    REQUIRE(invisible.warnings.size() == 1);
    CHECK_THAT(invisible.warnings[0], contains("m.mtl:1: material 'a' is invisible"));
    // Implausible values are left out.
    for (const char* wrong : {"d -0.5\n", "d 1.5\n", "d half\n", "Tr 2\n"})
        CHECK(material(std::string("Kd 0.5\n") + wrong).opacity == 1.0f);
}

TEST_CASE("Images of a material: loaded once, missing ones shown as checkers") {
    const TemporaryFolder folder;
    write_png8(folder.path() / "a b.png", {.width = 2, .height = 1, .rgb = {255, 0, 0, 0, 0, 255}});
    SceneDescription scene;
    load_mtl(folder.write("m.mtl", "newmtl a\nmap_Kd -s 1 1 1 -blendu on a b.png # wood\nmap_d a b.png\n"
                                   "newmtl b\nmap_Kd C:\\images\\a b.png\nmap_Ke -clamp on a b.png\n"
                                   "newmtl c\nmap_Kd ../gone.png\nmap_d gone.png\nmap_Kd -t 0.5 gone.png\n"
                                   "newmtl d\nKd 0.5\nmap_Pr a b.png\n"
                                   "newmtl e\nKs 1 1 1\nillum 3\nPr 0.5\nmap_Pr a b.png\nmap_Kd -clamp on\n"),
             scene);
    const std::vector<MaterialDescription>& m = scene.materials;
    CHECK(m[0].albedo == glm::vec3(1.0f));
    CHECK(m[0].textures.albedo == m[1].textures.albedo);
    CHECK(m[0].textures.opacity != m[0].textures.albedo);
    CHECK(m[0].opacity == 1.0f);
    CHECK(m[0].opacity_rule == OpacityRule::Blend);
    CHECK(m[1].opacity_rule == OpacityRule::Threshold);
    CHECK(m[1].emission == glm::vec3(1.0f));
    CHECK_FALSE(scene.textures[m[1].textures.emission].repeats);
    CHECK(scene.textures[m[2].textures.albedo].texels.size() == 4);
    CHECK(m[2].textures.opacity == kNoTexture);
    CHECK(m[3].textures.roughness == kNoTexture);  // matte
    CHECK(m[4].textures.roughness != kNoTexture);
    CHECK(m[4].textures.albedo == kNoTexture);
    std::string all;
    for (const std::string& warning : scene.warnings) all += warning + "\n";
    CHECK_THAT(all, contains("gone.png: cannot be read") && contains("shown as checkers") && contains("left out") &&
                        contains("-t of map_Kd") && contains("'map_Kd': expected the name of an image"));
}

TEST_CASE("Images by names in quotes, with slashes of either kind, and from other places") {
    const TemporaryFolder folder;
    const ByteImage image{.width = 2, .height = 1, .rgb = {255, 0, 0, 0, 0, 255}};
    std::filesystem::create_directories(folder.path() / "scene/t");
    write_png8(folder.path() / "outside.png", image);
    write_png8(folder.path() / "scene/a #1.png", image);
    write_png8(folder.path() / "scene/t/b.png", image);
    const std::string map =
        GENERATE(as<std::string>{}, "\"a #1.png\"", "'a #1.png' # quoted", "-s 1 1 1 \"a #1.png\"", "t\\b.png",
                 "./t/b.png", "t/../t/b.png", "..\\t\\b.png", "C:\\x\\t\\b.png", "/home/x/t/b.png",
                 "\"\\\\server\\x\\t/b.png\"", "../../outside.png");
    INFO(map);
    SceneDescription scene;
    load_mtl(folder.write("scene/m.mtl", "newmtl a\nmap_kd " + map + "\n"), scene);
    const TextureDescription& texture = scene.textures.at(scene.materials.at(0).textures.albedo);
    std::string told;
    for (const std::string& warning : scene.warnings) told += warning + "\n";
    if (map == "../../outside.png") {
        CHECK(texture.texels.size() == 4);  // checkers
        CHECK_THAT(told, contains("m.mtl:2: '../../outside.png' is outside of the scene's folder"));
    } else {
        CHECK(texture.width == 2);
        const bool is_elsewhere = map.find("..\\") == 0 || map.find('x') != std::string::npos;
        CHECK((told.find("m.mtl:2: image") != std::string::npos) == is_elsewhere);
        CHECK((told.find("b.png: read, because the named one is not there") != std::string::npos) == is_elsewhere);
    }
}

TEST_CASE("Images of libraries in folders below are looked for from these, within the scene's folder") {
    const TemporaryFolder folder;
    const ByteImage image{.width = 2, .height = 1, .rgb = {255, 0, 0, 0, 0, 255}};
    std::filesystem::create_directories(folder.path() / "t");
    write_png8(folder.path() / "t/a.png", image);
    SceneDescription scene;
    scene.source = folder.path() / "s.obj";
    load_mtl(folder.write("m/m.mtl", "newmtl a\nmap_Kd ../t/a.png\nnewmtl b\nmap_Kd t/a.png\n"), scene);
    REQUIRE(scene.textures.size() == 1);
    CHECK(scene.textures[0].width == 2);
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings[0], contains("m.mtl:4: image 't/a.png'"));
}

TEST_CASE("The options -s and -o place the images of a material") {
    const TemporaryFolder folder;
    write_png8(folder.path() / "a.png", {.width = 1, .height = 1, .rgb = {255, 0, 0}});
    SceneDescription scene;
    const std::vector<UvScale> uvs =
        load_mtl(folder.write("m.mtl", "newmtl a\nmap_Kd -o 0.25 0 0 -s 2 3 1 a.png\nnewmtl b\nmap_Kd -s 2 a.png\n"
                                       "newmtl c\nmap_Kd a.png\nnewmtl d\nmap_Kd -S 2 2 a.png\nmap_d -o 0 1 a.png\n"
                                       "newmtl e\nmap_Kd -s 0 0 a.png\nmap_Ke -mm 0 1 -mm 0 2 a.png\n"),
                 scene);
    REQUIRE(uvs.size() == 5);
    CHECK(uvs[0] == UvScale{{2.0f, 3.0f}, {0.25f, 0.0f}});
    CHECK(uvs[1] == UvScale{{2.0f, 1.0f}, {0.0f, 0.0f}});
    CHECK(uvs[2] == UvScale{});
    CHECK(uvs[3] == UvScale{{2.0f, 2.0f}, {0.0f, 0.0f}});
    REQUIRE(scene.warnings.size() == 2);
    CHECK_THAT(scene.warnings[0], contains("not supported: -mm of map_Ke, -s of map_Kd"));
    CHECK_THAT(scene.warnings[1], contains("m.mtl:7: images of one material with different -s or -o"));
}

TEST_CASE("Normal maps by norm and by the map_Bump of exporters, heights as their relief") {
    const TemporaryFolder folder;
    write_png8(folder.path() / "n.png", {.width = 2, .height = 1, .rgb = {128, 128, 255, 255, 128, 128}});
    write_png8(folder.path() / "h.png", {.width = 2, .height = 1, .rgb = {10, 10, 10, 200, 199, 200}});
    SceneDescription scene;
    load_mtl(folder.write("m.mtl", "newmtl a\nKd 0.5\nmap_Bump -bm 0.25 n.png\nnewmtl b\nKd 0.5\nnorm n.png\n"
                                   "newmtl c\nKd 0.5\nbump h.png\nnewmtl d\nKd 0.5\nnorm h.png\nmap_bump n.png\n"
                                   "newmtl e\nKd 0.5\nmap_bump -bm -1 n.png\n"),
             scene);
    const std::vector<MaterialDescription>& m = scene.materials;
    REQUIRE(scene.textures.size() == 3);
    CHECK(m[0].textures.normal == 0);
    CHECK(m[0].normal_strength == 0.25f);
    CHECK(scene.textures[0].texels[0].x == Approx(128.0 / 255.0));
    CHECK(m[1].textures.normal == 0);
    CHECK(m[1].normal_strength == 1.0f);
    // Two texels that repeat rise as much as they fall.
    CHECK(m[2].textures.normal == 1);
    CHECK(scene.textures[1].texels[0] == glm::vec4(0.5f, 0.5f, 1.0f, 1.0f));
    CHECK(m[3].textures.normal == 2);
    CHECK(scene.textures[2].texels[0].x == Approx(10.0 / 255.0));
    CHECK(m[4].normal_strength == 1.0f);
    REQUIRE(scene.warnings.size() == 1);
    CHECK_THAT(scene.warnings[0], contains("-bm of map_bump"));
}

TEST_CASE("Heights in a bump map of an MTL file rise by a hundredth of the image's width") {
    const TemporaryFolder folder;
    write_png8(folder.path() / "h.png",
               {.width = 4, .height = 1, .rgb = {0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255}});
    SceneDescription scene;
    load_mtl(folder.write("m.mtl", "newmtl a\nKd 0.5\nbump h.png\nnewmtl b\nKd 0.5\nmap_Bump -bm 2 h.png\n"), scene);
    REQUIRE(scene.textures.size() == 1);
    CHECK(scene.materials[1].textures.normal == 0);
    CHECK(scene.materials[1].normal_strength == 2.0f);
    // The second texel rises by half of the height of 1 a texel, which is 0.04 texels.
    const glm::vec3 normal = 2.0f * glm::vec3(scene.textures[0].texels[1]) - 1.0f;
    CHECK(-normal.x / normal.z == Approx(0.02).epsilon(1e-4));
    CHECK(normal.y == Approx(0.0f).margin(1e-6));
}
