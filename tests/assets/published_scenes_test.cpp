// The shipped scenes against their sources: the published numbers of the box, closed bodies, fronts to the inside.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/io/load_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/mesh_properties.h"

using namespace pl;
using namespace pl::test;

namespace {

SceneDescription load_published(const std::string& name) {
    SceneDescription scene = load_scene(name, std::filesystem::path(PL_SOURCE_DIR) / "assets");
    CHECK(scene.warnings.empty());
    return scene;
}

const MaterialDescription& material_of(const SceneDescription& scene, const Body& body) {
    for (const TriangleDescription& t : body) {
        CHECK(t.material == body[0].material);
    }
    return scene.materials[body[0].material];
}

/// A quad of the published table: corners so that its front looks into the box or out of a block.
struct Quad {
    std::string material;
    std::vector<glm::dvec3> corners;
};

std::vector<Quad> block(const std::vector<glm::dvec3>& top) {
    std::vector<Quad> quads = {{"white", top}};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 a = top[i];
        const glm::dvec3 b = top[(i + 1) % 4];
        quads.push_back({"white", {a, {a.x, 0, a.z}, {b.x, 0, b.z}, b}});
    }
    return quads;
}

/// In millimeters, with the light lowered by half of one.
std::vector<Quad> published_box() {
    std::vector<Quad> quads = {
        {"white", {{552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2}}},
        {"light", {{343, 548.3, 227}, {343, 548.3, 332}, {213, 548.3, 332}, {213, 548.3, 227}}},
        {"white", {{556, 548.8, 0}, {556, 548.8, 559.2}, {0, 548.8, 559.2}, {0, 548.8, 0}}},
        {"white", {{549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556, 548.8, 559.2}}},
        {"green", {{0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2}}},
        {"red", {{552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}, {556, 548.8, 0}}},
    };
    for (const Quad& quad : block({{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}})) {
        quads.push_back(quad);
    }
    for (const Quad& quad : block({{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}})) {
        quads.push_back(quad);
    }
    return quads;
}

bool is_corner(const Quad& quad, const glm::vec3& p) {
    return std::any_of(quad.corners.begin(), quad.corners.end(),
                       [&](const glm::dvec3& c) { return glm::vec3(c) == p; });
}

}  // namespace

TEST_CASE("Cornell: every published quad is there, with its material, facing the right way") {
    const SceneDescription scene = load_published("cornell");
    CHECK(scene.triangles.size() == 32);
    for (const Quad& quad : published_box()) {
        const glm::dvec3 expected = glm::cross(quad.corners[2] - quad.corners[0], quad.corners[3] - quad.corners[1]);
        glm::dvec3 sum(0.0);
        int count = 0;
        for (const TriangleDescription& t : scene.triangles) {
            const bool belongs = is_corner(quad, scene.positions[t.vertex.x]) &&
                                 is_corner(quad, scene.positions[t.vertex.y]) &&
                                 is_corner(quad, scene.positions[t.vertex.z]);
            if (belongs) {
                CHECK(scene.materials[t.material].name == quad.material);
                sum += area_vector(scene, t);
                ++count;
            }
        }
        CHECK(count == 2);
        // Rounded coordinates: a few float ulps of the area.
        CHECK(glm::length(sum - expected) < 1e-6 * glm::length(expected));
    }
}

TEST_CASE("Cornell: materials and camera as published") {
    const SceneDescription scene = load_published("cornell");
    std::map<std::string, MaterialDescription> materials;
    for (const MaterialDescription& m : scene.materials) {
        materials[m.name] = m;
    }
    REQUIRE(materials.size() == 4);
    CHECK(materials["white"].albedo == glm::vec3(0.725f, 0.71f, 0.68f));
    CHECK(materials["red"].albedo == glm::vec3(0.63f, 0.065f, 0.05f));
    CHECK(materials["green"].albedo == glm::vec3(0.14f, 0.45f, 0.091f));
    CHECK(materials["light"].albedo == glm::vec3(0.0f));
    CHECK(materials["light"].emission == glm::vec3(17, 12, 4));
    CHECK_FALSE(materials["light"].two_sided_emission);
    CHECK(scene.camera.eye == glm::vec3(278, 273, -800));
    CHECK(scene.camera.target.x == 278);
    CHECK(scene.camera.target.y == 273);
    CHECK(scene.camera.target.z > -800);
    CHECK(scene.camera.up == glm::vec3(0, 1, 0));
    // 39.3076 degrees, published rounded to 39.3077.
    CHECK(scene.camera.fov_deg == Approx(2.0 * std::atan(0.0125 / 0.035) * 180.0 / 3.14159265358979).epsilon(1e-5));
}

