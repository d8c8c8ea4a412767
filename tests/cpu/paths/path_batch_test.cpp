// Films, tables and counters of batches of paths have the bits of a loop over single paths. The loop
// uses trace_path of the kernel with the scalar BVH, so this also compares intersectors and random numbers.
#include <algorithm>
#include <array>
#include <cstring>

#include "core/kernel/guiding/update_volume.h"
#include "core/kernel/integrator/lamp_borders.h"
#include "core/kernel/integrator/probe.h"
#include "core/kernel/integrator/trace_path.h"
#include "cpu/paths/pass_setup.h"
#include "tests/cpu/small_room.h"
#include "tests/support/catch.hpp"
#include "tests/support/field/guided_methods.h"
#include "tests/support/same_bits.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr FeatureSet kLightSamples = FeatureSet{}.with(Feature::NextEventEstimation);

bool same_counters(const PassCounters& a, const PassCounters& b) {
    static_assert(std::has_unique_object_representations_v<PassCounters>);
    return std::memcmp(&a, &b, sizeof a) == 0;
}

struct Outcome {
    std::vector<Vec3f> film;
    HostTables tables;
    PassCounters counters;
};

bool same(const Outcome& a, const Outcome& b) {
    return same_bits(a.film, b.film) && same_counters(a.counters, b.counters) &&
           same_bits(a.tables.pending_sum, b.tables.pending_sum) &&
           same_bits(a.tables.pending_count, b.tables.pending_count) &&
           same_bits(a.tables.radiance, b.tables.radiance) && same_bits(a.tables.column_cdf, b.tables.column_cdf) &&
           same_bits(a.tables.row_cdf, b.tables.row_cdf);
}

constexpr std::uint32_t kPasses = 3;

/// Effects of a pass, and whether lights are sampled.
struct Effects {
    FeatureSet set;
    bool next_event = false;
};

PathSettings path_settings(const Effects& effects) {
    return {.seed = 77, .next_event = effects.next_event ? 1u : 0u};
}

/// A room without a ceiling under a constant sky, with a lamp that shines on both sides, and shading normals that lean; one has no length.
SceneDescription open_room() {
    SceneDescription scene = small_room();
    scene.environment = Vec3f{0.2f, 0.3f, 0.5f};
    scene.materials.back().two_sided_emission = true;
    const auto is_ceiling = [&](const TriangleDescription& triangle) {
        return std::ranges::all_of(std::array{triangle.vertex.x, triangle.vertex.y, triangle.vertex.z},
                                   [&](std::uint32_t corner) { return scene.positions[corner].y == 1.0f; });
    };
    std::erase_if(scene.triangles, is_ceiling);
    scene.normals = {Vec3f{0.1f, 1.0f, 0.05f}, Vec3f{-0.3f, 0.9f, 0.2f}, Vec3f{0.5f, 0.4f, 0.6f}, Vec3f{0.0f}};
    for (std::size_t i = 0; i < scene.triangles.size(); i += 2) scene.triangles[i].normal = {0, 1, 2};
    scene.triangles[3].normal = {3, 3, 3};
    return scene;
}

/// An image with light and dark texels, and one of normals that lean.
std::vector<TextureDescription> images() {
    TextureDescription colors{.width = 2, .height = 2};
    colors.texels = {{0.9f, 0.5f, 0.2f, 1.0f}, {0, 0, 0, 1}, {0.3f, 0.8f, 0.6f, 1.0f}, {1, 1, 1, 1}};
    TextureDescription normals{.content = TextureContent::Normal, .width = 2, .height = 1};
    normals.texels = {{0.6f, 0.4f, 0.9f, 1.0f}, {0.3f, 0.5f, 0.8f, 1.0f}};
    return {colors, normals};
}

/// An open room under an image sky with many lamps, one of which shows an image, and images on walls and floor.
SceneDescription room_of_images() {
    SceneDescription scene = open_room();
    scene.textures = images();
    scene.uvs = {{0, 0}, {1, 0}, {0, 1}};
    for (TriangleDescription& triangle : scene.triangles) triangle.uv = {0, 1, 2};
    scene.materials[0].textures.albedo = 0;
    scene.materials[2].textures.emission = 0;
    scene.environment_map = {.width = 2, .height = 1, .texels = {glm::vec3{0.1f}, glm::vec3{1.0f, 0.5f, 0.2f}}};
    Uniforms random(3);
    for (int i = 0; i < 40; ++i) {
        const Vec3f corner = random.cube(-0.9f, 0.9f);
        add_triangle(scene, corner, corner + 0.05f * random.direction(), corner + 0.05f * random.direction(), 2);
        scene.triangles.back().uv = {0, 1, 2};
    }
    return scene;
}

