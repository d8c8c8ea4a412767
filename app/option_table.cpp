#include "app/option_table.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "app/options/groups.h"
#include "app/parse_values.h"
#include "core/base/error.h"

namespace pl {
namespace {

std::vector<OptionSpec> join_groups() {
    std::vector<OptionSpec> table;
    for (const auto group : {output_options(), comparison_options(), picture_options(), limit_options(),
                             camera_options(), field_options(), program_options()})
        table.insert(table.end(), group.begin(), group.end());
    return table;
}

}  // namespace

std::string OptionSpec::help_text() const {
    if (values == nullptr) return std::string(help);
    const std::string rest = values();
    return fmt::format("{}:{}{}", help, rest.starts_with('\n') ? "" : " ", rest);
}

std::span<const OptionSpec> option_table() {
    static const std::vector<OptionSpec> table = join_groups();
    return table;
}

void apply_option(const OptionSpec& spec, Options& options, const std::string& text) {
    try {
        spec.parse(options, text);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Usage) throw;
        throw Error(ErrorKind::Usage,
                    fmt::format("{}{}: {}", spec.flags.empty() ? "" : "--", spec.name, error.what()));
    }
}

std::vector<std::string> texts_apart(const OptionSpec& spec, const Options& options, const Options& others) {
    if (spec.print == nullptr) return {};
    const std::vector<std::string> known = split(spec.print(others), '\n');
    std::vector<std::string> texts;
    for (const std::string& line : split(spec.print(options), '\n'))
        if (!line.empty() && std::ranges::find(known, line) == known.end()) texts.push_back(line);
    return texts;
}

}  // namespace pl
