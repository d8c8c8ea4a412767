#include "core/scene/facet_albedo.h"

#include <cmath>

#include "core/kernel/shading/fresnel.h"
#include "core/kernel/shading/microfacet.h"
#include "tests/support/catch.hpp"

using namespace pl;

namespace {

/// Point i of the R2 sequence in the unit square.   [Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences"]
Vec2f spread_point(int i) {
    const double x = 0.5 + i * 0.7548776662466927;
    const double y = 0.5 + i * 0.5698402909980532;
    return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}

/// The same share of light, by sampling the normals as paths do: F G2 / G1 is f cos over the density of the direction.
double by_samples(FacetLight light, float alpha, float cos_o, float eta) {
    constexpr int kSamples = 150'000;
    const Ggx ggx{{alpha}};
    const Vec3f wo{std::sqrt(1.0f - cos_o * cos_o), 0.0f, cos_o};
    double sum = 0.0;
    for (int i = 0; i < kSamples; ++i) {
        const Vec3f m = ggx.sample(wo, spread_point(i));
        const float cos_m = clamp_to(glm::dot(wo, m), 0.0f, 1.0f);
        const float f = light == FacetLight::Mirror ? 1.0f : fresnel_dielectric(cos_m, eta);
        const auto add = [&](float share, Vec3f wi) {
            sum += static_cast<double>(share * ggx.visible(wo, wi) / ggx.visible(wo));
        };
        if (const Vec3f wi = reflect_at(wo, m); wi.z > 0.0f) add(f, wi);
        if (light != FacetLight::Scattered || f == 1.0f) continue;
        if (const Vec3f wi = refract_at(wo, m, eta); wi.z < 0.0f) add(1.0f - f, wi);
    }
    return sum / kSamples;
}

}  // namespace

TEST_CASE("At normal incidence facets of width 1 return 1 less ln 2 by one reflection") {
    CHECK(facet_albedo(FacetLight::Mirror, 1.0, 1.0, 1.0) == Approx(1.0 - std::log(2.0)).epsilon(1e-6));
}

// 150 000 samples that are spread evenly are good to 1e-4: four times as many differ by up to 8.5e-5 from them.
TEST_CASE("Albedos of facets are what their sampled normals return") {
    for (const float alpha : {0.01f, 0.1f, 0.4f, 1.0f})
        for (const float cos_o : {0.04f, 0.3f, 0.65f, 0.999f}) {
            const auto check = [&](FacetLight light, float eta) {
                CAPTURE(alpha, cos_o, eta, static_cast<int>(light));
                const double albedo = facet_albedo(light, static_cast<double>(alpha), static_cast<double>(cos_o),
                                                   static_cast<double>(eta));
                CHECK(std::fabs(albedo - by_samples(light, alpha, cos_o, eta)) < 1.5e-4);
            };
            check(FacetLight::Mirror, 1.0f);
            for (const float eta : {1.05f, 1.5f, 2.5f}) check(FacetLight::Reflected, eta);
            for (const float eta : {1.05f, 1.5f, 2.5f, 1.0f / 1.05f, 1.0f / 1.5f, 1.0f / 2.5f})
                check(FacetLight::Scattered, eta);
        }
}

TEST_CASE("Facets of nearly no width are a smooth interface, and none gives anything that is not a share") {
    CHECK(facet_albedo(FacetLight::Mirror, 1e-4, 0.5, 1.0) == Approx(1.0).margin(1e-6));
    CHECK(facet_albedo(FacetLight::Reflected, 1e-4, 0.5, 1.5) ==
          Approx(static_cast<double>(fresnel_dielectric(0.5f, 1.5f))).margin(1e-6));
    CHECK(facet_albedo(FacetLight::Scattered, 1e-4, 0.5, 1.0 / 1.5) == Approx(1.0).margin(1e-6));
    for (const FacetLight light : {FacetLight::Mirror, FacetLight::Reflected, FacetLight::Scattered})
        for (const double eta : {1.0, 1.0 + 1e-7, 1.5, 4.0, 1.0 - 1e-7, 0.999, 0.25})
            for (const double alpha : {1e-12, 1e-8, 1e-3, 0.1, 1.0})
                for (const double cos_o : {1e-5, 1e-3, 0.1, 0.9, 1.0 - 1e-7, 1.0}) {
                    const double albedo = facet_albedo(light, alpha, cos_o, eta);
                    CAPTURE(static_cast<int>(light), eta, alpha, cos_o);
                    CHECK((albedo >= 0.0 && albedo <= 1.0 + 1e-5));
                }
}
