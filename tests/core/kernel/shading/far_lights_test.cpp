// Environment maps and the sun: their directions, and that samples of them follow their densities.
#include "core/kernel/shading/far_lights.h"

#include <functional>

#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/sampling_rule.h"

using namespace pl;
using namespace pl::test;

namespace {

/// The far lights of a scene that has a map with these texels.
HostScene under_map(std::uint32_t width, std::uint32_t height, std::vector<glm::vec3> texels,
                    float rotation_deg = 0.0f, const SunDescription& sun = {}) {
    SceneDescription scene;
    scene.materials.push_back(gray());
    add_triangle(scene, Vec3f{0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    scene.environment_map = {
        .width = width, .height = height, .rotation_deg = rotation_deg, .texels = std::move(texels)};
    scene.sun = sun;
    return pack_scene(scene);
}

struct NamedMap {
    const char* name;
    std::vector<glm::vec3> texels;
};

/// Maps of 16 x 8 that are hard to sample.
std::vector<NamedMap> hard_maps() {
    std::vector<NamedMap> maps = {{"constant", std::vector<glm::vec3>(128, glm::vec3(1.0f))},
                                  {"one bright texel", std::vector<glm::vec3>(128, glm::vec3(0.0f))},
                                  {"bright at the seam", std::vector<glm::vec3>(128, glm::vec3(1e-3f))},
                                  {"bright poles", std::vector<glm::vec3>(128, glm::vec3(1e-2f))},
                                  {"random with zeros", {}}};
    maps[1].texels[3 * 16 + 5] = glm::vec3(1e4f, 1e3f, 1e2f);
    maps[2].texels[4 * 16] = maps[2].texels[4 * 16 + 15] = glm::vec3(5.0f);
    for (std::size_t x = 0; x < 16; ++x) maps[3].texels[x] = maps[3].texels[7 * 16 + x] = glm::vec3(3.0f);
    Uniforms random(1);
    for (int i = 0; i < 128; ++i)
        maps[4].texels.push_back(random.below(3) == 0 ? glm::vec3(random.next(), random.next(), random.next())
                                                      : glm::vec3(0.0f));
    return maps;
}

Vec3f map_direction(double u, double v) {
    const double longitude = 2.0 * kHalfTurn * (u - 0.5);
    return Vec3f{Vec3d{std::sin(kHalfTurn * v) * std::sin(longitude), std::cos(kHalfTurn * v),
                       -std::sin(kHalfTurn * v) * std::cos(longitude)}};
}

/// Integral over the sphere by the midpoint rule, `per_turn` columns and half as many rows.
double over_sphere(int per_turn, const std::function<double(Vec3f)>& value) {
    double sum = 0.0;
    for (int row = 0; row < per_turn / 2; ++row)
        for (int column = 0; column < per_turn; ++column) {
            const double v = (row + 0.5) / (per_turn / 2);
            sum += std::sin(kHalfTurn * v) * value(map_direction((column + 0.5) / per_turn, v));
        }
    return sum * 4.0 * kHalfTurn * kHalfTurn / (static_cast<double>(per_turn) * per_turn);
}

}  // namespace

/// Image coordinates of a direction.
Vec2f map_point(const EnvironmentMap& map, Vec3f direction) { return pack(map_place(map, unpack(direction)).point); }

TEST_CASE("The map's middle is along -z, its right along +x, its first row up, and turning is counter-clockwise") {
    std::vector<glm::vec3> texels(8 * 4);
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = glm::vec3(static_cast<float>(i + 1));
    const HostScene packed = under_map(8, 4, texels);
    const EnvironmentMap map = packed.view().far_lights.map;
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 8; ++column) {
            const Vec3f direction =
                map_direction((static_cast<double>(column) + 0.5) / 8, (static_cast<double>(row) + 0.5) / 4);
            CHECK(map_radiance(map, direction).x == Approx(static_cast<float>(row * 8 + column + 1)).margin(1e-4));
        }
    CHECK(map_point(map, {0, 0, -1}).x == 0.5f);
    CHECK(map_point(map, {1, 0, 0}) == Vec2f{0.75f, 0.5f});
    CHECK(map_point(map, {0, 1, 0}).y == 0.0f);
    CHECK(map_point(map, {0, -1, 0}).y == 1.0f);
    const HostScene turned = under_map(8, 4, texels, 450.0f);  // its middle, along -z before, is along -x
    CHECK(map_point(turned.view().far_lights.map, {-1, 0, 0}).x == Approx(0.5f));
}

TEST_CASE("A map in axes of its own is turned as a whole, also mirrored, and sampled by the same density") {
    SceneDescription scene;
    scene.materials.push_back(gray());
    add_triangle(scene, Vec3f{0}, Vec3f{1, 0, 0}, Vec3f{0, 1, 0});
    std::vector<glm::vec3> texels;
    for (int i = 0; i < 8 * 4; ++i) texels.emplace_back(static_cast<float>(i + 1));
    scene.environment_map = {.width = 8, .height = 4, .rotation_deg = 30.0f, .texels = texels};
    const HostScene plain = pack_scene(scene);
    const float c = std::sqrt(0.5f);
    for (const glm::mat3& axes : {glm::mat3(1, 0, 0, 0, 0, 1, 0, -1, 0), glm::mat3(-1, 0, 0, 0, 1, 0, 0, 0, 1),
                                  glm::mat3(c, 0, c, 0, -1, 0, -c, 0, c)}) {
        scene.environment_map.axes = axes;
        const HostScene packed = pack_scene(scene);
        const FarLights& lights = packed.view().far_lights;
        Uniforms random(5);
        for (int i = 0; i < 1000; ++i) {
            const Vec3f local = map_direction(static_cast<double>(random.next()), static_cast<double>(random.next()));
            CHECK(far_radiance(lights, axes * local).x ==
                  Approx(far_radiance(plain.view().far_lights, local).x).epsilon(1e-3));
            CHECK(far_pdf_sa(lights, axes * local) ==
                  Approx(far_pdf_sa(plain.view().far_lights, local)).epsilon(1e-3));
            const Vec2f u = random.square();
            const FarSample turned = sample_far(lights, u, 0.0f);
            const FarSample own = sample_far(plain.view().far_lights, u, 0.0f);
            CHECK(glm::length(turned.wi - axes * own.wi) < 1e-5f);
            CHECK(turned.pdf_sa == own.pdf_sa);
            CHECK(turned.radiance == own.radiance);
        }
    }
}

TEST_CASE("The density of a map integrates to one, and is that of its samples") {
    for (const NamedMap& hard : hard_maps()) {
        INFO(hard.name);
        const HostScene packed = under_map(16, 8, hard.texels, 30.0f);
        const EnvironmentMap map = packed.view().far_lights.map;
        CHECK(over_sphere(768, [&](Vec3f d) { return static_cast<double>(map_pdf_sa(map, d)); }) ==
              Approx(1.0).epsilon(3e-4));
        Uniforms random(2);
        for (int i = 0; i < 100000; ++i) {
            const FarSample sample = sample_far(packed.view().far_lights, random.square(), random.next());
            REQUIRE(std::fabs(glm::length(sample.wi) - 1.0f) < 1e-6f);
            // Between texels the density may rise from 0 to its maximum, and the rounded direction lies on that
            // slope.
            const float evaluated = map_pdf_sa(map, sample.wi);
            REQUIRE(std::fabs(evaluated - sample.pdf_sa) <= 2e-3f * sample.pdf_sa + 1e-5f);
        }
    }
}

// S3: 512 bins, half of a texel each, over which the density is bilinear: its middle is its mean. N = 4e6: densities off
// by 1.5 %, alternating, are found.
TEST_CASE("Samples of a map follow its density") {
    for (const NamedMap& hard : hard_maps()) {
        INFO(hard.name);
        const HostScene packed = under_map(16, 8, hard.texels);
        const EnvironmentMap map = packed.view().far_lights.map;
        std::vector<double> expected;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 32; ++x) {
                const Vec2f middle{(static_cast<float>(x) + 0.5f) / 32.0f, (static_cast<float>(y) + 0.5f) / 16.0f};
                expected.push_back(static_cast<double>(map_density(map, map_taps(map, middle))) / 512.0);
            }
        std::vector<std::uint64_t> counts(512);
        Uniforms random(3);
        for (int i = 0; i < 4000000; ++i) {
            const Vec2f point = sample_map_point(map, random.square());
            const int column = min_of(static_cast<int>(point.x * 32.0f), 31);
            const int row = min_of(static_cast<int>(point.y * 16.0f), 15);
            ++counts[static_cast<std::size_t>(row * 32 + column)];
        }
        CHECK(sampler_matches(counts, expected, 0.015));
    }
}

