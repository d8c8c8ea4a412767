// Lobes: their arithmetic, their mixtures, their fit, the order of their sums, parallax, and refusal of damaged mixtures.
#include <algorithm>
#include <functional>

#include "core/fields/field_model.h"
#include "core/fields/mixture_fit.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/lobe_fixture.h"
#include "tests/support/statistics/sampling_rule.h"
#include "tests/support/statistics/sphere.h"

using namespace pl;
using namespace pl::test;

namespace {

float density_of(const VmfLobe& lobe, Vec3f wi) {
    return vmf_peak(lobe.kappa) * vmf_falloff(lobe.mean, lobe.kappa, wi);
}

}  // namespace

// The quadrature is exact to 1e-3 for lobes as narrow as 500; narrower ones are integrated along their axis, where the density of
// 1 - cos is kappa exp(-kappa (1 - cos)) / (1 - exp(-2 kappa)).
TEST_CASE("Densities of lobes integrate to one, from uniform to the narrowest") {
    for (const float kappa : {0.0f, 1e-7f, 1e-4f, 9e-4f, 1.1e-3f, 0.3f, 5.0f, 9.9f, 10.1f, 80.0f, 500.0f}) {
        const VmfLobe lobe{glm::normalize(Vec3f{0.3f, -0.5f, 0.2f}), kappa};
        INFO(kappa);
        CHECK(integral_over_sphere([&](Vec3f wi) { return density_of(lobe, wi); }) == Approx(1.0).epsilon(1e-3));
    }
    for (const float kappa : {500.0f, 5000.0f, kMostKappa}) {
        double sum = 0.0;
        const double width = 40.0 / static_cast<double>(kappa);
        for (int i = 0; i < 20000; ++i) {
            const double drop = width * (i + 0.5) / 20000.0;
            const auto sine = static_cast<float>(std::sqrt(drop * (2.0 - drop)));
            const Vec3f wi{sine, 0.0f, static_cast<float>(1.0 - drop)};
            sum += 2.0 * static_cast<double>(kPi) * width / 20000.0 *
                   static_cast<double>(density_of({{0.0f, 0.0f, 1.0f}, kappa}, wi));
        }
        CHECK(sum == Approx(1.0).epsilon(1e-3));
    }
}

// 1 - cos of samples has the distribution function (1 - exp(-kappa x)) / (1 - exp(-2 kappa)): the mean of it over samples is 1/2 and
// of its square 1/3. Five sigma of 200 000 samples are 0.0033 and 0.0034.
TEST_CASE("Samples of a lobe follow its density, from uniform to the narrowest") {
    Uniforms random(3);
    for (const float kappa : {0.0f, 1e-7f, 1e-3f, 0.5f, 10.0f, 1000.0f, kMostKappa}) {
        INFO(kappa);
        double first = 0.0;
        double second = 0.0;
        constexpr int kSamples = 200000;
        for (int i = 0; i < kSamples; ++i) {
            const Vec3f wi = sample_vmf_local(kappa, random.square());
            REQUIRE(std::fabs(glm::length(wi) - 1.0f) < 1e-5f);
            const double drop =
                0.5 * (static_cast<double>(square(wi.x) + square(wi.y)) + static_cast<double>(square(wi.z - 1.0f)));
            const double k = static_cast<double>(kappa);
            const double p = k < 1e-6 ? 0.5 * drop : std::expm1(-k * drop) / std::expm1(-2.0 * k);
            first += p / kSamples;
            second += p * p / kSamples;
        }
        CHECK(std::fabs(first - 0.5) < 0.0033);
        CHECK(std::fabs(second - 1.0 / 3.0) < 0.0034);
    }
    CHECK(sample_vmf_local(kMostKappa, {0.0f, 0.5f}).z == 1.0f);
    CHECK(sample_vmf_local(kMostKappa, {kBelowOne, 0.5f}).z > 0.99f);
    CHECK(sample_vmf_local(0.0f, {kBelowOne, 0.5f}).z < -0.99f);
}

TEST_CASE("A mean cosine and a concentration belong to each other") {
    for (const float kappa : {0.0f, 0.01f, 0.2f, 1.0f, 5.0f, 50.0f, 3000.0f}) {
        INFO(kappa);
        // The approximation of Banerjee et al. is within 5.5 %.
        CHECK(vmf_kappa(vmf_mean_cosine(kappa)) == Approx(kappa).epsilon(0.055).margin(1e-4));
    }
    CHECK(vmf_kappa(1.0f) == kMostKappa);
    CHECK(vmf_kappa(-0.5f) == 0.0f);
}

