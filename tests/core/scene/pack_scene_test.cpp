// From descriptions to arrays: lights, normals, planes, effects, bounds and the camera's basis.
#include "core/scene/pack_scene.h"

#include "core/scene/needed_effects.h"
#include "core/scene/triangle_planes.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using namespace pl::test;

namespace {

MaterialDescription glowing(Vec3f emission) {
    MaterialDescription material = gray(0.0f);
    material.emission = emission;
    return material;
}

/// Right triangle with legs of the given length in the plane z = `z`.
void add_right_triangle(SceneDescription& scene, float leg, float z, std::uint32_t material) {
    add_triangle(scene, Vec3f{0, 0, z}, Vec3f{leg, 0, z}, Vec3f{0, leg, z}, material);
}

bool all_finite(Vec3f v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

TEST_CASE("Lights are the emitting triangles in proportion to area and luminance") {
    SceneDescription scene;
    scene.materials = {gray(), glowing({1, 1, 1}), glowing({0, 3, 0})};
    add_right_triangle(scene, 2, 0, 0);  // not a light
    add_right_triangle(scene, 2, 1, 1);  // area 2
    add_right_triangle(scene, 4, 2, 2);  // area 8
    const HostScene packed = pack_scene(scene);
    REQUIRE(packed.lights.size() == 2);
    CHECK(packed.lights[0].primitive == 1);
    CHECK(packed.lights[1].primitive == 2);
    const float first = 2.0f * luminance(Vec3f{1, 1, 1});
    const float second = 8.0f * luminance(Vec3f{0, 3, 0});
    CHECK(packed.light_power == Approx(first + second));
    CHECK(packed.lights[0].cumulative_probability == Approx(first / (first + second)));
    CHECK(packed.lights[1].cumulative_probability == 1.0f);
}

TEST_CASE("Degenerate triangles are no lights and have no NaN") {
    SceneDescription scene;
    scene.materials = {glowing({1, 1, 1})};
    scene.materials[0].albedo = Vec3f{0.5f};
    add_triangle(scene, Vec3f{0}, Vec3f{0}, Vec3f{1, 0, 0});
    add_triangle(scene, Vec3f{0}, Vec3f{1, 1, 1}, Vec3f{2, 2, 2});
    add_triangle(scene, Vec3f{3}, Vec3f{3}, Vec3f{3});
    add_right_triangle(scene, 1, 0, 0);
    const HostScene packed = pack_scene(scene);
    REQUIRE(packed.lights.size() == 1);
    CHECK(packed.lights[0].primitive == 3);
    for (const TrianglePlane& plane : packed.planes) {
        CHECK(all_finite(plane.normal));
        CHECK(glm::length(plane.normal) == Approx(1.0f));
        CHECK(std::isfinite(plane.position_error));
        CHECK(plane.edge_margin <= static_cast<float>(kMaxEdgeMargin));
    }
}

// A float sum of 1e5 equal terms drifts by about 1e-3; a double sum rounded once is exact to a roundoff.
TEST_CASE("The power of many lights is summed in double") {
    SceneDescription scene;
    scene.materials = {glowing({1, 1, 1})};
    constexpr int kLights = 100000;
    for (int i = 0; i < kLights; ++i) add_right_triangle(scene, 0.1f, static_cast<float>(i), 0);
    const HostScene packed = pack_scene(scene);
    const double one =
        0.5 * static_cast<double>(0.1f) * static_cast<double>(0.1f) * static_cast<double>(luminance(Vec3f{1.0f}));
    CHECK(std::fabs(static_cast<double>(packed.light_power) / (one * kLights) - 1.0) <= 1.5e-7);
    CHECK(packed.lights.back().cumulative_probability == 1.0f);
    bool sorted = true;
    bool accurate = true;
    for (std::size_t i = 0; i < packed.lights.size(); ++i) {
        const float p = packed.lights[i].cumulative_probability;
        sorted = sorted && (i == 0 || p >= packed.lights[i - 1].cumulative_probability);
        accurate = accurate && std::fabs(static_cast<double>(p) - static_cast<double>(i + 1) / kLights) <= 1e-7;
    }
    CHECK(sorted);
    CHECK(accurate);
}

TEST_CASE("Scenes without smooth normals pack none and need no effect") {
    SceneDescription scene;
    scene.materials.push_back(gray());
    scene.normals = {Vec3f{0, 0, 1}};  // in the file, but of no triangle
    add_right_triangle(scene, 1, 0, 0);
    const HostScene packed = pack_scene(scene);
    CHECK(packed.normals.empty());
    CHECK(packed.triangle_normals.empty());
    CHECK(needed_effects(packed) == FeatureSet{});
}

TEST_CASE("Triangles without normals get their geometric one where others are smooth") {
    SceneDescription scene;
    scene.materials.push_back(gray());
    scene.normals = {Vec3f{0, 0, 2}, Vec3f{0, 3, 0}, Vec3f{0, 0, 0}};
    add_right_triangle(scene, 1, 0, 0);
    add_triangle(scene, Vec3f{0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1});  // faces +x
    scene.triangles[0].normal = {0, 1, 2};
    const HostScene packed = pack_scene(scene);
    REQUIRE(packed.triangle_normals.size() == 2);
    const TriangleNormals smooth = packed.triangle_normals[0];
    CHECK(packed.normals[smooth.n0] == Vec3f{0, 0, 1});
    CHECK(packed.normals[smooth.n1] == Vec3f{0, 1, 0});
    CHECK(packed.normals[smooth.n2] == Vec3f{0, 0, 0});  // degenerate: no weight
    const TriangleNormals flat = packed.triangle_normals[1];
    CHECK(packed.normals[flat.n0] == Vec3f{1, 0, 0});
    CHECK(flat.n0 == flat.n1);
    CHECK(flat.n0 == flat.n2);
    CHECK(needed_effects(packed) == FeatureSet{}.with(Feature::SmoothNormals));
}

TEST_CASE("An environment is an effect") {
    SceneDescription scene;
    scene.environment = {0, 0, 0.1f};
    CHECK(needed_effects(pack_scene(scene)) == FeatureSet{}.with(Feature::Environment));
    CHECK(effect_names(needed_effects(pack_scene(scene))) == std::vector<std::string>{"environment"});
    FeatureSet all;
    for (const Feature feature : kAllFeatures) all = all.with(feature);
    CHECK(effect_names(all) == std::vector<std::string>{"smooth-normals", "environment", "next-event-estimation",
                                                        "specular", "rough", "plastic", "textures", "cut-outs",
                                                        "environment-map", "thin-lens", "many-lights", "normal-maps",
                                                        "delta-lights", "absorption", "thin-panes", "blends",
                                                        "anisotropy", "instances", "velvet"});
    CHECK(effect_names(FeatureSet{}).empty());
}

TEST_CASE("An empty scene packs") {
    const HostScene packed = pack_scene(SceneDescription{});
    CHECK(packed.lights.empty());
    CHECK(packed.light_power == 0.0f);
    CHECK(packed.bvh_nodes.empty());
    CHECK(bounds_of(SceneDescription{}).empty());
    CHECK(bounds_of(SceneDescription{}).diagonal() == 0.0f);
}

TEST_CASE("Bounds cover the vertices of triangles and nothing else") {
    SceneDescription scene;
    scene.materials.push_back(gray());
    add_vertex(scene, {100, 100, 100});  // in the file, but unused
    add_triangle(scene, Vec3f{-1, 2, 3}, Vec3f{4, -5, 6}, Vec3f{0, 0, 0});
    const Bounds bounds = bounds_of(scene);
    CHECK(bounds.low == Vec3f{-1, -5, 0});
    CHECK(bounds.high == Vec3f{4, 2, 6});
    CHECK(bounds.center() == Vec3f{1.5f, -1.5f, 3});
    CHECK_FALSE(bounds.empty());
}

// Against a cross product of the exact corners; a float cross product of this sliver is off by degrees.
TEST_CASE("Plane normals of slivers are exact to rounding") {
    SceneDescription scene;
    scene.materials.push_back(gray());
    add_triangle(scene, Vec3f{1000, 2000, 3000}, Vec3f{1100, 2010, 3001}, Vec3f{1050, 2005, 3000.5005f});
    const HostScene packed = pack_scene(scene);
    const Vec3d a{scene.positions[0]};
    const Vec3d cross = glm::cross(Vec3d{scene.positions[1]} - a, Vec3d{scene.positions[2]} - a);
    CHECK(glm::length(Vec3d{packed.planes[0].normal} - glm::normalize(cross)) < 1e-7);
}

TEST_CASE("The camera's basis is orthogonal and as wide as the picture") {
    CameraDescription camera;
    camera.eye = {278, 273, -800};
    camera.target = {278, 273, 0};
    camera.up = {0, 1, 0};
    camera.fov_deg = 90.0f;
    const Camera basis = make_camera(camera, 200, 100);
    CHECK(basis.eye == camera.eye);
    CHECK(basis.axis == Vec3f{0, 0, 1});
    CHECK(glm::length(basis.up) == Approx(1.0f));
    CHECK(glm::length(basis.right) == Approx(2.0f));
    CHECK(basis.right.x < 0.0f);  // looking along +z with y up, right is -x
    // The middle of the picture looks forward, its corners see half of the angle each.
    CHECK(glm::length(generate_ray(basis, {100, 50}, {200, 100}).direction - basis.axis) < 1e-6f);
    const Vec3f top = generate_ray(basis, {100, 0}, {200, 100}).direction;
    CHECK(glm::dot(top, basis.axis) == Approx(std::sqrt(0.5f)));
    CHECK(top.y > 0.0f);
    CHECK(generate_ray(basis, {0, 50}, {200, 100}).direction.x > 0.0f);
}

TEST_CASE("Cameras that look along their up vector have a basis") {
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                for (const float ulps : {-1.0f, 0.0f, 1.0f}) {
                    const Vec3f direction{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
                    CameraDescription camera;
                    camera.eye = Vec3f{0.0f};
                    camera.target = direction;
                    camera.up = direction + Vec3f{ulps * 0x1p-24f, 0, 0};
                    const Camera basis = make_camera(camera, 100, 100);
                    REQUIRE(all_finite(basis.right));
                    REQUIRE(all_finite(basis.up));
                    REQUIRE(std::fabs(glm::length(basis.axis) - 1.0f) < 3e-7f);
                    REQUIRE(std::fabs(glm::dot(basis.right, basis.axis)) < 3e-7f);
                    REQUIRE(std::fabs(glm::dot(basis.up, basis.axis)) < 3e-7f);
                    REQUIRE(std::fabs(glm::dot(basis.up, basis.right)) < 3e-7f);
                    REQUIRE(std::fabs(glm::length(basis.up) - glm::length(basis.right)) < 3e-7f);
                }
}

TEST_CASE("Narrow and wide and tiny and far cameras keep their angle") {
    for (const float fov : {1e-3f, 1.0f, 40.0f, 120.0f, 179.0f})
        for (const float scale : {1e-15f, 1.0f, 1e15f}) {
            CameraDescription camera;
            camera.eye = scale * Vec3f{1, 2, 3};
            camera.target = scale * Vec3f{4, -2, 3};
            camera.fov_deg = fov;
            const Camera basis = make_camera(camera, 64, 64);
            const double expected = std::tan(0.5 * static_cast<double>(fov) * 3.14159265358979323846 / 180.0);
            CHECK(std::fabs(static_cast<double>(glm::length(basis.up)) / expected - 1.0) < 4e-7);
        }
}

namespace {

/// Two triangles; the first one's material has a texture of two texels for the given use, the second is plain.
SceneDescription textured(std::uint32_t TextureUse::*use, glm::vec4 left, glm::vec4 right) {
    SceneDescription scene;
    scene.materials = {gray(0.5f), gray(0.5f), gray(0.5f)};
    scene.materials[0].emission = Vec3f{2, 4, 8};
    scene.materials[0].textures.*use = 1;
    scene.materials[2].textures.*use = 0;  // of no triangle
    scene.textures = {{.width = 1, .height = 1, .texels = {glm::vec4(0.0f)}},
                      {.width = 2, .height = 1, .repeats = false, .texels = {left, right}}};
    scene.uvs = {{0, 0}, {0, 1}, {1, 1}};
    add_right_triangle(scene, 1, 0, 0);
    add_right_triangle(scene, 1, 1, 1);
    scene.triangles[0].uv = {0, 1, 2};
    return scene;
}

}  // namespace

TEST_CASE("Only images of materials in use are packed, with coordinates for all triangles") {
    const HostScene packed = pack_scene(textured(&TextureUse::albedo, glm::vec4(0.25f), glm::vec4(1.0f)));
    REQUIRE(packed.images.size() == 1);
    CHECK(packed.images[0].repeats == 0);
    CHECK(packed.texels.size() == 2);
    CHECK(unpack(packed.texels[0]) == Vec4f{0.25f});
    REQUIRE(packed.material_images.size() == 3);
    CHECK(packed.material_images[0].albedo == 0);
    CHECK(packed.material_images[1].albedo == kNoImage);
    CHECK(packed.material_images[2].albedo == kNoImage);
    REQUIRE(packed.triangle_uvs.size() == 2);
    CHECK(packed.uvs[packed.triangle_uvs[0].t2] == Vec2f{1, 1});
    CHECK(packed.uvs[packed.triangle_uvs[1].t0] == Vec2f{0, 0});
    CHECK(needed_effects(packed) == features(Feature::Textures));
    SceneDescription unused = textured(&TextureUse::albedo, glm::vec4(0.25f), glm::vec4(1.0f));
    unused.triangles.erase(unused.triangles.begin());
    CHECK(pack_scene(unused).images.empty());
    CHECK(pack_scene(unused).triangle_uvs.empty());
    CHECK(needed_effects(pack_scene(unused)) == FeatureSet{});
}

TEST_CASE("The power of a textured light is that of the mean of its image") {
    const HostScene packed = pack_scene(textured(&TextureUse::emission, {0.5f, 0, 1, 1}, {1.5f, 0, 0, 1}));
    CHECK(packed.materials[0].emission == Vec3f{2, 0, 4});
    CHECK(packed.material_images[0].emission_scale == Vec3f{1, 0, 2});
    CHECK(packed.light_power == Approx(0.5f * luminance(Vec3f{2, 0, 4})));
    const HostScene black = pack_scene(textured(&TextureUse::emission, glm::vec4(0.0f), glm::vec4(0.0f)));
    CHECK(black.lights.empty());
    CHECK(black.images.empty());
}

TEST_CASE("An image without holes is no cut-out") {
    CHECK(pack_scene(textured(&TextureUse::opacity, glm::vec4(0.5f), glm::vec4(1.0f))).images.empty());
    const HostScene packed = pack_scene(textured(&TextureUse::opacity, glm::vec4(0.49f), glm::vec4(1.0f)));
    CHECK(packed.images.size() == 1);
    CHECK(needed_effects(packed) == features(Feature::Textures, Feature::CutOuts));
}

TEST_CASE("Colors of vertices are textures, unless those in use are white") {
    SceneDescription scene;
    scene.materials = {gray()};
    add_triangle(scene, Vec3f{0, 0, 0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    scene.positions.push_back({7, 7, 7});
    scene.vertex_colors = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {0, 0, 0}};
    CHECK(pack_scene(scene).vertex_colors.empty());
    CHECK(needed_effects(pack_scene(scene)) == FeatureSet{});
    scene.vertex_colors[2].y = 0.5f;
    CHECK(pack_scene(scene).vertex_colors == scene.vertex_colors);
    CHECK(needed_effects(pack_scene(scene)) == features(Feature::Textures));
}

TEST_CASE("An opacity counts by its rule, with an image and without, and an opaque surface is no cut-out") {
    struct Case {
        float opacity, alpha;
        OpacityRule rule;
        bool has_holes;
    };
    for (const Case& c :
         {Case{1.0f, 1.0f, OpacityRule::Blend, false}, Case{1.0f, 0.99f, OpacityRule::Blend, true},
          Case{0.99f, 1.0f, OpacityRule::Blend, true}, Case{0.0f, 1.0f, OpacityRule::Blend, true},
          Case{0.7f, 0.8f, OpacityRule::Threshold, false}, Case{0.7f, 0.6f, OpacityRule::Threshold, true},
          Case{0.4f, 1.0f, OpacityRule::Threshold, true}}) {
        SceneDescription scene = textured(&TextureUse::opacity, glm::vec4(c.alpha), glm::vec4(1.0f));
        scene.materials[0].opacity = c.opacity;
        scene.materials[0].opacity_rule = c.rule;
        const HostScene packed = pack_scene(scene);
        INFO(c.opacity << " times " << c.alpha << ", rule " << static_cast<int>(c.rule));
        CHECK(needed_effects(packed).has(Feature::CutOuts) == c.has_holes);
        CHECK(packed.opacities.empty() == !c.has_holes);
        CHECK(packed.images.empty() == !(c.has_holes && c.alpha < 1.0f));
        scene.materials[0].textures.opacity = kNoTexture;
        const float least = c.rule == OpacityRule::Blend ? 1.0f : 0.5f;
        CHECK(pack_scene(scene).opacities.empty() == (c.opacity >= least));
    }
}

TEST_CASE("A blend is packed with the images of both materials, unless no path meets the other one") {
    SceneDescription scene = textured(&TextureUse::blend, glm::vec4(0.25f), glm::vec4(1.0f));
    CHECK(pack_scene(scene).images.empty());
    scene.materials[0].blend = {.other = 2, .share = 0.75f};
    scene.materials[2].textures = {.albedo = 0, .emission = 0, .opacity = 0, .normal = 0};
    scene.materials[2].opacity = 0.5f;
    const HostScene packed = pack_scene(scene);
    REQUIRE(packed.blends.size() == 3);
    CHECK(packed.blends[0].other == 2);
    CHECK(packed.blends[0].share == 0.75f);
    CHECK(packed.images[packed.blends[0].image].width == 2);
    CHECK(packed.blends[1].other == kNoBlend);
    CHECK(packed.images.size() == 2);
    CHECK(packed.images[packed.material_images[2].albedo].width == 1);
    CHECK(packed.opacities.empty());
    CHECK(packed.normal_maps.empty());
    CHECK(needed_effects(packed) == features(Feature::Textures, Feature::Blends));
    scene.materials[0].blend.share = 0.0f;
    CHECK(pack_scene(scene).blends.empty());
    scene.materials[0].blend.share = 0.75f;
    scene.triangles[0].material = 1;
    CHECK(pack_scene(scene).blends.empty());
}

TEST_CASE("Images that change nothing are not packed") {
    SceneDescription scene = textured(&TextureUse::roughness, glm::vec4(0.5f), glm::vec4(1.0f));
    CHECK(pack_scene(scene).images.empty());  // diffuse
    scene.materials[0].kind = SurfaceKind::Conductor;
    CHECK(pack_scene(scene).images.empty());  // smooth
    scene.materials[0].roughness = 0.5f;
    CHECK(pack_scene(scene).images.size() == 1);
    SceneDescription black = textured(&TextureUse::albedo, glm::vec4(0.5f), glm::vec4(1.0f));
    black.materials[0].albedo = Vec3f{0.0f};
    CHECK(pack_scene(black).images.empty());
}

TEST_CASE("Far lights are chosen by the power that the scene catches") {
    SceneDescription scene;
    scene.materials = {glowing({1, 1, 1})};
    add_right_triangle(scene, 2, 0, 0);
    scene.sun = {.direction = {0, 3, 0}, .radiance = Vec3f{1.0f}, .angle_deg = 20};
    const HostScene packed = pack_scene(scene);
    CHECK(packed.far_lights.sun.direction == Vec3f{0, 1, 0});
    CHECK(packed.far_lights.map_probability == 0.0f);
    // pi r^2 L omega against pi A L, with 2 r the diagonal of the bounds: r^2 = 2, A = 2, omega = 2 pi (1 - cos 10 deg).
    const float far = 2.0f * 2.0f * kPi * (1.0f - std::cos(10.0f * kPi / 180.0f));
    CHECK(packed.far_probability == Approx(max_of(far / (far + 2.0f), 0.1f)).epsilon(1e-4));
    CHECK(needed_effects(packed) == features(Feature::EnvironmentMap));
}