TEST_CASE("Cornell: bodies share the vertices of their common edges") {
    const SceneDescription scene = load_published("cornell");
    const std::vector<Body> parts = bodies(scene);
    REQUIRE(parts.size() == 4);
    for (const auto& [from, to] : open_edges(parts[0])) {  // the box: open at its front only
        CHECK(scene.positions[from].z == 0.0f);
        CHECK(scene.positions[to].z == 0.0f);
    }
    CHECK(open_edges(parts[0]).size() == 4);
    CHECK(open_edges(parts[1]).size() == 4);  // the light
    const double short_base = 27633.0;        // mm^2, shoelace formula on the published corners
    const double tall_base = 27626.5;
    for (const auto& [body, volume] : {std::pair{parts[2], 165.0 * short_base}, {parts[3], 330.0 * tall_base}}) {
        CHECK(open_edges(body).size() == 4);
        for (const auto& [from, to] : open_edges(body)) {  // the blocks: open at the floor only
            CHECK(scene.positions[from].y == 0.0f);
            CHECK(scene.positions[to].y == 0.0f);
        }
        CHECK(signed_volume(scene, body, {0, 0, 0}) == Approx(volume).epsilon(1e-6));
    }
}

TEST_CASE("Furnace: one closed body, fronts inside, whose radiance is 1") {
    const SceneDescription scene = load_published("furnace");
    CHECK(scene.triangles.size() == 12);
    const std::vector<Body> parts = bodies(scene);
    REQUIRE(parts.size() == 1);
    CHECK(open_edges(parts[0]).empty());
    CHECK(signed_volume(scene, parts[0], {0, 0, 0}) == Approx(-2.0 * 1.5 * 3.0));
    const MaterialDescription& m = material_of(scene, parts[0]);
    CHECK(m.emission / (1.0f - m.albedo) == glm::vec3(1.0f));
    CHECK(m.albedo == glm::vec3(0.5f));
    const glm::vec3 eye = glm::abs(scene.camera.eye);
    CHECK(glm::all(glm::lessThan(eye, glm::vec3(1.0f, 0.75f, 1.5f))));
}

TEST_CASE("Door: a closed room and a closed door, the lamp behind it") {
    const SceneDescription scene = load_published("door");
    CHECK(scene.triangles.size() == 36);
    const std::vector<Body> parts = bodies(scene);
    REQUIRE(parts.size() == 4);
    const Body& room = parts[0];
    const Body& lamp = parts[1];
    const Body& door = parts[2];
    const Body& cube = parts[3];

    CHECK(open_edges(room).empty());
    CHECK(signed_volume(scene, room, {0, 0, 0}) == Approx(-2.0 * 2.0 * 3.0));
    CHECK(material_of(scene, room).albedo == glm::vec3(0.75f));
    CHECK(open_edges(door).empty());
    CHECK(signed_volume(scene, door, {0, 0, 0}) == Approx(0.98 * 1.5 * 0.036).epsilon(1e-4));  // corners to 1e-6
    CHECK(material_of(scene, door).name == "blue");

    CHECK(material_of(scene, lamp).emission == glm::vec3(8.0f));
    CHECK(material_of(scene, lamp).albedo == glm::vec3(0.0f));
    glm::dvec3 lamp_area(0.0);
    for (const TriangleDescription& t : lamp) {
        lamp_area += 0.5 * area_vector(scene, t);
    }
    CHECK(lamp_area.z == Approx(0.93 * 1.5));
    CHECK(glm::length(lamp_area) == Approx(0.93 * 1.5));

    CHECK(open_edges(cube).size() == 4);
    for (const auto& [from, to] : open_edges(cube)) {
        CHECK(scene.positions[from].y == -1.0f);
        CHECK(scene.positions[to].y == -1.0f);
    }
    CHECK(signed_volume(scene, cube, {0, -1, 0}) == Approx(0.4 * 0.4 * 0.4));
    CHECK(glm::all(glm::lessThan(glm::abs(scene.camera.eye - glm::vec3(0, 0, -0.5f)), glm::vec3(1, 1, 1.5f))));
}

TEST_CASE("Door: it is ajar by 17.9 degrees, hangs free, and leaves everything inside the room") {
    const SceneDescription scene = load_published("door");
    const std::vector<Body> parts = bodies(scene);
    for (std::size_t part = 1; part < parts.size(); ++part) {
        for (const TriangleDescription& t : parts[part]) {
            for (int k = 0; k < 3; ++k) {
                const glm::vec3 p = scene.positions[t.vertex[k]];
                CHECK(glm::all(glm::lessThanEqual(glm::abs(p - glm::vec3(0, 0, -0.5f)), glm::vec3(1, 1, 1.5f))));
                if (part == 2) {
                    CHECK(p.y > -1.0f);
                    CHECK(p.z > -2.0f);
                }
            }
        }
    }
    // The lamp's side of the door is the large face that looks to the wall.
    for (const TriangleDescription& t : parts[2]) {
        const glm::dvec3 n = area_vector(scene, t);
        if (n.z < -0.9 * glm::length(n)) {
            CHECK(std::atan2(-n.x, -n.z) * 180.0 / 3.14159265358979 == Approx(17.9).margin(1e-3));
        }
    }
}
