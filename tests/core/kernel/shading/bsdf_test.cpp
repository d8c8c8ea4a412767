// Metals, glass and plastics: samples against densities, energy, reciprocity, limits.
#include "core/kernel/shading/bsdf.h"

#include <array>
#include <utility>

#include "tests/support/catch.hpp"
#include "tests/support/shading/lobe_fixture.h"

using namespace pl;
using namespace pl::test;

namespace {

void check_metals(SamplingTest test) {
    for (const float roughness : {0.3f, 0.6f, 1.0f})
        for (const float cos_o : {1.0f, 0.6f, 0.15f}) {
            INFO("roughness " << roughness << ", cosine " << cos_o);
            CHECK(check_sampling(LobeSurface(rough(SurfaceKind::Conductor, roughness)), cos_o, true, test));
        }
}

void check_glass(SamplingTest test) {
    for (const float roughness : {0.3f, 0.6f, 1.0f})
        for (const float cos_o : {0.9f, 0.6f, 0.15f})
            for (const bool front : {true, false}) {
                INFO("roughness " << roughness << ", cosine " << cos_o << (front ? ", outside" : ", inside"));
                CHECK(check_sampling(LobeSurface(rough(SurfaceKind::Dielectric, roughness)), cos_o, front, test));
            }
}

void check_plastics(SamplingTest test) {
    for (const float roughness : {0.0f, 0.3f, 1.0f})
        for (const float cos_o : {1.0f, 0.6f, 0.15f}) {
            INFO("roughness " << roughness << ", cosine " << cos_o);
            const LobeSurface plastic(rough(SurfaceKind::Plastic, roughness), Vec3f{0.5f});
            CHECK(check_sampling(plastic, cos_o, true, test));
        }
}

}  // namespace

TEST_CASE("Fresnel reflectances at their limits") {
    for (const float eta : {1.1f, 1.5f, 2.4f}) {
        CHECK(fresnel_dielectric(1.0f, eta) == Approx(square((eta - 1.0f) / (eta + 1.0f))).epsilon(1e-5));
        CHECK(fresnel_dielectric(1.0f, 1.0f / eta) == Approx(square((eta - 1.0f) / (eta + 1.0f))).epsilon(1e-5));
        CHECK(fresnel_dielectric(0.0f, eta) == Approx(1.0f));
        const float critical = std::sqrt(1.0f - 1.0f / (eta * eta));  // cosine inside
        CHECK(fresnel_dielectric(critical * 0.999f, 1.0f / eta) == 1.0f);
        CHECK(fresnel_dielectric(critical * 1.01f, 1.0f / eta) < 1.0f);
    }
    for (const float cos_i : {0.0f, 0.3f, 1.0f})
        CHECK(fresnel_dielectric(cos_i, 1.0f) == Approx(cos_i == 0.0f ? 1.0 : 0.0).margin(1e-12));
    CHECK(fresnel_conductor(1.0f, Vec3f{0.2f, 0.5f, 1.0f}, Vec3f{0.0f}) == Vec3f{0.2f, 0.5f, 1.0f});
    CHECK(fresnel_conductor(0.0f, Vec3f{0.2f}, Vec3f{0.0f}) == Vec3f{1.0f});
    for (const float eta : {1.1f, 1.5f, 2.4f})
        for (const float cos_i : {0.01f, 0.3f, 0.8f, 1.0f})
            CHECK(fresnel_complex(cos_i, eta, 0.0f) == Approx(fresnel_dielectric(cos_i, eta)).epsilon(1e-4));
}

