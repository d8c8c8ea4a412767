// Emission that the camera sees, in pixels that the border of a lamp crosses: by camera_emission.h and lamp_borders.h.
#include "core/kernel/integrator/lamp_borders.h"

#include <algorithm>
#include <set>

#include "core/base/host_array.h"
#include "core/kernel/integrator/trace_path.h"
#include "core/kernel/methods/default.h"
#include "core/scene/pack_scene.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/scenes/shapes.h"
#include "tests/support/statistics/moments.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr std::uint32_t kPictureSide = 3;
constexpr float kRadiance = 4.0f;
/// Share of the middle column of pixels that the lamp covers; all of the left one, nothing of the right one.
constexpr double kCovered = 0.65;

/// A lamp that only emits in the plane z = -1, left of x = `border`, before a camera that sees x from -1 to 1 there.
HostScene lamp_before_camera(float border = 0.1f) {
    SceneDescription scene;
    scene.materials = {{.name = "lamp", .emission = Vec3f{kRadiance}, .two_sided_emission = true}};
    std::uint32_t v[4];
    const Vec3f corners[] = {{-9, -9, -1}, {border, -9, -1}, {border, 9, -1}, {-9, 9, -1}};
    for (int i = 0; i < 4; ++i) v[i] = add_vertex(scene, corners[i]);
    add_quad(scene, v[0], v[1], v[2], v[3], 0);
    return pack_scene(scene);
}
CameraDescription camera_ahead() {
    return {.eye = Vec3f{0.0f}, .target = Vec3f{0.0f, 0.0f, -1.0f}, .fov_deg = 90.0f};
}

/// Film after `passes`, with or without further camera rays.
template <FeatureSet F = FeatureSet{}>
HostArray<FilmPixel> render(const HostScene& scene, std::uint64_t seed, std::uint32_t passes, bool refines) {
    const SceneView view = scene.view();
    const BvhIntersector intersector{view};
    SingleRays<F, BvhIntersector> rays{view, intersector};
    const PathSettings settings{.seed = seed};
    const Camera camera = make_camera(camera_ahead(), kPictureSide, kPictureSide);
    HostArray<FilmPixel> pixels(kPictureSide * kPictureSide);
    const FilmView film{view_of(pixels), kPictureSide, kPictureSide};
    PathCounters counters;
    for (std::uint32_t sample = 0; sample < passes; ++sample) {
        const PixelGrid grid{kPictureSide, kPictureSide, sample};
        for (std::uint32_t light = 0; refines && sample + 1 == kMarkingLook && light < view.lights.count; ++light)
            mark_lamp_borders<F>({camera, settings, grid, sample + 1}, view, rays, film, light);
        for (std::uint32_t pixel = 0; pixel < pixels.size(); ++pixel) {
            auto state = begin_path<F, DefaultMethod>(camera, settings, grid, pixel);
            trace_path<F>(PathContext<DefaultMethod>{view, DefaultMethod{}, settings}, intersector, state, counters);
            accumulate(film, pixel, state.radiance, sample);
            if (refines) refine_emission<F>({camera, settings, grid, sample + 1}, view, rays, film, pixel);
        }
    }
    return pixels;
}

}  // namespace

TEST_CASE("Values of emission differ by more than a tenth") {
    const EmissionSeen two = EmissionSeen::of(2.0f);
    CHECK(two.luminance() == 2.0f);
    CHECK_FALSE(two.differs_from(EmissionSeen::of(2.1f)));
    CHECK_FALSE(two.differs_from(EmissionSeen::of(1.9f)));
    CHECK(two.differs_from(EmissionSeen::of(2.3f)));
    CHECK(two.differs_from(EmissionSeen::of(0.0f)));
    CHECK_FALSE(two.differs_from(EmissionSeen{}));  // nothing seen yet
    CHECK_FALSE(EmissionSeen{}.differs_from(two));
    CHECK_FALSE(EmissionSeen::of(0.0f).differs_from(EmissionSeen::of(0.0f)));
    CHECK(EmissionSeen::of(0.0f).differs_from(EmissionSeen::of(1e-20f)));
    CHECK_FALSE(EmissionSeen::of(3e38f).differs_from(EmissionSeen::of(3e38f)));
}

