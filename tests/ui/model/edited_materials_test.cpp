#include "tests/support/catch.hpp"
#include "ui/model/edited_materials.h"

using namespace pl;

namespace {

MaterialDescription with_albedo(MaterialDescription material, float value) {
    material.albedo = glm::vec3{value};
    return material;
}

}  // namespace

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