// Radiance and density are both bilinear between the same points, up to the sine of the rows: weights hardly vary.
TEST_CASE("One bright texel is sampled almost perfectly") {
    const HostScene packed = under_map(16, 8, hard_maps()[1].texels);
    const EnvironmentMap map = packed.view().far_lights.map;
    const double power = over_sphere(1024, [&](Vec3f d) { return static_cast<double>(map_radiance(map, d).x); });
    Uniforms random(4);
    Moments moments;
    for (int i = 0; i < 200000; ++i) {
        const FarSample sample = sample_far(packed.view().far_lights, random.square(), random.next());
        if (sample.pdf_sa > 0.0f) moments.add(static_cast<double>(sample.radiance.x / sample.pdf_sa));
    }
    CHECK(mean_equals(moments, {power, 1e-3 * power}, 0.01));
    CHECK(moments.standard_error() * std::sqrt(200000.0) < 0.15 * power);
}

// L = a + b y gives an upward plane pi (a + 2 b / 3); S1: N = 1e6 resolves 1 %. The map's 128 rows are off by less than 1e-4.
TEST_CASE("The light of a linear sky on a plane has its closed form") {
    constexpr float a = 1.0f;
    constexpr float b = 0.8f;
    std::vector<glm::vec3> texels;
    for (int row = 0; row < 128; ++row) {
        const double cosine = std::cos(kHalfTurn * (row + 0.5) / 128);
        texels.insert(texels.end(), 256, glm::vec3(a + b * static_cast<float>(cosine)));
    }
    const HostScene packed = under_map(256, 128, texels, 77.0f);
    Uniforms random(5);
    Moments moments;
    for (int i = 0; i < 1000000; ++i) {
        const FarSample sample = sample_far(packed.view().far_lights, random.square(), random.next());
        moments.add(static_cast<double>(max_of(sample.wi.y, 0.0f) * sample.radiance.x / sample.pdf_sa));
    }
    const double expected = kHalfTurn * (static_cast<double>(a) + 2.0 * static_cast<double>(b) / 3.0);
    CHECK(mean_equals(moments, {expected, 2e-4 * expected}, 0.01));
}

