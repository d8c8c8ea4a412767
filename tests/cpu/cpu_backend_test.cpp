// The contract of a back end except its pictures: rejected requests, preserved state, description.
#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.h"
#include "core/kernel/guiding/update_volume.h"
#include "core/kernel/inspect/heat_map.h"
#include "tests/cpu/small_room.h"
#include "tests/support/catch.hpp"
#include "tests/support/same_bits.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr FilmSlot kBeauty{MethodId::Default, View::Beauty};

PassRequest pass_of(const Room& room, FilmSlot slot) {
    return {.slot = slot, .features = needed_effects(*room.scene), .path = {.seed = 3}, .camera = room.camera};
}

std::unique_ptr<RenderBackend> with_empty_film(const Room& room, FilmSlot slot) {
    auto backend = make_backend(room, {.threads = 2});
    backend->reset_film(slot, kWidth, kHeight);
    return backend;
}

/// A cleared film after one pass.
std::vector<Vec3f> whole_pass(const Room& room, FilmSlot slot) {
    const auto backend = with_empty_film(room, slot);
    backend->run_pass(pass_of(room, slot));
    return backend->read_film(slot).mean;
}

}  // namespace

TEST_CASE("Views in parallel equal views pixel by pixel") {
    const Room room;
    HostTables tables = room.empty_tables();
    for (std::size_t i = 0; i < tables.mean_radiance.size(); ++i) {
        tables.mean_radiance[i] = 0.1f * static_cast<float>(i % 7);
        tables.change[i] = 0.03f * static_cast<float>(i % 5);
        tables.bsdf_fraction[i] = 0.2f * static_cast<float>(i % 4);
    }
    for (std::size_t i = 0; i < tables.visits.size(); ++i) tables.visits[i] = static_cast<std::uint32_t>(i % 11 / 3);
    const auto side = static_cast<std::size_t>(room.shape.cells.side);
    for (std::size_t i = 0; i < tables.row_cdf.size(); ++i)
        if (i % side + 1 < side) tables.row_cdf[i] *= 1.0f / static_cast<float>(1 + i % 3);
    const TableField field = field_view(room.shape, *room.volumes, tables);
    const SceneView scene = room.scene->view();
    for (const ViewInfo& info : all_views()) {
        const View view = info.id;
        if (view == View::Beauty) continue;
        INFO(info.name);
        std::vector<float> values;
        for (std::uint32_t volume = 0; volume < tables.mean_radiance.size(); ++volume)
            values.push_back(volume_value(TableVolumeSummary{update_view(room.shape, tables)}, volume, view));
        if (is_heat_map(view)) CHECK(std::set<float>(values.begin(), values.end()).size() > 2);
        const ShownField shown{field, view_of(std::as_const(values))};
        const ViewContext context{.view = view,
                                  .shown = shown,
                                  .camera = room.camera,
                                  .settings = {.seed = 3},
                                  .grid = {kWidth, kHeight, 0}};
        std::vector<Vec3f> expected;
        for (std::uint32_t pixel = 0; pixel < kWidth * kHeight; ++pixel)
            expected.push_back(sample_view<FeatureSet{}>(context, scene, BvhIntersector{scene}, pixel));
        for (const int threads : {1, 7}) {
            const auto backend = make_backend(room, {.threads = threads});
            backend->upload_field(MethodId::Reinforcement, tables);
            const FilmSlot slot{MethodId::Default, view};
            backend->reset_film(slot, kWidth, kHeight);
            const PassCounters counters = backend->run_pass(pass_of(room, slot));
            CHECK(counters.paths == expected.size());
            CHECK(counters.invalid_samples == 0);
            CHECK(same_bits(expected, backend->read_film(slot).mean));
        }
    }
}

