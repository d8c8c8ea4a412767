// Textures, holes, light from far away and the lens in whole pictures: scenes whose radiance is known.
#include "tests/support/catch.hpp"
#include "tests/support/scenes/image_scenes.h"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/film_samples.h"
#include "tests/support/session/sessions.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::uint32_t kNever = 1000;

SceneDescription painted_furnace() { return painted_equilibrium(furnace_scene(0.5f, 0.5f)); }
SceneDescription latticed_furnace() {
    return with_lattices(painted_furnace(), {-1.0f, -0.75f, -1.5f}, {1.0f, 0.75f, 1.5f});
}

/// S1 on the mean of the picture over all channels, from batches of passes.
Decision shows(const SceneDescription& scene, Estimator estimator, double expected, double delta,
               std::uint32_t passes = 8) {
    Session session = make_session(scene, quick_learner(scene, estimator, 16, 3));
    Moments moments;
    double before = 0.0;
    for (int batch = 0; batch < 64; ++batch) {
        render_passes(session, passes);
        double after = 0.0;
        for (const Vec3d& sum : film_sums(session)) after += (sum.x + sum.y + sum.z) / (3.0 * 256.0);
        moments.add((after - before) / passes);
        before = after;
    }
    CHECK(session.snapshot(slot_of(session)).counters.invalid_samples == 0);
    return mean_equals(moments, {expected, 2e-4 * expected}, delta);
}

/// 64 batches of 16 samples per pixel.
Picture lamp_picture(const SceneDescription& scene, Estimator estimator, std::uint64_t seed) {
    Session session = make_session(scene, quick_learner(scene, estimator, 32, seed));
    Picture picture(32, 32);
    render_batches(session, picture, 64, 16);
    return picture;
}

void blend(MaterialDescription& material, float opacity) {
    material.opacity = opacity;
    material.opacity_rule = OpacityRule::Blend;
}

/// A sheet between camera and plane, as large as the plane. Its image halves twice the opacity.
SceneDescription veiled_plane(float plane, float sheet, float opacity, bool has_image) {
    SceneDescription scene = plane_scene(plane);
    scene.materials.push_back(gray(sheet));
    constexpr float s = 1e4f;
    add_triangle(scene, Vec3f{-s, 0.5f, s}, Vec3f{s, 0.5f, s}, Vec3f{0, 0.5f, -s}, 1);
    blend(scene.materials[1], has_image ? 2.0f * opacity : opacity);
    if (!has_image) return scene;
    scene.textures.push_back(
        {.content = TextureContent::Opacity, .width = 1, .height = 1, .texels = {glm::vec4(1, 1, 1, 0.5f)}});
    scene.materials[1].textures.opacity = 0;
    scene.uvs = {{0, 0}, {1, 0}, {0, 1}};
    scene.triangles[1].uv = {0, 1, 2};
    return scene;
}

}  // namespace

// At every vertex emission and reflected radiance add up to 1: no error but the cut after 64
// vertices. A path brings 1 minus the product of the albedos it met.
TEST_CASE("Painted rooms in equilibrium show 1 in every pixel of every path, through lattices and a lens too") {
    SceneDescription lens = latticed_furnace();
    lens.camera.aperture_radius = 0.1f;
    for (const SceneDescription& scene :
         {painted_furnace(), latticed_furnace(), lens, painted_equilibrium(shipped_scene("door"))}) {
        const FilmSamples samples = sample_film(scene, {128, 128}, {.max_depth = 64, .roulette_start = kNever});
        const float tolerance = 64 * 12 * kRoundoff + std::pow(46.0f / 64.0f, 64.0f);
        std::uint64_t wrong = 0;
        for (const Vec3f& value : samples.values)
            for (int channel = 0; channel < 3; ++channel)
                wrong += std::fabs(value[channel] - 1.0f) <= tolerance ? 0 : 1;
        INFO(scene.name);
        CHECK(wrong <= 3 * samples.counters.path.zero_directions);
        CHECK(samples.counters.path.zero_directions <= 2);
        CHECK(samples.counters.path.escaped == 0);
    }
}

