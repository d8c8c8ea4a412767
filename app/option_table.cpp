#include "app/option_table.h"

#include <vector>

#include <fmt/format.h>

#include "app/options/groups.h"
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
    return values == nullptr ? std::string(help) : fmt::format("{}: {}", help, values());
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
        throw Error(ErrorKind::Usage, fmt::format("--{}: {}", spec.name, error.what()));
    }
}

}  // namespace pl
