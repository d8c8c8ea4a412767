// Every option once: its text on the command line and in scene files, its meaning and its help. Parsing, help, scene
// settings and "copy as command" all use this table.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/option_values.h"

namespace pl {

/// Set of subcommands.
class CommandSet {
public:
    template <class... Commands>
    explicit constexpr CommandSet(Commands... commands) : bits_((bit(commands) | ...)) {}
    constexpr bool has(Command command) const { return (bits_ & bit(command)) != 0; }

private:
    static constexpr unsigned bit(Command command) { return 1u << static_cast<unsigned>(command); }
    unsigned bits_;
};

struct OptionSpec {
    std::string_view name;   ///< "spp"
    std::string_view flags;  ///< all spellings, shortest first, aliases last: "-t,--threads"
    std::string_view value;  ///< placeholder of the value in the help; empty: a switch
    std::string_view group;  ///< heading in the help; empty: not shown
    std::string_view help;
    bool is_expert = false;       ///< in the help of all options only
    CommandSet commands;          ///< where it may be given
    bool repeatable = false;      ///< every occurrence counts, instead of the last one
    bool in_scene_files = false;  ///< may be a scene's setting
    /// Throws Error(Usage) "expected ..., got ..." for an invalid value.
    void (*parse)(Options&, const std::string& text) = nullptr;
    /// The value of the options as text that parses to it, empty if there is none; null for options that are no part
    /// of a picture. Of an option that is given once for each of several values, these line by line.
    std::string (*print)(const Options&) = nullptr;
    /// What the help says of the values, behind `help` and a colon; null if `help` says all. Lines stay lines.
    std::string (*values)() = nullptr;

    std::string help_text() const;
};

/// In the order in which options are applied, whatever their order on the command line.
std::span<const OptionSpec> option_table();

/// Parses one option's value; puts its name in front of error messages.
void apply_option(const OptionSpec& spec, Options& options, const std::string& text);

/// The texts of an option that its `print` has of these options and not of `others`.
std::vector<std::string> texts_apart(const OptionSpec& spec, const Options& options, const Options& others);

}  // namespace pl
