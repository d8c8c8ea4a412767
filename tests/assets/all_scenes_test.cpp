// All scenes that come with the program: they load without a warning, have a light, are small, and their knobs work.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/io/load_scene.h"
#include "core/scene/scene_hash.h"
#include "tests/support/catch.hpp"
#include "tests/support/files/assets.h"
#include "tests/support/scenes/mesh_properties.h"

using namespace pl;
using namespace pl::test;

namespace {

bool is_lit(const SceneDescription& scene) {
    return scene.environment != glm::vec3(0.0f) || !scene.environment_map.texels.empty() ||
           std::any_of(scene.triangles.begin(), scene.triangles.end(), [&](const TriangleDescription& t) {
               return scene.materials[t.material].emission != glm::vec3(0.0f);
           });
}

std::uintmax_t bytes_of_files(const std::string& name) {
    std::uintmax_t bytes = 0;
    for (const auto& file : std::filesystem::directory_iterator(kAssets / "scenes" / name)) bytes += file.file_size();
    return bytes;
}

/// Points at the same index that differ between two states of a scene.
std::vector<std::size_t> moved_points(const SceneDescription& a, const SceneDescription& b) {
    std::vector<std::size_t> moved;
    for (std::size_t i = 0; i < a.positions.size(); ++i)
        if (a.positions[i] != b.positions[i]) moved.push_back(i);
    return moved;
}

double distance_to_line(const glm::dvec3& p, const glm::dvec3& about, const glm::dvec3& axis) {
    return glm::length(glm::cross(p - about, axis));
}

}  // namespace

TEST_CASE("Every shipped scene loads, is lit, small, and reflects at most 0.9") {
    const std::vector<std::string> names = list_scenes(kAssets);
    CHECK(names == std::vector<std::string>{"bar",           "boxed-lights", "ceiling",   "coats",     "cornell",
                                            "door",          "furnace",      "gallery",   "indirect",  "labyrinth",
                                            "lens",          "living-room",  "open-box",  "pillars",   "plates",
                                            "shelter",       "sky",          "spheres",   "staircase", "still-life",
                                            "textured-room", "thin-wall",    "two-lights"});
    for (const std::string& name : names) {
        CAPTURE(name);
        const SceneDescription scene = load_scene(name, kAssets);
        CHECK(scene.warnings.empty());
        CHECK(is_lit(scene));
        const bool is_picture = name == "bar" || name == "living-room" || name == "still-life";
        CHECK(scene.triangles.size() <= (is_picture ? 60000 : 3000));
        CHECK(bytes_of_files(name) < 5'000'000);
        for (const MaterialDescription& m : scene.materials)
            CHECK(glm::all(glm::lessThanEqual(m.albedo, glm::vec3(0.9f))));
    }
}

// References and learned fields are found again by these: a change that moves one makes them worthless.
TEST_CASE("Scenes that came before textures and surfaces keep their hashes") {
    const std::pair<const char*, const char*> hashes[] = {
        {"boxed-lights", "99c176617b344517"}, {"ceiling", "7952afd48a7d6f30"},   {"cornell", "04bc284b3d5af508"},
        {"door", "731578822fcff38f"},         {"furnace", "6c9f43b588385568"},   {"indirect", "f8b621b754246e08"},
        {"labyrinth", "79803806bce82adf"},    {"open-box", "75f0785aae2b3273"},  {"pillars", "fd1139dda63d6f85"},
        {"shelter", "29805ec1129185e3"},      {"sky", "83c5057cf30d97e7"},       {"staircase", "43a853ab1bae73b9"},
        {"thin-wall", "c1d8564ec8ade5e8"},    {"two-lights", "346d0d5e60b3560b"}};
    for (const auto& [name, hash] : hashes) {
        CAPTURE(name);
        CHECK(scene_hash(load_scene(name, kAssets)) == hash);
    }
}

TEST_CASE("The rooms of the sealed scenes are closed, and seen from inside") {
    for (const char* name : {"boxed-lights", "ceiling", "gallery", "labyrinth", "pillars", "shelter", "staircase",
                             "thin-wall", "two-lights"}) {
        CAPTURE(name);
        const SceneDescription scene = load_scene(name, kAssets);
        const Body room = bodies(scene).front();
        CHECK(open_edges(room).empty());
        const glm::dvec3 eye(scene.camera.eye);
        // Every wall faces the camera, so each cone over a wall has a negative volume.
        for (const TriangleDescription& t : room) CHECK(signed_volume(scene, {t}, eye) < 0.0);
    }
}

TEST_CASE("Every knob changes its scene at both ends of its range, and nothing at its default") {
    std::size_t count = 0;
    for (const std::string& name : list_scenes(kAssets)) {
        const SceneDescription plain = load_scene(name, kAssets);
        for (const KnobDescription& knob : plain.knobs) {
            CAPTURE(name, knob.name);
            ++count;
            const auto hash_at = [&](float value) {
                return scene_hash(load_scene(name, kAssets, {.parameters = {{knob.name, fmt::format("{}", value)}}}));
            };
            CHECK(hash_at(knob.default_value) == scene_hash(plain));
            for (const float end : {knob.low, knob.high})
                if (end != knob.default_value) CHECK(hash_at(end) != scene_hash(plain));
        }
    }
    CHECK(count == 11);
}

TEST_CASE("The door turns about its hinge by the given angle") {
    const SceneDescription plain = load_scene("door", kAssets);
    const SceneDescription wide = load_scene("door", kAssets, {.parameters = {{"opening", "40"}}});
    const std::vector<std::size_t> moved = moved_points(plain, wide);
    CHECK(moved.size() >= 6);  // the corners of the leaf that are not on the hinge
    for (const std::size_t i : moved) {
        const glm::dvec3 hinge(0.47, -1.0, -1.999);
        CHECK(distance_to_line(wide.positions[i], hinge, {0, 1, 0}) ==
              Approx(distance_to_line(plain.positions[i], hinge, {0, 1, 0})).margin(1e-6));
        CHECK(wide.positions[i].y == plain.positions[i].y);
    }
    const Body leaf = bodies(wide)[2];
    for (const TriangleDescription& t : leaf) {
        const glm::dvec3 n = area_vector(wide, t);
        if (n.z < -0.7 * glm::length(n) && std::abs(n.y) < 1e-6)
            CHECK(std::atan2(-n.x, -n.z) * 180.0 / 3.14159265358979 == Approx(40.0).margin(1e-3));
    }
}

TEST_CASE("The thin wall is as thick as given, the lights as far apart") {
    const auto extent = [](const SceneDescription& scene, const Body& body) {
        float low = INFINITY;
        float high = -INFINITY;
        for (const TriangleDescription& t : body) {
            for (int k = 0; k < 3; ++k) {
                low = std::min(low, scene.positions[t.vertex[k]].x);
                high = std::max(high, scene.positions[t.vertex[k]].x);
            }
        }
        return std::pair(low, high);
    };
    const SceneDescription thin = load_scene("thin-wall", kAssets, {.parameters = {{"thickness", "0.001"}}});
    const auto [left, right] = extent(thin, bodies(thin)[2]);
    CHECK(right - left == Approx(0.001).epsilon(1e-4));
    CHECK(right + left == Approx(0.0).margin(1e-8));

    const SceneDescription lights = load_scene("two-lights", kAssets, {.parameters = {{"separation", "5"}}});
    const std::vector<Body> parts = bodies(lights);
    CHECK(extent(lights, parts[3]).second == Approx(-2.5));
    CHECK(extent(lights, parts[4]).first == Approx(2.5));
}
