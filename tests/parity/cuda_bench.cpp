// cuda_bench [OPTIONS]: the speed of the CUDA back end on the present device, by the host's clock, as records for device_tables.py
// (record.h). Medians of passes. Guided and unguided segments are compared in the same run.
#include <algorithm>
#include <cstdlib>

#include <CLI/CLI.hpp>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/io/load_scene.h"
#include "core/session/session.h"
#include "cuda/cuda_backend.h"
#include "tests/parity/record.h"
#include "tests/support/files/temporary_folder.h"
#include "tests/support/scenes/bumpy_ball.h"

using namespace pl;

namespace {

struct Options {
    double seconds = 1.0;
    std::vector<std::string> sizes{"512x512", "1280x720", "1920x1080"};
    std::vector<std::string> also;
    std::string fields_size;
    std::size_t ball_rows = 0;
};

struct Size {
    int width = 0;
    int height = 0;
};

struct Row {
    std::string scene;
    std::string label;
    MethodId method = MethodId::Default;
    bool next_event = false;
    Size size;
    FieldSettings field{};
    std::uint32_t most_samples = 1;  ///< per pixel and launch
};

/// Whether sessions render several samples per pixel in one call, and so the back end in one launch.
template <class AnySession>
concept RendersSeveral = requires(AnySession& session, FilmSlot slot) {
    session.advance(slot, nullptr, 4u);
};

template <class AnySession>
void advance(AnySession& session, FilmSlot slot, [[maybe_unused]] std::uint32_t most_samples) {
    if constexpr (RendersSeveral<AnySession>)
        session.advance(slot, nullptr, most_samples);
    else
        session.advance(slot);
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Measures a row for about so many seconds, at least 9 passes, and prints its record.
void measure(const std::shared_ptr<const SceneDescription>& scene, const Row& row, double seconds) {
    RenderSettings settings;
    settings.method = row.method;
    settings.next_event = row.next_event;
    settings.guiding = GuidingRule::Always;  // the kernel of the row's name runs
    settings.width = row.size.width;
    settings.height = row.size.height;
    settings.camera = scene->camera;
    settings.field = row.field;
    Session session(make_cuda_backend(), scene, settings);
    const FilmSlot slot = slot_of(settings);
    while (session.passes(slot) < 16 * row.most_samples)
        advance(session, slot, row.most_samples);  // launch sizes settle
    const PassCounters before = session.summary(slot).counters;
    const std::uint32_t first = session.passes(slot);
    std::vector<double> passes;
    const Stopwatch watch;
    while (passes.size() < 9 || watch.seconds() < seconds) {
        const std::uint32_t done = session.passes(slot);
        const Stopwatch call;
        advance(session, slot, row.most_samples);
        passes.push_back(call.seconds() / static_cast<double>(session.passes(slot) - done));
    }
    const PassCounters after = session.summary(slot).counters;
    const double count = static_cast<double>(session.passes(slot) - first);
    const double pass = median(passes);
    parity::Record("bench")
        .field("scene", row.scene)
        .field("row", row.label)
        .field("method", info_of(row.method).name)
        .field("nee", row.next_event ? "on" : "off")
        .field("size", fmt::format("{}x{}", row.size.width, row.size.height))
        .field("passes", count)
        .field("most_samples", row.most_samples)
        .field("ms_per_pass", 1.0e3 * pass)
        .field("paths_per_s", static_cast<double>(after.paths - before.paths) / count / pass)
        .field("segments_per_s", static_cast<double>(after.path.segments - before.path.segments) / count / pass);
}

Size parse_size(const std::string& text) {
    Size size;
    if (std::sscanf(text.c_str(), "%dx%d", &size.width, &size.height) != 2 || size.width < 1 || size.height < 1)
        throw Error(ErrorKind::Usage, "--sizes: expected WIDTHxHEIGHT, got '" + text + "'");
    return size;
}

void measure_methods(const std::shared_ptr<const SceneDescription>& scene, const std::string& name, Size size,
                     double seconds) {
    for (const MethodInfo& method : all_methods())
        for (const bool next_event : {false, true})
            measure(scene,
                    {.scene = name, .label = "method", .method = method.id, .next_event = next_event, .size = size},
                    seconds);
}

/// `reinforcement` by the representations that the back end serves; the row's label names them.
void measure_fields(const std::shared_ptr<const SceneDescription>& scene, Size size, double seconds) {
    for (const auto& [label, representation] :
         {std::pair{"table", Representation::Table}, std::pair{"neural", Representation::Neural}})
        for (const bool next_event : {false, true}) {
            Row row{.scene = "cornell",
                    .label = label,
                    .method = MethodId::Reinforcement,
                    .next_event = next_event,
                    .size = size};
            row.field.representation = representation;
            measure(scene, row, seconds);
        }
}

void measure_launches(const std::shared_ptr<const SceneDescription>& scene, Size size, double seconds) {
    for (const MethodId method : {MethodId::Default, MethodId::Precomputed})
        for (const std::uint32_t samples : {1u, 4u, 16u})
            measure(scene,
                    {.scene = "cornell", .label = "launch", .method = method, .size = size, .most_samples = samples},
                    seconds);
}

void run(const Options& options) {
    parity::Record("device").field("name", make_cuda_backend()->info().device);
    const auto cornell = std::make_shared<const SceneDescription>(load_scene("cornell", find_assets_dir()));
    for (const std::string& size : options.sizes)
        measure_methods(cornell, "cornell", parse_size(size), options.seconds);
    if constexpr (RendersSeveral<Session>)
        for (const std::string& size : {options.sizes.front(), options.sizes.back()})
            measure_launches(cornell, parse_size(size), options.seconds);
    for (const std::string& name : options.also)
        measure_methods(std::make_shared<const SceneDescription>(load_scene(name, find_assets_dir())), name,
                        parse_size(options.sizes.back()), options.seconds);
    if (!options.fields_size.empty()) measure_fields(cornell, parse_size(options.fields_size), options.seconds);
    if (options.ball_rows == 0) return;
    const test::TemporaryFolder folder;
    const auto ball = std::make_shared<const SceneDescription>(
        load_scene(test::write_bumpy_ball(folder.path(), options.ball_rows).string(), find_assets_dir()));
    measure_methods(ball, fmt::format("ball of {} triangles", ball->triangles.size()),
                    parse_size(options.sizes.back()), options.seconds);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{"Speed of the CUDA back end"};
    app.add_option("--seconds", options.seconds, "for each row")->check(CLI::PositiveNumber);
    app.add_option("--sizes", options.sizes, "WIDTHxHEIGHT of the pictures; --also and the ball have the last")
        ->delimiter(',');
    app.add_option("--also", options.also, "shipped scenes to measure besides the Cornell box")->delimiter(',');
    app.add_option("--fields-size", options.fields_size,
                   "WIDTHxHEIGHT of the comparison of representations; without: none");
    app.add_option("--ball-rows", options.ball_rows, "rows of a ball of quads, 501 for a million triangles; 0: none")
        ->check(CLI::Range(0, 2000));
    CLI11_PARSE(app, argc, argv);
    try {
        run(options);
        return 0;
    } catch (const Error& error) {
        std::fprintf(stderr, "cuda_bench: %s\n", error.what());
        return static_cast<int>(error.kind());
    }
}
