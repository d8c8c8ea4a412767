// Choices describe themselves: completely, and in the help and the manual as in the program.
#include "app/option_parsers.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "app/help.h"
#include "app/option_table.h"
#include "app/options/groups.h"
#include "core/io/load_settings.h"
#include "core/scene/surface_info.h"
#include "tests/support/described_choice.h"
#include "tests/support/program/run_program.h"

namespace pl::test {
namespace {

/// The names that the parser of an option knows; none if it takes others, too.
std::vector<std::string> names_of(const OptionSpec& spec) {
    try {
        Options ignored;
        spec.parse(ignored, "?");
    } catch (const ChoiceError& error) {
        return error.names();
    }
    return {};
}

std::string manual() { return read_all(PL_SOURCE_DIR "/docs/manual.md"); }

std::string in_quotes(std::string_view name) { return "`" + std::string(name) + "`"; }

/// The row of a table of the manual that has a text in backticks.
std::string row_with(const std::string& text) {
    std::istringstream lines(manual());
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("|") && line.find("`" + text) != std::string::npos) return line;
    return "";
}

/// Words of the manual in backticks that are values of no choice.
bool is_other_word(const std::string& word) {
    return word == "auto" || method_by_name(word) ||
           std::ranges::any_of(all_commands(), [&](const CommandInfo& info) { return info.name == word; });
}

/// Options with one of several names as their value.
std::vector<OptionSpec> choosing_options() {
    std::vector<OptionSpec> chosen;
    std::ranges::copy_if(option_table(), std::back_inserter(chosen),
                         [](const OptionSpec& spec) { return spec.values != nullptr && spec.value == "NAME"; });
    std::ranges::copy_if(learn_values(), std::back_inserter(chosen),
                         [](const OptionSpec& spec) { return spec.value == "NAME"; });
    return chosen;
}

/// "--field NAME", "--learn rate=NAME".
std::string usage_of(const OptionSpec& spec) {
    return (spec.flags.empty() ? "--learn " : "--") + std::string(spec.name) + (spec.flags.empty() ? "=" : " ") +
           "NAME";
}

TEST_CASE("every value of a choice is described, and each by a name and a label of its own") {
    check_choice<LearningRate>();
    check_choice<LearningTarget>();
    check_choice<LearnedLight>();
    check_choice<Representation>();
    check_choice<RouletteRule>();
    check_choice<GuidingRule>();
    check_choice<ToneCurve>();
    check_choice<HemisphereDisplay>();
    check_choice<MapKd>();
    check_choice<UpAxis>();
    check_choice<SurfaceKind>();
    check_texts<ImageKind>();
}

TEST_CASE("the help of a choice names its values and the default") {
    CHECK(choosing_options().size() >= 12);
    for (const OptionSpec& spec : choosing_options()) {
        const std::string help = spec.help_text();
        CAPTURE(help);
        CHECK(names_of(spec).size() >= 2);
        for (const std::string& name : names_of(spec)) CHECK_THAT(help, contains(name));
        if (help.find("explained by") == std::string::npos) CHECK_THAT(help, contains(" (default)"));
    }
}

TEST_CASE("the manual lists the values of a choice, no others, and the default") {
    for (const OptionSpec& spec : choosing_options()) {
        if (spec.name == "view") continue;
        const std::string row = row_with(usage_of(spec));
        CAPTURE(row);
        const std::vector<std::string> names = names_of(spec);
        for (const std::string& name : names) CHECK_THAT(row, contains(in_quotes(name)));
        const std::regex word("`([a-z-]+)`");
        for (std::sregex_iterator found(row.begin(), row.end(), word), end; found != end; ++found) {
            const std::string text = (*found)[1];
            CAPTURE(text);
            if (!text.starts_with("-")) CHECK((is_other_word(text) || std::ranges::find(names, text) != names.end()));
        }
        const std::string standard = spec.print(Options{});
        if (!standard.empty()) CHECK_THAT(row.substr(row.find(" | ") + 1), contains(in_quotes(standard)));
    }
    for (const ViewInfo& view : all_views()) {
        CAPTURE(std::string(view.name));
        CHECK_FALSE(row_with(std::string(view.name) + "`").empty());
    }
}

}  // namespace
}  // namespace pl::test