// Of 32 samples, seeds 1 to 400: the mean over seeds agrees with the covered share within five standard errors, and the variance
// falls by more than 20.
TEST_CASE("Further camera rays keep the mean of a pixel that a lamp's border crosses, and remove its noise") {
    const HostScene scene = lamp_before_camera();
    const double truth = kCovered * static_cast<double>(kRadiance);
    Moments plain;
    Moments refined;
    Moments halves[2];
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        plain.add(static_cast<double>(mean_radiance(render(scene, seed, 32, false)[4]).x));
        const FilmPixel pixel = render(scene, seed, 32, true)[4];
        refined.add(static_cast<double>(mean_radiance(pixel).x));
        for (int half = 0; half < 2; ++half) halves[half].add(static_cast<double>(half_mean(pixel, half == 1).x));
    }
    const auto is_true = [&](const Moments& means) {
        return std::fabs(means.mean() - truth) <
               5.0 * std::sqrt(means.variance() / static_cast<double>(means.count()));
    };
    CHECK(is_true(plain));
    CHECK(is_true(refined));
    CHECK(is_true(halves[0]));
    CHECK(is_true(halves[1]));
    CHECK(20.0 * refined.variance() < plain.variance());
}

// A random ray would see so thin a part of a lamp, or so thin a gap beside it, once in 250 times.
TEST_CASE("A lamp's border near the edge of a pixel is found in the third pass") {
    for (const float covered : {0.004f, 0.996f}) {
        const HostScene scene = lamp_before_camera((2.0f * covered - 1.0f) / 3.0f);
        for (std::uint64_t seed = 1; seed <= 50; ++seed) CHECK(render(scene, seed, 3, true)[4].emission.varies == 1);
    }
}

TEST_CASE("Pixels that no border of a lamp crosses keep every bit") {
    const HostScene scene = lamp_before_camera();
    const HostArray<FilmPixel> plain = render(scene, 7, 16, false);
    const HostArray<FilmPixel> refined = render(scene, 7, 16, true);
    for (const std::size_t row : {0u, 1u, 2u}) {
        CHECK(refined[kPictureSide * row + 1].emission.varies == 1);
        for (const std::size_t column : {0u, 2u}) {
            CHECK(refined[kPictureSide * row + column].emission.varies == 0);
            CHECK(refined[kPictureSide * row + column].sum == plain[kPictureSide * row + column].sum);
            CHECK(refined[kPictureSide * row + column].second_sum == plain[kPictureSide * row + column].second_sum);
        }
    }
}

// The lamp covers 1 % of the middle pixel, away from its corners: 16 random rays miss it six times of seven.
TEST_CASE("A lamp smaller than a pixel is found from the lamp, and its noise removed") {
    SceneDescription scene;
    scene.materials = {{.name = "lamp", .emission = Vec3f{kRadiance}, .two_sided_emission = true}};
    const float side = 2.0f / 3.0f * 0.1f;
    std::uint32_t v[4];
    const Vec3f corners[] = {
        {0.1f, 0.1f, -1}, {0.1f + side, 0.1f, -1}, {0.1f + side, 0.1f + side, -1}, {0.1f, 0.1f + side, -1}};
    for (int i = 0; i < 4; ++i) v[i] = add_vertex(scene, corners[i]);
    add_quad(scene, v[0], v[1], v[2], v[3], 0);
    const HostScene lamp = pack_scene(scene);
    const double truth = 0.01 * static_cast<double>(kRadiance);
    Moments plain;
    Moments refined;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        plain.add(static_cast<double>(mean_radiance(render(lamp, seed, 16, false)[4]).x));
        const HostArray<FilmPixel> pixels = render(lamp, seed, 16, true);
        refined.add(static_cast<double>(mean_radiance(pixels[4]).x));
        for (std::size_t i = 0; i < pixels.size(); ++i) REQUIRE(pixels[i].emission.varies == (i == 4 ? 1 : 0));
    }
    const auto error = [&](const Moments& means) {
        return 5.0 * std::sqrt(means.variance() / static_cast<double>(means.count()));
    };
    CHECK(std::fabs(refined.mean() - truth) < error(refined));
    CHECK(std::fabs(plain.mean() - truth) < error(plain));
    CHECK(50.0 * refined.variance() < plain.variance());
}

