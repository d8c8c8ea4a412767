#include "core/session/placement.h"

#include "core/scene/pack_scene.h"
#include "cpu/cpu_backend.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"

using namespace pl;
using namespace pl::test;

namespace {

struct Placed {
    HostScene scene = pack_scene(shipped_scene("cornell"));
    FieldSettings settings{.volumes = 30, .bins = 16};
    std::shared_ptr<RenderBackend> backend = make_cpu_backend({.threads = 1});
    Placement placement;

    Placed() {
        backend->upload_scene(std::make_shared<const HostScene>(scene));
        placement.ensure(*backend, scene, settings, Camera{});
    }
};

}  // namespace

TEST_CASE("Placement: volumes are placed once, and anew after they were cleared") {
    CHECK(Placement().bins() == 0);
    CHECK(Placement().seconds() == 0.0);
    Placed placed;
    REQUIRE(placed.placement.is_placed());
    CHECK(placed.placement.count() >= 30);
    CHECK(placed.placement.bins() == 16);
    CHECK(placed.placement.seconds() > 0.0);
    const auto volumes = placed.placement.volumes();
    placed.placement.ensure(*placed.backend, placed.scene, placed.settings, Camera{});
    CHECK(placed.placement.volumes() == volumes);
    placed.placement.clear();
    CHECK_FALSE(placed.placement.is_placed());
    CHECK(placed.placement.seconds() == 0.0);
}

TEST_CASE("Placement: added volumes go with the tables that asked for them, others stay") {
    Placed placed;
    placed.placement.count_round();
    placed.placement.undo_refinement();
    CHECK(placed.placement.is_placed());
    CHECK((placed.placement.refinement() == Refinement{}));
    HostVolumes volumes = *placed.placement.volumes();
    placed.placement.refine(*placed.backend, placed.scene, {.volumes = volumes, .parents = {0, 3}});
    CHECK(placed.placement.refinement().added == 2);
    placed.placement.undo_refinement();
    CHECK_FALSE(placed.placement.is_placed());
    CHECK((placed.placement.refinement() == Refinement{}));
}

TEST_CASE("Placement: other materials change the radiance unit, and the volumes only where they would move") {
    Placed placed;
    const float unit = placed.placement.shape().radiance_unit;
    SceneDescription description = shipped_scene("cornell");
    for (MaterialDescription& material : description.materials) material.emission *= 64.0f;
    placed.placement.change_materials(pack_scene(description), placed.settings, true);
    CHECK(placed.placement.is_placed());
    CHECK(placed.placement.shape().radiance_unit > unit);
    placed.placement.change_materials(pack_scene(description), placed.settings, false);
    CHECK_FALSE(placed.placement.is_placed());
}
