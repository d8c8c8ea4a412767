// Shapes of Mitsuba scenes: built-in ones, meshes of files, their transformations and instances.
#include "core/io/mitsuba/shapes.h"

#include <cmath>
#include <cstring>

#include <glm/gtc/constants.hpp>

#include "tests/core/io/mitsuba/mitsuba_text.h"

using namespace pl;
using namespace pl::test;

namespace {

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

std::string one_shape(const std::string& packed) { return number_bytes(0x041c, 2) + number_bytes(4, 2) + packed; }

/// A mesh of version 4 of two triangles in the plane z, with texture coordinates.
std::string serialized_square(float z, std::uint32_t last = 3) {
    std::string mesh = number_bytes(0x1002, 4) + std::string("name") + '\0' + number_bytes(4, 8) +
                       number_bytes(2, 8) + float_bytes({0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z}) +
                       float_bytes({0, 0, 1, 0, 1, 1, 0, 1});
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, last}) mesh += number_bytes(corner, 4);
    return one_shape(stored(mesh));
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

TEST_CASE("mitsuba: rectangle, cube, disk and sphere, with their fronts outwards") {
    CHECK(normal_and_area(load_mitsuba_text(kSquare)) == glm::dvec4(0, 0, 4, 4));
    const SceneDescription cube = load_mitsuba_text("<shape type=\"cube\"/>");
    CHECK(volume(cube) == Approx(8.0));
    // On the face towards +z images lie on their side: upwards in them is -x.
    for (const TriangleDescription& t : cube.triangles)
        for (int k = 0; k < 3; ++k)
            if (t.vertex.x / 4 == 3) {
                const glm::vec3& p = cube.positions[t.vertex[k]];
                CHECK(cube.uvs[t.uv[k]] == 0.5f * (glm::vec2(p.y, -p.x) + 1.0f));
            }
    const glm::dvec4 disk = normal_and_area(load_mitsuba_text("<shape type=\"disk\"/>"));
    CHECK(disk.z == Approx(glm::pi<double>()).epsilon(1e-5));
    CHECK(disk.w == Approx(glm::pi<double>()).epsilon(1e-5));
    const SceneDescription ball = load_mitsuba_text("<shape type=\"sphere\"><point name=\"center\" x=\"1\" y=\"2\" "
                                                    "z=\"3\"/><float name=\"radius\" value=\"2\"/></shape>");
    CHECK(volume(ball) == Approx(32.0 / 3.0 * glm::pi<double>()).epsilon(2e-4));
    CHECK(normal_and_area(ball).w == Approx(16.0 * glm::pi<double>()).epsilon(1e-5));
    CHECK(is_told(ball, "spheres are fine meshes of their area"));
    float farthest = 0.0f;
    for (const TriangleDescription& t : ball.triangles)
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 offset = ball.positions[t.vertex[k]] - glm::vec3(1, 2, 3);
            farthest = std::max(farthest, std::abs(glm::length(offset) - 2.0f));
            farthest = std::max(farthest, glm::distance(glm::normalize(offset), ball.normals[t.normal[k]]));
        }
    CHECK(farthest < 2e-4f);
}

TEST_CASE("mitsuba: texture coordinates of a disk are those of its points, in a ring and around") {
    const SceneDescription disk = load_mitsuba_text("<shape type=\"disk\"/>");
    for (const TriangleDescription& t : disk.triangles) {
        glm::dvec2 p(0.0), uv(0.0);
        for (int k = 0; k < 3; ++k) {
            p += glm::dvec2(disk.positions[t.vertex[k]]) / 3.0;
            uv += glm::dvec2(disk.uvs[t.uv[k]]) / 3.0;
        }
        CHECK(std::abs(uv.x - glm::length(p)) < 1e-3);
        const double turn = std::atan2(p.y, p.x) / (2.0 * glm::pi<double>());
        CHECK(std::abs(1.0 - uv.y - (turn < 0.0 ? turn + 1.0 : turn)) < 1e-3);
    }
}