TEST_CASE("Edges between equal lamps, behind other surfaces, behind the camera or outside the film mark nothing") {
    const auto marks = [](const SceneDescription& scene, Vec3f eye, Vec3f target, float aperture = 0.0f) {
        const HostScene packed = pack_scene(scene);
        const SceneView view = packed.view();
        const BvhIntersector intersector{view};
        SingleRays<FeatureSet{}, BvhIntersector> rays{view, intersector};
        CameraDescription description = camera_ahead();
        description.eye = eye;
        description.target = target;
        EmissionContext context{
            make_camera(description, kPictureSide, kPictureSide), {}, {kPictureSide, kPictureSide, 1}, kMarkingLook};
        context.camera.aperture_radius = aperture;
        HostArray<FilmPixel> pixels(kPictureSide * kPictureSide);
        for (std::uint32_t light = 0; light < view.lights.count; ++light)
            mark_lamp_borders<FeatureSet{}>(context, view, rays, {view_of(pixels), kPictureSide, kPictureSide},
                                            light);
        return std::count_if(pixels.begin(), pixels.end(), [](const FilmPixel& p) { return p.emission.varies != 0; });
    };
    const auto quad = [](SceneDescription& scene, float left, float right, float z, std::uint32_t material) {
        std::uint32_t v[4];
        const Vec3f corners[] = {{left, -9, z}, {right, -9, z}, {right, 9, z}, {left, 9, z}};
        for (int i = 0; i < 4; ++i) v[i] = add_vertex(scene, corners[i]);
        add_quad(scene, v[0], v[1], v[2], v[3], material);
    };
    SceneDescription lamp;
    lamp.materials = {{.name = "lamp", .emission = Vec3f{kRadiance}, .two_sided_emission = true}, {.name = "wall"}};
    quad(lamp, -9.0f, 0.1f, -1.0f, 0);
    const Vec3f ahead{0.0f, 0.0f, -1.0f};
    CHECK(marks(lamp, Vec3f{0.0f}, ahead) == 3);
    CHECK(marks(lamp, Vec3f{0.0f}, ahead, 0.1f) == 0);                           // a lens
    CHECK(marks(lamp, Vec3f{0.0f}, -ahead) == 0);                                // behind the camera
    CHECK(marks(lamp, Vec3f{6.0f, 0.0f, 0.0f}, Vec3f{6.0f, 0.0f, -1.0f}) == 0);  // outside the film
    SceneDescription joined = lamp;
    quad(joined, 0.1f, 9.0f, -1.0f, 0);
    CHECK(marks(joined, Vec3f{0.0f}, ahead) == 0);
    SceneDescription hidden = lamp;
    quad(hidden, -9.0f, 9.0f, -0.5f, 1);
    CHECK(marks(hidden, Vec3f{0.0f}, ahead) == 0);
}