TEST_CASE("A pass leaves rounding and denormals as they were") {
    const Room room;
    volatile float tiny = 1e-40f;
    REQUIRE(std::fesetround(FE_UPWARD) == 0);
    const auto backend = make_backend(room, {.threads = 2});
    CHECK(std::fegetround() == FE_UPWARD);
    REQUIRE(std::fesetround(FE_TONEAREST) == 0);
    backend->reset_film(kBeauty, kWidth, kHeight);
    backend->run_pass(pass_of(room, kBeauty));
    CHECK(std::fegetround() == FE_TONEAREST);
    CHECK(tiny * 0.5f > 0.0f);
    CHECK(tiny + tiny > tiny);
}

TEST_CASE("A pass of a heat map replaces the one before") {
    const Room room;
    const FilmSlot slot{MethodId::Reinforcement, View::Visits};
    const auto backend = with_empty_film(room, slot);
    CHECK_THROWS_WITH(backend->run_pass(pass_of(room, slot)), contains("tables of 'reinforcement'"));
    const auto cells = static_cast<float>(room.shape.cells.count());
    for (const std::uint32_t visits : {3u, 8u}) {
        HostTables tables = room.empty_tables();
        std::fill(tables.visits.begin(), tables.visits.end(), visits);
        backend->upload_field(MethodId::Reinforcement, tables);
        backend->run_pass(pass_of(room, slot));
        const FilmReading film = backend->read_film(slot);
        CHECK(film.weight == kWidth * kHeight);
        const Vec3f expected{cells * static_cast<float>(visits)};
        CHECK(std::ranges::all_of(film.mean, [&](Vec3f value) { return value == expected; }));
    }
}

TEST_CASE("The halves of a film are its passes of even and of odd number") {
    const Room room;
    const FilmSlot slot{MethodId::Default, View::Beauty};
    const auto render = [&](std::initializer_list<std::uint32_t> passes) {
        const auto backend = with_empty_film(room, slot);
        for (const std::uint32_t sample : passes) {
            PassRequest request = pass_of(room, slot);
            request.sample = sample;
            request.passes = sample + 1;
            backend->run_pass(request);
        }
        return backend->read_halves(slot);
    };
    const FilmReading all = render({0, 1, 2, 3, 4});
    CHECK(all.halves.weights == std::array<std::uint64_t, 2>{3 * kWidth * kHeight, 2 * kWidth * kHeight});
    CHECK(all.halves.are_both_there());
    const FilmReading even = render({0, 2, 4});
    const FilmReading odd = render({1, 3});
    CHECK_FALSE(even.halves.are_both_there());
    CHECK(same_bits(odd.mean, odd.halves.mean[1]));
    // Sums differ by a few rounding errors of doubles: at most one ulp of a float.
    const auto same_but_for_rounding = [](const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
        return std::ranges::equal(
            a, b, [](Vec3f x, Vec3f y) { return max_component(glm::abs(x - y)) <= 2e-7f * max_component(x); });
    };
    CHECK(same_but_for_rounding(even.mean, all.halves.mean[0]));
    CHECK(same_bits(odd.mean, all.halves.mean[1]));
    CHECK_FALSE(same_but_for_rounding(all.mean, all.halves.mean[0]));
}

TEST_CASE("A stopped pass has done a prefix of the pixels, and can be resumed") {
    const Room room;
    for (const View view : {View::Beauty, View::Direct}) {
        INFO(info_of(view).name);
        const FilmSlot slot{MethodId::Default, view};
        const std::vector<Vec3f> whole = whole_pass(room, slot);
        const auto parts = with_empty_film(room, slot);
        PassRequest request = pass_of(room, slot);
        const StopFlag stop{true};
        request.stop = &stop;
        CHECK(parts->run_pass(request).paths == 0);
        CHECK(parts->read_film(slot).weight == 0);
        request.stop = nullptr;
        request.first_pixel = 1000;
        CHECK(parts->run_pass(request).paths == kWidth * kHeight - 1000);
        CHECK(is_black(parts->read_film(slot).mean[999]));
        CHECK_FALSE(same_bits(whole, parts->read_film(slot).mean));
        // The previous pixels belong to another pass of the same sample.
        parts->reset_film(slot, kWidth, kHeight);
        request.first_pixel = 0;
        parts->run_pass(request);
        CHECK(same_bits(whole, parts->read_film(slot).mean));
    }
}

