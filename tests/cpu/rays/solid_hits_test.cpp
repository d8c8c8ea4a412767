// Rays through holes: hits of batches are correct, with the bits of single rays, for every intersector.
#include "cpu/rays/solid_hits.h"

#include "core/scene/pack_scene.h"
#include "cpu/rays/batch_tracer.h"
#include "tests/cpu/rays/bvh_batch.h"
#include "tests/cpu/rays/random_rays.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/image_scenes.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A stack of sheets with holes, every second one of which is partly opaque elsewhere.
HostScene sheets() {
    SceneDescription scene = box_scene({});
    for (int i = 0; i < 4; ++i) {
        scene = with_lattices(std::move(scene), Vec3f{-1.0f + 0.1f * static_cast<float>(i)}, Vec3f{1.0f});
        if (i % 2 == 0) continue;
        scene.materials.back().opacity = 0.5f;
        scene.materials.back().opacity_rule = OpacityRule::Blend;
    }
    return pack_scene(scene);
}

template <BatchIntersector I>
void check_holes(const SceneView& scene, const I& intersector) {
    const BvhIntersector single{scene};
    const std::vector<Ray> rays = random_rays(scene, 20000, 1);
    const auto count = static_cast<std::uint32_t>(rays.size());
    SolidHits<kEveryFeature, I> solid(scene, intersector, count);
    RayBatch batch(count);
    for (std::uint32_t i = 0; i < count; ++i) batch.set_ray(i, rays[i]);
    solid.find_closest(batch, count);
    int through = 0;
    int partly = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Hit expected = closest_solid_hit<kEveryFeature>(scene, single, rays[i]);
        REQUIRE(same_bits(batch.hit(i), expected));
        REQUIRE(is_blocked<kEveryFeature>(scene, single, rays[i]) == expected.found());
        if (expected.found()) {
            const float opacity = opacity_at<kEveryFeature>(scene, expected.primitive, hit_weights(expected));
            REQUIRE(opacity > 0.0f);
            partly += opacity < 1.0f ? 1 : 0;
        }
        through += same_bits(expected, single.closest_hit(rays[i])) ? 0 : 1;
    }
    CHECK(through > 1000);
    CHECK(partly > 1000);
}

}  // namespace

TEST_CASE("Batches of rays through holes have the bits of single rays, by every intersector") {
    const HostScene packed = sheets();
    const SceneView scene = packed.view();
    REQUIRE_FALSE(scene.opacities.empty());
    check_holes(scene, BvhBatch(scene));
    check_holes(scene, DenseIntersector(scene));
    check_holes(scene, WideIntersector(scene));
    check_holes(scene, BatchTracer(scene));
}

TEST_CASE("A set without cut-outs finds no more than the closest hits") {
    const HostScene packed = sheets();
    const SceneView scene = packed.view();
    const BvhIntersector single{scene};
    for (const Ray& ray : random_rays(scene, 1000, 2))
        REQUIRE(same_bits(closest_solid_hit<FeatureSet{}>(scene, single, ray), single.closest_hit(ray)));
}

// Behind holes, t and t_max still refer to the origin of the ray.
TEST_CASE("Surfaces behind a hole have their true distance, and those behind the end of a segment are not hit") {
    SceneDescription description;
    description.materials = {gray(), gray()};
    description.materials[1].textures.opacity = 0;
    description.textures.push_back({.width = 1, .height = 1, .texels = {glm::vec4(0.0f)}});
    for (const float z : {1.0f, 2.0f, 3.0f})
        add_triangle(description, Vec3f{-9, -9, z}, Vec3f{9, -9, z}, Vec3f{0, 9, z}, z < 3.0f ? 1u : 0u);
    const HostScene packed = pack_scene(description);
    const BvhIntersector single{packed.view()};
    const Ray unit{.origin = {0, 0, 0}, .direction = {0, 0, 1}};
    const Hit hit = closest_solid_hit<kEveryFeature>(packed.view(), single, unit);
    CHECK(hit.primitive == 2);
    CHECK(hit.t == Approx(3.0f));
    const Ray before{.origin = {0, 0, 0}, .direction = {0, 0, 2.9f}, .t_max = 1.0f};
    const Ray beyond{.origin = {0, 0, 0}, .direction = {0, 0, 3.1f}, .t_max = 1.0f};
    CHECK_FALSE(is_blocked<kEveryFeature>(packed.view(), single, before));
    CHECK(is_blocked<kEveryFeature>(packed.view(), single, beyond));
    const Ray half{.origin = {0, 0, 0}, .direction = {0, 0, 1}, .t_max = 2.5f};
    CHECK_FALSE(is_blocked<kEveryFeature>(packed.view(), single, half));
}
