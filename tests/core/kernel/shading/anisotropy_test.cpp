// Anisotropic facets of metals: their density, samples, energy and reciprocity, the isotropic limit, and their direction on a surface.
#include "core/kernel/shading/anisotropy.h"

#include <array>

#include "core/scene/anisotropy.h"
#include "core/scene/needed_effects.h"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/shading/lobe_fixture.h"

using namespace pl;
using namespace pl::test;

namespace {

using BrushedGgx = GgxOf<AnisotropicWidth>;

/// Of the x axis, and turned.
BrushedSurface brushed(float roughness, float anisotropy, float rotation_deg = 0.0f) {
    return BrushedSurface(rough(SurfaceKind::Conductor, roughness), Vec3f{0.0f},
                          {.material = pack_anisotropy(anisotropy, rotation_deg), .axis = {.u = {2.0f, 0.0f, 0.0f}}});
}

Vec3f direction_at(double cosine, double angle) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return Vec3f{Vec3d{sine * std::cos(angle), sine * std::sin(angle), cosine}};
}

/// Integral over the hemisphere, by midpoints.
template <class Function>
double integral(Function function) {
    constexpr int kHeights = 1500;
    constexpr int kSectors = 720;
    double sum = 0.0;
    for (int h = 0; h < kHeights; ++h)
        for (int s = 0; s < kSectors; ++s)
            sum += function(direction_at((h + 0.5) / kHeights, kTurn * (s + 0.5) / kSectors));
    return sum * kTurn / (double{kHeights} * kSectors);
}

/// One metal triangle in the plane z = 0 with these texture coordinates.
SceneDescription metal_triangle(std::array<glm::vec2, 3> uvs, float rotation_deg) {
    SceneDescription scene;
    scene.materials.push_back({.name = "metal",
                               .kind = SurfaceKind::Conductor,
                               .roughness = 0.5f,
                               .anisotropy = 0.8f,
                               .rotation_deg = rotation_deg});
    scene.uvs = {uvs[0], uvs[1], uvs[2]};
    add_triangle(scene, Vec3f{0, 0, 0}, Vec3f{2, 0, 0}, Vec3f{0, 3, 0});
    scene.triangles[0].uv = {0, 1, 2};
    return scene;
}
constexpr std::array<glm::vec2, 3> kPlain{glm::vec2{0, 0}, {1, 0}, {0, 1}};

/// The angle from x towards y, in degrees within [0, 180), in which the lobe seen along the normal is widest.
int widest_angle(const SceneDescription& scene, bool front = true) {
    const HostScene packed = pack_scene(scene);
    const Vec3f wo{0.0f, 0.0f, front ? 1.0f : -1.0f};
    const SurfacePoint point = make_surface_point<FeatureSet{}>(packed.view(), 0, Vec3f{1.0f / 3.0f}, wo);
    const auto bsdf = make_bsdf<kEveryFeature>(packed.view(), point, Vec3f{1.0f / 3.0f}, wo);
    int widest = 0;
    float most = 0.0f;
    for (int degrees = 0; degrees < 180; degrees += 5) {
        Vec3f wi = direction_at(0.8, kTurn * degrees / 360.0);
        wi.z *= wo.z;
        const float value = bsdf.eval(point, wi, 0.8f).x;
        if (value > most) widest = degrees;
        most = max_of(most, value);
    }
    return widest;
}

}  // namespace

TEST_CASE(
    "The facets of anisotropic metals cover the surface once, and what is visible of them what a direction sees") {
    for (const float ratio : {1.0f, 0.5f, 0.2f})
        for (const float alpha : {0.3f, 0.7f}) {
            const BrushedGgx ggx{{alpha, ratio}};
            INFO("width " << alpha << ", ratio " << ratio);
            CHECK(integral([&](Vec3f m) { return static_cast<double>(ggx.density(m) * m.z); }) ==
                  Approx(1.0).epsilon(2e-3));
            for (const double angle : {0.0, 0.7, 1.5707963}) {
                const Vec3f wo = direction_at(0.4, angle);
                const double seen = integral([&](Vec3f m) {
                    return static_cast<double>(ggx.visible(wo) * ggx.density(m) * max_of(glm::dot(wo, m), 0.0f));
                });
                INFO("angle " << angle);
                CHECK(seen == Approx(0.4).epsilon(3e-3));
            }
        }
}