TEST_CASE("A pass in parts is the whole pass, and each part keeps to its pixels") {
    const Room room;
    for (const View view : {View::Beauty, View::Direct}) {
        INFO(info_of(view).name);
        const FilmSlot slot{MethodId::Default, view};
        const std::vector<Vec3f> whole = whole_pass(room, slot);
        const auto parts = with_empty_film(room, slot);
        PassRequest request = pass_of(room, slot);
        request.end_pixel = 700;
        CHECK(parts->run_pass(request).paths == 700);
        CHECK(is_black(parts->read_film(slot).mean[700]));
        request.first_pixel = 700;
        request.end_pixel = kToTheLast;
        CHECK(parts->run_pass(request).paths == kWidth * kHeight - 700);
        CHECK(same_bits(whole, parts->read_film(slot).mean));
    }
}

TEST_CASE("An update in parallel equals an update volume by volume") {
    const Room room;
    HostTables expected = room.empty_tables();
    Uniforms random(9);
    for (std::size_t i = 0; i < expected.pending_sum.size(); ++i) {
        expected.pending_count[i] = random.below(5);
        expected.pending_sum[i] = static_cast<std::int64_t>(random.bits()) * expected.pending_count[i];
    }
    const auto backend = make_backend(room, {.threads = 7});
    backend->upload_field(MethodId::Precomputed, expected);
    CHECK(same_bits(expected.pending_sum, tables_of(backend->download_field(MethodId::Precomputed)).pending_sum));
    backend->update_field(MethodId::Precomputed);
    for (std::uint32_t volume = 0; volume < room.volumes->normals.size(); ++volume)
        update_volume(update_view(room.shape, expected), volume);
    const HostTables tables = tables_of(backend->download_field(MethodId::Precomputed));
    CHECK(same_bits(expected.radiance, tables.radiance));
    CHECK(same_bits(expected.visits, tables.visits));
    CHECK(same_bits(expected.pending_sum, tables.pending_sum));
    CHECK(same_bits(expected.pending_count, tables.pending_count));
    CHECK(same_bits(expected.row_cdf, tables.row_cdf));
    CHECK(same_bits(expected.column_cdf, tables.column_cdf));
    CHECK(same_bits(expected.mean_radiance, tables.mean_radiance));
}

TEST_CASE("Invalid samples are counted, not painted over") {
    SceneDescription description = small_room();
    description.materials[2].emission.x = std::numeric_limits<float>::infinity();
    const Room room(description);
    const auto backend = make_backend(room, {.threads = 2});
    backend->reset_film(kBeauty, kWidth, kHeight);
    const PassCounters counters = backend->run_pass(pass_of(room, kBeauty));
    const FilmReading film = backend->read_film(kBeauty);
    std::uint64_t marked = 0;
    for (const Vec3f& mean : film.mean) marked += std::isnan(mean.x) ? 1 : 0;
    CHECK(counters.invalid_samples > 0);
    CHECK(film.invalid == counters.invalid_samples);
    CHECK(marked == counters.invalid_samples);
    CHECK(film.weight + film.invalid == film.mean.size());
    CHECK(counters.paths == film.mean.size());
}

