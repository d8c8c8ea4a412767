// The effects that a scene needs, against a look at each material of random descriptions; and that absent effects
// take no memory.
#include "core/scene/needed_effects.h"

#include "core/scene/pack_scene.h"
#include "core/scene/surface_info.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A box of a few materials, each diffuse two times out of three.
SceneDescription random_scene(Uniforms& random) {
    SceneDescription scene;
    const std::uint32_t materials = 1 + random.below(3);
    for (std::uint32_t i = 0; i < materials; ++i) {
        MaterialDescription material = gray();
        if (random.below(3) == 0) material.kind = kSurfaces[random.below(kSurfaces.size())].choice.value;
        if (material.kind == SurfaceKind::Dielectric && random.below(2) == 0) material.absorption = glm::vec3(1.0f);
        // One table for all, so that packing stays quick.
        if (material.kind == SurfaceKind::Conductor && random.below(2) == 0) material.roughness = 0.5f;
        if (i == 0) material.anisotropy = 0.5f;
        scene.materials.push_back(material);
    }
    for (std::uint32_t i = 0; i < 4; ++i)
        add_triangle(scene, random.cube(-1, 1), random.cube(-1, 1), random.cube(-1, 1), random.below(materials));
    if (random.below(4) == 0) {
        MaterialDescription& material = scene.materials[scene.triangles.back().material];
        material.opacity = 0.9f;
        material.opacity_rule = OpacityRule::Blend;
    }
    if (random.below(4) == 0 && materials == 2) {
        scene.materials[0].blend = {.other = 1, .share = 0.5f};
        scene.triangles.front().material = 0;
    }
    if (random.below(3) == 0) scene.environment = Vec3f{0.5f};
    if (random.below(3) == 0) {
        scene.normals = {Vec3f{0, 1, 0}};
        scene.triangles.front().normal = {0, 0, 0};
    }
    if (random.below(4) == 0) scene.sun.radiance = Vec3f{10.0f};
    return scene;
}

FeatureSet needed_by_look(const SceneDescription& scene) {
    FeatureSet set;
    for (const MaterialDescription& m : scene.materials) {
        if (m.opacity < 1.0f) set = set.with(Feature::CutOuts);
        if (m.blend.is_any()) set = set.with(Feature::Blends);
        if (m.kind == SurfaceKind::Diffuse) continue;
        set = set.with(m.roughness > 0.0f ? Feature::Rough : Feature::Specular);
        if (m.kind == SurfaceKind::Plastic) set = set.with(Feature::Plastic);
        if (m.kind == SurfaceKind::Pane) set = set.with(Feature::ThinPanes);
        if (m.kind == SurfaceKind::Velvet) set = set.with(Feature::Velvet);
        if (m.absorbs()) set = set.with(Feature::Absorption);
    }
    if (scene.environment != glm::vec3{0.0f}) set = set.with(Feature::Environment);
    if (scene.sun.radiance != glm::vec3{0.0f}) set = set.with(Feature::EnvironmentMap);
    for (const TriangleDescription& t : scene.triangles)
        if (scene.materials[t.material].kind == SurfaceKind::Conductor &&
            scene.materials[t.material].roughness > 0.0f && scene.materials[t.material].anisotropy > 0.0f)
            set = set.with(Feature::Anisotropy);
    for (const TriangleDescription& t : scene.triangles)
        if (t.normal.x != TriangleDescription::kNoNormal) set = set.with(Feature::SmoothNormals);
    return set;
}

}  // namespace

TEST_CASE("The scan of a scene finds the effects of all its materials") {
    Uniforms random(1);
    std::uint32_t seen = 0;
    for (int i = 0; i < 60; ++i) {
        const SceneDescription scene = random_scene(random);
        const FeatureSet needed = needed_effects(pack_scene(scene));
        CHECK(needed == needed_by_look(scene));
        seen |= needed.bits;
    }
    // All but light samples, images, the lens and instances, which the random scenes have none of.
    CHECK(seen == features(Feature::SmoothNormals, Feature::Environment, Feature::Specular, Feature::Rough,
                           Feature::Plastic, Feature::CutOuts, Feature::EnvironmentMap, Feature::Absorption,
                           Feature::ThinPanes, Feature::Blends, Feature::Anisotropy, Feature::Velvet)
                      .bits);
}

TEST_CASE("Effects that a scene does not need take no memory") {
    SceneDescription scene;
    scene.materials = {gray()};
    add_box(scene, Vec3f{-1.0f}, Vec3f{1.0f}, true);
    const HostScene packed = pack_scene(scene);
    CHECK(packed.normals.capacity() == 0);
    CHECK(packed.triangle_normals.capacity() == 0);
    CHECK(packed.lobes.capacity() == 0);
    CHECK(packed.directional_albedo.capacity() == 0);
    CHECK(packed.absorption.capacity() == 0);
    CHECK(packed.delta_lights.capacity() == 0);
    CHECK(packed.images.capacity() == 0);
    CHECK(packed.material_images.capacity() == 0);
    CHECK(packed.opacities.capacity() == 0);
    CHECK(packed.blends.capacity() == 0);
    CHECK(packed.anisotropies.capacity() == 0);
    CHECK(packed.instances.capacity() == 0);
    CHECK(packed.instance_nodes.capacity() == 0);
    CHECK(packed.mesh_nodes.capacity() == 0);
    CHECK(packed.mesh_triangles.capacity() == 0);
    CHECK(packed.uvs.capacity() == 0);
    CHECK(packed.vertex_colors.capacity() == 0);
    CHECK(packed.map_texels.capacity() == 0);
    CHECK(needed_effects(packed) == FeatureSet{});
}
