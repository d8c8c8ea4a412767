// The default camera: it sees the whole model, fills the picture, is level, and looks from a good side.
#include "core/io/frame_camera.h"

#include <cmath>

#include "core/io/obj.h"
#include "core/scene/instances.h"
#include "core/scene/up_axis.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

const Vec3f kX{1.0f, 0.0f, 0.0f};
const Vec3f kY{0.0f, 1.0f, 0.0f};
const Vec3f kZ{0.0f, 0.0f, 1.0f};

SceneDescription box(Vec3f low, Vec3f high) {
    SceneDescription scene;
    scene.materials = {gray()};
    add_box(scene, low, high, false);
    return scene;
}

/// Largest |x| or |y| of a vertex in the picture, 1 at its edges; infinite if a vertex is behind the camera.
double extent_in_picture(const SceneDescription& scene, const CameraDescription& camera) {
    const glm::dvec3 eye(camera.eye);
    const glm::dvec3 back = glm::normalize(eye - glm::dvec3(camera.target));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(camera.up), back));
    const glm::dvec3 up = glm::cross(back, right);
    const double tangent = std::tan(0.5 * static_cast<double>(camera.fov_deg) * 3.14159265358979 / 180.0);
    double most = 0.0;
    for (const TriangleDescription& triangle : scene.triangles)
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 p = glm::dvec3(scene.positions[triangle.vertex[k]]) - eye;
            const double depth = -glm::dot(p, back);
            if (!(depth > 0.0)) return INFINITY;
            most = std::max({most, std::abs(glm::dot(p, right)) / (depth * tangent),
                             std::abs(glm::dot(p, up)) / (depth * tangent)});
        }
    return most;
}

Vec3f backward(const CameraDescription& camera) { return glm::normalize(camera.eye - camera.target); }

/// Walls of a room of thickness 0.1, open towards +z, with a block in it. Closed surfaces, fronts outwards.
SceneDescription walls() {
    SceneDescription scene = box({-2.0f, -0.1f, -2.0f}, {2.0f, 0.0f, 2.0f});
    add_box(scene, {-2.0f, 3.0f, -2.0f}, {2.0f, 3.1f, 2.0f}, false);
    add_box(scene, {-2.1f, -0.1f, -2.0f}, {-2.0f, 3.1f, 2.0f}, false);
    add_box(scene, {2.0f, -0.1f, -2.0f}, {2.1f, 3.1f, 2.0f}, false);
    add_box(scene, {-2.1f, -0.1f, -2.1f}, {2.1f, 3.1f, -2.0f}, false);
    add_box(scene, {-0.5f, 0.0f, -0.5f}, {0.5f, 1.0f, 0.5f}, false);
    return scene;
}

}  // namespace

TEST_CASE("The framing camera sees the whole of a scene, and fills the picture with it") {
    const Vec3f size = GENERATE(Vec3f(1, 1, 1), Vec3f(0.1f, 2, 0.3f), Vec3f(5, 0.1f, 4), Vec3f(1e6f, 2e6f, 1e6f),
                                Vec3f(1e-5f, 1e-5f, 3e-5f), Vec3f(0.01f, 0.01f, 8));
    const float fov_deg = GENERATE(5.0f, 40.0f, 120.0f);
    for (const Vec3f up : {kX, kY, kZ}) {
        SceneDescription scene = box(-0.4f * size, 0.6f * size);
        scene.up = up;
        const CameraDescription camera = frame_camera(scene, fov_deg);
        CAPTURE(size.x, size.y, size.z, fov_deg, up.y, up.z);
        CHECK(camera.up == up);
        CHECK(camera.fov_deg == fov_deg);
        const double extent = extent_in_picture(scene, camera);
        CHECK(extent < 0.91);
        if (fov_deg < 100.0f) CHECK(extent > 0.89);  // wider ones keep away from the surface
    }
}

TEST_CASE("A tiny scene far from the origin is in the picture, too") {
    for (const float offset : {1e2f, 1e4f, 1e6f}) {
        const float size = 30.0f * offset * 0x1p-23f;
        const SceneDescription scene = box(Vec3f{offset}, Vec3f{offset + size});
        CHECK(extent_in_picture(scene, frame_camera(scene)) < 1.0);
    }
}