TEST_CASE("Films are kept apart by method and view, and emptied when reset") {
    const Room room;
    const auto backend = make_backend(room, {.threads = 1});
    const FilmSlot normal{MethodId::Default, View::Normal};
    backend->reset_film(kBeauty, kWidth, kHeight);
    backend->reset_film(normal, kWidth, kHeight);
    backend->run_pass(pass_of(room, kBeauty));
    CHECK(backend->read_film(kBeauty).weight == kWidth * kHeight);
    CHECK(backend->read_film(normal).weight == 0);
    backend->reset_film(kBeauty, 3, 2);
    const FilmReading empty = backend->read_film(kBeauty);
    CHECK(empty.width == 3);
    CHECK(empty.height == 2);
    CHECK(empty.weight == 0);
    REQUIRE(empty.mean.size() == 6);
    CHECK(is_black(empty.mean[5]));
}

TEST_CASE("New volumes clear the tables, a new scene does not") {
    const Room room;
    const auto backend = make_backend(room, {.threads = 1});
    CHECK_FALSE(backend->has_field(MethodId::Reinforcement));
    CHECK(tables_of(backend->download_field(MethodId::Reinforcement)).radiance.empty());
    backend->upload_field(MethodId::Reinforcement, room.empty_tables());
    CHECK(backend->has_field(MethodId::Reinforcement));
    CHECK_FALSE(backend->has_field(MethodId::Precomputed));
    backend->upload_scene(room.scene);
    CHECK(backend->has_field(MethodId::Reinforcement));
    backend->upload_volumes(room.volumes, room.shape);
    CHECK_FALSE(backend->has_field(MethodId::Reinforcement));
}

TEST_CASE("Missing tables and volumes are named, not read") {
    const Room room;
    const auto bare = make_cpu_backend({.threads = 1});
    bare->reset_film(kBeauty, kWidth, kHeight);
    CHECK_THROWS_WITH(bare->run_pass(pass_of(room, kBeauty)), contains("expected a scene"));
    CHECK_THROWS_WITH(bare->upload_field(MethodId::Precomputed, {}), contains("expected volumes"));
    bare->upload_scene(room.scene);
    for (const FilmSlot slot :
         {FilmSlot{MethodId::Default, View::Voronoi}, FilmSlot{MethodId::Default, View::Normal}})
        bare->reset_film(slot, 4, 4);
    CHECK_THROWS_WITH(bare->run_pass(pass_of(room, {MethodId::Default, View::Voronoi})),
                      contains("expected volumes"));
    CHECK_NOTHROW(bare->run_pass(pass_of(room, {MethodId::Default, View::Normal})));

    const auto backend = make_backend(room, {.threads = 1});
    const FilmSlot guided{MethodId::Reinforcement, View::Beauty};
    CHECK_THROWS_WITH(backend->read_film(guided), contains("expected a film"));
    backend->reset_film(guided, kWidth, kHeight);
    CHECK_THROWS_WITH(backend->run_pass(pass_of(room, guided)), contains("tables of 'reinforcement'"));
    CHECK_THROWS_WITH(backend->update_field(MethodId::Precomputed), contains("tables of 'precomputed'"));
    CHECK_THROWS_WITH(backend->precompute({}), contains("tables of 'precomputed'"));
    CHECK_THROWS_AS(backend->reset_film(guided, 0, 4), Error);
    CHECK_THROWS_AS(backend->reset_film(guided, 4, -1), Error);
    CHECK_THROWS_AS(backend->reset_film(guided, 1 << 17, 1 << 17), Error);
}

TEST_CASE("Settings that make no sense are refused") {
    CHECK_THROWS_AS(make_cpu_backend({.threads = -1}), Error);
    CHECK_THROWS_AS(make_cpu_backend({.threads = 100000}), Error);
    CHECK_THROWS_AS(make_cpu_backend({.threads = 1, .batch_paths = 0}), Error);
    CHECK(make_cpu_backend({})->info().threads >= 1);
}

TEST_CASE("The back end names its device") {
    const Room room;
    const auto backend = make_backend(room, {.threads = 2});
    CHECK(backend->info().name == "cpu");
    CHECK_FALSE(backend->info().device.empty());
    CHECK(backend->info().threads == 2);
    CHECK_THAT(backend->info().intersector, contains("dense"));
}
