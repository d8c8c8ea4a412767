// No hidden absolute length: a scene multiplied by a power of two gives the same hits, bit by bit. Products of three
// lengths bound the range: by 2^-40 they lose bits, at 2^42 they overflow.
#include "tests/support/catch.hpp"
#include "tests/support/rays/walk.h"

using namespace pl;
using namespace pl::test;

namespace {

SceneDescription make_scene(float scale) {
    SceneDescription scene;
    scene.materials.push_back(gray());
    add_box(scene, {-1, -0.75f, -1.5f}, {1, 0.75f, 1.5f}, true);
    add_spiky_sphere(scene, 8, 8, 0.2f, 0.5f, 3);
    add_box(scene, {-0.9f, -0.75f, -0.5f}, {-0.7f, 0.1f, 0.3f}, false);
    transform(scene, true, 1.0f, {0.3f, 0.1f, -0.2f});
    for (glm::vec3& p : scene.positions) p *= scale;  // exact
    return scene;
}

/// The hits of a walk, with lengths divided by the scale again.
struct Step {
    Hit hit;
    Vec3f position, normal, origin;

    bool same_bits(const Step& other) const {
        return std::bit_cast<std::array<std::uint32_t, 13>>(*this) ==
               std::bit_cast<std::array<std::uint32_t, 13>>(other);
    }
};

std::vector<Step> record_walk(float scale) {
    const HostScene packed = pack_scene(make_scene(scale));
    const SceneView scene = packed.view();
    const BvhIntersector intersector{scene};
    Uniforms random(31);
    std::vector<Step> steps;
    Ray ray{.origin = scale * Vec3f{0.1f, 0.65f, -0.9f}, .direction = {0.6f, 0.0f, 0.8f}};
    while (steps.size() < 20000) {
        Step step{};
        step.hit = intersector.closest_hit(ray);
        if (!step.hit.found()) break;
        const SurfacePoint point = make_surface_point<FeatureSet{}>(scene, step.hit, -ray.direction);
        ray = spawn_ray(point, lambert_sample(point, random.square()));
        step.hit.t /= scale;
        step.position = point.position / scale;
        step.normal = point.geometric_normal;
        step.origin = ray.origin / scale;
        steps.push_back(step);
    }
    return steps;
}

}  // namespace

TEST_CASE("Scaling a scene by a power of two changes no bit of its hits") {
    const std::vector<Step> expected = record_walk(1.0f);
    REQUIRE(expected.size() == 20000);
    for (const int exponent : {-30, -20, -10, 10, 20, 30}) {
        const std::vector<Step> scaled = record_walk(std::ldexp(1.0f, exponent));
        REQUIRE(scaled.size() == expected.size());
        std::size_t same = 0;
        while (same < expected.size() && scaled[same].same_bits(expected[same])) ++same;
        INFO("scaled by 2^" << exponent);
        CHECK(same == expected.size());
    }
}
