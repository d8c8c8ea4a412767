// docs/extending.md is true: a method and a representation that the project does not know, each in one header, render through the
// CPU's own driver and agree with default path tracing by rule S2.
#include "cpu/passes/pass_kernels.h"
#include "cpu/rays/batch_tracer.h"
#include "tests/cpu/small_room.h"
#include "tests/extending/cosine_lobe_field.h"
#include "tests/extending/uniform_method.h"
#include "tests/support/catch.hpp"
#include "tests/support/session/sessions.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr FeatureSet kLightSamples = features(Feature::NextEventEstimation);
constexpr int kSide = 32;
constexpr int kBatches = 64;

/// One pass of any method through the batches of the CPU back end, as sums of radiance.
template <Method M>
void add_batch(Picture& picture, const Room& room, const M& method, std::uint64_t seed, std::uint32_t passes,
               std::uint32_t first) {
    const BatchTracer tracer(room.scene->view());
    const Camera camera = make_camera(small_room().camera, kSide, kSide);
    HostArray<FilmPixel> pixels(kSide * kSide);
    const FilmView film{view_of(pixels), kSide, kSide};
    const PassSetup setup{.scene = room.scene->view(), .path = {.seed = seed, .next_event = 1}};
    for (std::uint32_t pass = 0; pass < passes; ++pass)
        run_paths<kLightSamples>(setup, tracer, method, PictureWork<kLightSamples, M>{camera, first + pass, film});
    std::vector<Vec3d> sums;
    for (const FilmPixel& pixel : pixels) sums.push_back(Vec3d{mean_radiance(pixel)} * static_cast<double>(passes));
    picture.add(sums, passes);
}

template <Method M>
Picture render(const Room& room, const M& method, std::uint64_t seed, std::uint32_t passes) {
    Picture picture(kSide, kSide);
    for (std::uint32_t batch = 0; batch < kBatches; ++batch)
        add_batch(picture, room, method, seed, passes, batch * passes);
    return picture;
}

/// Default path tracing: seed 2, 64 batches of 16 passes at 32 x 32. With the others a difference of 2 % of the mean is eight
/// standard errors; false alarms have probability 1e-6.
const Picture& reference(const Room& room) {
    static const Picture picture = render(room, DefaultMethod{}, 2, 16);
    return picture;
}

constexpr double kResolution = 0.02;

}  // namespace

TEST_CASE("Extending: a method in one header agrees with default path tracing", "[statistical]") {
    const Room room;
    CHECK(same_picture(render(room, UniformMethod{}, 1, 16), reference(room), kResolution));
}

TEST_CASE("Extending: a representation in one header learns, and agrees with default path tracing", "[statistical]") {
    const Room room;
    const PlacementView placement = placement_view(*room.volumes, room.shape.extent);
    CosineLobes lobes(placement);
    Guided<CosineLobeField, ExpectedSarsa> method;
    method.field = lobes.view(placement);
    method.mixture.learned = 0;
    method.learning.light = LearnedLight::All;
    Picture picture(kSide, kSide);
    for (std::uint32_t batch = 0; batch < kBatches; ++batch) {
        add_batch(picture, room, method, 1, 16, 16 * batch);
        lobes.update();
    }
    CHECK(same_picture(picture, reference(room), kResolution));
    // Lobes of the walls have turned from their normals towards the lamp, and all volumes expect light.
    int turned = 0;
    int lit = 0;
    for (std::size_t i = 0; i < lobes.axis.size(); ++i) {
        turned += glm::dot(lobes.axis[i], room.volumes->normals[i]) < 0.95f ? 1 : 0;
        lit += lobes.mean_radiance[i] > 0.0f ? 1 : 0;
    }
    CHECK(turned > 10);
    CHECK(lit > static_cast<int>(lobes.axis.size()) * 3 / 4);
}

TEST_CASE("Extending: a representation keeps the light of light samples apart") {
    const Room room;
    CosineLobes lobes(placement_view(*room.volumes, room.shape.extent));
    Guided<CosineLobeField, ExpectedSarsa> method;
    method.field = lobes.view(placement_view(*room.volumes, room.shape.extent));
    method.mixture.learned = 0;
    Picture picture(kSide, kSide);
    add_batch(picture, room, method, 1, 16, 0);
    lobes.update();
    const auto lit = std::ranges::count_if(lobes.mean_direct, [](float direct) { return direct > 0.0f; });
    CHECK(2 * static_cast<std::size_t>(lit) > lobes.mean_direct.size());
}

TEST_CASE("Extending: every model has the interface of its concept") {
    STATIC_REQUIRE(GuidingField<CosineLobeField>);
    STATIC_REQUIRE_FALSE(RadianceField<CosineLobeField>);
    STATIC_REQUIRE(GuidedMethod<Guided<CosineLobeField, ExpectedSarsa>>);
    STATIC_REQUIRE(GuidedMethod<Guided<CosineLobeField, MonteCarlo>>);
    STATIC_REQUIRE_FALSE(TableGuided<Guided<CosineLobeField, ExpectedSarsa>>);
    STATIC_REQUIRE(Method<UniformMethod>);
}
