// Mitsuba scenes of 0.x and 3: shapes, surfaces, emitters, camera, parameters and includes, notes, and files that are refused.
#include "core/io/mitsuba/mitsuba.h"

#include <cmath>
#include <cstring>

#include "core/io/image.h"
#include "core/io/load_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/input_error.h"
#include "tests/support/files/temporary_folder.h"

using namespace pl;
using pl::test::contains;
using pl::test::input_error;
using pl::test::TemporaryFolder;

namespace {

std::string scene_of(const std::string& content) { return "<scene version=\"3.0.0\">\n" + content + "\n</scene>\n"; }

SceneDescription load(const TemporaryFolder& folder, const std::string& content) {
    return load_scene(folder.write("s.xml", scene_of(content)).string(), "");
}
SceneDescription load(const std::string& content) { return load(TemporaryFolder(), content); }

std::string refusal(const std::string& content) {
    return input_error([&] { load(content); });
}

const std::string kSquare = "<shape type=\"rectangle\"/>";

/// The only material of a scene with this surface.
MaterialDescription surface(const std::string& bsdf) {
    const SceneDescription scene = load("<shape type=\"rectangle\">" + bsdf + "</shape>");
    REQUIRE(scene.materials.size() == 1);
    return scene.materials[0];
}

bool is_told(const SceneDescription& scene, const std::string& words) {
    return std::any_of(scene.warnings.begin(), scene.warnings.end(),
                       [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

/// Mean of the geometric normals, weighted by area, and the area.
glm::dvec4 normal_and_area(const SceneDescription& scene) {
    glm::dvec3 sum(0.0);
    double area = 0.0;
    for (const TriangleDescription& t : scene.triangles) {
        const glm::dvec3 a(scene.positions[t.vertex.x]);
        const glm::dvec3 n = 0.5 * glm::cross(glm::dvec3(scene.positions[t.vertex.y]) - a,
                                              glm::dvec3(scene.positions[t.vertex.z]) - a);
        sum += n;
        area += glm::length(n);
    }
    return {sum, area};
}

/// Volume that the triangles enclose; positive if they face outwards.
double volume(const SceneDescription& scene) {
    double sum = 0.0;
    for (const TriangleDescription& t : scene.triangles)
        sum +=
            glm::dot(glm::dvec3(scene.positions[t.vertex.x]),
                     glm::cross(glm::dvec3(scene.positions[t.vertex.y]), glm::dvec3(scene.positions[t.vertex.z]))) /
            6.0;
    return sum;
}

}  // namespace

TEST_CASE("mitsuba: rectangle, cube, disk and sphere, with their fronts outwards") {
    CHECK(normal_and_area(load(kSquare)) == glm::dvec4(0, 0, 4, 4));
    const SceneDescription cube = load("<shape type=\"cube\"/>");
    CHECK(volume(cube) == Approx(8.0));
    // On the face towards +z images lie on their side: upwards in them is -x.
    for (const TriangleDescription& t : cube.triangles)
        for (int k = 0; k < 3; ++k)
            if (t.vertex.x / 4 == 3) {
                const glm::vec3& p = cube.positions[t.vertex[k]];
                CHECK(cube.uvs[t.uv[k]] == 0.5f * (glm::vec2(p.y, -p.x) + 1.0f));
            }
    const glm::dvec4 disk = normal_and_area(load("<shape type=\"disk\"/>"));
    CHECK(disk.z == Approx(3.14159).epsilon(0.01));
    const SceneDescription ball = load("<shape type=\"sphere\"><point name=\"center\" x=\"1\" y=\"2\" "
                                       "z=\"3\"/><float name=\"radius\" value=\"2\"/></shape>");
    CHECK(volume(ball) == Approx(8.0 * 4.18879).epsilon(0.01));
    CHECK(is_told(ball, "spheres are meshes"));
    for (const glm::vec3& p : ball.positions)
        CHECK(glm::length(p - glm::vec3(1, 2, 3)) == Approx(2.0f).epsilon(1e-5));
    CHECK(glm::dot(ball.normals[0], glm::vec3(0, 0, 1)) == Approx(1.0f));
}

TEST_CASE("mitsuba: transformations in their order, of both spellings, mirrored and flipped fronts") {
    const auto square = [](const std::string& transform) {
        return load("<shape type=\"rectangle\"><transform name=\"toWorld\">" + transform + "</transform></shape>");
    };
    const SceneDescription moved = square("<scale value=\"2\"/><rotate x=\"1\" angle=\"90\"/><translate y=\"5\"/>");
    const glm::dvec4 facing = normal_and_area(moved);
    CHECK(facing.w == Approx(16.0));
    CHECK(facing.y == Approx(-16.0));
    CHECK(moved.positions[0].y == Approx(5.0f));
    CHECK(normal_and_area(square("<scale x=\"-1\" y=\"1\" z=\"1\"/>")).z == Approx(4.0));
    CHECK(normal_and_area(square("<matrix value=\"1 0 0 7 0 1 0 0 0 0 1 0 0 0 0 1\"/>")).z == Approx(4.0));
    CHECK(square("<matrix value=\"1 0 0 7 0 1 0 0 0 0 1 0 0 0 0 1\"/>").positions[0].x == 6.0f);
    CHECK(normal_and_area(load("<shape type=\"rectangle\"><boolean name=\"flip_normals\" value=\"true\"/></shape>"))
              .z == Approx(-4.0));
}

TEST_CASE("mitsuba: OBJ and PLY files, text and binary, smooth unless they say otherwise") {
    const TemporaryFolder folder;
    folder.write("m/tent.obj", "v 0 0 0\nv 1 0 0\nv 0 1 -1\nv 0 -1 -1\nf 1 2 3\nf 1 4 2\n");
    const std::string header =
        "ply\nformat FORMAT 1.0\ncomment x\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const auto with = [&](const std::string& format) {
        return std::string(header).replace(header.find("FORMAT"), 6, format);
    };
    folder.write("m/text.ply", with("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
    std::string little = with("binary_little_endian");
    std::string big = with("binary_big_endian");
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) {
        char bytes[4];
        std::memcpy(bytes, &value, 4);
        little.append(bytes, 4);
        for (int i = 3; i >= 0; --i) big += bytes[i];
    }
    little += std::string("\4\0\0\0\0\1\0\0\0\2\0\0\0\3\0\0\0", 17);
    big += std::string("\4\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\3", 17);
    folder.write("m/little.ply", little);
    folder.write("m/big.ply", big);
    const auto shape = [&](const std::string& type, const std::string& name, const std::string& more = "") {
        return load(folder, "<shape type=\"" + type + "\"><string name=\"filename\" value=\"m/" + name + "\"/>" +
                                more + "</shape>");
    };
    for (const char* name : {"text.ply", "little.ply", "big.ply"}) {
        const SceneDescription scene = shape("ply", name);
        INFO(name);
        CHECK(normal_and_area(scene) == glm::dvec4(0, 0, 1, 1));
        CHECK(scene.files.back() == folder.path() / "m" / name);
    }
    const SceneDescription smooth = shape("obj", "tent.obj");
    REQUIRE(smooth.triangles.size() == 2);
    CHECK(glm::length(smooth.normals[smooth.triangles[0].normal.x] - glm::vec3(0, 0, 1)) < 1e-6f);
    const SceneDescription flat = shape("obj", "tent.obj", "<boolean name=\"faceNormals\" value=\"true\"/>");
    CHECK(flat.triangles[0].normal.x == TriangleDescription::kNoNormal);
    folder.write("m/cut.ply", little.substr(0, little.size() - 3));
    CHECK_THAT(input_error([&] { shape("ply", "cut.ply"); }),
               contains("cut.ply: byte") && contains("end of the file"));
    folder.write("m/far.ply", with("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 4\n");
    CHECK_THAT(input_error([&] { shape("ply", "far.ply"); }),
               contains("expected indices below 4") && contains("got 4"));
    folder.write("m/giant.ply", with("ascii").replace(header.find("vertex 4") + 1, 8, "vertex 4000000000"));
    CHECK_THAT(input_error([&] { shape("ply", "giant.ply"); }), contains("giant.ply: byte"));
}

TEST_CASE("mitsuba: colors of a PLY file's vertices are shown by surfaces that ask for them, in instances too") {
    const TemporaryFolder folder;
    const auto header = [](const std::string& type) {
        return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "property " +
               type + " red\nproperty " + type + " green\nproperty " + type +
               " blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    };
    folder.write("bytes.ply", header("uchar") + "0 0 0 255 51 0\n1 0 0 0 0 255\n1 1 0 102 0 0\n3 0 1 2\n");
    folder.write("floats.ply", header("float") + "0 0 0 1 0.25 0\n1 0 0 0 -1 0\n1 1 0 0 0 2\n3 0 1 2\n");
    const std::string painted = "<bsdf type=\"diffuse\"><texture type=\"mesh_attribute\" name=\"reflectance\">"
                                "<string name=\"name\" value=\"vertex_color\"/></texture></bsdf>";
    const auto shape = [](const std::string& name, const std::string& bsdf) {
        return "<shape type=\"ply\"><string name=\"filename\" value=\"" + name + "\"/>" + bsdf + "</shape>";
    };
    const SceneDescription plain = load(folder, shape("bytes.ply", "<bsdf type=\"diffuse\"/>"));
    CHECK(plain.vertex_colors.empty());
    const SceneDescription scene = load(folder, kSquare + shape("bytes.ply", painted) + kSquare);
    REQUIRE(scene.vertex_colors.size() == scene.positions.size());
    CHECK(scene.materials[scene.triangles[2].material].albedo == glm::vec3(1.0f));
    const glm::uvec3 corners = scene.triangles[2].vertex;
    CHECK(scene.vertex_colors[corners.x] == glm::vec3(1.0f, 0.2f, 0.0f));
    CHECK(scene.vertex_colors[corners.y] == glm::vec3(0.0f, 0.0f, 1.0f));
    CHECK(scene.vertex_colors[corners.z] == glm::vec3(0.4f, 0.0f, 0.0f));
    for (const std::size_t other : {0, 3})
        CHECK(scene.vertex_colors[scene.triangles[other].vertex.x] == glm::vec3(1.0f));
    const SceneDescription copies =
        load(folder, "<shape type=\"shapegroup\" id=\"g\">" + shape("bytes.ply", painted) +
                         "</shape><shape type=\"instance\"><ref id=\"g\"/></shape>" + kSquare);
    REQUIRE(copies.vertex_colors.size() == copies.positions.size());
    CHECK(copies.vertex_colors[copies.triangles[0].vertex.x] == glm::vec3(1.0f, 0.2f, 0.0f));
    const SceneDescription wide = load(folder, shape("floats.ply", painted));
    CHECK(wide.vertex_colors == std::vector<glm::vec3>{{1, 0.25f, 0}, {0, 0, 0}, {0, 0, 1}});
    CHECK(is_told(wide, "colors of vertices outside of [0, 1]"));
    CHECK(is_told(load("<shape type=\"rectangle\">" + painted + "</shape>"), "white on shapes without such"));
}

TEST_CASE("mitsuba: surfaces, by reference, inside of adapters, and with the values of the plugins") {
    const SceneDescription scene = load("<bsdf type=\"twosided\" id=\"wall\"><bsdf type=\"diffuse\"><rgb "
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
    const SceneDescription odd =
        load("<shape type=\"rectangle\"><bsdf type=\"coating\"><bsdf type=\"hair\"/></bsdf></shape>");
    CHECK(is_told(odd, "the effect of 'coating' is left out"));
    CHECK(is_told(odd, "surfaces of the type 'hair' are shown as gray"));
    const auto blended = [](const std::string& weight) {
        return surface("<bsdf type=\"blendbsdf\">" + weight +
                       "<bsdf type=\"conductor\"/><bsdf type=\"plastic\"/></bsdf>");
    };
    CHECK(blended("<float name=\"weight\" value=\"0.3\"/>").kind == SurfaceKind::Conductor);
    CHECK(blended("<float name=\"weight\" value=\"0.7\"/>").kind == SurfaceKind::Plastic);
    const SceneDescription plain = load("<shape type=\"rectangle\"><bsdf type=\"normalmap\"><rgb name=\"normalmap\" "
                                        "value=\"1\"/><bsdf type=\"diffuse\"/></bsdf></shape>");
    CHECK(is_told(plain, "the texture of 'normalmap' is no image, and is left out"));
}

TEST_CASE("mitsuba: the inside of glass absorbs, by name or in its place, and other media are told") {
    const auto shape = [](const std::string& inside, const std::string& bsdf = "dielectric") {
        return "<shape type=\"cube\"><bsdf type=\"" + bsdf + "\"/>" + inside + "</shape>";
    };
    const std::string ink = "<rgb name=\"sigma_t\" value=\"1, 2, 0\"/><float name=\"scale\" value=\"0.5\"/><rgb "
                            "name=\"albedo\" value=\"0\"/></medium>";
    const std::string inside = "<medium type=\"homogeneous\" name=\"interior\">" + ink;
    const SceneDescription scene = load("<medium type=\"homogeneous\" id=\"ink\">" + ink + shape(inside) + shape("") +
                                        shape("<ref name=\"interior\" id=\"ink\"/>"));
    REQUIRE(scene.materials.size() == 3);
    CHECK(scene.materials[0].absorption == glm::vec3(0.5f, 1.0f, 0.0f));
    CHECK(scene.materials[1].absorption == glm::vec3(0.0f));
    CHECK(scene.materials[2].absorption == glm::vec3(0.5f, 1.0f, 0.0f));
    CHECK(scene.warnings.size() == 1);  // of the light that the scene lacks
    const SceneDescription older = load(shape("<medium type=\"homogeneous\" name=\"interior\"><spectrum "
                                              "name=\"sigmaA\" value=\"0.25\"/></medium>"));
    CHECK(older.materials[0].absorption == glm::vec3(0.25f));
    const SceneDescription milk = load(shape("<medium type=\"homogeneous\" name=\"interior\"/>"));
    CHECK(milk.materials[0].absorption == glm::vec3(0.0f));
    CHECK(is_told(milk, "media that scatter light"));
    CHECK(is_told(load(shape("<medium type=\"heterogeneous\" name=\"interior\"/>")), "and those that vary"));
    CHECK(is_told(load(shape(inside, "plastic")), "media inside of other surfaces than glass are left out"));
    CHECK(is_told(load(shape("<medium type=\"homogeneous\" name=\"exterior\"/>")), "media outside of shapes"));
    CHECK_THAT(refusal(shape("<medium type=\"homogeneous\" name=\"interior\"><rgb name=\"sigma_a\" value=\"1\"/>"
                             "<float name=\"scale\" value=\"-2\"/></medium>")),
               contains("expected an absorption of at least 0, got -2 -2 -2"));
}

TEST_CASE("mitsuba: a normal map is that of the surface inside") {
    const TemporaryFolder folder;
    write_png8(folder.path() / "n.png", {.width = 1, .height = 1, .rgb = {255, 51, 0}});
    const SceneDescription scene = load(
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
        return load(folder, "<shape type=\"rectangle\">" + bsdf + "</shape>");
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
    CHECK(is_told(load("<shape type=\"rectangle\">" + mask(half) + "<emitter type=\"area\"/></shape>"),
                  "the light of shapes with a mask is masked, too"));
    CHECK_THAT(refusal("<shape type=\"rectangle\"><bsdf type=\"mask\"/></shape>"),
               contains("mask: expected a surface inside, got none"));
}

TEST_CASE("mitsuba: area and constant emitters, others are told") {
    const SceneDescription scene =
        load("<shape type=\"rectangle\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"20, 3, "
             "3\"/></emitter></shape>" +
             kSquare +
             "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.3\"/></emitter><emitter type=\"sunsky\"/>");
    CHECK(scene.materials[scene.triangles[0].material].emission == glm::vec3(20, 3, 3));
    CHECK(scene.materials[scene.triangles[0].material].albedo == glm::vec3(0.0f));
    CHECK(scene.materials[scene.triangles[2].material].emission == glm::vec3(0.0f));
    CHECK(scene.environment == glm::vec3(0.3f));
    CHECK(is_told(scene, "emitters of the type 'sunsky' are left out"));
}

TEST_CASE("mitsuba: point, spot and directional emitters") {
    const std::string place = "<transform name=\"to_world\"><lookat origin=\"1, 2, 3\" target=\"1, 0, 3\" up=\"1, 0, "
                              "0\"/></transform>";
    const std::string spot = "<emitter type=\"spot\">" + place + "<float name=\"cutoff_angle\" value=\"";
    const SceneDescription scene =
        load(kSquare +
             "<emitter type=\"point\"><point name=\"position\" x=\"4\" y=\"5\" z=\"6\"/><rgb name=\"intensity\" "
             "value=\"1, 2, 3\"/></emitter>" +
             spot + "40\"/></emitter>" +
             "<emitter type=\"directional\"><vector name=\"direction\" x=\"0\" y=\"-2\" z=\"0\"/><rgb "
             "name=\"irradiance\" value=\"7\"/></emitter>");
    REQUIRE(scene.punctual_lights.size() == 3);
    CHECK(scene.punctual_lights[0].kind == PunctualKind::Point);
    CHECK(scene.punctual_lights[0].position == glm::vec3(4, 5, 6));
    CHECK(scene.punctual_lights[0].intensity == glm::vec3(1, 2, 3));
    CHECK(scene.punctual_lights[1].kind == PunctualKind::Spot);
    CHECK(scene.punctual_lights[1].falloff == SpotFalloff::Angle);
    CHECK(scene.punctual_lights[1].position == glm::vec3(1, 2, 3));
    CHECK(glm::length(scene.punctual_lights[1].direction - glm::vec3(0, -1, 0)) < 1e-6f);
    CHECK(scene.punctual_lights[1].inner_deg == 30.0f);
    CHECK(scene.punctual_lights[1].outer_deg == 40.0f);
    CHECK(scene.punctual_lights[2].kind == PunctualKind::Directional);
    CHECK(scene.punctual_lights[2].direction == glm::vec3(0, -1, 0));
    CHECK(scene.punctual_lights[2].intensity == glm::vec3(7.0f));
    CHECK_THAT(input_error([&] { load(kSquare + spot + "0\"/></emitter>"); }), contains("beam_width < cutoff_angle"));
}

TEST_CASE("mitsuba: the camera, its angle across or upwards, and the size of the picture") {
    const std::string film = "<film type=\"hdrfilm\"><integer name=\"width\" value=\"640\"/><integer name=\"height\" "
                             "value=\"360\"/></film>";
    const std::string place =
        "<transform name=\"to_world\"><lookat origin=\"0, 1, 5\" target=\"0, 1, 0\" up=\"0, 1, 0\"/></transform>";
    const SceneDescription scene = load(kSquare + "<sensor type=\"perspective\"><float name=\"fov\" value=\"60\"/>" +
                                        place + film + "</sensor>");
    CHECK(scene.camera.eye == glm::vec3(0, 1, 5));
    CHECK(glm::length(glm::normalize(scene.camera.target - scene.camera.eye) - glm::vec3(0, 0, -1)) < 1e-6f);
    CHECK(scene.camera.up == glm::vec3(0, 1, 0));
    CHECK(scene.camera.fov_deg == Approx(35.98339777).epsilon(1e-5));
    CHECK(scene.setting("size") == "640x360");
    const SceneDescription upwards = load(
        kSquare +
        "<sensor type=\"thinlens\"><float name=\"fov\" value=\"60\"/><string name=\"fovAxis\" value=\"y\"/><float "
        "name=\"apertureRadius\" value=\"0.5\"/><float name=\"focusDistance\" value=\"3\"/>" +
        film + "</sensor>");
    CHECK(upwards.camera.fov_deg == Approx(60.0f));
    CHECK(upwards.camera.aperture_radius == 0.5f);
    CHECK(upwards.camera.focus_distance == 3.0f);
    CHECK(upwards.camera.target.z == 1.0f);
}

TEST_CASE("mitsuba: parameters and included files") {
    const TemporaryFolder folder;
    folder.write("parts/wall.xml",
                 scene_of("<bsdf type=\"diffuse\" id=\"wall\"><rgb name=\"reflectance\" value=\"$gray\"/></bsdf>"));
    const SceneDescription scene =
        load(folder, "<default name=\"gray\" value=\"0.25\"/><include filename=\"parts/wall.xml\"/>"
                     "<shape type=\"rectangle\"><ref id=\"wall\"/></shape>");
    CHECK(scene.materials.at(0).albedo == glm::vec3(0.25f));
    REQUIRE(scene.files.size() == 2);
    CHECK(scene.files[1] == folder.path() / "parts/wall.xml");
    folder.write("again.xml", scene_of("<include filename=\"again.xml\"/>"));
    CHECK_THAT(input_error([&] { load(folder, "<include filename=\"again.xml\"/>"); }), contains("in a circle?"));
}

TEST_CASE("mitsuba: broken files are refused with file and line", "[hard]") {
    struct Case {
        std::string content;
        std::string told;
    };
    for (const Case& broken : std::vector<Case>{
             {"<shape type=\"rectangle\">", "not valid XML"},
             {"", "expected a shape with an area, got none"},
             {"<shape type=\"rectangle\"><ref id=\"none\"/></shape>",
              "s.xml:2: 'ref': expected the id of an object, got 'none'"},
             {"<shape type=\"obj\"><string name=\"filename\" value=\"../a.obj\"/></shape>",
              "in the folder of the scene"},
             {"<shape type=\"obj\"><string name=\"filename\" value=\"/etc/passwd\"/></shape>",
              "in the folder of the scene"},
             {"<include filename=\"../a.xml\"/>", "in the folder of the scene"},
             {"<shape type=\"rectangle\"><bsdf type=\"diffuse\"><spectrum name=\"reflectance\" "
              "value=\"400:0.1 700:\"/></bsdf></shape>",
              "expected pairs of a wavelength and a value such as 400:0.5, got '700:'"},
             {"<shape type=\"sphere\"><float name=\"radius\" value=\"x\"/></shape>",
              "expected finite numbers, got 'x'"},
             {"<shape type=\"sphere\"><float name=\"radius\" value=\"1e19\"/></shape>",
              "expected coordinates up to 1e+18"},
             {"<shape type=\"rectangle\"><transform name=\"to_world\"><shear/></transform></shape>",
              "expected translate, scale"},
             {"<shape type=\"rectangle\"><bsdf type=\"twosided\"/></shape>", "expected a surface inside, got none"},
             {"<bsdf type=\"mask\" id=\"a\"><ref id=\"a\"/></bsdf><shape type=\"rectangle\"><ref id=\"a\"/></shape>",
              "got a circle"},
             {kSquare + "<sensor type=\"perspective\"><film type=\"a\"><integer name=\"width\" "
                        "value=\"0\"/></film></sensor>",
              "expected a picture of 1 to 65536 pixels"},
             {kSquare + "<sensor type=\"perspective\"><float name=\"fov\" value=\"180\"/></sensor>",
              "within (0, 180) degrees"},
         }) {
        INFO(broken.content);
        CHECK_THAT(refusal(broken.content), contains("s.xml") && contains(broken.told));
    }
    std::string deep;
    for (int i = 0; i < 100000; ++i) deep += "<a>";
    for (int i = 0; i < 100000; ++i) deep += "</a>";
    CHECK_THAT(refusal(deep), contains("s.xml"));
    // Entities of a document type are not expanded: such a file stays as small as it is.
    const TemporaryFolder folder;
    const auto bomb = folder.write("b.xml", "<!DOCTYPE a [<!ENTITY b \"cccccccccc\"><!ENTITY d \"&b;&b;&b;\">]>\n" +
                                                scene_of("<shape type=\"rectangle\" id=\"&d;\"/>"));
    CHECK(load_scene(bomb.string(), "").triangles.size() == 2);
    CHECK_THAT(input_error([&] { load_scene(folder.write("c.xml", "<svg/>").string(), ""); }),
               contains("expected a scene of Mitsuba"));
}

TEST_CASE("mitsuba: surfaces that begin in the same line are different ones") {
    const auto square = [](const std::string& color) {
        return "<shape type=\"rectangle\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"" + color +
               "\"/></bsdf></shape>";
    };
    const SceneDescription scene = load(square("0.1") + square("0.2") + kSquare + kSquare);
    REQUIRE(scene.materials.size() == 3);
    CHECK(scene.materials[0].albedo == glm::vec3(0.1f));
    CHECK(scene.materials[1].albedo == glm::vec3(0.2f));
    CHECK(scene.triangles[2].material == 1);
    CHECK(scene.triangles[6].material == 2);
}

namespace {

std::string number_bytes(std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xffu);
    return text;
}
std::string float_bytes(const std::vector<float>& values) {
    std::string text(values.size() * sizeof(float), '\0');
    std::memcpy(text.data(), values.data(), text.size());
    return text;
}

/// A stream of zlib of one block that is not compressed.
std::string stored(const std::string& bytes) {
    return std::string("\x78\x01\x01") + number_bytes(bytes.size(), 2) + number_bytes(0xffff - bytes.size(), 2) +
           bytes + number_bytes(0, 4);
}

/// A mesh of version 4 of two triangles in the plane z, with texture coordinates.
std::string serialized_square(float z, std::uint32_t last = 3) {
    std::string mesh = number_bytes(0x1002, 4) + std::string("name") + '\0' + number_bytes(4, 8) +
                       number_bytes(2, 8) + float_bytes({0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z}) +
                       float_bytes({0, 0, 1, 0, 1, 1, 0, 1});
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, last}) mesh += number_bytes(corner, 4);
    return number_bytes(0x041c, 2) + number_bytes(4, 2) + stored(mesh);
}

std::string serialized_file(const std::vector<std::string>& shapes) {
    std::string file, places;
    for (const std::string& shape : shapes) {
        places += number_bytes(file.size(), 8);
        file += shape;
    }
    return file + places + number_bytes(shapes.size(), 4);
}

std::string serialized_shape(const std::string& more = "") {
    return "<shape type=\"serialized\"><string name=\"filename\" value=\"m.serialized\"/>" + more + "</shape>";
}

}  // namespace

TEST_CASE("mitsuba: serialized meshes, by their number in the file") {
    const TemporaryFolder folder;
    folder.write("m.serialized", serialized_file({serialized_square(0), serialized_square(5)}));
    const SceneDescription first = load(folder, serialized_shape());
    CHECK(normal_and_area(first) == glm::dvec4(0, 0, 1, 1));
    CHECK(first.positions[2] == glm::vec3(1, 1, 0));
    CHECK(first.uvs[2] == glm::vec2(1, 0));  // the first row of an image is at v = 0
    const SceneDescription second = load(folder, serialized_shape("<integer name=\"shape_index\" value=\"1\"/>"));
    CHECK(second.positions[2] == glm::vec3(1, 1, 5));
}

TEST_CASE("mitsuba: damaged serialized meshes are refused with the byte") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& bytes, const std::string& more = "") {
        folder.write("m.serialized", bytes);
        return input_error([&] { load(folder, serialized_shape(more)); });
    };
    const std::string good = serialized_file({serialized_square(0)});
    CHECK_THAT(refused(""), contains("byte 0: expected 2 bytes"));
    CHECK_THAT(refused("abcdefgh"), contains("expected a serialized mesh of version 3 or 4"));
    CHECK_THAT(refused(good, "<integer name=\"shape_index\" value=\"1\"/>"), contains("one of 1 shapes"));
    CHECK_THAT(refused(serialized_file({serialized_square(0, 4)})), contains("indices below 4"));
    CHECK_THAT(refused(serialized_file({serialized_square(NAN)})), contains("a finite number"));
    CHECK_THAT(refused(good.substr(0, 4) + "nothing packed" + good.substr(good.size() - 12)),
               contains("a compressed mesh"));
    for (std::size_t size = 0; size < good.size(); size += 7) CHECK_FALSE(refused(good.substr(0, size)).empty());
}

TEST_CASE("mitsuba: instances are copies of their group, which is not shown itself") {
    const std::string group = "<shape type=\"shapegroup\" id=\"g\">" + kSquare +
                              "<shape type=\"cube\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
                              "value=\"0.2\"/></bsdf></shape></shape>";
    const auto instance = [](const std::string& place) {
        return "<shape type=\"instance\"><ref id=\"g\"/><transform name=\"to_world\">" + place +
               "</transform></shape>";
    };
    const SceneDescription scene = load(group + instance("<translate x=\"5\"/>") + instance("<scale x=\"-2\"/>"));
    CHECK(scene.triangles.size() == 2 * 14);
    CHECK(scene.materials.size() == 2);
    CHECK(scene.triangles[2].material == scene.triangles[16].material);
    CHECK(volume(scene) == Approx(8.0 + 16.0));
    CHECK_THAT(refusal(group + "<shape type=\"instance\"/>"), contains("expected the shapegroup"));
    CHECK_THAT(refusal(group), contains("expected a shape with an area"));
    CHECK_THAT(refusal(group + instance("<scale value=\"1e30\"/>")), contains("expected coordinates up to"));
}
