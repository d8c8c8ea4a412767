#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"
#include "ui/model/edited_materials.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Materials: a file can name the first of each name, and edits of others are known to be missing") {
    auto scene = std::make_shared<SceneDescription>();
    for (const char* name : {"a", "", "a", "b"}) scene->materials.push_back({.name = name});
    EditedMaterials materials(scene);
    REQUIRE(materials.named().size() == 2);
    CHECK(materials.are_edits_named());
    materials.set(3, with_albedo(scene->materials[3], 0.5f));
    CHECK(materials.named()[1].albedo == glm::vec3{0.5f});
    CHECK(materials.are_edits_named());
    materials.set(2, with_albedo(scene->materials[2], 0.5f));
    CHECK(materials.named()[0].albedo == glm::vec3{0.0f});
    CHECK_FALSE(materials.are_edits_named());
}

TEST_CASE("Materials: only what moves no volume leaves the selected one") {
    const MaterialDescription white = with_albedo({}, 0.5f);
    CHECK_FALSE(may_move_volumes(white, with_albedo(white, 0.7f)));
    CHECK(may_move_volumes(white, with_albedo(white, 0.0f)));
    MaterialDescription other = white;
    other.emission.y = 1.0f;
    CHECK(may_move_volumes(white, other));
    other = white;
    other.kind = SurfaceKind::Plastic;
    CHECK(may_move_volumes(white, other));
    CHECK(may_move_volumes(other, with_albedo(other, 0.7f)));
    other = white;
    other.textures.albedo = 0;
    CHECK(may_move_volumes(other, with_albedo(other, 0.7f)));
}