// S1: seed 3, 64 batches; lights are chosen by the mean of their images and met through holes. Resolves 2 %.
TEST_CASE("Painted rooms with lattices show 1 by every method, with light samples and without") {
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(shows(latticed_furnace(), estimator, 1.0, 0.02));
    }
}

// An emitting sheet that is hit brings its emission, one that is passed nothing; in equilibrium both give 1 on every path. S1 as above.
TEST_CASE("Painted rooms with partly opaque lattices show 1 by every method, with light samples and without") {
    SceneDescription scene = latticed_furnace();
    blend(scene.materials.back(), 0.4f);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(shows(scene, estimator, 1.0, 0.02));
    }
}

// A sheet of opacity a and albedo r under an even sky of radiance 1 lets 1 - a through and reflects a r, from above and from below. Over a
// plane of albedo p the light between both is (1 - a) / (1 - p a r) on its way down. S1 as above; the sky is both sampled as a light
// and not, and the opacity is a number, or a number times the opacity of an image.
TEST_CASE("A partly opaque sheet over a plane under an even sky shows its closed form by every method") {
    constexpr float kOpacity = 0.4f, kSheet = 0.5f, kPlane = 0.8f;
    for (const bool has_image : {false, true}) {
        SceneDescription scene = veiled_plane(kPlane, kSheet, kOpacity, has_image);
        scene.environment_map = linear_sky(0.75f, 0.0f);
        scene.environment = glm::vec3(0.25f);
        const double through = 1.0 - kOpacity;
        const double back = kOpacity * kSheet;
        const double expected = back + through * through * kPlane / (1.0 - kPlane * back);
        for (const Estimator estimator : kEstimators) {
            INFO(estimator << (has_image ? ", with an image" : ""));
            CHECK(shows(scene, estimator, expected, 0.02));
        }
    }
}

// Each reflection is by either material: the light between sheet and plane depends on their mean albedos alone. The plane is a chain of
// three materials; the sheet blends by an image, and its opacity decides about the same hits. S1 as above.
TEST_CASE(
    "A blended, partly opaque sheet over a blended plane under an even sky shows its closed form by every method") {
    constexpr float kOpacity = 0.4f;
    SceneDescription scene = veiled_plane(0.9f, 0.2f, kOpacity, false);
    scene.materials.insert(scene.materials.end(), {gray(0.3f), gray(0.6f), gray(1.0f)});
    scene.materials[0].blend = {.other = 2, .share = 0.5f};
    scene.materials[2].blend = {.other = 3, .share = 0.2f};
    scene.materials[1].blend = {.other = 4, .share = 0.8f};
    scene.materials[1].textures.blend = 0;
    scene.textures.push_back(
        {.content = TextureContent::Number, .width = 1, .height = 1, .texels = {glm::vec4(0.5f, 1, 1, 1)}});
    scene.uvs = {{0, 0}, {1, 0}, {0, 1}};
    scene.triangles[1].uv = {0, 1, 2};
    scene.environment_map = linear_sky(0.75f, 0.0f);
    scene.environment = glm::vec3(0.25f);
    const double plane = 0.5 * 0.9 + 0.5 * (0.8 * 0.3 + 0.2 * 0.6);
    const double sheet = 0.6 * 0.2 + 0.4 * 1.0;
    const double through = 1.0 - kOpacity;
    const double back = kOpacity * sheet;
    const double expected = back + through * through * plane / (1.0 - plane * back);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(shows(scene, estimator, expected, 0.02));
    }
}

