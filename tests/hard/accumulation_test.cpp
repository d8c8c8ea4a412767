// Long runs in the arithmetic: sums of 1e10 samples, extreme neighbors, counters at their ends, sizes that change.
#include "core/kernel/film/film_view.h"
#include "core/kernel/guiding/table_update.h"
#include "tests/hard/hard_scenes.h"
#include "tests/support/catch.hpp"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

namespace {

/// A pixel after `samples` samples that are all the same. Within a power of two of the sum every addition of a double is
/// rounded alike, so all of them are done by one product, which is exact there: it has the bits of the loop. A full pixel
/// takes no more.
class LongPixel {
public:
    explicit LongPixel(float value) : value_(value) {}

    void add(std::uint64_t samples) {
        samples = std::min<std::uint64_t>(samples, kMostWeight - pixel_.weight);
        while (samples > 0) {
            add_once();
            --samples;
            const double before = pixel_.sum.x;
            if (samples == 0 || before == 0.0) continue;
            // All but the last few additions below the next power of two, where the spacing of doubles changes.
            const double end = std::ldexp(1.0, std::ilogb(before) + 1);
            add_once();
            --samples;
            const double step = pixel_.sum.x - before;
            const double fitting = step > 0.0 ? (end - pixel_.sum.x) / step - 2.0 : 0.0;
            if (!(fitting >= 1.0)) continue;
            const auto jump = std::min(samples, static_cast<std::uint64_t>(fitting));
            pixel_.sum += Vec3d{step * static_cast<double>(jump)};
            pixel_.weight += static_cast<std::uint32_t>(jump);
            samples -= jump;
        }
    }
    void add_once() { accumulate(FilmView{{&pixel_, 1}, 1, 1}, 0, Vec3f{value_}, 0); }
    const FilmPixel& pixel() const { return pixel_; }

private:
    float value_;
    FilmPixel pixel_;
};

double relative_error(const FilmPixel& pixel, float value) {
    return std::fabs(static_cast<double>(mean_radiance(pixel).x) / static_cast<double>(value) - 1.0);
}

}  // namespace

TEST_CASE("A sum in leaps has the bits of a sum in single steps", "[hard]") {
    for (const float value : {0.1f, 1.0f, 3.7e-5f, 17.3f}) {
        LongPixel leaps(value);
        LongPixel steps(value);
        leaps.add(2000000);
        for (int i = 0; i < 2000000; ++i) steps.add_once();
        INFO(value);
        CHECK(leaps.pixel().sum.x == steps.pixel().sum.x);
        CHECK(leaps.pixel().weight == steps.pixel().weight);
    }
}

// A day at 100 000 samples per second and pixel. Equal samples are the worst case: all roundings go the same way.
TEST_CASE("From a million to 1e10 samples a converged pixel changes by less than 1e-6", "[hard]") {
    for (const float value : {0.1f, 1.0f / 3.0f, 0.9999999f, 3.7e-5f, 17.3f, 1e8f}) {
        LongPixel pixel(value);
        pixel.add(1000000);
        const double before = static_cast<double>(mean_radiance(pixel.pixel()).x);
        CHECK(within(relative_error(pixel.pixel(), value), 1e-7));
        pixel.add(10000000000u - 1000000u);
        INFO(value);
        CHECK(within(static_cast<double>(mean_radiance(pixel.pixel()).x) / before - 1.0, 1e-6));
    }
}

TEST_CASE("A pixel whose counter is full stays as it is", "[hard]") {
    FilmPixel pixel;
    const FilmView film{{&pixel, 1}, 1, 1};
    pixel.weight = kMostWeight - 1;
    pixel.sum = Vec3d{2.0 * static_cast<double>(pixel.weight)};
    for (int i = 0; i < 5; ++i) accumulate(film, 0, Vec3f{2.0f}, 1);
    CHECK(pixel.weight == kMostWeight);
    CHECK(mean_radiance(pixel) == Vec3f{2.0f});
    pixel.invalid = kMostWeight;
    accumulate(film, 0, Vec3f{kNan}, 1);
    CHECK(pixel.invalid == kMostWeight);
}

TEST_CASE("Beside a pixel of 1e8 others keep every bit", "[hard]") {
    std::array<FilmPixel, 3> pixels;
    std::array<FilmPixel, 3> alone;
    Uniforms random(5);
    for (std::uint32_t pass = 0; pass < 10000; ++pass)
        for (std::uint32_t i = 0; i < 3; ++i) {
            const Vec3f value = random.cube(0.0f, 1.0f);
            accumulate({{alone.data(), 3}, 3, 1}, i, value, pass);
            accumulate({{pixels.data(), 3}, 3, 1}, i, i == 1 ? 1e8f * value : value, pass);
        }
    for (const std::size_t i : {0u, 2u}) CHECK(std::memcmp(&pixels[i], &alone[i], sizeof(FilmPixel)) == 0);
    CHECK(within(pixels[1].sum.x / alone[1].sum.x / 1e8 - 1.0, 1e-7));
}

// By every method: the films and fields from before the change of size leave no trace in default path tracing.
TEST_CASE("Another size and back is a fresh start", "[hard]") {
    const SceneDescription scene = shipped_scene("cornell");
    const RenderSettings settings = small_settings(scene, {MethodId::Default, true});
    Session session = make_session(scene, settings, 2);
    render_passes(session, 3);
    const State before = state_of(session);
    session.apply(EditSize{7, 90});
    render_passes(session, 2);
    CHECK(session.snapshot(slot_of(session)).pixels.size() == 7 * 90);
    session.apply(EditSize{settings.width, settings.height});
    CHECK(session.passes(slot_of(session)) == 0);
    render_passes(session, 3);
    CHECK(same_film(before, state_of(session)));
}

TEST_CASE("Numbers of samples that split a run anywhere make the same picture", "[hard]") {
    const SceneDescription scene = shipped_scene("door");
    for (const Estimator estimator : kEstimators) {
        Session whole = make_session(scene, small_settings(scene, estimator, 16, 16), 2);
        Session parts = make_session(scene, small_settings(scene, estimator, 16, 16), 1);
        render_passes(whole, 20);
        const StopFlag stop{true};
        for (int i = 0; i < 20; ++i) {
            CHECK(parts.advance(slot_of(parts), &stop) == Progress::Stopped);
            parts.snapshot_with_halves(slot_of(parts));  // a look changes nothing
            render_passes(parts, 1);
        }
        INFO(estimator);
        CHECK(same_state(state_of(whole), state_of(parts)));
    }
}