/// The same with surfaces of every kind: by turns on the block, and on the triangles of walls and floor.
SceneDescription room_of_surfaces() {
    SceneDescription scene = room_of_images();
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    const glm::vec3 gray(0.6f);
    const MaterialDescription kinds[] = {
        {.name = "mirror", .albedo = {}, .kind = SurfaceKind::Conductor, .specular = glm::vec3(0.9f)},
        {.name = "metal", .albedo = {}, .kind = SurfaceKind::Conductor, .roughness = 0.4f, .anisotropy = 0.5f},
        {.name = "ink", .kind = SurfaceKind::Dielectric, .absorption = {0.5f, 0.2f, 0.0f}},
        {.name = "coat", .albedo = gray, .kind = SurfaceKind::Plastic},
        {.name = "dull coat", .albedo = gray, .kind = SurfaceKind::Plastic, .roughness = 0.5f},
        {.name = "pane", .kind = SurfaceKind::Pane},
        {.name = "velvet", .albedo = gray, .kind = SurfaceKind::Velvet, .roughness = 0.5f},
        {.name = "relief", .albedo = gray, .textures = {.normal = 1}},
        {.name = "polished relief",
         .albedo = gray,
         .kind = SurfaceKind::Plastic,
         .textures = {.albedo = 0, .normal = 1}},
        {.name = "rust", .albedo = {}, .kind = SurfaceKind::Conductor, .blend = {.other = 0}},
        {.name = "stains", .albedo = gray, .blend = {.other = first}},
    };
    scene.materials.insert(scene.materials.end(), std::begin(kinds), std::end(kinds));
    std::uint32_t kind = 0;
    for (TriangleDescription& triangle : scene.triangles)
        if (triangle.material == 1 || (triangle.material == 0 && kind % 3 == 0))
            triangle.material = first + kind++ % static_cast<std::uint32_t>(std::size(kinds));
        else if (triangle.material == 0)
            ++kind;
    return scene;
}

/// Traces path by path.
template <FeatureSet F, Method M>
Outcome loop_over_paths(const Room& room, const Effects& effects) {
    Outcome outcome{.film = {}, .tables = room.empty_tables(), .counters = {}};
    HostArray<FilmPixel> pixels(kWidth * kHeight);
    const FilmView film{view_of(pixels), kWidth, kHeight};
    const SceneView scene = room.scene->view();
    const PathSettings settings = path_settings(effects);
    const BvhIntersector intersector{scene};
    SingleRays<F, BvhIntersector> rays{scene, intersector};
    M method;
    if constexpr (GuidedMethod<M>) method.field = field_view(room.shape, *room.volumes, outcome.tables);
    for (std::uint32_t sample = 0; sample < kPasses; ++sample) {
        const EmissionContext emission{room.camera, settings, {kWidth, kHeight, sample}, sample + 1};
        for (std::uint32_t light = 0; sample + 1 == kMarkingLook && light < scene.lights.count; ++light)
            outcome.counters.path.emission_rays += mark_lamp_borders<F>(emission, scene, rays, film, light);
        for (std::uint32_t pixel = 0; pixel < pixels.size(); ++pixel) {
            auto state = begin_path<F, M>(room.camera, settings, {kWidth, kHeight, sample}, pixel);
            trace_path<F>(PathContext<M>{scene, method, settings}, BvhIntersector{scene}, state,
                          outcome.counters.path);
            count_path(outcome.counters, state.radiance, accumulate(film, pixel, state.radiance, sample));
            outcome.counters.path.emission_rays += refine_emission<F>(emission, scene, rays, film, pixel);
        }
        if constexpr (std::is_same_v<M, ReinforcementMethod>)
            for (std::uint32_t volume = 0; volume < room.volumes->normals.size(); ++volume)
                update_volume(update_view(room.shape, outcome.tables), volume);
    }
    for (const FilmPixel& pixel : pixels) outcome.film.push_back(mean_radiance(pixel));
    return outcome;
}

Outcome batches(const Room& room, MethodId method, const Effects& effects, const CpuSettings& settings) {
    const auto backend = make_backend(room, settings);
    const FilmSlot slot{method, View::Beauty};
    backend->reset_film(slot, kWidth, kHeight);
    backend->upload_field(method, room.empty_tables());
    Outcome outcome;
    for (std::uint32_t sample = 0; sample < kPasses; ++sample) {
        outcome.counters += backend->run_pass({.slot = slot,
                                               .features = effects.set,
                                               .path = path_settings(effects),
                                               .camera = room.camera,
                                               .mixture = {},
                                               .sample = sample,
                                               .passes = sample + 1});
        if (method == MethodId::Reinforcement) backend->update_field(method);
    }
    outcome.film = backend->read_film(slot).mean;
    outcome.tables = tables_of(backend->download_field(method));
    return outcome;
}

