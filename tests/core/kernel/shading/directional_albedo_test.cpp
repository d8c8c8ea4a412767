// Tables of albedos between their entries, and the white furnace that they bring about: surfaces that absorb nothing under an even sky
// have its radiance within 0.05 %, at any roughness and from 2 degrees above the surface on.
#include "core/kernel/shading/directional_albedo.h"

#include <algorithm>

#include "core/scene/facet_albedo.h"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.h"
#include "tests/support/shading/lobe_fixture.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr double kTolerance = 5e-4;

/// The largest error of a table at random roughnesses and angles, half of them up to 12 degrees above the surface and half of them of
/// nearly smooth facets. Glass is divided by it, so that its error is relative.
double worst_error(FacetLight light, double eta, const std::vector<float>& values) {
    const AlbedoTable table{values.data()};
    Uniforms random(31);
    double worst = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const float roughness = random.between(0.03f, i % 2 == 0 ? 0.3f : 1.0f);
        const float elevation = random.between(2.0f, i % 4 < 2 ? 12.0f : 90.0f);
        const float cos_o = std::sin(elevation * kPi / 180.0f);
        const double alpha = static_cast<double>(roughness) * static_cast<double>(roughness);
        const double expected = facet_albedo(light, alpha, static_cast<double>(cos_o), eta);
        const auto found = static_cast<double>(table.at(roughness, cos_o));
        const double error = light == FacetLight::Scattered ? expected / found - 1.0 : expected - found;
        worst = std::max(worst, std::fabs(error));
    }
    return worst;
}

/// Integral of f cos over the directions above, by midpoints that are closest at the horizon and around the mirrored direction's azimuth.
double returned_light(const auto& bsdf) {
    constexpr int kHeights = 400;
    constexpr int kSectors = 240;
    const SurfacePoint point = LobeSurface::point();
    double sum = 0.0;
    for (int h = 0; h < kHeights; ++h) {
        const double root = (h + 0.5) / kHeights;
        const double z = root * root;
        const double radius = std::sqrt(1.0 - z * z);
        for (int s = 0; s < kSectors; ++s) {
            const double turn = (s + 0.5) / kSectors;
            const double angle = kHalfTurn * (1.0 - turn * turn);
            const Vec3f wi{Vec3d{radius * std::cos(angle), radius * std::sin(angle), z}};
            sum += 4.0 * root * turn * static_cast<double>(bsdf.eval(point, wi, wi.z).x);
        }
    }
    return sum * 2.0 * kHalfTurn / (double{kHeights} * kSectors);
}

}  // namespace

// facet_albedo() is good to 1e-4.
TEST_CASE("Tables of albedos are right between their entries within 0.05 %") {
    CHECK(worst_error(FacetLight::Mirror, 1.0, lossless_albedo()) < kTolerance - 1e-4);
    for (const float ior : {1.05f, 1.2f, 1.5f, 2.0f, 2.5f}) {
        CAPTURE(ior);
        CHECK(worst_error(FacetLight::Reflected, static_cast<double>(ior), coat_albedo(ior)) < kTolerance - 1e-4);
        for (const float eta : {ior, 1.0f / ior}) {
            CAPTURE(eta);
            CHECK(worst_error(FacetLight::Scattered, static_cast<double>(eta), glass_albedo(eta)) <
                  kTolerance - 1e-4);
        }
    }
}

TEST_CASE("The mean albedo of a table is that of its interpolation") {
    const std::vector<float> values = coat_albedo(1.5f);
    const AlbedoTable table{values.data()};
    for (const float roughness : {0.0f, 0.0371f, 0.21f, 0.7f, 1.0f}) {
        constexpr int kSteps = 20'000;
        double mean = 0.0;
        for (int i = 0; i < kSteps; ++i) {
            const double root = (i + 0.5) / kSteps;  // of the cosine: mu dmu is 2 root^3 droot
            mean +=
                4.0 * root * root * root * static_cast<double>(table.at(roughness, static_cast<float>(root * root)));
        }
        CAPTURE(roughness);
        CHECK(static_cast<double>(table.mean(roughness)) == Approx(mean / kSteps).epsilon(2e-5));
    }
}

// The BSDFs as they are evaluated, so that float rounding and what is made of the tables count too. 96 000 directions are good to
// 1e-4 for lobes as wide as these: sixteen times as many differ by less.
TEST_CASE("Rough metals and plastics that absorb nothing have the radiance of an even sky within 0.05 %") {
    for (const SurfaceKind kind : {SurfaceKind::Conductor, SurfaceKind::Plastic})
        for (const float roughness : {0.39f, 0.52f, 0.71f, 0.93f, 1.0f}) {
            const LobeSurface surface(rough(kind, roughness), Vec3f{1.0f});
            for (const float elevation : {2.2f, 5.0f, 11.0f, 37.0f, 74.0f}) {
                const float cos_o = std::sin(elevation * kPi / 180.0f);
                CAPTURE(static_cast<int>(kind), roughness, elevation);
                CHECK(std::fabs(returned_light(surface.from(tilted(cos_o))) - 1.0) < kTolerance);
            }
        }
}

// The matte base under a smooth coat, and the coat's reflection of a delta lobe.
TEST_CASE("White plastics under a smooth coat have the radiance of an even sky within 0.05 %") {
    for (const float ior : {1.05f, 1.5f, 2.5f}) {
        SurfaceLobes lobes = rough(SurfaceKind::Plastic, 0.0f);
        lobes.ior = ior;
        const LobeSurface surface(lobes, Vec3f{1.0f});
        for (const float elevation : {2.2f, 11.0f, 37.0f, 74.0f}) {
            const float cos_o = std::sin(elevation * kPi / 180.0f);
            CAPTURE(ior, elevation);
            const double coat = static_cast<double>(fresnel_dielectric(cos_o, ior));
            CHECK(std::fabs(returned_light(surface.from(tilted(cos_o))) + coat - 1.0) < kTolerance);
        }
    }
}