// Against 10^5 points of each line: no pixel is missed, and none marked that the line does not come near to.
TEST_CASE("A line on the film visits the pixels that it crosses, in their order") {
    constexpr float kSize = 16.0f;
    Uniforms random(4);
    for (int round = 0; round < 300; ++round) {
        const float reach = round % 3 == 0 ? 2.0f : 40.0f;
        const auto coordinate = [&] {
            return round % 7 == 0 ? float(random.below(17)) : random.between(-reach, reach + kSize);
        };
        const Vec2f first{coordinate(), coordinate()};
        const Vec2f last = round % 5 == 0 ? Vec2f{first.x, coordinate()} : Vec2f{coordinate(), coordinate()};
        const FilmLine line(first, last, {kSize, kSize});
        std::set<std::pair<int, int>> visited, near_by;
        float begin = line.begin;
        for (int i = 0; i < 64 && begin < line.end; ++i) {
            const float end = line.next_border(begin);
            const Vec2f at = line.at(0.5f * (begin + end));
            visited.insert({static_cast<int>(at.x), static_cast<int>(at.y)});
            REQUIRE(end > begin);
            begin = end;
        }
        for (int i = 0; i <= 100000; ++i) {
            const Vec2f at = first + static_cast<float>(i) * 1e-5f * (last - first);
            const auto inside = [&](float margin) {
                return at.x >= margin && at.y >= margin && at.x <= kSize - margin && at.y <= kSize - margin;
            };
            const auto to_border = [](float x) { return std::fabs(x - std::round(x)); };
            if (inside(0.01f) && to_border(at.x) > 0.01f && to_border(at.y) > 0.01f)
                REQUIRE(visited.contains({static_cast<int>(at.x), static_cast<int>(at.y)}));
            if (!inside(-0.01f)) continue;
            for (const float dx : {-0.01f, 0.0f, 0.01f})
                for (const float dy : {-0.01f, 0.0f, 0.01f})
                    near_by.insert(
                        {static_cast<int>(std::floor(at.x + dx)), static_cast<int>(std::floor(at.y + dy))});
        }
        for (const auto& pixel : visited)
            REQUIRE((near_by.contains(pixel) || pixel.first == 16 || pixel.second == 16));
    }
}

// As for lamps: seeds 1 to 400, 32 samples; the mean agrees with the open share within five standard errors.
TEST_CASE("The border of a bright sky loses its noise by fewer rays, that of a dim one is left to the samples") {
    constexpr FeatureSet kSky = FeatureSet{}.with(Feature::Environment);
    for (const float radiance : {kRadiance, 1.0f}) {
        SceneDescription description;
        description.materials = {{.name = "wall", .albedo = Vec3f{0.0f}}};
        std::uint32_t v[4];
        const Vec3f corners[] = {{-9, -9, -1}, {0.1f, -9, -1}, {0.1f, 9, -1}, {-9, 9, -1}};
        for (int i = 0; i < 4; ++i) v[i] = add_vertex(description, corners[i]);
        add_quad(description, v[0], v[1], v[2], v[3], 0);
        description.environment = Vec3f{radiance};
        const HostScene scene = pack_scene(description);
        const bool is_bright = radiance > kBrightSky;
        CHECK(has_visible_emission(scene.view()) == is_bright);
        Moments plain;
        Moments refined;
        for (std::uint64_t seed = 1; seed <= 400; ++seed) {
            plain.add(static_cast<double>(mean_radiance(render<kSky>(scene, seed, 32, false)[4]).x));
            const FilmPixel pixel = render<kSky>(scene, seed, 32, true)[4];
            refined.add(static_cast<double>(mean_radiance(pixel).x));
            REQUIRE(pixel.emission.varies == (is_bright ? EmissionSeen::kSkyBorder : 0));
        }
        const double truth = (1.0 - kCovered) * static_cast<double>(radiance);
        for (const Moments& means : {plain, refined})
            CHECK(std::fabs(means.mean() - truth) <
                  5.0 * std::sqrt(means.variance() / static_cast<double>(means.count())));
        if (is_bright)
            CHECK(5.0 * refined.variance() < plain.variance());
        else
            CHECK(refined.variance() == plain.variance());
    }
}