// S3: 12 rings of equal solid angle x 12 sectors; N = 2e6 finds densities off by 1.2 %.
TEST_CASE("The sun's disc is sampled evenly") {
    for (const float angle_deg : {0.533f, 10.0f, 180.0f}) {
        const HostScene packed =
            under_map(0, 0, {}, 0.0f, {.direction = {1, 2, -1}, .radiance = glm::vec3(3), .angle_deg = angle_deg});
        const Sun sun = packed.view().far_lights.sun;
        const double half_angle = static_cast<double>(angle_deg) / 2.0 * kHalfTurn / 180.0;
        const double solid_angle = 2.0 * kHalfTurn * (1.0 - std::cos(half_angle));
        CHECK(1.0 / static_cast<double>(inside_sun_pdf_sa(sun)) == Approx(solid_angle).epsilon(1e-4));
        CHECK(in_sun(sun, sun.direction));
        CHECK_FALSE(in_sun(sun, -sun.direction));
        const Frame frame = make_frame(sun.direction);
        std::vector<std::uint64_t> counts(144);
        int outside = 0;
        Uniforms random(6);
        for (int i = 0; i < 2000000; ++i) {
            const Vec3f wi = sample_sun(sun, random.square());
            outside += in_sun(sun, wi) ? 0 : 1;
            const Vec3f local = frame.to_local(wi);
            const Vec3f chord = wi - sun.direction;
            const int ring = min_of(static_cast<int>(12.0f * glm::dot(chord, chord) / sun.chord2), 11);
            const auto sector = static_cast<int>(12.0f * (turns_of(local.y, local.x) + 0.5f));
            ++counts[static_cast<std::size_t>(ring * 12 + min_of(sector, 11))];
        }
        CHECK(sampler_matches(counts, std::vector<double>(144, 1.0 / 144.0), 0.012));
        CHECK(outside < 400);  // rounding on the rim, of the smallest sun most
    }
}

// S1: N = 1e6 resolves 1 % of all light that arrives.
TEST_CASE("Map and sun together bring all of their light, with the density that belongs to each direction") {
    const SunDescription sun{.direction = {0.3f, 1, 0.2f}, .radiance = {2000, 1500, 1000}, .angle_deg = 2};
    const HostScene packed = under_map(16, 8, hard_maps()[4].texels, 0.0f, sun);
    const FarLights lights = packed.view().far_lights;
    CHECK(lights.map_probability >= 0.1f);
    CHECK(lights.map_probability <= 0.9f);
    double power = over_sphere(768, [&](Vec3f d) { return static_cast<double>(map_radiance(lights.map, d).x); });
    power += 2000.0 * 2.0 * kHalfTurn * (1.0 - std::cos(kHalfTurn / 180.0));
    Uniforms random(7);
    Moments moments;
    for (int i = 0; i < 1000000; ++i) {
        const FarSample sample = sample_far(lights, random.square(), random.next());
        if (sample.pdf_sa > 0.0f)
            moments.add(static_cast<double>(sample.radiance.x / sample.pdf_sa));
        else
            moments.add(0.0);
        REQUIRE(std::fabs(sample.pdf_sa - far_pdf_sa(lights, sample.wi)) <= 2e-3f * sample.pdf_sa + 1e-5f);
    }
    CHECK(mean_equals(moments, {power, 1e-3 * power}, 0.01));
}

TEST_CASE("Lights that are black are none") {
    const HostScene dark = under_map(4, 2, std::vector<glm::vec3>(8, glm::vec3(0.0f)));
    CHECK(dark.view().far_lights.empty());
    CHECK(dark.map_texels.empty());
    CHECK(dark.far_probability == 0.0f);
    CHECK(is_black(far_radiance(dark.view().far_lights, {0, 1, 0})));
    CHECK(far_pdf_sa(dark.view().far_lights, {0, 1, 0}) == 0.0f);
    CHECK(under_map(1, 1, {glm::vec3(1.0f)}).far_probability == 1.0f);
}