TEST_CASE("A product of lobes is the product of their densities") {
    Uniforms random(4);
    for (const float kappa : {0.0f, 0.7f, 30.0f, 2000.0f})
        for (int i = 0; i < 50; ++i) {
            const VmfLobe a{square_to_sphere(random.square()), kappa};
            const VmfLobe b{square_to_sphere(random.square()), kCosineKappa};
            const VmfProduct product = vmf_product(a, b);
            const Vec3f wi = kappa > 100.0f ? glm::normalize(a.mean + 0.02f * random.cube(-1.0f, 1.0f))
                                            : square_to_sphere(random.square());
            const float expected = vmf_falloff(a.mean, a.kappa, wi) * vmf_falloff(b.mean, b.kappa, wi);
            CHECK(product.scale * vmf_falloff(product.lobe.mean, product.lobe.kappa, wi) ==
                  Approx(expected).epsilon(2e-3).margin(1e-12));
        }
}

TEST_CASE("Directions keep their place in 30 bits") {
    Uniforms random(5);
    for (int i = 0; i < 10000; ++i) {
        const Vec3f wi = square_to_sphere(random.square());
        REQUIRE(glm::length(unpack_direction(pack_direction(wi)) - wi) < 2e-4f);
    }
    for (const Vec3f axis : {Vec3f{1, 0, 0}, Vec3f{0, -1, 0}, Vec3f{0, 0, 1}, Vec3f{0, 0, -1}})
        CHECK(glm::length(unpack_direction(pack_direction(axis)) - axis) < 2e-4f);
}

TEST_CASE("A fresh mixture has the cosine's density, nearly, and knows nothing") {
    TestLobes lobes;
    const LobeField field = lobes.view();
    const LobeLocation location = lobes.at();
    Uniforms random(6);
    for (int i = 0; i < 1000; ++i) {
        const Vec3f wi = square_to_sphere({0.55f + 0.45f * random.next(), random.next()});
        const float relative = field.density(location, {}, wi).pdf_sa / (wi.z * kInvPi);
        CHECK(relative > 0.4f);
        CHECK(relative < 2.0f);
    }
    CHECK(field.value_at(location) == 0.0f);
    CHECK(field.radiance_at(location, pack_direction({0.0f, 0.0f, 1.0f})) == 0.0f);
    CHECK_FALSE(damage_of(lobes.lobes).has_value());
}

TEST_CASE("Densities of mixtures integrate to one at every point") {
    for (const int rounds : {0, 1, 16}) {
        TestLobes lobes = trained_lobes(1, rounds);
        const LobeField field = lobes.view();
        for (const Vec3f position : {Vec3f{0.0f}, Vec3f{0.4f, -0.3f, 0.0f}}) {
            SurfacePoint point = TestLobes::point_at(position);
            point.shading_normal = glm::normalize(Vec3f{0.3f, 0.1f, 1.0f});
            const LobeLocation location = field.locate(point);
            CHECK(integral_over_sphere([&](Vec3f wi) { return field.density(location, point, wi).pdf_sa; }) ==
                  Approx(1.0).epsilon(2e-3));
        }
    }
}

// Rule S3, false alarms 1e-6: 400 000 samples in 256 equal parts of the sphere; a density off by 5 % from part to part would be found.
TEST_CASE("Samples of a mixture follow its density") {
    TestLobes lobes = trained_lobes();
    const LobeField field = lobes.view();
    const LobeLocation location = lobes.at({0.2f, 0.1f, 0.0f});
    REQUIRE(std::ranges::count_if(location.mixture.lobes.weight, [](float weight) { return weight > 0.0f; }) >= 4);
    const std::vector<double> probabilities =
        cell_probabilities([&](Vec3f wi) { return field.density(location, {}, wi).pdf_sa; });
    std::vector<std::uint64_t> counts(probabilities.size(), 0);
    Uniforms random(2);
    for (int i = 0; i < 400000; ++i) {
        ScatterUniforms numbers;
        numbers.u = {0.0f, random.next(), random.next(), 0.0f};
        const Vec3f wi = field.sample(location, {}, numbers);
        REQUIRE(field.density(location, {}, wi).pdf_sa > 0.0f);
        ++counts[cell_of(wi)];
    }
    CHECK(sampler_matches(counts, probabilities, 0.05));
}

TEST_CASE("Training brings a mixture to the light") {
    TestLobes lobes = trained_lobes(1, 24);
    const LobeField field = lobes.view();
    const LobeLocation location = lobes.at();
    // Of radiance: 40 and 2 at the peaks, 0.05 between them; of one lobe, some per cent of its tail.
    CHECK(field.radiance_at(location, pack_direction(kSharpPeak)) == Approx(40.0f).epsilon(0.25));
    CHECK(field.radiance_at(location, pack_direction(kWidePeak)) == Approx(2.05f).epsilon(0.25));
    CHECK(field.radiance_at(location, pack_direction({0.0f, -1.0f, 0.0f})) < 0.3f);
    const double expected = integral_over_sphere([](Vec3f wi) { return wi.z > 0.0f ? two_peaks(wi) : 0.0f; });
    CHECK(static_cast<double>(lobes.lobes.total[0]) == Approx(expected * 1.0).epsilon(0.1));
    CHECK(field.radiance_at(location, -1) == field.value_at(location));
}

