// Velvet: its formula, samples against densities, energy, reciprocity.
#include "core/kernel/shading/velvet.h"

#include <cmath>
#include <numeric>

#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/shading/lobe_fixture.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr float kRoughnesses[] = {SheenFibers::kLeastRoughness, 0.5f, 1.0f};
constexpr float kCosines[] = {1.0f, 0.6f, 0.15f, 0.02f};

LobeSurface velvet(float roughness, Vec3f base, Vec3f sheen) {
    SurfaceLobes lobes = rough(SurfaceKind::Velvet, roughness);
    lobes.specular = sheen;
    return LobeSurface(lobes, base);
}

/// The text of the extension, in double precision.
double lambda(double x, double alpha) {
    const auto l = [&](double at) {
        const double share = (1.0 - alpha) * (1.0 - alpha);
        const auto mix = [&](double a, double b) { return a * (1.0 - share) + b * share; };
        return mix(21.5473, 25.3245) / (1.0 + mix(3.82987, 3.32435) * std::pow(at, mix(0.19823, 0.16801))) +
               mix(-1.97760, -1.27393) * at + mix(-4.32054, -4.85967);
    };
    return x < 0.5 ? std::exp(l(x)) : std::exp(2.0 * l(0.5) - l(1.0 - x));
}
double sheen_by_formula(Vec3d wo, Vec3d wi, double alpha) {
    const Vec3d h = glm::normalize(wo + wi);
    const double distribution = (2.0 + 1.0 / alpha) * std::pow(1.0 - h.z * h.z, 0.5 / alpha) / kTurn;
    return distribution / ((1.0 + lambda(wo.z, alpha) + lambda(wi.z, alpha)) * 4.0 * wo.z);
}

void check_samples(SamplingTest test) {
    for (const float roughness : kRoughnesses)
        for (const float cos_o : {1.0f, 0.6f, 0.15f}) {
            INFO("roughness " << roughness << ", cosine " << cos_o);
            CHECK(check_sampling(velvet(roughness, Vec3f{0.5f}, Vec3f{0.8f}), cos_o, true, test));
        }
}

}  // namespace

TEST_CASE("The sheen of velvet is that of KHR_materials_sheen") {
    Uniforms random(7);
    for (const float roughness : kRoughnesses) {
        const SheenFibers fibers(roughness);
        const double alpha = static_cast<double>(roughness) * static_cast<double>(roughness);
        for (int i = 0; i < 1000; ++i) {
            const Vec3f wo = random_above(random);
            const Vec3f wi = random_above(random);
            CHECK(static_cast<double>(fibers.reflection(wo, wi)) ==
                  Approx(sheen_by_formula(Vec3d{wo}, Vec3d{wi}, alpha)).epsilon(1e-3).margin(1e-7));
        }
    }
}

TEST_CASE("Velvet without a sheen is a Lambert reflector, and a black one under a black sheen is black") {
    const SurfacePoint point = LobeSurface::point();
    const auto bare = velvet(0.5f, Vec3f{0.25f}, Vec3f{0.0f}).from(tilted(0.7f));
    const Vec3f wi = glm::normalize(Vec3f{0.3f, -0.2f, 0.5f});
    CHECK(bare.eval(point, wi, wi.z).x == Approx(0.25f * wi.z * kInvPi));
    CHECK(bare.pdf_sa(point, wi) == Approx(wi.z * kInvPi));
    CHECK(bare.albedo().x == Approx(0.25f));
    CHECK_FALSE(velvet(0.5f, Vec3f{0.0f}, Vec3f{0.0f}).from(tilted(0.7f)).scatters());
    CHECK(velvet(0.5f, Vec3f{0.0f}, Vec3f{0.5f}).from(tilted(0.7f)).is_specular());
    CHECK(bare.delta_probability() == 0.0f);
    CHECK(bare.cosine(point, {0.0f, 0.6f, -0.8f}) == 0.0f);
}

// S3 over 576 bins.
TEST_CASE("Velvet is sampled as its density says") { check_samples(kQuickSampling); }
TEST_CASE("Velvet is sampled as its density says, finely", "[merge]") { check_samples(kFineSampling); }

TEST_CASE("The density of velvet integrates to 1") {
    const SurfacePoint point = LobeSurface::point();
    for (const float cos_o : kCosines) {
        const auto bsdf = velvet(0.5f, Vec3f{0.5f}, Vec3f{0.8f}).from(tilted(cos_o));
        const auto bins = SphereBins::integrate([&](Vec3f wi) { return bsdf.pdf_sa(point, wi); });
        CHECK(std::accumulate(bins.begin(), bins.end(), 0.0) == Approx(1.0).epsilon(1e-4));
    }
}

TEST_CASE("Velvet looks the same from both ends") {
    Uniforms random(9);
    const SurfacePoint point = LobeSurface::point();
    for (const float roughness : kRoughnesses) {
        const LobeSurface surface = velvet(roughness, Vec3f{0.5f}, Vec3f{0.8f});
        for (int i = 0; i < 2000; ++i) {
            const Vec3f a = random_above(random);
            const Vec3f b = random_above(random);
            const float there = surface.from(a).eval(point, b, b.z).x / b.z;
            CHECK(there == Approx(surface.from(b).eval(point, a, a.z).x / a.z).epsilon(2e-4));
        }
    }
}

// Seed 5, 2e5 samples, four standard errors and the interpolation of the table.
TEST_CASE(
    "White velvet under a white sheen returns no more light than arrives, and a sheen alone what its table says") {
    const std::vector<float> values = sheen_albedo();
    for (const float roughness : kRoughnesses)
        for (const float cos_o : kCosines) {
            const Moments white =
                returned_light(velvet(roughness, Vec3f{1.0f}, Vec3f{1.0f}), tilted(cos_o), true, 200000);
            INFO("roughness " << roughness << ", cosine " << cos_o << ": " << white.mean() << " +- "
                              << white.standard_error());
            CHECK(white.mean() < 1.0 + 5e-4 + 4.0 * white.standard_error());
            CHECK(white.mean() > 0.5);
            const Moments sheen =
                returned_light(velvet(roughness, Vec3f{0.0f}, Vec3f{1.0f}), tilted(cos_o), true, 200000);
            const double expected = static_cast<double>(AlbedoTable{values.data()}.at(roughness, cos_o));
            INFO("sheen " << sheen.mean() << " +- " << sheen.standard_error() << ", expected " << expected);
            CHECK(std::fabs(sheen.mean() - expected) < 1e-3 + 4.0 * sheen.standard_error());
        }
}

TEST_CASE("The fibers of velvet reflect at most what arrives, from the least roughness on") {
    const std::vector<float> values = sheen_albedo();
    for (float roughness = SheenFibers::kLeastRoughness; roughness <= 1.0f; roughness += 0.01f)
        for (float root = 0.0f; root <= 1.0f; root += 0.005f)
            CHECK(AlbedoTable{values.data()}.at(roughness, root * root) <= 1.0f);
}
