// Normal maps: directions of texels on surfaces of all kinds, both sides, and values at which a frame could break.
#include "core/kernel/scene/normal_map.h"

#include "core/kernel/shading/bsdf.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/rays/walk.h"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

/// Of a map with these components of the normal.
glm::vec4 texel_of(Vec3f normal) { return glm::vec4(0.5f * (glm::normalize(normal) + Vec3f{1.0f}), 1.0f); }

/// One triangle in the plane z = 0, u along x and v along y, with a normal map of one texel.
SceneDescription mapped(const glm::vec4& texel, float strength = 1.0f) {
    SceneDescription scene;
    scene.materials.push_back(gray(1.0f));
    scene.materials[0].textures.normal = 0;
    scene.materials[0].normal_strength = strength;
    scene.textures.push_back({.content = TextureContent::Normal, .width = 1, .height = 1, .texels = {texel}});
    scene.uvs = {{0, 0}, {1, 0}, {0, 1}};
    add_triangle(scene, Vec3f{0, 0, 0}, Vec3f{2, 0, 0}, Vec3f{0, 3, 0});
    scene.triangles[0].uv = {0, 1, 2};
    return scene;
}

constexpr Hit kHit{.t = 1.0f, .primitive = 0, .b1 = 0.25f, .b2 = 0.25f};
constexpr FeatureSet kMapped = features(Feature::NormalMaps);

SurfacePoint point_of(const SceneDescription& scene, Vec3f wo) {
    return make_surface_point<kMapped>(pack_scene(scene).view(), kHit, wo);
}
Vec3f normal_of(const SceneDescription& scene, Vec3f wo = {0, 0, 1}) { return point_of(scene, wo).shading_normal; }

bool are_near(Vec3f a, Vec3f b) { return glm::length(a - b) < 2e-3f; }  // texels are half floats

}  // namespace

TEST_CASE("A normal map holds normals along u, v and the normal of the surface") {
    CHECK(are_near(normal_of(mapped(texel_of({0, 0, 1}))), {0, 0, 1}));
    CHECK(are_near(normal_of(mapped(texel_of({1, 0, 1}))), glm::normalize(Vec3f{1, 0, 1})));
    CHECK(are_near(normal_of(mapped(texel_of({0, -2, 1}))), glm::normalize(Vec3f{0, -2, 1})));
    // Slopes times the strength.
    CHECK(are_near(normal_of(mapped(texel_of({1, 0, 1}), 0.5f)), glm::normalize(Vec3f{0.5f, 0, 1})));
    CHECK(pack_scene(mapped(texel_of({1, 0, 1}), 0.0f)).normal_maps.empty());
    SceneDescription down = mapped(texel_of({1, 1, 1}));
    down.materials[0].normal_green = NormalGreen::Down;
    CHECK(are_near(normal_of(down), glm::normalize(Vec3f{1, -1, 1})));
}

TEST_CASE("A normal map follows mirrored and turned texture coordinates") {
    SceneDescription mirrored = mapped(texel_of({1, 1, 1}));
    mirrored.uvs = {{0, 0}, {-1, 0}, {0, 1}};
    CHECK(are_near(normal_of(mirrored), glm::normalize(Vec3f{-1, 1, 1})));
    mirrored.materials[0].normal_green = NormalGreen::Left;
    CHECK(are_near(normal_of(mirrored), glm::normalize(Vec3f{-1, -1, 1})));
    SceneDescription turned = mapped(texel_of({1, 0, 1}));
    turned.uvs = {{0, 0}, {0, 1}, {-1, 0}};  // u along -y
    CHECK(are_near(normal_of(turned), glm::normalize(Vec3f{0, -1, 1})));
}

TEST_CASE("Seen from behind, the normals of a map are those of the same surface") {
    const SceneDescription scene = mapped(texel_of({1, 0, 1}));
    const SurfacePoint behind = point_of(scene, {0, 0, -1});
    CHECK_FALSE(behind.front);
    CHECK(are_near(behind.shading_normal, -glm::normalize(Vec3f{1, 0, 1})));
    CHECK(glm::dot(behind.shading_normal, behind.geometric_normal) > 0.0f);
}

TEST_CASE("A normal map bends the interpolated normals of a smooth surface") {
    SceneDescription scene = mapped(texel_of({0, 0, 1}));
    const Vec3f smooth = glm::normalize(Vec3f{0.3f, 0.2f, 1});
    scene.normals = {smooth};
    scene.triangles[0].normal = {0, 0, 0};
    const HostScene packed = pack_scene(scene);
    const auto point = make_surface_point<kMapped.with(Feature::SmoothNormals)>(packed.view(), kHit, {0, 0, 1});
    CHECK(are_near(point.shading_normal, smooth));
    const TangentFrame tangents = tangent_frame(texture_axis<kMapped>(packed.view(), 0), smooth);
    REQUIRE(tangents.side == 1.0f);
    for (const Vec3f axis : {tangents.frame.x, tangents.frame.y, tangents.frame.z})
        CHECK(glm::length(axis) == Approx(1.0f));
    CHECK(std::fabs(glm::dot(tangents.frame.x, tangents.frame.y)) < 1e-6f);
    CHECK(std::fabs(glm::dot(tangents.frame.x, smooth)) < 1e-6f);
}