constexpr CpuSettings kSettings[] = {
    {.threads = 1, .batch_paths = 1024}, {.threads = 2, .batch_paths = 1024}, {.threads = 7, .batch_paths = 1024},
    {.threads = 1, .batch_paths = 1},    {.threads = 2, .batch_paths = 16},   {.threads = 7, .batch_paths = 1000},
    {.threads = 2, .batch_paths = 100},
};

void check_batches(const Outcome& expected, const Room& room, MethodId method, const Effects& effects) {
    REQUIRE(expected.counters.paths == kPasses * kWidth * kHeight);
    REQUIRE((expected.counters.path.shadow_rays > 0) == effects.next_event);
    REQUIRE((expected.counters.path.method.records > 0) == (method == MethodId::Reinforcement));
    for (const CpuSettings& settings : kSettings) {
        INFO("effects " << effects.set.bits << ", next event " << effects.next_event << ", batch "
                        << settings.batch_paths << ", threads " << settings.threads);
        CHECK(same(expected, batches(room, method, effects, settings)));
    }
}

template <FeatureSet F, class M>
void check_effects(const Room& room, MethodId method, const Effects& effects) {
    check_batches(loop_over_paths<F, M>(room, effects), room, method, effects);
}

template <class M>
void check_method(MethodId method) {
    const Room closed;
    const Room open(open_room());
    check_effects<FeatureSet{}, M>(closed, method, {FeatureSet{}, false});
    check_effects<kLightSamples, M>(closed, method, {kLightSamples, true});
    for (const bool next_event : {false, true})
        check_effects<kPlainFeatures, M>(open, method, {kPlainFeatures, next_event});
}

/// Rooms with what lanes leave to the steps of one path.
template <class M>
void check_surfaces(MethodId method) {
    constexpr FeatureSet kImages = kCompiledSets[3];
    const Room images(room_of_images());
    const Room surfaces(room_of_surfaces());
    REQUIRE_FALSE(images.scene->view().light_tree.empty());
    REQUIRE(kImages.covers(needed_effects(*images.scene)));
    REQUIRE_FALSE(surfaces.scene->view().absorption.empty());
    for (const bool next_event : {false, true}) {
        check_effects<kImages, M>(images, method, {kImages, next_event});
        check_effects<kEveryFeature, M>(surfaces, method, {kEveryFeature, next_event});
    }
}

}  // namespace

TEST_CASE("Batches of default paths equal single paths") { check_method<DefaultMethod>(MethodId::Default); }
TEST_CASE("Batches of precomputed paths equal single paths") {
    check_method<PrecomputedMethod>(MethodId::Precomputed);
}
TEST_CASE("Batches of reinforcement paths equal single paths") {
    check_method<ReinforcementMethod>(MethodId::Reinforcement);
}

TEST_CASE("Batches of default paths at images and lobes equal single paths") {
    check_surfaces<DefaultMethod>(MethodId::Default);
}
TEST_CASE("Batches of precomputed paths at images and lobes equal single paths") {
    check_surfaces<PrecomputedMethod>(MethodId::Precomputed);
}
TEST_CASE("Batches of reinforcement paths at images and lobes equal single paths") {
    check_surfaces<ReinforcementMethod>(MethodId::Reinforcement);
}

TEST_CASE("Batches of probes equal single probes") {
    const Room room;
    HostTables expected = room.empty_tables();
    const TableField field = field_view(room.shape, *room.volumes, expected);
    const SceneView scene = room.scene->view();
    PathSettings settings = path_settings({kLightSamples, true});
    settings.stream = Stream::Precompute;
    PassCounters counters;
    for (std::uint32_t probe = 0; probe < field.normals.count * 16; ++probe) {
        auto state = begin_probe<kLightSamples>(field, settings, probe, {.index = 2, .strata_side = 4});
        trace_path<kLightSamples>(PathContext<ProbeMethod>{scene, ProbeMethod{}, settings}, BvhIntersector{scene},
                                  state, counters.path);
        finish_probe(field, state, counters.path.method);
        count_path(counters, state.radiance, true);
    }
    for (const std::uint32_t batch : {1u, 16u, 1024u})
        for (const int threads : {1, 2, 7}) {
            const auto backend = make_backend(room, {.threads = threads, .batch_paths = batch});
            backend->upload_field(MethodId::Precomputed, room.empty_tables());
            const PassCounters result =
                backend->precompute({.features = kLightSamples, .path = settings, .sample = 2, .strata_side = 4});
            const HostTables tables = tables_of(backend->download_field(MethodId::Precomputed));
            CHECK(same_counters(counters, result));
            CHECK(same_bits(expected.pending_sum, tables.pending_sum));
            CHECK(same_bits(expected.pending_count, tables.pending_count));
        }
}