// The plane sees lamps of partial opacity, by a number and by an image, one behind the other and a point light behind both. S2: seeds 1 and
// 2, 64 batches; resolves 5 %.
TEST_CASE("Partly opaque lamps are the same with light samples and without") {
    SceneDescription scene = plane_scene(0.5f);
    scene.materials.push_back(gray(0.3f));
    scene.materials[1].emission = glm::vec3(3.0f);
    scene.materials[1].two_sided_emission = true;
    blend(scene.materials[1], 0.3f);
    scene.materials.push_back(scene.materials[1]);
    blend(scene.materials[2], 0.8f);
    scene.textures.push_back({.content = TextureContent::Opacity,
                              .width = 2,
                              .height = 1,
                              .texels = {glm::vec4(1, 1, 1, 0.1f), glm::vec4(1, 1, 1, 1)}});
    scene.materials[2].textures.opacity = 0;
    scene.uvs = {{0, 0}, {1, 0}, {0, 1}};
    add_triangle(scene, Vec3f{-0.5f, 1.5f, -0.5f}, Vec3f{0.5f, 1.5f, -0.5f}, Vec3f{0.0f, 1.5f, 0.7f}, 1);
    add_triangle(scene, Vec3f{-0.6f, 2.0f, -0.5f}, Vec3f{0.6f, 2.0f, -0.5f}, Vec3f{0.0f, 2.0f, 0.9f}, 2);
    scene.triangles.back().uv = {0, 1, 2};
    scene.punctual_lights.push_back({.kind = PunctualKind::Point, .position = {0, 3, 0}, .intensity = glm::vec3(9)});
    const Picture expected = lamp_picture(scene, {MethodId::Default, true}, 2);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(same_picture(lamp_picture(scene, estimator, 1), expected, 0.05));
    }
}

// The plane reflects a + 2 b / 3 of a sky a + b y. S1 as above.
TEST_CASE("A plane under a linear sky shows its closed form by every method") {
    SceneDescription scene = plane_scene(0.5f);
    scene.environment_map = linear_sky(1.0f, 0.9f);
    scene.environment_map.rotation_deg = 123.0f;
    scene.environment = glm::vec3(0.25f);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(shows(scene, estimator, 0.5 * (0.25 + 1.0 + 0.6), 0.02));
    }
}

// The camera sees a small part of the plane, around the weights 1/4, 1/4 and 1/2 of its corners: of their colors, too. S1 as above.
TEST_CASE("A plane with colors of vertices shows their mean where the camera looks, by every method") {
    SceneDescription scene = plane_scene(0.8f);
    scene.vertex_colors = {glm::vec3(1.0f), glm::vec3(0.2f), glm::vec3(0.4f)};
    scene.environment_map = linear_sky(1.0f, 0.0f);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(shows(scene, estimator, 0.8 * (0.25 * 1.0 + 0.25 * 0.2 + 0.5 * 0.4), 0.02));
    }
}

// Of the hemisphere around a normal that is tilted by 45 degrees the part below the plane is lost: (1 + cos 45) / 2 are left of an even sky.
// The sky is both sampled as a light and not.
TEST_CASE("A plane with a slanted normal map under an even sky shows its closed form by every method") {
    SceneDescription scene = plane_scene(0.5f);
    scene.textures.push_back(
        {.content = TextureContent::Normal,
         .width = 1,
         .height = 1,
         .texels = {glm::vec4(0.5f + 0.5f * std::sqrt(0.5f), 0.5f, 0.5f + 0.5f * std::sqrt(0.5f), 1)}});
    scene.materials[0].textures.normal = 0;
    scene.uvs = {{0, 0}, {1, 0}, {0, 1}};
    scene.triangles[0].uv = {0, 1, 2};
    scene.environment_map = linear_sky(1.0f, 0.0f);
    scene.environment = glm::vec3(0.25f);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(shows(scene, estimator, 0.5 * 1.25 * 0.5 * (1.0 + std::sqrt(0.5)), 0.02));
    }
}