// Gold, copper, aluminum and chromium, red and blue each, and a metal of high index, which Schlick's approximation makes brightest.
TEST_CASE("The reflectance of metals follows their complex index of refraction") {
    const Vec2f metals[] = {{0.143f, 3.98f}, {1.44f, 1.60f}, {0.2f, 3.91f},  {1.10f, 2.14f}, {1.66f, 9.22f},
                            {0.52f, 4.84f},  {3.1f, 3.3f},   {2.33f, 3.14f}, {4.37f, 5.21f}};
    float largest = 0.0f, largest_of_schlick = 0.0f;
    for (const Vec2f metal : metals) {
        const auto exact = [&](float cos_i) { return fresnel_complex(cos_i, metal.x, metal.y); };
        const Vec3f f0{exact(1.0f)};
        const float schlick_at_edge = fresnel_conductor(kEdgeCosine, f0, Vec3f{0.0f}).x;
        const Vec3f loss = edge_loss_of(f0, Vec3f{exact(kEdgeCosine) / schlick_at_edge});
        CHECK(fresnel_conductor(kEdgeCosine, f0, loss).x == Approx(exact(kEdgeCosine)).epsilon(1e-5));
        double mean = 0.0;
        constexpr int kSteps = 1000;
        for (int i = 0; i < kSteps; ++i) {
            const float cos_i = (static_cast<float>(i) + 0.5f) / kSteps;
            largest = max_of(largest, std::fabs(fresnel_conductor(cos_i, f0, loss).x - exact(cos_i)));
            largest_of_schlick =
                max_of(largest_of_schlick, std::fabs(fresnel_conductor(cos_i, f0, Vec3f{0.0f}).x - exact(cos_i)));
            mean += 2.0 * static_cast<double>(cos_i * fresnel_conductor(cos_i, f0, loss).x) / kSteps;
        }
        CHECK(static_cast<double>(mean_fresnel_conductor(f0, loss).x) == Approx(mean).epsilon(1e-4));
    }
    CHECK(largest < 0.06f);
    CHECK(largest_of_schlick > 0.25f);
    CHECK(edge_loss_of(Vec3f{0.7f}, Vec3f{1.0f}) == Vec3f{0.0f});
    const Vec3f black = fresnel_conductor(kEdgeCosine, Vec3f{0.0f}, edge_loss_of(Vec3f{0.0f}, Vec3f{0.0f}));
    CHECK((black.x >= 0.0f && black.x < 1e-6f));
}

TEST_CASE("Refraction obeys Snell's law, there and back") {
    Uniforms random(3);
    for (int i = 0; i < 10000; ++i) {
        Vec3f wo = random.direction();
        wo.z = std::fabs(wo.z);
        const float eta = random.between(1.01f, 2.5f);
        const Vec3f up{0.0f, 0.0f, 1.0f};
        const Vec3f wi = refract_at(wo, up, eta);
        CHECK(wi.z < 0.0f);
        CHECK(glm::length(Vec2f{wo.x, wo.y} + eta * Vec2f{wi.x, wi.y}) < 2e-6f);
        // Back from below: the same picture upside down.
        const Vec3f up_side_down{-wi.x, -wi.y, -wi.z};
        if (fresnel_dielectric(up_side_down.z, 1.0f / eta) < 1.0f) {
            const Vec3f back = refract_at(up_side_down, up, 1.0f / eta);
            CHECK(glm::length(back + wo) < 2e-3f);
        }
    }
}

// S3 over 576 bins.
TEST_CASE("Rough metals are sampled as their density says") { check_metals(kQuickSampling); }
TEST_CASE("Rough glass is sampled as its density says, from outside and from inside") { check_glass(kQuickSampling); }
TEST_CASE("Plastics are sampled as their density says") { check_plastics(kQuickSampling); }
TEST_CASE("Rough metals are sampled as their density says, finely", "[merge]") { check_metals(kFineSampling); }
TEST_CASE("Rough glass is sampled as its density says, finely", "[merge]") { check_glass(kFineSampling); }
TEST_CASE("Plastics are sampled as their density says, finely", "[merge]") { check_plastics(kFineSampling); }

