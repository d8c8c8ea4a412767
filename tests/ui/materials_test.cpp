// Materials that are changed in the window: what is asked, what is refused, what the render thread makes of it.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/measure/picture_identity.h"
#include "tests/support/catch.hpp"
#include "tests/ui/model_bench.h"
#include "ui/edit_queue.h"

using namespace pl;
using namespace pl::test;

namespace {

struct MaterialBench : ModelBench {
    MaterialBench() : ModelBench(16) {}
};

MaterialDescription with_albedo(MaterialDescription material, float value) {
    material.albedo = glm::vec3{value};
    return material;
}

bool told(const ViewerModel& model, const std::string& part) {
    return std::any_of(model.log().begin(), model.log().end(),
                       [&](const LogLine& line) { return line.text.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("Materials: a change reaches the picture, and its scene is another one") {
    MaterialBench bench;
    const auto scene = small_scene();
    ViewerModel model(bench.options, scene, bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    const std::uint64_t before = model.status().picture;
    MaterialDescription coated = with_albedo(scene->materials[0], 0.25f);
    coated.kind = SurfaceKind::Plastic;
    model.set_material(0, coated);
    CHECK(model.materials().is_edited(0));
    CHECK(model.materials().edited_names() == std::vector<std::string>{"floor"});
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0 && model.status().picture != before; }));
    CHECK(model.status().scene->materials[0] == coated);
    SceneDescription changed = *scene;
    changed.materials[0] = coated;
    RenderSettings settings = model.settings();
    CHECK(model.status().picture == picture_key(changed, settings));
    REQUIRE(bench.run_until(model, [&] { return model.frame()->description->materials[0] == coated; }));

    model.restore_material(0);
    CHECK(model.materials().edited_names().empty());
    CHECK(bench.run_until(model, [&] { return model.status().picture == before; }));
}

TEST_CASE("Materials: a bad value is refused with the reason, and the old material stays") {
    MaterialBench bench;
    const auto scene = small_scene();
    ViewerModel model(bench.options, scene, bench.options.settings, 0.0);
    for (const float bad : {-0.1f, 1.1f, NAN}) {
        model.set_material(0, with_albedo(scene->materials[0], bad));
        CHECK(model.materials().now()[0] == scene->materials[0]);
    }
    CHECK(told(model, "material 'floor': albedo"));
    model.set_material(7, scene->materials[0]);  // there is none
    model.restore_material(7);
    model.select_material(7);
    CHECK_FALSE(model.selected_material().has_value());
    REQUIRE(bench.run_until(model, [&] { return model.status().picture != 0; }));
    CHECK(model.status().scene == scene);
}

TEST_CASE("Materials: two of them are changed and restored together") {
    MaterialBench bench;
    const auto scene = small_scene();
    ViewerModel model(bench.options, scene, bench.options.settings, 0.0);
    model.set_material(0, with_albedo(scene->materials[0], 0.1f));
    model.set_material(1, with_albedo(scene->materials[1], 0.2f));
    model.set_material(0, with_albedo(scene->materials[0], 0.3f));
    REQUIRE(bench.run_until(model, [&] {
        return model.status().scene->materials[0].albedo.x == 0.3f &&
               model.status().scene->materials[1].albedo.x == 0.2f;
    }));
    model.restore_materials();
    CHECK(bench.run_until(model, [&] { return model.status().scene->materials == scene->materials; }));
}

TEST_CASE("Materials: references are looked for with the changed scene") {
    MaterialBench bench;
    std::atomic<float> asked{-1.0f};  // looks are made on a thread of their own
    bench.options.find_reference = [&](const OpenScene& scene, const RenderSettings&) {
        asked = scene.description->materials[0].albedo.x;
        return std::shared_ptr<const StoredReference>();
    };
    const auto scene = small_scene();
    ViewerModel model(bench.options, scene, bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return asked == scene->materials[0].albedo.x; }));
    model.set_material(0, with_albedo(scene->materials[0], 0.25f));
    CHECK(bench.run_until(model, [&] { return asked == 0.25f; }));
}

TEST_CASE("Materials: a new scene has those of its file, and pictures of it tell which are others") {
    MaterialBench bench;
    const auto scene = small_scene();
    bench.options.load_scene = [](const std::string&) { return small_scene(); };
    ViewerModel model(bench.options, scene, bench.options.settings, 0.0);
    CHECK(model.picture().edited_materials.empty());
    model.select_material(1);
    model.set_material(0, with_albedo(scene->materials[0], 0.25f));
    CHECK(model.picture().edited_materials == std::vector<std::string>{"floor"});
    model.reload();
    REQUIRE(bench.run_until(model, [&] { return model.materials().edited_names().empty(); }));
    CHECK_FALSE(model.selected_material().has_value());
    CHECK(bench.run_until(model, [&] { return model.status().scene->materials[0].albedo.x == 0.5f; }));
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