TEST_CASE("Facets of equal widths have the bits of isotropic ones") {
    Uniforms random(1);
    const SurfacePoint point = LobeSurface::point();
    for (const float roughness : {0.03f, 0.4f, 1.0f}) {
        const BrushedGgx ggx{{square(roughness), 1.0f}};
        const Ggx round{{square(roughness)}};
        const SurfaceLobes lobes = rough(SurfaceKind::Conductor, roughness);
        const LobeSurface plain(lobes);
        const BrushedSurface even(lobes);
        for (int i = 0; i < 1000; ++i) {
            Vec3f wo = random.direction();
            Vec3f wi = random.direction();
            wo.z = std::fabs(wo.z) + 1e-3f;
            wi.z = std::fabs(wi.z) + 1e-3f;
            const Vec2f u = random.square();
            REQUIRE(ggx.density(wi) == round.density(wi));
            REQUIRE(ggx.visible(wo, wi) == round.visible(wo, wi));
            REQUIRE(ggx.sample(wo, u) == round.sample(wo, u));
            const float choice = random.next();
            REQUIRE(even.from(wo).sample(point, u, choice) == plain.from(wo).sample(point, u, choice));
            REQUIRE(even.from(wo).eval(point, wi, wi.z) == plain.from(wo).eval(point, wi, wi.z));
            REQUIRE(even.from(wo).pdf_sa(point, wi) == plain.from(wo).pdf_sa(point, wi));
            REQUIRE(even.from(wo).albedo() == plain.from(wo).albedo());
        }
    }
}

namespace {

void check_brushed_metals(SamplingTest test) {
    for (const float anisotropy : {0.5f, 0.9f})
        for (const double cos_o : {1.0, 0.6, 0.15})
            for (const double angle : {0.0, 1.0}) {
                INFO("anisotropy " << anisotropy << ", cosine " << cos_o << ", angle " << angle);
                CHECK(check_sampling(brushed(0.6f, anisotropy, 20.0f), direction_at(cos_o, angle), true, test));
            }
}

}  // namespace

// S3 over 576 bins.
TEST_CASE("Anisotropic metals are sampled as their density says") { check_brushed_metals(kQuickSampling); }
TEST_CASE("Anisotropic metals are sampled as their density says, finely", "[merge]") {
    check_brushed_metals(kFineSampling);
}

TEST_CASE("Anisotropic metals look the same from both ends, and change when they are turned") {
    Uniforms random(9);
    const SurfacePoint point = LobeSurface::point();
    for (const float anisotropy : {0.3f, 0.9f}) {
        const BrushedSurface surface = brushed(0.5f, anisotropy, 40.0f);
        const BrushedSurface turned = brushed(0.5f, anisotropy, 100.0f);
        float largest = 0.0f;
        for (int i = 0; i < 2000; ++i) {
            const Vec3f a = random_above(random);
            const Vec3f b = random_above(random);
            const float there = surface.from(a).eval(point, b, b.z).x / b.z;
            CHECK(there == Approx(surface.from(b).eval(point, a, a.z).x / a.z).epsilon(5e-4));
            largest = max_of(largest, std::fabs(turned.from(a).eval(point, b, b.z).x / b.z - there));
        }
        CHECK(largest > 0.1f);
    }
}

// The table is of isotropic facets and does not see the azimuth: only the mean over directions is right.
TEST_CASE("White anisotropic metals return all light in the mean over directions, and nearly so in each") {
    for (const auto [roughness, anisotropy, of_each] : {std::array{0.2f, 0.5f, 0.05f},
                                                        {0.2f, 0.9f, 0.12f},
                                                        {0.5f, 0.5f, 0.06f},
                                                        {0.5f, 0.9f, 0.25f},
                                                        {0.8f, 0.5f, 0.12f}}) {
        const BrushedSurface surface = brushed(roughness, anisotropy);
        Uniforms random(3);
        double sum = 0.0;
        double most = 0.0;
        constexpr int kDirections = 256;
        for (int i = 0; i < kDirections; ++i) {
            const double cosine = std::sqrt((i + 0.5) / kDirections);
            const double angle = kTurn * static_cast<double>(random.next());
            const double returned = returned_light(surface, direction_at(cosine, angle), true, 4000).mean();
            sum += returned;
            if (cosine > 0.1) most = std::max(most, std::fabs(returned - 1.0));
        }
        INFO("roughness " << roughness << ", anisotropy " << anisotropy << ": mean " << sum / kDirections
                          << ", largest error " << most);
        CHECK(std::fabs(sum / kDirections - 1.0) < 0.01);
        CHECK(most < static_cast<double>(of_each));
    }
}

