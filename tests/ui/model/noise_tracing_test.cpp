// The noise of the clicked pixel: traced only while a panel shows it.
#include "ui/model/noise_tracing.h"

#include "tests/support/catch.hpp"
#include "tests/ui/file_bench.h"
#include "tests/ui/traced_floor.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Noise tracing: works while it is shown, rests while it is hidden, and ends with the paths") {
    FileBench bench;
    bench.options.settings.method = MethodId::Reinforcement;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    NoiseTracing& noise = model.paths().noise();
    noise.show();
    model.paths().set_shown(true);
    model.paths().pick(kFloor);
    REQUIRE(bench.run_until(model, [&] { return is_traced(model); }));
    CHECK(noise.noise() == nullptr);
    CHECK_FALSE(noise.is_working());
    CHECK(noise.seconds() == 0.0);

    REQUIRE(bench.run_until(model, [&] {
        noise.show();
        return noise.noise() != nullptr;
    }));
    CHECK(noise.failure().empty());
    CHECK(noise.noise()->pixel == model.paths().paths()->pixel);
    CHECK(noise.noise()->plain.paths >= kJackknifeGroups);
    CHECK(noise.noise()->guided.has_value());
    CHECK(noise.noise()->guided_method == MethodId::Reinforcement);

    // Hidden, it rests with its result; shown again, it goes on.
    REQUIRE(bench.run_until(model, [&] { return !noise.is_working(); }));
    const std::uint64_t paths = noise.noise()->plain.paths;
    const double seconds = noise.seconds();
    for (int i = 0; i < 5; ++i) model.update(0.0);
    CHECK_FALSE(noise.is_working());
    CHECK(noise.seconds() == seconds);
    if (paths < NoiseTracing::kMostPaths)
        REQUIRE(bench.run_until(model, [&] {
            noise.show();
            return noise.noise()->plain.paths > paths;
        }));

    // Another pixel starts over; Esc ends all.
    model.paths().pick({0.3f, 0.65f});
    REQUIRE(bench.run_until(model, [&] { return noise.noise() == nullptr; }));
    model.cancel();
    CHECK_FALSE(model.paths().is_shown());
    model.update(0.0);
    CHECK_FALSE(noise.is_working());
    CHECK(noise.noise() == nullptr);
}

TEST_CASE("Noise tracing: it ends at the largest number of paths") {
    FileBench bench;
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    REQUIRE(bench.run_until(model, [&] { return has_frame(model); }));
    model.paths().set_shown(true);
    model.paths().pick(kFloor);
    REQUIRE(bench.run_until(model, [&] {
        model.paths().noise().show();
        const diagnose::PixelNoise* const noise = model.paths().noise().noise();
        return noise != nullptr && noise->plain.paths >= NoiseTracing::kMostPaths;
    }));
    CHECK(model.paths().noise().noise()->plain.paths == NoiseTracing::kMostPaths);
    CHECK_FALSE(model.paths().noise().noise()->guided);  // nothing was learned
    model.paths().noise().show();
    model.update(0.0);
    CHECK_FALSE(model.paths().noise().is_working());
}
