#include "core/scene/instances.h"

#include <string>

#include "core/base/error.h"
#include "core/scene/scene_hash.h"
#include "core/scene/triangle_planes.h"
#include "core/scene/validate.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/instanced_meshes.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A floor of two triangles, and a box shown three times.
SceneDescription three_boxes() {
    SceneDescription scene;
    scene.materials.push_back(gray());
    add_quad(scene, add_vertex(scene, {-9, 0, 9}), add_vertex(scene, {9, 0, 9}), add_vertex(scene, {9, 0, -9}),
             add_vertex(scene, {-9, 0, -9}));
    add_box(scene, Vec3f{0.0f}, Vec3f{1.0f}, false);
    make_mesh(scene, 2);
    for (int i = 0; i < 3; ++i) {
        glm::mat4x3 placement(2.0f);
        placement[3] = {2.0f * static_cast<float>(i), 1.0f, 0.0f};
        scene.instances.push_back({0, placement});
    }
    return scene;
}

std::string complaint_of(const SceneDescription& scene) {
    try {
        validate_scene(scene);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

}  // namespace

TEST_CASE("Instances number their triangles behind those that are in the scene directly") {
    const SceneDescription scene = three_boxes();
    CHECK(complaint_of(scene).empty());
    CHECK(direct_triangles(scene) == 2);
    CHECK(shown_triangles(scene) == 2 + 3 * 12);
    const HostScene packed = pack_scene(scene);
    CHECK(packed.triangles.size() == 14);
    CHECK(packed.planes.size() == 2);
    CHECK(packed.bvh_triangles.size() == 2);
    CHECK(packed.mesh_triangles.size() == 12);
    for (std::uint32_t i = 0; i < 3; ++i) {
        CHECK(packed.instances[i].first_primitive == 2 + 12 * i);
        CHECK(packed.instances[i].first_triangle == 2);
        for (const std::uint32_t primitive : {2 + 12 * i, 13 + 12 * i})
            CHECK(&packed.view().instances.instance_of(primitive) == &packed.instances[i]);
    }
}

TEST_CASE("Copies are in the places of instances, in their order") {
    const SceneDescription scene = three_boxes();
    const SceneDescription copied = with_copies(scene);
    CHECK(copied.meshes.empty());
    CHECK(copied.instances.empty());
    REQUIRE(copied.triangles.size() == 2 + 3 * 12);
    CHECK(copied.positions.size() == 4 + 3 * 8);
    for (std::uint32_t i = 0; i < 36; ++i)
        for (int k = 0; k < 3; ++k) {
            const Vec3f corner = scene.positions[scene.triangles[2 + i % 12].vertex[k]];
            const Vec3f expected = 2.0f * corner + Vec3f{2.0f * static_cast<float>(i / 12), 1.0f, 0.0f};
            CHECK(Vec3f{copied.positions[copied.triangles[2 + i].vertex[k]]} == expected);
        }
    const Bounds bounds = bounds_of(scene);
    CHECK(bounds.low == bounds_of(copied).low);
    CHECK(bounds.high == bounds_of(copied).high);
    for (int k = 0; k < 3; ++k)
        CHECK(Vec3f{copied.positions[copied.triangles[1].vertex[k]]} ==
              Vec3f{scene.positions[scene.triangles[1].vertex[k]]});
}

TEST_CASE("Ten thousand instances take the memory of one mesh and of their transformations") {
    SceneDescription scene;
    scene.materials.push_back(gray());
    add_spiky_sphere(scene, 224, 224, 0.9f, 1.0f, 1);
    make_mesh(scene, 0);
    REQUIRE(scene.meshes[0].triangle_count > 99000);
    Uniforms random(2);
    add_instances(scene, random, 1, 100.0f, 1.0f);
    const std::uint64_t one = bytes_of(pack_scene(scene));
    add_instances(scene, random, 9999, 100.0f, 1.0f);
    CHECK(shown_triangles(scene) > 990000000);
    const HostScene packed = pack_scene(scene);
    // 128 bytes and two numbers each, and a hierarchy of two nodes of 32 bytes.
    CHECK(bytes_of(packed) - one <= 10000 * (128 + 8 + 64));
    CHECK(one < scene.meshes[0].triangle_count * 150);
}

TEST_CASE("No edge of an instance is longer than the bound") {
    Uniforms random(9);
    SceneDescription scene;
    scene.materials.push_back(gray());
    add_spiky_sphere(scene, 5, 5, 0.2f, 1.0f, 1);
    make_mesh(scene, 0);
    add_instances(scene, random, 30, 10.0f, 4.0f);
    const HostScene copied = pack_scene(with_copies(scene));
    const double longest = longest_edge(view_of(copied.positions), view_of(copied.triangles));
    const double bound = pack_scene(scene).longest_edge;
    CHECK(bound >= longest);
    CHECK(bound < 2.0 * longest);
}

TEST_CASE("Meshes and instances that do not fit are refused with their place") {
    SceneDescription scene = three_boxes();
    scene.instances[1].mesh = 4;
    CHECK_THAT(complaint_of(scene), contains("instance 1: mesh 4 is out of range, there are 1"));
    scene = three_boxes();
    scene.instances[2].to_world[0] = glm::vec3(0.0f);
    CHECK_THAT(complaint_of(scene), contains("instance 2 of mesh 'mesh'"));
    scene = three_boxes();
    scene.instances[0].to_world[0] *= -1.0f;
    CHECK_THAT(complaint_of(scene), contains("does not mirror"));
    scene = three_boxes();
    scene.meshes[0].triangle_count = 11;
    CHECK_THAT(complaint_of(scene), contains("the last ones of 14"));
    scene = three_boxes();
    scene.materials[0].emission = glm::vec3(1.0f);
    CHECK_THAT(complaint_of(scene), contains("emits light"));
    MaterialDescription lamp = gray();
    lamp.emission = glm::vec3(1.0f);
    CHECK_THROWS_AS(validate_material(lamp, 0, three_boxes()), Error);
}

TEST_CASE("The hash of a scene knows its instances") {
    const SceneDescription scene = three_boxes();
    SceneDescription moved = scene;
    moved.instances[2].to_world[3].x += 1.0f;
    SceneDescription fewer = scene;
    fewer.instances.pop_back();
    CHECK(scene_hash(scene) == scene_hash(three_boxes()));
    CHECK(scene_hash(scene) != scene_hash(moved));
    CHECK(scene_hash(scene) != scene_hash(fewer));
    CHECK(same_triangles(pack_scene(scene), pack_scene(scene)));
    CHECK_FALSE(same_triangles(pack_scene(scene), pack_scene(moved)));
}
