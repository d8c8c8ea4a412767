// The mixture of BSDF and table: samples follow its density, the density belongs to the direction, weights are bounded.
#include "core/kernel/methods/guided.h"

#include "tests/support/catch.hpp"
#include "tests/support/field/field_fixture.h"
#include "tests/support/field/guided_methods.h"
#include "tests/support/numbers.h"
#include "tests/support/statistics/sampling_rule.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr int kRows = 12;     ///< of cos(theta) around z, from -1 to 1
constexpr int kColumns = 24;  ///< of the angle
constexpr int kQuadrature = 24;

/// A horizontal surface beside the volume, whose shading normal leans by the given angle.
SurfacePoint make_surface(double lean_deg, float beside) {
    SurfacePoint surface;
    surface.position = {beside, -0.5f * beside, 0.0f};
    const double angle = lean_deg * kTurn / 360.0;
    surface.shading_normal = Vec3f{Vec3d{std::sin(angle), 0.0, std::cos(angle)}};
    return surface;
}

/// Unit, 30 degrees from +z: the volume's hemisphere is not the surface's.
Vec3f leaning_normal() { return Vec3f{Vec3d{0.0, 0.5, std::sqrt(0.75)}}; }

std::size_t bin_of(Vec3f d) {
    const double row = (static_cast<double>(d.z) + 1.0) * 0.5 * kRows;
    const double column = (std::atan2(static_cast<double>(d.y), static_cast<double>(d.x)) / kTurn + 0.5) * kColumns;
    return static_cast<std::size_t>(min_of(static_cast<int>(row), kRows - 1) * kColumns +
                                    min_of(static_cast<int>(column), kColumns - 1));
}

/// Integral of a density over each bin by the midpoint rule; bins have equal solid angles.
template <class Pdf>
std::vector<double> integrate_bins(Pdf&& pdf) {
    std::vector<double> bins(kRows * kColumns);
    const double cell = 2.0 * kTurn / (kRows * kColumns * kQuadrature * kQuadrature);
    for (int y = 0; y < kRows * kQuadrature; ++y)
        for (int x = 0; x < kColumns * kQuadrature; ++x) {
            const double z = (y + 0.5) / (kRows * kQuadrature) * 2.0 - 1.0;
            const double angle = ((x + 0.5) / (kColumns * kQuadrature) - 0.5) * kTurn;
            const double radius = std::sqrt(1.0 - z * z);
            const Vec3f d{Vec3d{radius * std::cos(angle), radius * std::sin(angle), z}};
            bins[static_cast<std::size_t>(y / kQuadrature * kColumns + x / kQuadrature)] +=
                static_cast<double>(pdf(d)) * cell;
        }
    return bins;
}

/// Draws as the integrator does.
struct Draws {
    std::uint32_t next = 0;

    DirectionSample operator()(const PrecomputedMethod& guided, TableLocation vertex, const SurfacePoint& surface) {
        const Rng rng{5, Stream::Picture, next++, 0};
        return guided.sample_direction(vertex, surface, numbers_of(rng, 1));
    }
};

/// S3 over at most 287 degrees of freedom; a density off by `delta` alternating from bin to bin is found.
void check_mixture(int samples, double delta) {
    TestField field(12, {leaning_normal()});
    for (const Vec2f fraction_and_place : {Vec2f{0.1f, 0.0f}, Vec2f{0.1f, 0.6f}, Vec2f{0.5f, 0.3f}})
        for (const NamedWeights& hard : hard_weights(12)) {
            const float fraction = fraction_and_place.x;
            const SurfacePoint surface = make_surface(20.0, fraction_and_place.y);
            field.tables.inverse_reach[0] = 1.0f;
            field.set_weights(hard.weights);
            const auto guided = guided_by<PrecomputedMethod>(field.view(), {.learned = 0, .bsdf_fraction = fraction});
            const std::vector<double> expected =
                integrate_bins([&](Vec3f d) { return guided.pdf_sa({0}, surface, d); });
            double sum = 0.0;
            for (const double p : expected) sum += p;
            std::vector<std::uint64_t> counts(expected.size());
            Draws draw;
            for (int i = 0; i < samples; ++i) ++counts[bin_of(draw(guided, {0}, surface).wi)];
            INFO(hard.name << ", BSDF fraction " << fraction << ", beside by " << fraction_and_place.y);
            CHECK(std::fabs(sum - 1.0) < 2e-3);  // of the quadrature: a cell that is one bin or less
            CHECK(sampler_matches(counts, expected, delta));
        }
}

}  // namespace

TEST_CASE("Samples of the mixture follow its density") { check_mixture(250000, 0.034); }
TEST_CASE("Samples of the mixture follow its density, finely", "[merge]") { check_mixture(1000000, 0.017); }

TEST_CASE("The density of a sample is that of its direction and no weight exceeds its bound") {
    TestField field(16, {leaning_normal()});
    for (const float fraction : {0.1f, 0.5f, 0.9f, 1.0f})
        for (const NamedWeights& hard : hard_weights(16)) {
            field.set_weights(hard.weights);
            const auto guided = guided_by<PrecomputedMethod>(field.view(), {.learned = 0, .bsdf_fraction = fraction});
            const SurfacePoint surface = make_surface(10.0, 0.5f);
            field.tables.inverse_reach[0] = 1.5f;
            Draws draw;
            double heaviest = 0.0;
            for (int i = 0; i < 50000; ++i) {
                const DirectionSample sample = draw(guided, {0}, surface);
                REQUIRE(sample.pdf_sa == guided.pdf_sa({0}, surface, sample.wi));
                REQUIRE(std::fabs(glm::length(sample.wi) - 1.0f) < 1e-5f);
                if (!(sample.pdf_sa > 0.0f)) continue;
                const float bsdf = reflection_cosine(surface, sample.wi) * kInvPi;
                heaviest = max_of(heaviest, static_cast<double>(bsdf) / static_cast<double>(sample.pdf_sa));
            }
            INFO(hard.name << ", BSDF fraction " << fraction);
            CHECK(heaviest <= (1.0 + 1e-6) / static_cast<double>(fraction));
        }
}