TEST_CASE("A model is seen in three-quarter view from slightly above") {
    for (const Vec3f up : {kX, kY, kZ}) {
        SceneDescription scene = box(Vec3f{-1.0f}, Vec3f{1.0f});
        scene.up = up;
        const Vec3f front = up == kZ ? -kY : kZ;
        const Vec3f back = backward(frame_camera(scene));
        CHECK(glm::dot(back, up) == Approx(std::sin(20.0 * 3.14159265 / 180.0)).margin(1e-3));
        CHECK(glm::dot(back, front) == Approx(std::cos(0.34907) * std::cos(35.0 * 3.14159265 / 180.0)).margin(1e-3));
        CHECK(glm::dot(back, glm::cross(up, front)) > 0.5f);
    }
    const SceneDescription flat = box({-1.0f, 0.0f, -1.0f}, {1.0f, 0.2f, 1.0f});
    CHECK(backward(frame_camera(flat)).y == Approx(std::sin(40.0 * 3.14159265 / 180.0)).margin(1e-3));
}

TEST_CASE("An open surface is seen from its front side") {
    for (const float side : {1.0f, -1.0f}) {
        SceneDescription poster;
        poster.materials = {gray()};
        for (const Vec3f p : {Vec3f(-1, 1, 0), Vec3f(1, 1, 0), Vec3f(1, 3, 0), Vec3f(-1, 3, 0)})
            add_vertex(poster, {side * p.x, p.y, p.z});
        add_quad(poster, 0, 1, 2, 3);
        CHECK(side * backward(frame_camera(poster)).z > 0.5f);

        SceneDescription wall;
        wall.materials = {gray()};
        for (const Vec3f p : {Vec3f(0, 1, 1), Vec3f(0, 1, -1), Vec3f(0, 3, -1), Vec3f(0, 3, 1)})
            add_vertex(wall, {p.x, p.y, side * p.z});
        add_quad(wall, 0, 1, 2, 3);
        CHECK(side * backward(frame_camera(wall)).x > 0.5f);
    }
}

TEST_CASE("A box that is open on one side is looked into, straight on") {
    const SceneDescription cornell = load_obj(std::string(PL_SOURCE_DIR) + "/assets/scenes/cornell/cornell.obj");
    CHECK(open_side(cornell) == -kZ);
    CHECK(backward(frame_camera(cornell)) == -kZ);
    CHECK(extent_in_picture(cornell, frame_camera(cornell)) < 0.91);

    // Walls of any thickness, opened towards any side.
    const SceneDescription room = walls();
    CHECK(open_side(room) == kZ);
    SceneDescription turned = room;
    for (glm::vec3& p : turned.positions) p = {p.z, p.y, -p.x};
    CHECK(open_side(turned) == kX);
    for (glm::vec3& p : turned.positions) p = {-p.x, p.y, -p.z};
    CHECK(open_side(turned) == -kX);
    SceneDescription lifted = room;
    for (glm::vec3& p : lifted.positions) p = {p.x, -p.z, p.y};
    lifted.up = kZ;
    CHECK(open_side(lifted) == -kY);
}

TEST_CASE("A closed box, a table and a plane have no open side") {
    CHECK_FALSE(open_side(box(Vec3f{-1.0f}, Vec3f{1.0f})).has_value());
    const SceneDescription furnace = load_obj(std::string(PL_SOURCE_DIR) + "/assets/scenes/furnace/furnace.obj");
    CHECK_FALSE(open_side(furnace).has_value());
    SceneDescription table = box({-0.8f, 0.7f, -0.5f}, {0.8f, 0.75f, 0.5f});
    for (const float x : {-0.8f, 0.7f})
        for (const float z : {-0.5f, 0.4f}) add_box(table, {x, 0.0f, z}, {x + 0.1f, 0.7f, z + 0.1f}, false);
    CHECK_FALSE(open_side(table).has_value());
    SceneDescription plane;
    plane.materials = {gray()};
    for (const Vec3f p : {Vec3f(-1, 0, -1), Vec3f(-1, 0, 1), Vec3f(1, 0, 1), Vec3f(1, 0, -1)}) add_vertex(plane, p);
    add_quad(plane, 0, 1, 2, 3);
    CHECK_FALSE(open_side(plane).has_value());
}

TEST_CASE("Instances are in the picture, as boxes") {
    SceneDescription scene = box({-1, -1, -1}, {1, 1, 1});
    scene.meshes = {{"box", 0, static_cast<std::uint32_t>(scene.triangles.size())}};
    scene.instances = {{0, glm::mat4x3(2, 0, 0, 0, 1, 0, 0, 0, 1, 5, 0, 0)}, {0, glm::mat4x3(1.0f)}};
    SceneDescription copied = scene;
    expand_instances(copied);
    scene.up = copied.up = guess_up(scene);
    CHECK(scene.up == guess_up(copied));
    const CameraDescription camera = frame_camera(scene);
    const CameraDescription other = frame_camera(copied);
    CHECK(glm::distance(camera.eye, other.eye) < 1e-4f);
    CHECK(glm::distance(camera.target, other.target) < 1e-4f);
    CHECK(extent_in_picture(copied, camera) == Approx(0.9));
}
