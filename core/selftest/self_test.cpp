#include "core/selftest/self_test.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "core/base/timer.h"
#include "core/selftest/known_scenes.h"
#include "core/session/methods.h"
#include "core/session/session.h"

namespace pl {
namespace {

/// Two-sided normal quantiles: one false alarm in a million, one error in a thousand that is missed.
constexpr double kAlarm = 4.8916;
constexpr double kMiss = 3.0902;

struct Way {
    MethodId method = MethodId::Default;
    bool next_event = false;
    int max_depth = 64;
};

std::string words_of(Way way) {
    return std::string(info_of(way.method).name) + (way.next_event ? " with light samples" : "");
}

RenderSettings settings_of(const SceneDescription& scene, Way way, int side) {
    RenderSettings settings;
    settings.method = way.method;
    settings.next_event = way.next_event;
    settings.max_depth = way.max_depth;
    settings.width = settings.height = side;
    settings.camera = scene.camera;
    settings.field.volumes = 100;
    settings.field.bins = 64;
    return settings;
}

class SelfTest {
public:
    SelfTest(const std::shared_ptr<RenderBackend>& backend, const std::function<void(const SelfCheck&)>& told,
             const StopFlag* stop)
        : backend_(backend), told_(told), stop_(stop) {}

    std::vector<SelfCheck> run() {
        check_exact_sums();
        check_emission();
        check_invisible_blocks();
        check_equal_bits();
        check_closed_box();
        check_means();
        return std::move(done_);
    }

private:
    bool stopped() const { return stop_ != nullptr && *stop_; }

    /// The picture at this number of samples per pixel; empty when stopped.
    Snapshot render(const SceneDescription& scene, const RenderSettings& settings, std::uint32_t passes) {
        Session session(backend_, std::make_shared<const SceneDescription>(scene), settings);
        const FilmSlot slot = slot_of(settings);
        while (session.passes(slot) < passes)
            if (session.advance(slot, stop_) == Progress::Stopped) return {};
        return session.snapshot(slot);
    }

    /// Runs one check unless stopped. `measure` fills in all members but name, criterion and time.
    template <class Measure>
    void check(std::string name, std::string criterion, Measure&& measure) {
        if (stopped()) return;
        const Stopwatch watch;
        SelfCheck result{
            .backend = backend_->info().name, .name = std::move(name), .criterion = std::move(criterion)};
        measure(result);
        if (stopped()) return;
        result.seconds = watch.seconds();
        if (told_) told_(result);
        done_.push_back(std::move(result));
    }

    /// Every pixel has the `expected` value, except for at most as many as have a direction exactly along the
    /// horizon.
    void judge_pixels(SelfCheck& result, const Snapshot& picture, double expected, double tolerance) const {
        std::vector<double> off;
        for (const Vec3f& pixel : picture.pixels)
            for (int c = 0; c < 3; ++c) off.push_back(std::fabs(static_cast<double>(pixel[c]) - expected));
        std::sort(off.begin(), off.end(), [](double a, double b) { return !(a <= b) && b == b; });
        const auto skipped = 3 * static_cast<std::size_t>(picture.counters.path.zero_directions);
        const double worst = skipped < off.size() ? off[skipped] : std::numeric_limits<double>::infinity();
        result.expected = expected;
        result.tolerance = tolerance;
        result.measured = expected + worst;
        settle(result, worst);
    }

    /// Rule for a mean: its error is within the alarm limit, and the standard error is small enough to resolve
    /// `delta`.
    static void judge_mean(SelfCheck& result, const Snapshot& picture, double expected, double reference_error,
                           double delta) {
        double mean = 0.0;
        double squares = 0.0;
        double count = 0.0;
        for (const Vec3f& pixel : picture.pixels) {
            const double before = static_cast<double>(pixel.y) - mean;
            mean += before / ++count;
            squares += before * (static_cast<double>(pixel.y) - mean);
        }
        const double error = std::sqrt(squares / ((count - 1.0) * count));
        result.expected = expected;
        result.measured = mean;
        result.tolerance = kAlarm * error + reference_error;
        settle(result, std::fabs(mean - expected));
        result.passed = result.passed && error > 0.0 && error <= delta * expected / (kAlarm + kMiss);
    }

    /// Negated comparison, so that NaN fails.
    static void settle(SelfCheck& result, double off) {
        result.passed = off <= result.tolerance;
        result.used_share = off == 0.0 ? 0.0 : off / result.tolerance;
    }

    void check_exact_sums() {
        for (const int depth : {1, 3}) {
            const float rho = 0.5f;
            const double sum = 0.25 * (1.0 - std::pow(0.5, depth)) / 0.5;
            check(fmt::format("furnace, paths cut after {}", depth), "the geometric sum in every pixel",
                  [&](SelfCheck& result) {
                      const SceneDescription scene = furnace(glm::vec3{0.25f}, rho);
                      const Snapshot picture = render(scene, settings_of(scene, {.max_depth = depth}, 128), 1);
                      judge_pixels(result, picture, sum, 4.0 * (depth + 1) * static_cast<double>(kRoundoff) * sum);
                  });
        }
    }

    void check_emission() {
        check("a black lamp fills the view", "its emission in every pixel, to the bit", [&](SelfCheck& result) {
            const SceneDescription scene = furnace(glm::vec3{12.1f}, 0.0f);
            judge_pixels(result, render(scene, settings_of(scene, {}, 64), 3), static_cast<double>(12.1f), 0.0);
        });
    }