// The chi-square divergence from light that is a mixture itself, by quadrature.
TEST_CASE("The divergence of a mixture from the light falls with its updates") {
    const auto divergence = [](int rounds) {
        TestLobes lobes = trained_lobes(1, rounds);
        const LobeField field = lobes.view();
        const auto light = [](Vec3f wi) { return wi.z > 0.0f ? two_peaks(wi) : 0.0f; };
        const double all = integral_over_sphere(light);
        return integral_over_sphere([&](Vec3f wi) {
            const float p = light(wi) / static_cast<float>(all);
            const float q = field.radiance_pdf_sa(0, Vec3f{0.0f}, wi);
            return p > 0.0f ? p * std::log(p / q) : 0.0f;
        });
    };
    const double before = divergence(0);
    const double early = divergence(2);
    const double late = divergence(24);
    CHECK(early < before);
    CHECK(late < 0.5 * early);
    CHECK(late < 0.1);
}

TEST_CASE("Lobes split where light is missing, and nearly equal ones merge") {
    TestLobes lobes = trained_lobes(1, 24);
    CHECK(lobes.lobes.lobe_count[0] >= 2);
    CHECK(lobes.lobes.lobe_count[0] <= kMostLobes);
    // One narrow peak: eight lobes that all move to it become few.
    TestLobes single;
    Uniforms random(8);
    for (int round = 0; round < 60; ++round) {
        for (int i = 0; i < 2000; ++i) {
            const Vec3f wi = square_to_sphere({0.5f + 0.5f * random.next(), random.next()});
            single.record({wi, 2.0f * kUniformSpherePdf, std::exp(20.0f * (wi.z - 1.0f))});
        }
        single.update();
    }
    CHECK(single.lobes.lobe_count[0] <= 5);
    CHECK_FALSE(damage_of(single.lobes).has_value());
}

TEST_CASE("A merge of equal lobes changes nothing, one of distant lobes much") {
    FittedLobe a;
    a.weight = 0.3f;
    a.lobe = {{0.0f, 0.0f, 1.0f}, 20.0f};
    FittedLobe b = a;
    CHECK(std::fabs(merge_misfit(a, b, a.lobe)) < 1e-5f);
    b.lobe.mean = {1.0f, 0.0f, 0.0f};
    const VmfLobe merged{glm::normalize(a.lobe.mean + b.lobe.mean), 3.0f};
    // The same integral by quadrature.
    const double expected = integral_over_sphere([&](Vec3f wi) {
        const float pair = 0.3f * density_of(a.lobe, wi) + 0.3f * density_of(b.lobe, wi);
        const float one = 0.6f * density_of(merged, wi);
        return square(pair - one) / one;
    });
    CHECK(static_cast<double>(merge_misfit(a, b, merged)) == Approx(expected).epsilon(1e-2));
    CHECK(expected > 0.1);
}

// A lamp at a point: samples at points all around agree on its place, and a point far from the site looks towards it.
TEST_CASE("Lobes turn towards their light as seen from each point") {
    const Vec3f lamp{0.3f, 0.1f, 0.6f};
    TestLobes lobes;
    Uniforms random(9);
    for (int round = 0; round < 12; ++round) {
        for (int i = 0; i < 2000; ++i) {
            const Vec3f position{random.between(-0.3f, 0.3f), random.between(-0.3f, 0.3f), 0.0f};
            const Vec3f wi = square_to_sphere({0.5f + 0.5f * random.next(), random.next()});
            const float along = max_of(glm::dot(lamp - position, wi), 0.01f);
            const float miss = glm::length(lamp - position - along * wi);
            lobes.record({wi, 2.0f * kUniformSpherePdf, miss < 0.08f ? 1.0f : 0.0f, position, along});
        }
        lobes.update();
    }
    for (const Vec3f position : {Vec3f{0.0f}, Vec3f{-0.3f, 0.2f, 0.0f}, Vec3f{0.3f, -0.3f, 0.0f}}) {
        const LobeLocation location = lobes.at(position);
        const float towards = location.mixture.pdf_sa(glm::normalize(lamp - position));
        // The lamp fills 0.05 steradians; without parallax the two far points have less than 1 there.
        CHECK(towards > 5.0f);
    }
}