TEST_CASE("Where no volume serves the mixture is the BSDF alone") {
    TestField field(12, {Vec3f{0, 0, 1}});
    field.set_weights(hard_weights(12)[2].weights);
    const auto guided = guided_by<PrecomputedMethod>(field.view(), {.learned = 0, .bsdf_fraction = 0.5f});
    SurfacePoint surface;
    MethodCounters counters;
    CHECK(guided.locate(surface, counters).volume == 0);
    surface.geometric_normal = surface.shading_normal = Vec3f{1, 0, 0};
    const TableLocation nowhere = guided.locate(surface, counters);
    CHECK(nowhere.volume == kNoVolume);
    CHECK(counters.lookups == 2);
    CHECK(counters.lookup_misses == 1);
    Draws draw;
    for (int i = 0; i < 10000; ++i) {
        const DirectionSample sample = draw(guided, nowhere, surface);
        REQUIRE(sample.pdf_sa == lambert_pdf_sa(surface, sample.wi));
    }
}

TEST_CASE("A fraction of one is the BSDF alone") {
    TestField field(12);
    field.set_weights(hard_weights(12)[2].weights);
    const auto guided = guided_by<PrecomputedMethod>(field.view(), {.learned = 0, .bsdf_fraction = 1.0f});
    const SurfacePoint surface;
    Draws draw;
    for (int i = 0; i < 10000; ++i) {
        const DirectionSample sample = draw(guided, {0}, surface);
        REQUIRE(sample.pdf_sa == lambert_pdf_sa(surface, sample.wi));
    }
}

TEST_CASE("Reinforcement learning adds its target to the cell of the direction") {
    TestField field(4, {Vec3f{0, 0, 1}, leaning_normal()});
    field.tables.mean_radiance = {0.0f, 2.0f};
    ReinforcementMethod method;
    method.field = field.view();
    MethodCounters counters;
    const Vec3f wi = square_to_cosine_hemisphere(DirectionCells{4}.point_in_cell(9, {0.5f, 0.5f}));
    const auto open = [&](TableLocation vertex, Vec3f direction) {
        const FieldDensity density = field.view().density({0}, SurfacePoint{}, direction);
        ReinforcementMethod::Memory memory;
        method.scattered(memory, vertex,
                         {.direction = {direction, density.pdf_sa, 1.0f, vertex.is_served() ? density.bin : -1}},
                         counters);
        return memory;
    };
    auto memory = open({0}, wi);
    CHECK(memory.entry.volume == 0);
    CHECK(memory.entry.cell == 9);

    // L_e + rho V, by rms(). Powers of two: exact.
    method.record(method.observe(memory, {.emitted = Vec3f{0.0f}, .albedo = Vec3f{0.25f}}, {1}, counters));
    const auto quarter_gray = static_cast<double>(rms(Vec3f{0.25f})) * 2.0;
    CHECK(field.tables.pending_count[9] == 1);
    CHECK(field.tables.pending_sum[9] == static_cast<std::int64_t>(quarter_gray * 16777216.0));
    // A lamp that reflects nothing, or the sky.
    method.record(method.observe(memory, {.emitted = Vec3f{1.0f}}, {kNoVolume}, counters));
    CHECK(field.tables.pending_count[9] == 2);
    CHECK(counters.records == 2);

    // Radiance beyond the sums' range is counted, and added as their largest value.
    CHECK(counters.clamped_records == 0);
    const float most = kMaxRecordedUnits * field.view().radiance_unit;
    method.record(method.observe(memory, {.emitted = Vec3f{2.0f * most}}, {kNoVolume}, counters));
    CHECK(counters.clamped_records == 1);
    CHECK(counters.records == 3);
    CHECK(field.tables.pending_sum[9] == static_cast<std::int64_t>((quarter_gray + 1.0 + 65536.0) * 16777216.0));

    // Nothing is known where the surface reflects but no volume serves it, and nothing where none was left.
    method.record(method.observe(memory, {.emitted = Vec3f{1.0f}, .albedo = Vec3f{0.5f}}, {kNoVolume}, counters));
    ReinforcementMethod::Memory none{};
    method.record(method.observe(none, {.emitted = Vec3f{1.0f}}, {1}, counters));
    CHECK(counters.records == 3);
    CHECK(field.tables.pending_count[9] == 3);
    CHECK_FALSE(open({kNoVolume}, wi).entry.is_trained());
    CHECK_FALSE(open({0}, {0, 0.6f, -0.8f}).entry.is_trained());  // below the volume's horizon
}

TEST_CASE("The precomputed method learns nothing") {
    TestField field(4);
    PrecomputedMethod method;
    method.field = field.view();
    MethodCounters counters;
    PrecomputedMethod::Memory memory;
    method.scattered(memory, TableLocation{0}, {.direction = {Vec3f{0, 0, 1}, 1.0f, 1.0f}}, counters);
    method.record(method.observe(memory, {.emitted = Vec3f{1.0f}}, TableLocation{0}, counters));
    CHECK(counters.records == 0);
    CHECK(field.tables.pending_count == LargeArray<std::uint32_t>(16, 0));
}