TEST_CASE("mitsuba: spheres and disks have their area, and the fewer triangles the more there are or if they emit") {
    const auto balls = [](int count, const std::string& inside) {
        std::string text;
        for (int i = 0; i < count; ++i) text += "<shape type=\"sphere\">" + inside + "</shape>";
        return text;
    };
    const std::string light = "<emitter type=\"area\"/>";
    // Both ends of each range, except ranges of thousands.
    const struct {
        std::string content;
        int balls;
        std::size_t triangles;
    } cases[] = {{balls(16, ""), 16, 65024},
                 {balls(17, ""), 17, 16128},
                 {balls(101, ""), 101, 3968},
                 {balls(4, light), 4, 3968},
                 {balls(5, light), 5, 960},
                 {balls(101, light), 101, 224},
                 {balls(1, "") + "<shape type=\"shapegroup\" id=\"g\">" + balls(16, "") + "</shape>", 1, 16128}};
    for (const auto& expected : cases) {
        const SceneDescription scene = load_mitsuba_text(expected.content);
        CHECK(scene.triangles.size() == expected.triangles * static_cast<std::size_t>(expected.balls));
        CHECK(normal_and_area(scene).w == Approx(4.0 * glm::pi<double>() * expected.balls).epsilon(1e-5));
    }
    CHECK(load_mitsuba_text("<shape type=\"disk\"/>").triangles.size() == 256);
    const SceneDescription lamp = load_mitsuba_text("<shape type=\"disk\">" + light + "</shape>");
    CHECK(lamp.triangles.size() == 64);
    CHECK(normal_and_area(lamp).w == Approx(glm::pi<double>()).epsilon(1e-5));
    // Every instance of a group that emits is a copy, before its group or behind it.
    const std::string shown = "<shape type=\"instance\"><ref id=\"g\"/></shape>";
    const SceneDescription copies = load_mitsuba_text(shown + "<shape type=\"shapegroup\" id=\"g\">" +
                                                      balls(2, light) + "</shape>" + shown + shown);
    CHECK(copies.triangles.size() == 6 * 960);
}

TEST_CASE("mitsuba: transformations in their order, of both spellings, mirrored and flipped fronts") {
    const auto square = [](const std::string& transform) {
        return load_mitsuba_text("<shape type=\"rectangle\"><transform name=\"toWorld\">" + transform +
                                 "</transform></shape>");
    };
    const SceneDescription moved = square("<scale value=\"2\"/><rotate x=\"1\" angle=\"90\"/><translate y=\"5\"/>");
    const glm::dvec4 facing = normal_and_area(moved);
    CHECK(facing.w == Approx(16.0));
    CHECK(facing.y == Approx(-16.0));
    CHECK(moved.positions[0].y == Approx(5.0f));
    CHECK(normal_and_area(square("<scale x=\"-1\" y=\"1\" z=\"1\"/>")).z == Approx(4.0));
    CHECK(normal_and_area(square("<matrix value=\"1 0 0 7 0 1 0 0 0 0 1 0 0 0 0 1\"/>")).z == Approx(4.0));
    CHECK(square("<matrix value=\"1 0 0 7 0 1 0 0 0 0 1 0 0 0 0 1\"/>").positions[0].x == 6.0f);
    CHECK(square("<matrix value=\"2 0 0 0 3 0 0 0 1\"/>").positions[0] == glm::vec3(-2, -3, 0));
    CHECK(normal_and_area(
              load_mitsuba_text("<shape type=\"rectangle\"><boolean name=\"flip_normals\" value=\"true\"/></shape>"))
              .z == Approx(-4.0));
}

TEST_CASE("mitsuba: mirrored spheres, and meshes without normals, turn inside out, others keep their front") {
    const auto mirrored = [](const std::string& type) {
        return load_mitsuba_text("<shape type=\"" + type +
                                 "\"><transform name=\"to_world\"><scale x=\"-1\"/></transform></shape>");
    };
    CHECK(volume(mirrored("sphere")) < 0.0);
    CHECK(volume(mirrored("cube")) > 0.0);
    const TemporaryFolder folder;
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    folder.write("corners.obj", corners + "f 1 2 3\n");
    folder.write("normals.obj", corners + "vn 0 0 1\nf 1//1 2//1 3//1\n");
    const auto facing = [&](const std::string& name, const std::string& more = "") {
        return normal_and_area(load_mitsuba_text(folder, "<shape type=\"obj\"><string name=\"filename\" value=\"" +
                                                             name +
                                                             "\"/><transform name=\"to_world\"><scale x=\"-1\"/>"
                                                             "</transform>" +
                                                             more + "</shape>"))
            .z;
    };
    CHECK(facing("corners.obj") == Approx(-0.5));
    CHECK(facing("normals.obj") == Approx(0.5));
    CHECK(facing("normals.obj", "<boolean name=\"face_normals\" value=\"true\"/>") == Approx(-0.5));
    CHECK(facing("corners.obj", "<boolean name=\"flip_normals\" value=\"true\"/>") == Approx(0.5));
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
        return load_mitsuba_text(folder, "<shape type=\"" + type + "\"><string name=\"filename\" value=\"m/" + name +
                                             "\"/>" + more + "</shape>");
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
    const SceneDescription plain = load_mitsuba_text(folder, shape("bytes.ply", "<bsdf type=\"diffuse\"/>"));
    CHECK(plain.vertex_colors.empty());
    const SceneDescription scene = load_mitsuba_text(folder, kSquare + shape("bytes.ply", painted) + kSquare);
    REQUIRE(scene.vertex_colors.size() == scene.positions.size());
    CHECK(scene.materials[scene.triangles[2].material].albedo == glm::vec3(1.0f));
    const glm::uvec3 corners = scene.triangles[2].vertex;
    CHECK(scene.vertex_colors[corners.x] == glm::vec3(1.0f, 0.2f, 0.0f));
    CHECK(scene.vertex_colors[corners.y] == glm::vec3(0.0f, 0.0f, 1.0f));
    CHECK(scene.vertex_colors[corners.z] == glm::vec3(0.4f, 0.0f, 0.0f));
    for (const std::size_t other : {0, 3})
        CHECK(scene.vertex_colors[scene.triangles[other].vertex.x] == glm::vec3(1.0f));
    const SceneDescription copies =
        load_mitsuba_text(folder, "<shape type=\"shapegroup\" id=\"g\">" + shape("bytes.ply", painted) +
                                      "</shape><shape type=\"instance\"><ref id=\"g\"/></shape>" + kSquare);
    REQUIRE(copies.vertex_colors.size() == copies.positions.size());
    CHECK(copies.vertex_colors[copies.triangles[0].vertex.x] == glm::vec3(1.0f, 0.2f, 0.0f));
    const SceneDescription wide = load_mitsuba_text(folder, shape("floats.ply", painted));
    CHECK(wide.vertex_colors == std::vector<glm::vec3>{{1, 0.25f, 0}, {0, 0, 0}, {0, 0, 1}});
    CHECK(is_told(wide, "colors of vertices outside of [0, 1]"));
    CHECK(is_told(load_mitsuba_text("<shape type=\"rectangle\">" + painted + "</shape>"),
                  "white on shapes without such"));
}