TEST_CASE("Neither the order of training samples nor threads change a bit of lobes") {
    TestLobes forward = trained_lobes(1, 2);
    TestLobes backward = trained_lobes(1, 2);
    std::vector<LobeSample> samples = lobe_samples(3000, 9);
    for (const LobeSample& sample : samples) forward.record(sample);
    std::ranges::reverse(samples);
    for (const LobeSample& sample : samples) backward.record(sample);
    CHECK(forward == backward);
    forward.update(1);
    backward.update(8);
    CHECK(forward == backward);
    CHECK_FALSE(trained_lobes(1, 2) == forward);
}

TEST_CASE("The irradiance of a volume with lobes is the cosine-weighted mean of its training samples") {
    TestLobes lobes;
    Uniforms random(4);
    for (int i = 0; i < 1000; ++i) {
        const Vec3f wi = square_to_sphere({0.5f + 0.5f * random.next(), random.next()});
        lobes.record({wi, random.between(0.1f, 2.0f), 3.0f});
    }
    lobes.update();
    CHECK(lobes.lobes.mean_radiance[0] == Approx(3.0f).epsilon(1e-5));
    CHECK(lobes.lobes.samples[0] == 1000);
    CHECK(lobes.lobes.change[0] == lobes.lobes.mean_radiance[0]);
}

TEST_CASE("Extreme training samples leave sound mixtures") {
    for (const float target : {1e-30f, 1e30f, kInfinity, kNan}) {
        TestLobes lobes = trained_lobes(1, 3, 200);
        for (int i = 0; i < 3; ++i) {
            lobes.record({{0.0f, 0.0f, 1.0f}, 1e-20f, target, {}, 1e-30f});
            lobes.record({{0.0f, 0.6f, 0.8f}, 1e20f, target, {0.9f, 0.9f, 0.0f}, kInfinity});
            lobes.record({{0.6f, 0.0f, -0.8f}, 0.1f, 1.0f});
            lobes.update();
            CHECK(fits(lobes.shape, lobes.lobes, 1));
            const std::optional<FieldDamage> damage = damage_of(lobes.lobes);
            INFO((damage ? damage->got : std::string()));
            CHECK_FALSE(damage.has_value());
        }
        const float pdf_sa = lobes.at().mixture.pdf_sa({0.0f, 0.0f, 1.0f});
        CHECK((pdf_sa >= 0.0f && pdf_sa < kInfinity));
    }
}

TEST_CASE("A volume with lobes is forgotten, and split in two that know the same") {
    TestLobes lobes = trained_lobes(1, 4);
    const std::uint32_t parents[] = {0};
    const HostLobes two = split_field(lobes.shape, lobes.lobes, parents);
    CHECK(fits(lobes.shape, two, 2));
    CHECK(two.lobe_count[1] == lobes.lobes.lobe_count[0]);
    CHECK(two.kappa[kMostLobes] == lobes.lobes.kappa[0]);
    CHECK(two.samples[0] + two.samples[1] == lobes.lobes.samples[0]);
    CHECK_FALSE(damage_of(two).has_value());
    HostField field = lobes.lobes;
    forget_volume(lobes.shape, lobes.volumes, field, 0);
    lobes.lobes = std::get<HostLobes>(field);
    CHECK(lobes == TestLobes{});
}

TEST_CASE("The bytes of lobes are those of their arrays") {
    TestLobes lobes;
    const std::size_t bytes = bytes_by_volume<HostLobes>(lobes.shape);
    CHECK(field_bytes(lobes.lobes) == bytes);
    lobes.shape.light_clusters = 5;
    CHECK(bytes_by_volume<HostLobes>(lobes.shape) > bytes);
    CHECK(bytes < table_bytes(256));
}

TEST_CASE("Damaged lobes are found") {
    const TestLobes whole = trained_lobes(1, 2);
    REQUIRE_FALSE(damage_of(whole.lobes).has_value());
    const auto is_found = [&](const std::function<void(HostLobes&)>& damage) {
        HostLobes lobes = whole.lobes;
        damage(lobes);
        return !fits(whole.shape, lobes, 1) || damage_of(lobes).has_value();
    };
    CHECK(is_found([](HostLobes& t) { t.lobe_count[0] = 0; }));
    CHECK(is_found([](HostLobes& t) { t.lobe_count[0] = kMostLobes + 1; }));
    CHECK(is_found([](HostLobes& t) { t.weight[0] += 0.1f; }));
    CHECK(is_found([](HostLobes& t) { t.weight[0] = kNan; }));
    CHECK(is_found([](HostLobes& t) { t.mean[1] += 0.5f; }));
    CHECK(is_found([](HostLobes& t) { t.mean[2] = kNan; }));
    CHECK(is_found([](HostLobes& t) { t.kappa[0] = 1e6f; }));
    CHECK(is_found([](HostLobes& t) { t.inverse_distance[0] = kInfinity; }));
    CHECK(is_found([](HostLobes& t) { t.moments.pop_back(); }));
    CHECK(is_found([](HostLobes& t) { t.mean_radiance.clear(); }));
}