TEST_CASE("Without texture coordinates a normal map changes no bit") {
    const SceneDescription scene = mapped(texel_of({1, 0, 1}));
    for (const std::vector<glm::vec2>& uvs : {std::vector<glm::vec2>{{0, 0}, {0, 0}, {0, 0}},
                                              {{0, 0}, {1, 1}, {2, 2}},
                                              {{0, 0}, {3e38f, 0}, {0, 3e38f}}}) {
        SceneDescription degenerate = scene;
        degenerate.uvs = uvs;
        CHECK(is_finite(normal_of(degenerate)));
    }
    SceneDescription none = scene;
    none.triangles[0].uv = glm::uvec3(TriangleDescription::kNoUv);
    CHECK(normal_of(none) == Vec3f{0, 0, 1});
    // Effects that a scene does not have change nothing either.
    CHECK(needed_effects(pack_scene(scene)) == kMapped.with(Feature::Textures));
    SceneDescription plain = scene;
    plain.materials[0].textures.normal = kNoTexture;
    CHECK(needed_effects(pack_scene(plain)) == FeatureSet{});
    CHECK(pack_scene(plain).normal_maps.empty());
}

TEST_CASE("Mapped normals are unit and above the surface for all texels, coordinates and strengths") {
    Uniforms random(31);
    for (int i = 0; i < 20000; ++i) {
        const float odd[] = {0.0f, 0.5f, 1.0f, 1e30f, random.next()};
        const auto channel = [&] { return odd[random.below(5)]; };
        SceneDescription scene =
            mapped({channel(), channel(), channel(), 1}, std::pow(100.0f, random.between(-1, 1)));
        const float size = std::pow(10.0f, random.between(-6, 6));
        for (glm::vec2& uv : scene.uvs) uv = {size * random.between(-1, 1), size * random.between(-1, 1)};
        for (glm::vec3& position : scene.positions) position = random.cube(-1, 1);
        scene.normals = {random.direction()};
        scene.triangles[0].normal = {0, 0, 0};
        const HostScene packed = pack_scene(scene);
        if (packed.triangles.empty()) continue;
        const Vec3f wo = random.direction();
        const auto point = make_surface_point<kMapped.with(Feature::SmoothNormals)>(packed.view(), kHit, wo);
        REQUIRE(is_finite(point.shading_normal));
        REQUIRE(glm::length(point.shading_normal) == Approx(1.0f).margin(1e-5));
        REQUIRE(glm::dot(point.shading_normal, point.geometric_normal) >= -1e-6f);
        const Vec3f bent = reflecting_normal(point.shading_normal, point.geometric_normal, wo);
        REQUIRE(glm::length(bent) == Approx(1.0f).margin(1e-5));
        if (glm::dot(wo, point.geometric_normal) < 0.01f) continue;
        REQUIRE(glm::dot(2.0f * glm::dot(wo, bent) * bent - wo, point.geometric_normal) >= 0.5f * kLeastMappedCosine);
        REQUIRE(glm::dot(wo, bent) > 0.0f);
    }
}

TEST_CASE("The normal of lobes is bent only where the mirror direction would be inside") {
    const Vec3f plane{0, 0, 1};
    const Vec3f normal = glm::normalize(Vec3f{0.2f, 0, 1});
    CHECK(reflecting_normal(normal, plane, glm::normalize(Vec3f{0.5f, 0, 1})) == normal);
    const Vec3f wo = glm::normalize(Vec3f{-1, 0, 0.1f});
    const Vec3f slope = glm::normalize(Vec3f{-1, 0, 1});
    REQUIRE((2.0f * glm::dot(wo, slope) * slope - wo).z > 0.0f);
    const Vec3f away = glm::normalize(Vec3f{1, 0, 1});
    REQUIRE((2.0f * glm::dot(wo, away) * away - wo).z < 0.0f);
    CHECK(reflecting_normal(away, plane, wo).x < away.x);
}

// Of the hemisphere around the mapped normal the half space below the surface is lost: (1 + cos) / 2 of the irradiance of a white sky.
TEST_CASE("A white surface under a white sky reflects the share that its mapped normals leave") {
    for (const float slope : {0.0f, 0.3f, 1.0f, 3.0f}) {
        const HostScene packed = pack_scene(mapped(texel_of({slope, 0, 1})));
        const Vec3f wo{0, 0, 1};
        const SurfacePoint point = make_surface_point<kEveryFeature>(packed.view(), kHit, wo);
        const auto bsdf = make_bsdf<kEveryFeature>(packed.view(), point, hit_weights(kHit), wo);
        constexpr int kSide = 512;
        double reflected = 0.0;
        for (int i = 0; i < kSide * kSide; ++i) {
            const float z = 1.0f - 2.0f * (static_cast<float>(i % kSide) + 0.5f) / kSide;
            const float phi = 2.0f * kPi * (static_cast<float>(i / kSide) + 0.5f) / kSide;
            const float r = std::sqrt(1.0f - z * z);
            const Vec3f wi{r * std::cos(phi), r * std::sin(phi), z};
            const float cosine = bsdf.cosine(point, wi);
            if (cosine > 0.0f) reflected += static_cast<double>(bsdf.eval(point, wi, cosine).x);
        }
        reflected *= 4.0 * static_cast<double>(kPi) / (kSide * kSide);
        CAPTURE(slope);
        CHECK(reflected == Approx(0.5 * (1.0 + 1.0 / std::hypot(1.0, static_cast<double>(slope)))).margin(2e-3));
    }
}