// A cone of half angle 30 degrees around 45 degrees: irradiance pi sin(30)^2 cos(45) L. Light samples alone find it well.
TEST_CASE("A plane under a large sun shows its closed form by every method") {
    SceneDescription scene = plane_scene(0.5f);
    scene.sun = {.direction = {1, 1, 0}, .radiance = glm::vec3(4.0f), .angle_deg = 60.0f};
    const double expected = 0.5 * 4.0 * 0.25 * std::sqrt(0.5);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(shows(scene, estimator, expected, 0.05, 24));
    }
}

// The irradiances of the single lights add up: the probabilities of map, sun and surfaces are divided out. A lamp of
// side 1 at height 1 in the middle of a sky that it hides a part of; S1 against the sum of closed forms would need the
// hidden part, so it is black and the sky behind it counted out: with light samples and without must agree.
TEST_CASE("Map, sun and a lamp together are the same with light samples and without") {
    SceneDescription scene = plane_scene(0.5f);
    scene.materials.push_back(gray(0.0f));
    scene.materials[1].emission = glm::vec3(3.0f);
    add_triangle(scene, Vec3f{-0.5f, 1.5f, -0.5f}, Vec3f{0.5f, 1.5f, -0.5f}, Vec3f{0.0f, 1.5f, 0.7f}, 1);
    scene.environment_map = linear_sky(1.0f, 0.9f);
    scene.sun = {.direction = {1, 1, 0}, .radiance = glm::vec3(10.0f), .angle_deg = 30.0f};
    const Picture expected = lamp_picture(scene, {MethodId::Default, true}, 2);
    for (const Estimator estimator : kEstimators) {
        INFO(estimator);
        CHECK(same_picture(lamp_picture(scene, estimator, 1), expected, 0.05));
    }
}

// A pixel that sampled but one kind of lights in all its passes would never come to its radiance. Root mean squares of the difference of
// two seeds, 256 pixels: 64 times the samples leave at most a quarter, an eighth being expected of independent ones. A kind that
// is chosen once for a pixel leaves the whole.
TEST_CASE("Every pixel under map, sun and a lamp comes to its radiance") {
    SceneDescription scene = plane_scene(0.5f);
    scene.materials.push_back(gray(0.0f));
    scene.materials[1].emission = glm::vec3(3.0f);
    add_triangle(scene, Vec3f{-0.5f, 1.5f, -0.5f}, Vec3f{0.5f, 1.5f, -0.5f}, Vec3f{0.0f, 1.5f, 0.7f}, 1);
    scene.environment_map = linear_sky(1.0f, 0.9f);
    const auto pixels_of = [&](std::uint64_t seed, std::uint32_t passes) {
        RenderSettings settings = settings_for(scene, {MethodId::Default, true}, 16, 16);
        settings.seed = seed;
        Session session = make_session(scene, settings);
        render_passes(session, passes);
        return session.snapshot(slot_of(session)).pixels;
    };
    const auto difference = [&](std::uint32_t passes) {
        const auto a = pixels_of(1, passes);
        const auto b = pixels_of(2, passes);
        double square = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) square += std::pow(static_cast<double>(a[i].x - b[i].x), 2.0);
        return std::sqrt(square / static_cast<double>(a.size()));
    };
    CHECK(difference(4096) < 0.25 * difference(64));
}

// The view of direct light takes one light sample of all kinds, and sees the sky.
TEST_CASE("The direct view of a plane under a linear sky shows its closed form") {
    SceneDescription scene = plane_scene(0.5f);
    scene.environment_map = linear_sky(1.0f, 0.9f);
    RenderSettings settings = settings_for(scene, {}, 16, 16);
    settings.view = View::Direct;
    Session session = make_session(scene, settings);
    render_passes(session, 1024);
    Moments moments;
    for (const Vec3f& pixel : session.snapshot(slot_of(session)).pixels) moments.add(static_cast<double>(pixel.x));
    CHECK(mean_equals(moments, {0.8, 2e-4}, 0.02));
}