    // Each surface rounds some ten times, and a path through the block meets a few surfaces.
    void check_invisible_blocks() {
        for (const SurfaceKind kind : {SurfaceKind::Dielectric, SurfaceKind::Conductor})
            check(kind == SurfaceKind::Dielectric ? "clear glass under an even sky" : "a mirror under an even sky",
                  "invisible in every pixel", [&](SelfCheck& result) {
                      MaterialDescription material{.name = "lossless"};
                      material.kind = kind;
                      const SceneDescription scene = lossless_block(material);
                      judge_pixels(result, render(scene, settings_of(scene, {.next_event = true}, 64), 2), 1.0, 2e-5);
                  });
    }

    /// Number of pixels whose bits differ; all pixels if the sizes differ.
    static double differing(const Snapshot& a, const Snapshot& b) {
        if (a.pixels.size() != b.pixels.size()) return static_cast<double>(a.pixels.size() + b.pixels.size());
        double count = 0.0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            count += std::memcmp(&a.pixels[i], &b.pixels[i], sizeof(Vec3f)) == 0 ? 0.0 : 1.0;
        return count;
    }

    void check_equal_bits() {
        const SceneDescription scene = cube_under_ceiling();
        SceneDescription scaled = scene;
        for (glm::vec3& position : scaled.positions) position *= 1024.0f;
        scaled.camera.eye *= 1024.0f;
        scaled.camera.target *= 1024.0f;
        for (const Way way : {Way{}, Way{MethodId::Reinforcement, true}}) {
            const auto compare = [&](SelfCheck& result, const SceneDescription& other) {
                result.measured = differing(render(scene, settings_of(scene, way, 48), 4),
                                            render(other, settings_of(other, way, 48), 4));
                settle(result, result.measured);
            };
            check("the same seed twice: " + words_of(way), "no pixel differs by a bit",
                  [&](SelfCheck& result) { compare(result, scene); });
            check("a scene 1024 times as large: " + words_of(way), "no pixel differs by a bit",
                  [&](SelfCheck& result) { compare(result, scaled); });
        }
    }

    void check_closed_box() {
        check("a closed box", "no path escapes, no sample is invalid", [&](SelfCheck& result) {
            const SceneDescription scene = furnace(glm::vec3{0.2f}, 0.8f);
            const Snapshot picture = render(scene, settings_of(scene, {MethodId::Reinforcement, true}, 128), 4);
            result.measured = static_cast<double>(picture.counters.path.escaped + picture.counters.invalid_samples);
            settle(result, result.measured);
        });
    }

    struct ExpectedMean {
        double radiance;
        double error;  ///< of `radiance` itself
        double delta;  ///< smallest relative difference that the check finds
    };

    /// A mean, rendered in one way, over pixels that all see the same radiance.
    void check_mean(const std::string& name, const SceneDescription& scene, Way way, std::uint32_t passes,
                    const ExpectedMean& mean) {
        check(fmt::format("{}: {}", name, words_of(way)),
              fmt::format("the mean, resolving {:.3g} %", 100.0 * mean.delta), [&](SelfCheck& result) {
                  judge_mean(result, render(scene, settings_of(scene, way, 64), passes), mean.radiance, mean.error,
                             mean.delta);
              });
    }

    void check_means() {
        const SceneDescription closed = furnace(glm::vec3{0.5f}, 0.5f);
        const SceneDescription cube = cube_under_ceiling();
        for (const MethodInfo& method : all_methods()) {
            check_mean("furnace", closed, {method.id, false}, 16, {1.0, 0.0, 0.02});
            check_mean("cube under a bright ceiling", cube, {method.id, method.uses_field}, 64,
                       {kCubeFloorRadiance, kCubeFloorError, 0.03});
        }
        for (const bool next_event : {false, true}) {
            const Way way{MethodId::Reinforcement, next_event};
            // Mirrors count as vertices, so that the usual maximal depth would cut off a thousandth of the light.
            const Way long_way{way.method, next_event, 10000};
            const LampScene over = lamp_over_floor();
            check_mean("lamp over a floor", over.scene, way, 64, {over.floor_radiance, 1e-6, 0.03});
            check_mean("plates between mirrors", plates_between_mirrors(), long_way, 32, {kPlateRadiance, 0.0, 0.03});
        }
        const LampScene beside = lamp_beside_floor();
        check_mean("lamp beside a floor", beside.scene, {MethodId::Default, true}, 64,
                   {beside.floor_radiance, 1e-6, 0.02});
        const LampScene tiny = tiny_lamp();
        check_mean("tiny lamp", tiny.scene, {MethodId::Default, true}, 16,
                   {tiny.floor_radiance, 1e-3 * tiny.floor_radiance, 0.02});
        check_mean("floor under a linear sky", floor_under_linear_sky(0.6f, 1.0f, 0.5f), {MethodId::Default, true},
                   16, {static_cast<double>(0.6f) * (1.0 + 2.0 * 0.5 / 3.0), 1e-4, 0.02});
    }

    std::shared_ptr<RenderBackend> backend_;
    const std::function<void(const SelfCheck&)>& told_;
    const StopFlag* stop_;
    std::vector<SelfCheck> done_;
};

}  // namespace

std::vector<SelfCheck> run_self_test(const std::shared_ptr<RenderBackend>& backend,
                                     const std::function<void(const SelfCheck&)>& told, const StopFlag* stop) {
    return SelfTest(backend, told, stop).run();
}

std::vector<SelfCheck> run_self_test(const std::vector<std::string>& backends, const BackendFactory& make,
                                     const std::function<void(const SelfCheck&)>& told, const StopFlag* stop) {
    std::vector<SelfCheck> all;
    for (const std::string& backend : backends) {
        if (stop != nullptr && *stop) break;
        std::ranges::move(run_self_test(make(backend), told, stop), std::back_inserter(all));
    }
    return all;
}

}  // namespace pl
