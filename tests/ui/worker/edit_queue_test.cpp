#include "tests/catch.hpp"
#include "tests/ui/fake_backend.h"
#include "ui/edit_queue.h"

using namespace pl;
using namespace pl::test;

namespace {

MaterialDescription with_albedo(MaterialDescription material, float value) {
    material.albedo = glm::vec3{value};
    return material;
}

}  // namespace

TEST_CASE("Edit queue: of each kind only the newest is left, in order of its arrival") {
    EditQueue queue;
    CHECK(queue.empty());
    CameraDescription first;
    first.fov_deg = 10.0f;
    CameraDescription second;
    second.fov_deg = 20.0f;
    queue.push(EditCamera{first});
    queue.push(EditScene{nullptr});
    queue.push(EditMethod{MethodId::Precomputed});
    queue.push(EditCamera{second});
    queue.push(EditMethod{MethodId::Reinforcement});
    const auto edits = queue.take();
    CHECK(queue.empty());
    REQUIRE(edits.size() == 3);
    // A camera that follows a scene must be applied after it: a new scene brings its own.
    CHECK(std::holds_alternative<EditScene>(edits[0]));
    REQUIRE(std::holds_alternative<EditCamera>(edits[1]));
    CHECK(std::get<EditCamera>(edits[1]).camera.fov_deg == 20.0f);
    CHECK(std::get<EditMethod>(edits[2]).method == MethodId::Reinforcement);
}

TEST_CASE("Materials: of each only the newest edit waits, and a scene replaces them all") {
    const auto scene = small_scene();
    EditQueue queue;
    queue.push(EditMaterial{0, with_albedo(scene->materials[0], 0.1f)});
    queue.push(EditMaterial{1, with_albedo(scene->materials[1], 0.2f)});
    queue.push(EditMaterial{0, with_albedo(scene->materials[0], 0.3f)});
    queue.push(EditSeed{1});
    auto edits = queue.take();
    REQUIRE(edits.size() == 3);
    CHECK(std::get<EditMaterial>(edits[0]).index == 1);
    CHECK(std::get<EditMaterial>(edits[1]).material.albedo.x == 0.3f);
    queue.push(EditMaterial{5, scene->materials[0]});
    queue.push(EditScene{scene});
    queue.push(EditMaterial{0, scene->materials[0]});
    edits = queue.take();
    REQUIRE(edits.size() == 2);
    CHECK(std::holds_alternative<EditScene>(edits[0]));
}
