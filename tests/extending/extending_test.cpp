// docs/extending.md is true: a method in one header and a representation in two, which the project does not know, render through the
// CPU's own driver and agree with default path tracing by rule S2.
#include "core/io/sealed_file.h"
#include "cpu/passes/pass_kernels.h"
#include "cpu/rays/batch_tracer.h"
#include "tests/cpu/small_room.h"
#include "tests/extending/cosine_lobe_model.h"
#include "tests/extending/uniform_method.h"
#include "tests/support/catch.hpp"
#include "tests/support/session/same_bits.h"

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

/// Lobes of the small room before any training sample, and the method that they guide.
struct LobesInRoom {
    Room room;
    HostCosineLobes lobes = make_arrays<HostCosineLobes>(room.shape, room.volumes->normals.size());

    Guided<CosineLobeField, ExpectedSarsa> method(LearnedLight light = LearningSettings{}.light) {
        Guided<CosineLobeField, ExpectedSarsa> method;
        method.field = field_view(room.shape, *room.volumes, lobes);
        method.mixture.learned = 0;
        method.learning.light = light;
        return method;
    }
    void update() { CosineLobeModel::update(room.shape, *room.volumes, lobes, 1); }
};

TEST_CASE("Extending: a representation in two headers learns, and agrees with default path tracing",
          "[statistical]") {
    LobesInRoom trained;
    Picture picture(kSide, kSide);
    for (std::uint32_t batch = 0; batch < kBatches; ++batch) {
        add_batch(picture, trained.room, trained.method(LearnedLight::All), 1, 16, 16 * batch);
        trained.update();
    }
    CHECK(same_picture(picture, reference(trained.room), kResolution));
    // Lobes of the walls have turned from their normals towards the lamp, and all volumes expect light.
    const CosineLobeField field = trained.method().field;
    int turned = 0;
    int lit = 0;
    for (std::uint32_t i = 0; i < field.normals.count; ++i) {
        turned += glm::dot(field.axis_of(i), field.normals[i]) < 0.95f ? 1 : 0;
        lit += field.mean_radiance[i] > 0.0f ? 1 : 0;
    }
    CHECK(turned > 10);
    CHECK(lit > static_cast<int>(field.normals.count) * 3 / 4);
}

TEST_CASE("Extending: a representation keeps the light of light samples apart") {
    LobesInRoom trained;
    Picture picture(kSide, kSide);
    add_batch(picture, trained.room, trained.method(), 1, 16, 0);
    trained.update();
    const auto lit = std::ranges::count_if(trained.lobes.direct, [](float direct) { return direct > 0.0f; });
    CHECK(2 * static_cast<std::size_t>(lit) > trained.lobes.direct.size());
}

// What the list of representations expands, for one that is not in it.
TEST_CASE(
    "Extending: lengths, bytes, divided and forgotten volumes, files and kernels follow from the list of arrays") {
    LobesInRoom trained;
    Picture picture(kSide, kSide);
    add_batch(picture, trained.room, trained.method(), 1, 4, 0);
    const FieldShape& shape = trained.room.shape;
    HostCosineLobes& lobes = trained.lobes;
    const std::size_t volumes = volume_count(lobes);
    int pending = 0, filled = 0;
    for_each_pending_array(lobes, [&](const auto& array) {
        ++pending;
        filled += std::ranges::any_of(array, [](auto sum) { return sum != 0; }) ? 1 : 0;
    });
    CHECK(pending == 9);
    CHECK(filled == 6);  // the room has no clusters of lights, and the fraction of the BSDF is not learned
    trained.update();
    const auto best = std::ranges::max_element(lobes.mean_radiance) - lobes.mean_radiance.begin();
    const auto volume = static_cast<std::uint32_t>(best);
    CHECK(fits(shape, lobes, volumes));
    CHECK(field_bytes(lobes) == volumes * bytes_by_volume<HostCosineLobes>(shape));

    const std::uint32_t parents[] = {volume};
    const HostCosineLobes more = split_field(shape, lobes, parents);
    CHECK(fits(shape, more, volumes + 1));
    CHECK(more.direction[3 * volumes] == lobes.direction[3 * volume]);
    CHECK(more.samples[volume] + more.samples[volumes] == lobes.samples[volume]);

    BinaryWriter writer;
    zip(lobes, lobes, [&](const auto&, auto& array) { transfer_array(writer, array); });
    const std::filesystem::path path = "field";
    BinaryReader reader(writer.bytes(), path, "field");
    HostCosineLobes read;
    zip(read, read, [&](const auto&, auto& array) { transfer_array(reader, array); });
    CHECK(same_arrays(read, lobes));

    const CosineLobeInspector inspector = CosineLobeModel::inspector(field_view(shape, *trained.room.volumes, lobes));
    CHECK(inspector.radiance(volume, 0) > 0.0f);
    CHECK(summary_of(shape, *trained.room.volumes, lobes).samples(volume) > 0.0f);
    forget_volume(shape, *trained.room.volumes, lobes, volume);
    CHECK(inspector.radiance(volume, 0) == 0.0f);
    CHECK_FALSE(damage_of(lobes).has_value());

    using Kernels = decltype(host_kernels_of(TypeList<CosineLobeModel>{}));
    STATIC_REQUIRE(Kernels::kCount == MethodList::kCount + 1);
    STATIC_REQUIRE(
        std::same_as<TypeAt<MethodList::kCount, Kernels>::Integrator, Guided<CosineLobeField, ExpectedSarsa>>);
}

TEST_CASE("Extending: every model has the interface of its concept") {
    STATIC_REQUIRE(GuidingField<CosineLobeField>);
    STATIC_REQUIRE_FALSE(RadianceField<CosineLobeField>);
    STATIC_REQUIRE(FieldModel<CosineLobeModel>);
    STATIC_REQUIRE(GuidedMethod<Guided<CosineLobeField, ExpectedSarsa>>);
    STATIC_REQUIRE(GuidedMethod<Guided<CosineLobeField, MonteCarlo>>);
    STATIC_REQUIRE_FALSE(TableGuided<Guided<CosineLobeField, ExpectedSarsa>>);
    STATIC_REQUIRE(Method<UniformMethod>);
}
