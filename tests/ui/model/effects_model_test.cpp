// The table of effects: which are needed and why, and the kernels that serve them.
#include <algorithm>

#include "tests/support/catch.hpp"
#include "tests/ui/fake_backend.h"
#include "ui/model/effects_model.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

/// A frame of a scene whose floor is a mirror.
std::shared_ptr<PublishedFrame> frame_of_mirror() {
    auto scene = std::make_shared<SceneDescription>(*small_scene());
    scene->materials[0].kind = SurfaceKind::Conductor;
    auto frame = std::make_shared<PublishedFrame>();
    frame->description = scene;
    frame->scene = std::make_shared<const HostScene>(pack_scene(*scene));
    frame->backend.name = "cpu";
    frame->settings.next_event = false;
    return frame;
}

}  // namespace

TEST_CASE("Effects: what is needed has a reason") {
    const auto frame = frame_of_mirror();
    EffectsModel model;
    CHECK(model.rows().empty());
    model.update(*frame);
    REQUIRE(model.rows().size() == std::size(kAllFeatures));
    for (const EffectRow& row : model.rows()) {
        INFO(row.name);
        CHECK(row.needed() == (row.name == "specular"));
    }
    const auto specular = std::ranges::find(model.rows(), "specular", &EffectRow::name);
    REQUIRE(specular != model.rows().end());
    CHECK(specular->reason == "of 1 material: floor");
}