TEST_CASE("Facets are widest along u, turned towards v, on both sides and on mirrored images") {
    CHECK(widest_angle(metal_triangle(kPlain, 0.0f)) == 0);
    CHECK(widest_angle(metal_triangle(kPlain, 90.0f)) == 90);
    CHECK(widest_angle(metal_triangle(kPlain, 30.0f)) == 30);
    CHECK(widest_angle(metal_triangle(kPlain, 30.0f), false) == 30);
    CHECK(widest_angle(metal_triangle({glm::vec2{0, 0}, {0, 1}, {-1, 0}}, 30.0f)) == 120);
    CHECK(widest_angle(metal_triangle({glm::vec2{0, 0}, {1, 0}, {0, -1}}, 30.0f)) == 150);
    CHECK(widest_angle(metal_triangle({glm::vec2{0, 0}, {1, 0}, {0, -1}}, 30.0f), false) == 150);
}

TEST_CASE("Without texture coordinates the direction of facets is that of the normal alone, the same on both sides") {
    SceneDescription scene = metal_triangle(kPlain, 30.0f);
    scene.triangles[0].uv = glm::uvec3{TriangleDescription::kNoUv};
    CHECK(widest_angle(scene) == widest_angle(scene, false));
    scene = metal_triangle({glm::vec2{1, 1}, {1, 1}, {1, 1}}, 30.0f);
    CHECK(widest_angle(scene) == widest_angle(scene, false));
}

TEST_CASE("A bent normal turns the facets with it") {
    const AnisotropicFacets::Grain grain{.material = pack_anisotropy(0.5f, 25.0f),
                                         .axis = {.u = {0.3f, 2.0f, -1.0f}}};
    Uniforms random(4);
    for (int i = 0; i < 1000; ++i) {
        const Vec3f normal = random.direction();
        const Frame frame = AnisotropicFacets::frame(grain, normal);
        CHECK(glm::length(frame.x) == Approx(1.0).epsilon(1e-5));
        CHECK(std::fabs(glm::dot(frame.x, normal)) < 1e-5f);
        CHECK(glm::length(glm::cross(frame.x, frame.y) - normal) < 1e-5f);
        const Vec3f u = glm::normalize(grain.axis.u - glm::dot(grain.axis.u, normal) * normal);
        CHECK(glm::dot(frame.x, u) == Approx(std::cos(25.0 * kTurn / 360.0)).epsilon(1e-4));
    }
}

TEST_CASE("No direction gives anything that is not finite on anisotropic metals") {
    Uniforms random(21);
    const SurfacePoint point = LobeSurface::point();
    for (const float roughness : {0.03f, 0.3f, 1.0f})
        for (const float anisotropy : {0.2f, kMostAnisotropy})
            for (const float height : {0.0f, 1e-30f, 1e-7f, 1e-3f, 0.5f, 1.0f})
                for (const bool along : {true, false}) {
                    const float flat = 1.0f - height;
                    const Vec3f wo = glm::normalize(along ? Vec3f{flat, 0.0f, height} : Vec3f{0.0f, flat, height});
                    const BrushedSurface surface = brushed(roughness, anisotropy);
                    const auto bsdf = surface.from(wo);
                    for (int i = 0; i < 200; ++i) {
                        const Vec2f u = i == 0 ? Vec2f{0.0f} : (i == 1 ? Vec2f{0.5f} : random.square());
                        const Vec3f wi = bsdf.sample(point, u, random.next());
                        CHECK(std::fabs(glm::length(wi) - 1.0f) < 1e-4f);
                        const float pdf_sa = bsdf.pdf_sa(point, wi);
                        CHECK((pdf_sa >= 0.0f && pdf_sa < kInfinity));
                        const float cos_i = bsdf.cosine(point, wi);
                        if (cos_i > 0.0f) CHECK(is_valid_radiance(bsdf.eval(point, wi, cos_i)));
                    }
                }
}