// A surface that absorbs nothing reflects all light. Seed 5, 2e5 samples, four standard errors and the interpolation of tables, see
// directional_albedo_test.cpp for what is finer.
TEST_CASE("White surfaces return all light") {
    for (const SurfaceKind kind : {SurfaceKind::Conductor, SurfaceKind::Plastic})
        for (const float roughness : {0.0f, 0.1f, 0.35f, 0.7f, 1.0f})
            for (const float cos_o : {1.0f, 0.7f, 0.4f, 0.1f}) {
                if (kind == SurfaceKind::Conductor && roughness == 0.0f) continue;
                const LobeSurface surface(rough(kind, roughness), Vec3f{1.0f});
                const Moments returned = returned_light(surface, tilted(cos_o), true, 200000);
                INFO("kind " << static_cast<int>(kind) << ", roughness " << roughness << ", cosine " << cos_o << ": "
                             << returned.mean() << " +- " << returned.standard_error());
                CHECK(std::fabs(returned.mean() - 1.0) < 5e-4 + 4.0 * returned.standard_error());
            }
}
// Transmitted radiance is divided by the square of eta, which is undone here.
TEST_CASE("Clear glass loses no light, rough or smooth") {
    for (const float roughness : {0.0f, 0.1f, 0.35f, 0.7f, 1.0f})
        for (const float cos_o : {1.0f, 0.7f, 0.4f, 0.1f})
            for (const bool front : {true, false}) {
                const float ior = 1.5f;
                const float eta = front ? ior : 1.0f / ior;
                SurfaceLobes lobes = rough(SurfaceKind::Dielectric, roughness);
                lobes.transmission = Vec3f{eta * eta};
                const Moments returned = returned_light(LobeSurface(lobes), tilted(cos_o), front, 200000);
                INFO("roughness " << roughness << ", cosine " << cos_o << (front ? ", outside: " : ", inside: ")
                                  << returned.mean() << " +- " << returned.standard_error());
                CHECK(std::fabs(returned.mean() - 1.0) < 5e-4 + 4.0 * returned.standard_error());
            }
}

// Single scattering, F = 1. At roughness 1 and normal incidence 1 - ln 2; other values measured with a standard error of 2e-4.
TEST_CASE("Albedo of single scattering by GGX") {
    const std::vector<float> values = lossless_albedo();
    const AlbedoTable table{values.data()};
    CHECK(table.at(1.0f, 1.0f) == Approx(1.0 - std::log(2.0)).epsilon(2e-5));
    const float cosines[] = {1.0f, 0.7f, 0.5f, 0.2f};
    const std::pair<float, std::array<double, 4>> rows[] = {{0.1f, {0.9883, 0.9815, 0.9691, 0.9046}},
                                                            {0.3f, {0.8772, 0.8445, 0.8217, 0.8383}},
                                                            {0.5f, {0.6876, 0.6830, 0.6981, 0.7898}},
                                                            {1.0f, {0.3069, 0.3788, 0.4508, 0.6414}}};
    for (const auto& [alpha, expected] : rows)
        for (std::size_t i = 0; i < 4; ++i) {
            INFO("alpha " << alpha << ", cosine " << cosines[i]);
            CHECK(static_cast<double>(table.at(std::sqrt(alpha), cosines[i])) == Approx(expected[i]).margin(1e-3));
        }
}

TEST_CASE("Metals and plastics look the same from both ends") {
    Uniforms random(9);
    for (const SurfaceKind kind : {SurfaceKind::Conductor, SurfaceKind::Plastic})
        for (const float roughness : {0.0f, 0.2f, 0.5f, 1.0f}) {
            if (kind == SurfaceKind::Conductor && roughness == 0.0f) continue;
            const LobeSurface surface(rough(kind, roughness), Vec3f{0.5f});
            const SurfacePoint point = LobeSurface::point();
            for (int i = 0; i < 2000; ++i) {
                const Vec3f a = random_above(random);
                const Vec3f b = random_above(random);
                const float there = surface.from(a).eval(point, b, b.z).x / b.z;
                const float back = surface.from(b).eval(point, a, a.z).x / a.z;
                CHECK(there == Approx(back).epsilon(2e-4));
            }
        }
}

TEST_CASE("Directions that a surface cannot send light to have no cosine") {
    const SurfacePoint point = LobeSurface::point();
    const Vec3f below{0.0f, 0.6f, -0.8f};
    const Vec3f above{0.0f, 0.6f, 0.8f};
    const LobeSurface metal(rough(SurfaceKind::Conductor, 0.5f));
    CHECK(metal.from(tilted(0.7f)).cosine(point, below) == 0.0f);
    CHECK(metal.from(tilted(0.7f)).cosine(point, above) == Approx(0.8f));
    const LobeSurface glass(rough(SurfaceKind::Dielectric, 0.5f));
    CHECK(glass.from(tilted(0.7f)).cosine(point, below) == Approx(0.8f));
    const LobeSurface mirror(rough(SurfaceKind::Conductor, 0.0f));
    CHECK(mirror.from(tilted(0.7f)).cosine(point, above) == 0.0f);
    CHECK(mirror.from(tilted(0.7f)).delta_probability() == 1.0f);
    CHECK(mirror.from(tilted(0.7f)).is_specular());
}