TEST_CASE("mitsuba: serialized meshes, by their number in the file") {
    const TemporaryFolder folder;
    folder.write("m.serialized", serialized_file({serialized_square(0), serialized_square(5)}));
    const SceneDescription first = load_mitsuba_text(folder, serialized_shape());
    CHECK(normal_and_area(first) == glm::dvec4(0, 0, 1, 1));
    CHECK(first.positions[2] == glm::vec3(1, 1, 0));
    CHECK(first.uvs[2] == glm::vec2(1, 0));  // the first row of an image is at v = 0
    const SceneDescription second =
        load_mitsuba_text(folder, serialized_shape("<integer name=\"shape_index\" value=\"1\"/>"));
    CHECK(second.positions[2] == glm::vec3(1, 1, 5));
}

TEST_CASE("mitsuba: damaged serialized meshes are refused with the byte") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& bytes, const std::string& more = "") {
        folder.write("m.serialized", bytes);
        return input_error([&] { load_mitsuba_text(folder, serialized_shape(more)); });
    };
    const std::string good = serialized_file({serialized_square(0)});
    CHECK_THAT(refused(""), contains("byte 0: expected 2 bytes"));
    CHECK_THAT(refused("abcdefgh"), contains("expected a serialized mesh of version 3 or 4"));
    CHECK_THAT(refused(good, "<integer name=\"shape_index\" value=\"1\"/>"), contains("one of 1 shapes"));
    CHECK_THAT(refused(serialized_file({serialized_square(0, 4)})), contains("indices below 4"));
    CHECK_THAT(refused(serialized_file({serialized_square(NAN)})), contains("a finite number"));
    CHECK_THAT(refused(good.substr(0, 4) + "nothing packed" + good.substr(good.size() - 12)),
               contains("a compressed mesh"));
    // A block of the kind that does not exist, for which the library gives no reason.
    CHECK_THAT(refused(serialized_file({one_shape("\x78\x01\x07")})), contains("a compressed mesh"));
    // Counts that the packed bytes cannot hold take no memory.
    const auto counts = [&](std::uint64_t vertices, std::uint64_t triangles) {
        return refused(serialized_file({one_shape(stored(number_bytes(0, 4) + std::string(1, '\0') +
                                                         number_bytes(vertices, 8) + number_bytes(triangles, 8)))}));
    };
    CHECK_THAT(counts(std::uint64_t{1} << 24, 0), contains("expected counts that fit into"));
    CHECK_THAT(counts(std::uint64_t{1} << 62, std::uint64_t{1} << 62), contains("expected counts that fit into"));
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
    const SceneDescription scene =
        load_mitsuba_text(group + instance("<translate x=\"5\"/>") + instance("<scale x=\"-2\"/>"));
    CHECK(scene.triangles.size() == 2 * 14);
    CHECK(scene.materials.size() == 2);
    CHECK(scene.triangles[2].material == scene.triangles[16].material);
    CHECK(volume(scene) == Approx(8.0 + 16.0));
    CHECK_THAT(refusal(group + "<shape type=\"instance\"/>"), contains("expected the shapegroup"));
    CHECK_THAT(refusal(group), contains("expected a shape with an area"));
    CHECK_THAT(refusal(group + instance("<scale value=\"1e30\"/>")), contains("expected coordinates up to"));
}
