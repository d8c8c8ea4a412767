#include "app/suite.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/option_parsers.h"
#include "core/base/error.h"

namespace pl {
namespace {

namespace fs = std::filesystem;

/// The ends of the paths of its scenes below the folder of --scenes; --quick takes the first ones.
struct Suite {
    std::string_view name;
    std::span<const std::string_view> scenes;
};

/// Options of `bench` by which others have measured. No option may be a switch.
struct Protocol {
    std::string_view name;
    std::string_view options;
    std::string_view source;
};

// clang-format off
constexpr auto kLiterature = std::to_array<std::string_view>({
    "veach-ajar/scene.xml",       // Veach, Ajar
    "veach-bidir/scene.xml",      // Veach, Bidir Room
    "breakfast-room/scene.xml",   // The Breakfast Room
    "grey-white-room/scene.xml",  // The Grey & White Room
    "staircase/scene.xml",        // The Wooden Staircase
    "classroom/scene.xml",        // Japanese Classroom
    "bathroom/scene.xml",         // Contemporary Bathroom
    "kitchen/kitchen.json",       // Country Kitchen, converted
    "mitsuba/spaceship.xml",      // Spaceship
});

constexpr auto kSuites = std::to_array<Suite>({
    {kNoPreset, {}},
    {"literature", kLiterature},
});

constexpr auto kProtocols = std::to_array<Protocol>({
    {kNoPreset, "", ""},
    {"npm", "--nee off --roulette off --max-depth 10",
     "Dong et al. 2023, Neural Parametric Mixtures for Path Guiding: gains at equal samples, by relMSE"},
    {"df", "--nee off --roulette off --max-depth 6 --time-limit 120 --seeds 10",
     "Figueiredo et al. 2025, Neural Path Guiding with Distribution Factorization: relMSE after 120 s without the worst 0.1 % of "
     "the pixels, the trimmed relMSE"},
    {"production", "--nee on --spp 64",
     "rendering-scripts of Open PGL: relMSE of 64 samples, there with epsilon 0.001 and without the worst 0.01 % of the "
     "pixels, here with 0.01 and, if trimmed, without 0.1 %"},
    {"ours", "--nee on --time-limit 120 --seeds 10",
     "time to the same error, with intervals; the curves of 120 s contain those of 2 and 20 s"},
});
// clang-format on

constexpr std::string_view kQuickOptions = "--size 160x90 --time-limit 2 --seeds 5 --reference-spp 1024";
constexpr std::size_t kQuickScenes = 3;

template <class Row>
const Row& row_named(std::span<const Row> rows, const std::string& name) {
    return *std::ranges::find(rows, name, &Row::name);
}

void add_unless_given(CommandLine& line, std::string_view name, const std::string& text) {
    if (is_given(line.given, name)) return;
    const auto spec = std::ranges::find_if(option_table(), [&](const OptionSpec& option) {
        return option.name == name && option.commands.has(Command::Bench);
    });
    apply_option(*spec, line.options, text);
    line.given.push_back({&*spec, text});
}

void add_options(CommandLine& line, std::string_view options) {
    std::istringstream words{std::string(options)};
    for (std::string flag, value; words >> flag >> value;)
        add_unless_given(line, std::string_view(flag).substr(2), value);
    std::ranges::stable_sort(line.given, {}, &GivenOption::spec);  // as parse_command_line() leaves them
}

/// All .xml and .json files below a folder, sorted.
std::vector<fs::path> scene_files(const std::string& folder) {
    if (!fs::is_directory(folder))
        throw Error(ErrorKind::Input, fmt::format("--scenes: expected a folder, got '{}'", folder));
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(
             folder, fs::directory_options::skip_permission_denied | fs::directory_options::follow_directory_symlink))
        if (entry.path().extension() == ".xml" || entry.path().extension() == ".json") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

std::vector<std::string> scenes_of(const Suite& suite, const Options& options, Console& console) {
    const std::vector<fs::path> files = scene_files(options.scenes_folder);
    std::vector<std::string> scenes;
    std::vector<std::string_view> missing;
    for (const std::string_view scene : suite.scenes.first(options.quick ? kQuickScenes : suite.scenes.size())) {
        const auto found = std::ranges::find_if(
            files, [&](const fs::path& file) { return file.generic_string().ends_with(fmt::format("/{}", scene)); });
        if (found == files.end())
            missing.push_back(scene);
        else
            scenes.push_back(found->string());
    }
    if (scenes.empty())
        throw Error(ErrorKind::Input, fmt::format("{}: expected scenes of the suite '{}' in it, there are none: {}",
                                                  options.scenes_folder, suite.name, fmt::join(missing, ", ")));
    if (!missing.empty())
        console.log().warning(fmt::format("{}: the suite '{}' is without {}, which are not in it",
                                          options.scenes_folder, suite.name, fmt::join(missing, ", ")));
    return scenes;
}

}  // namespace

CommandLine expanded(CommandLine line, Console& console) {
    const Options& options = line.options;
    const bool has_suite = options.suite != kNoPreset;
    if (has_suite == options.scenes_folder.empty())
        throw Error(ErrorKind::Usage, !has_suite
                                          ? "--scenes: expected --suite with it"
                                          : "--suite: expected the folder of its scenes with it, --scenes DIR");
    if (options.quick) add_options(line, kQuickOptions);
    add_options(line, row_named(std::span<const Protocol>(kProtocols), options.protocol).options);
    if (has_suite)
        line.options.inputs = scenes_of(row_named(std::span<const Suite>(kSuites), options.suite), options, console);
    return line;
}

std::vector<std::string> suite_names() {
    return names_in(kSuites, [](const Suite& suite) { return suite.name; });
}

std::vector<std::string> protocol_names() {
    return names_in(kProtocols, [](const Protocol& protocol) { return protocol.name; });
}

std::string describe_suites() {
    std::string text = fmt::format("{} (default)", kNoPreset);
    for (const Suite& suite : std::span(kSuites).subspan(1))
        text += fmt::format("\n{}: {}", suite.name, fmt::join(suite.scenes, ", "));
    return text;
}

std::string describe_protocols() {
    std::string text = fmt::format("{} (default)", kNoPreset);
    for (const Protocol& protocol : std::span(kProtocols).subspan(1))
        text += fmt::format("\n{}: {} ({})", protocol.name, protocol.options, protocol.source);
    return text;
}

std::string describe_quick() { return std::string(kQuickOptions); }

}  // namespace pl
