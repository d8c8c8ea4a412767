// Options of the table, group by group: option_table() joins them in this order.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "app/option_parsers.h"
#include "app/option_table.h"
#include "app/parse_values.h"

namespace pl {

/// Files to write.
std::span<const OptionSpec> output_options();
/// Place of an inspection, method, comparisons of a bench.
std::span<const OptionSpec> comparison_options();
/// View, back end, size, seed, estimator, display.
std::span<const OptionSpec> picture_options();
/// Limits of a rendering, thresholds of a comparison.
std::span<const OptionSpec> limit_options();
std::span<const OptionSpec> camera_options();
std::span<const OptionSpec> field_options();
/// What `--learn` sets, each as an option whose name stands before the "=".
std::span<const OptionSpec> learn_values();
/// Messages and the window.
std::span<const OptionSpec> program_options();

using Text = const std::string&;

/// Subcommands that options have in common.
inline constexpr CommandSet kEverywhere(Command::View, Command::Render, Command::Replay, Command::Info,
                                        Command::Convert, Command::Devices, Command::Inspect, Command::Trace,
                                        Command::Compare, Command::Reference, Command::Bench, Command::Report,
                                        Command::Score, Command::SelfTest);
inline constexpr CommandSet kWithScene(Command::View, Command::Render, Command::Replay, Command::Info,
                                       Command::Inspect, Command::Trace, Command::Reference, Command::Bench);
/// Choices for opening a scene.
inline constexpr CommandSet kOpening(Command::View, Command::Render, Command::Replay, Command::Info, Command::Convert,
                                     Command::Inspect, Command::Trace, Command::Reference, Command::Bench);
inline constexpr CommandSet kThreaded(Command::View, Command::Render, Command::Replay, Command::Info,
                                      Command::Inspect, Command::Trace, Command::Reference, Command::Bench,
                                      Command::SelfTest);
inline constexpr CommandSet kOneMethod(Command::View, Command::Render, Command::Replay, Command::Info,
                                       Command::Inspect, Command::Trace, Command::Reference);
inline constexpr CommandSet kPaths(Command::View, Command::Render, Command::Replay, Command::Inspect, Command::Trace,
                                   Command::Reference, Command::Bench);
inline constexpr CommandSet kSampling(Command::View, Command::Render, Command::Replay, Command::Inspect,
                                      Command::Trace);
inline constexpr CommandSet kPictures(Command::View, Command::Render, Command::Replay);
inline constexpr CommandSet kHeadless(Command::Render, Command::Replay, Command::Info, Command::Convert,
                                      Command::Devices, Command::Inspect, Command::Trace, Command::Compare,
                                      Command::Reference, Command::Bench, Command::Report, Command::Score,
                                      Command::SelfTest);
inline constexpr CommandSet kFiles(Command::Render, Command::Inspect);
inline constexpr CommandSet kWithStats(Command::Render, Command::Replay, Command::Inspect);
inline constexpr CommandSet kWorking(Command::Render, Command::Replay, Command::Inspect, Command::Trace,
                                     Command::Reference, Command::Bench);

/// Headings of the help.
inline constexpr std::string_view kOutput = "Output";
inline constexpr std::string_view kPicture = "Picture";
inline constexpr std::string_view kStop = "Limits (the first one that is reached ends the run)";
inline constexpr std::string_view kCompared = "Comparison";
inline constexpr std::string_view kOutcome = "Outcome";
inline constexpr std::string_view kCamera = "Camera";
inline constexpr std::string_view kField = "Learned field";
inline constexpr std::string_view kPlace = "Place";
inline constexpr std::string_view kMessages = "Messages";
inline constexpr std::string_view kViewer = "Viewer";
inline constexpr std::string_view kHidden = "";

/// Parsers for members of Options that take any text, a switch, a side of a picture.
template <auto kMember>
void parse_text(Options& options, const std::string& text) {
    options.*kMember = text;
}

template <auto kMember>
void parse_flag(Options& options, const std::string&) {
    options.*kMember = true;
}

template <auto kMember>
void parse_side(Options& options, const std::string& text) {
    options.*kMember = static_cast<int>(parse_whole(text, 1, kMaxImageSide));
}

/// The member at the end of a path of members of Options.
template <auto... kMembers>
constexpr auto& member_of(auto& options) {
    return (options.*....*kMembers);
}

/// An option for such a member whose values describe themselves.
template <auto... kMembers>
constexpr OptionSpec choosing(OptionSpec spec) {
    using Value = std::remove_reference_t<decltype(member_of<kMembers...>(std::declval<Options&>()))>;
    spec.parse = [](Options& o, Text text) { member_of<kMembers...>(o) = parse_choice<Value>(text); };
    spec.print = [](const Options& o) { return std::string(name_of(member_of<kMembers...>(o))); };
    spec.values = [] {
        const Options standard;
        return describe_choices<Value>(member_of<kMembers...>(standard));
    };
    return spec;
}

}  // namespace pl