// The numbers of grazing and of upright directions at both ends of roughness.
TEST_CASE("No direction gives anything that is not finite") {
    Uniforms random(21);
    const float heights[] = {0.0f, 1e-30f, 1e-7f, 1e-3f, 0.5f, 1.0f};
    for (const SurfaceInfo& info : kSurfaces)
        for (const float roughness : {0.0f, 0.03f, 0.3f, 1.0f})
            for (const float height : heights)
                for (const bool front : {true, false}) {
                    if (info.choice.value == SurfaceKind::Pane && roughness > 0.0f) continue;
                    const LobeSurface surface(rough(info.choice.value, roughness),
                                              Vec3f{info.has(material_parameter::kAlbedo) ? 0.5f : 0.0f});
                    const auto bsdf = surface.from(glm::normalize(Vec3f{1.0f - height, 0.0f, height}), front);
                    const SurfacePoint point = LobeSurface::point(front);
                    for (int i = 0; i < 200; ++i) {
                        const Vec2f u = i == 0 ? Vec2f{0.0f} : (i == 1 ? Vec2f{0.5f} : random.square());
                        const DeltaDirection delta = bsdf.sample_delta(point, random.next());
                        CHECK((roughness > 0.0f || is_valid_radiance(delta.weight)));
                        if (bsdf.delta_probability() == 1.0f) continue;
                        const Vec3f wi = bsdf.sample(point, u, random.next());
                        CHECK((is_black(wi) || std::fabs(glm::length(wi) - 1.0f) < 1e-4f));
                        const float pdf_sa = bsdf.pdf_sa(point, wi);
                        CHECK((pdf_sa >= 0.0f && pdf_sa < kInfinity));
                        const float cos_i = bsdf.cosine(point, wi);
                        if (cos_i > 0.0f) CHECK(is_valid_radiance(bsdf.eval(point, wi, cos_i)));
                    }
                }
}

// Light goes to and fro between the faces of a sheet: the sum over all ways through it.
TEST_CASE("A thin pane reflects and lets through what its two faces do together, from both sides alike") {
    for (const float ior : {1.0f, 1.33f, 1.5f, 2.4f})
        for (const float cos_o : {1.0f, 0.8f, 0.3f, 0.05f})
            for (const bool front : {true, false}) {
                SurfaceLobes lobes = rough(SurfaceKind::Pane, 0.0f);
                lobes.ior = ior;
                lobes.specular = Vec3f{0.5f};
                lobes.transmission = Vec3f{0.25f};
                const LobeSurface pane(lobes);
                const Vec3f wo = tilted(cos_o);
                const auto bsdf = pane.from(wo, front);
                CHECK(bsdf.delta_probability() == 1.0f);
                CHECK(bsdf.is_specular());
                const double face = static_cast<double>(fresnel_dielectric(cos_o, ior));
                double reflected = face;
                for (double way = (1.0 - face) * (1.0 - face) * face; way > 1e-12; way *= face * face)
                    reflected += way;
                CAPTURE(ior, cos_o, front, reflected);
                const SurfacePoint point = LobeSurface::point(front);
                const auto share = static_cast<float>(reflected);
                const DeltaDirection mirrored = bsdf.sample_delta(point, 0.999f * share);
                if (share > 0.0f) {
                    CHECK(mirrored.weight == lobes.specular);
                    CHECK(mirrored.wi.z == Approx(wo.z).epsilon(1e-5));
                    CHECK(mirrored.wi.x == Approx(-wo.x).margin(1e-6));
                }
                const DeltaDirection straight = bsdf.sample_delta(point, 1.001f * share + 1e-7f);
                CHECK(straight.weight == lobes.transmission);
                CHECK(glm::length(straight.wi + wo) < 1e-6f);
            }
}
