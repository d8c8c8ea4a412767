// The words: every option once, with its text on the command line and in scene files, its meaning and its help. Parsing,
// help, scene settings and "copy as command" all go by this table.
#pragma once

#include <span>
#include <string>
#include <string_view>

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
    std::string_view name;   ///< the word: "spp"
    std::string_view flags;  ///< all spellings, shortest first, aliases last: "-t,--threads"
    std::string_view value;  ///< what stands for the value in the help; empty: a switch
    std::string_view group;  ///< heading in the help; empty: not shown
    std::string_view help;
    CommandSet commands;          ///< where it may be given
    bool repeatable = false;      ///< every one counts that is given, instead of the last one
    bool in_scene_files = false;  ///< may be a scene's setting
    /// Throws Error(Usage) "expected ..., got ..." for a value that is wrong.
    void (*parse)(Options&, const std::string& text) = nullptr;
    /// Text that parses to what the options have, empty if there is none; null: no part of a picture.
    std::string (*print)(const Options&) = nullptr;
};

/// In the order in which options are applied, whatever their order on the command line.
std::span<const OptionSpec> option_table();

/// Parses one option's value, with its name in front of complaints.
void apply_option(const OptionSpec& spec, Options& options, const std::string& text);

}  // namespace pl
