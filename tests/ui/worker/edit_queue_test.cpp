#include "ui/worker/edit_queue.h"

#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

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
    // A camera edit after a scene edit must be applied after it: a new scene has its own camera.
    CHECK(find_edit<EditScene>(edits[0]));
    REQUIRE(find_edit<EditCamera>(edits[1]));
    CHECK(find_edit<EditCamera>(edits[1])->camera.fov_deg == 20.0f);
    CHECK(std::get<EditMethod>(edits[2]).method == MethodId::Reinforcement);
}

TEST_CASE("Edit queue: of each material only the newest edit is left, and a scene replaces them all") {
    EditQueue queue;
    queue.push(EditMaterial{0, gray(0.1f)});
    queue.push(EditMaterial{1, gray(0.2f)});
    queue.push(EditMaterial{0, gray(0.3f)});
    queue.push(EditSeed{1});
    auto edits = queue.take();
    REQUIRE(edits.size() == 3);
    CHECK(find_edit<EditMaterial>(edits[0])->index == 1);
    CHECK(find_edit<EditMaterial>(edits[1])->material.albedo.x == 0.3f);
    queue.push(EditMaterial{5, gray(0.4f)});
    queue.push(EditScene{nullptr});
    queue.push(EditMaterial{0, gray(0.5f)});
    edits = queue.take();
    REQUIRE(edits.size() == 2);
    CHECK(find_edit<EditScene>(edits[0]));
}

TEST_CASE("Edit queue: every volume that is to be forgotten is left once, until all or another scene's are") {
    EditQueue queue;
    queue.push(EditForgetVolume{MethodId::Reinforcement, 3});
    queue.push(EditForgetVolume{MethodId::Reinforcement, 5});
    queue.push(EditForgetVolume{MethodId::Reinforcement, 3});
    queue.push(EditSeed{1});
    auto edits = queue.take();
    REQUIRE(edits.size() == 3);
    CHECK(find_edit<EditForgetVolume>(edits[0])->volume == 5);
    CHECK(find_edit<EditForgetVolume>(edits[1])->volume == 3);
    queue.push(EditForgetVolume{MethodId::Reinforcement, 3});
    queue.push(EditForget{});
    edits = queue.take();
    REQUIRE(edits.size() == 1);
    CHECK(find_edit<EditForget>(edits[0]));
}
