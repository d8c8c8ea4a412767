// The paths of a pixel: the picture's, the brightest first, and beside each the path of the other method by the same random numbers.
#include "core/diagnose/pixel_paths.h"

#include <algorithm>

#include "core/diagnose/record_path.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::diagnose;
using namespace pl::test;

namespace {

constexpr std::uint32_t kTracedPixel = 20 * 61 + 30;

Session rendered(const SceneDescription& scene, Estimator estimator, std::uint32_t passes) {
    Session session = make_session(scene, small_settings(scene, estimator));
    render_passes(session, passes);
    return session;
}

}  // namespace

TEST_CASE("Pixel paths: the mean of all paths of a pixel is its value in the picture") {
    const SceneDescription scene = shipped_scene("cornell");
    const Session session = rendered(scene, {MethodId::Default, true}, 40);
    PassPair passes = pass_pair(session, slot_of(session));
    CHECK_FALSE(passes.shows_guided);
    CHECK_FALSE(passes.guided.has_value());  // nothing has been learned
    const PixelPaths paths = trace_pixel(passes, {.pixel = kTracedPixel, .count = 40});
    REQUIRE(paths.plain.size() == 40);
    CHECK(paths.samples == 40);
    CHECK(paths.searched == 40);
    CHECK(paths.guided.empty());
    glm::dvec3 sum{0.0};
    for (const PathRecord& path : paths.plain) sum += glm::dvec3(path.radiance);
    const Vec3f value = session.snapshot(slot_of(session)).pixels[kTracedPixel];
    CHECK(glm::length(sum / 40.0 - glm::dvec3(value)) < 1.0e-6 * glm::length(glm::dvec3(value)));
    CHECK(luminance(value) > 0.0f);
}

TEST_CASE("Pixel paths: the brightest of all passes come first, the newest are the last passes") {
    const SceneDescription scene = shipped_scene("cornell");
    const Session session = rendered(scene, {MethodId::Default, true}, 50);
    PassPair passes = pass_pair(session, slot_of(session));
    const PixelPaths all = trace_pixel(passes, {.pixel = kTracedPixel, .count = 50});
    const PixelPaths brightest = trace_pixel(passes, {.pixel = kTracedPixel, .count = 7});
    CHECK(brightest.searched == 50);
    REQUIRE(brightest.passes.size() == 7);
    CHECK(std::ranges::equal(brightest.passes, std::span(all.passes).first(7)));
    CHECK(std::ranges::is_sorted(brightest.plain, std::ranges::greater{}, path_light));
    CHECK(path_light(all.plain.front()) > path_light(all.plain.back()));

    const PixelPaths newest = trace_pixel(passes, {.pixel = kTracedPixel, .count = 7, .choice = PassChoice::Newest});
    CHECK(newest.searched == 7);
    std::vector<std::uint32_t> numbers = newest.passes;
    std::ranges::sort(numbers);
    CHECK(numbers == std::vector<std::uint32_t>{43, 44, 45, 46, 47, 48, 49});
    CHECK(std::ranges::is_sorted(newest.plain, std::ranges::greater{}, path_light));
}

TEST_CASE("Pixel paths: a learner's picture has those of default beside them, by the same random numbers") {
    const SceneDescription scene = shipped_scene("cornell");
    const Session learned = rendered(scene, {MethodId::Reinforcement, true}, 12);
    const Session plain = rendered(scene, {MethodId::Default, true}, 12);
    PassPair passes = pass_pair(learned, slot_of(learned));
    CHECK(passes.shows_guided);
    CHECK(passes.guided_method == MethodId::Reinforcement);
    const PixelPathsRequest newest{.pixel = kTracedPixel, .count = 12, .choice = PassChoice::Newest};
    const PixelPaths paths = trace_pixel(passes, newest);
    REQUIRE(paths.plain.size() == 12);
    REQUIRE(paths.guided.size() == 12);
    CHECK(std::ranges::is_sorted(paths.guided, std::ranges::greater{}, path_light));
    PassReplay alone = plain.pass_replay(slot_of(plain));
    alone.schedule = passes.plain.schedule;
    bool differ = false;
    for (std::size_t i = 0; i < 12; ++i) {
        const PathRecord path = record_path(alone, field_of(alone), kTracedPixel, paths.passes[i]);
        CHECK(path.radiance == paths.plain[i].radiance);
        CHECK(path.vertices.size() == paths.plain[i].vertices.size());
        CHECK(paths.guided[i].vertices[0].position == path.vertices[0].position);
        CHECK(paths.guided[i].is_guided);
        differ |= paths.guided[i].radiance != path.radiance;
    }
    CHECK(differ);
}

TEST_CASE("Pixel paths: a picture of default has the learner's paths by the same random numbers beside it") {
    const SceneDescription scene = shipped_scene("cornell");
    RenderSettings settings = small_settings(scene, {MethodId::Default, false});
    Session session = make_session(scene, settings);
    const FilmSlot learner{MethodId::Reinforcement, View::Beauty};
    render_passes(session, learner, 6);
    render_passes(session, 3);
    PassPair passes = pass_pair(session, slot_of(session));
    REQUIRE(passes.guided.has_value());
    CHECK_FALSE(passes.shows_guided);
    const PixelPaths paths = trace_pixel(passes, {.pixel = kTracedPixel, .count = 4});
    // The picture has three passes; the fourth follows.
    CHECK(paths.samples == 3);
    REQUIRE(paths.guided.size() == 4);
    CHECK(std::ranges::max(paths.passes) == 3);
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(paths.guided[i].sample == paths.plain[i].sample);
        CHECK(paths.guided[i].is_guided);
        CHECK_FALSE(paths.plain[i].is_guided);
    }
}

TEST_CASE("Pixel paths: a raised stop flag ends the search, views without paths have none") {
    const SceneDescription scene = shipped_scene("cornell");
    Session session = rendered(scene, {MethodId::Default, false}, 2);
    PassPair passes = pass_pair(session, slot_of(session));
    const StopFlag stop{true};
    const PixelPaths paths = trace_pixel(passes, {.pixel = kTracedPixel}, &stop);
    CHECK(paths.searched == 0);
    CHECK(paths.plain.empty());
    CHECK_THROWS(pass_pair(session, {MethodId::Default, View::Normal}));
}

TEST_CASE("Pixel paths: the order by light keeps equal paths as they are") {
    std::vector<PathRecord> paths(4);
    paths[1].radiance = Vec3f{2.0f};
    paths[3].radiance = Vec3f{5.0f};
    CHECK(by_light(paths) == std::vector<std::size_t>{3, 1, 0, 2});
}
