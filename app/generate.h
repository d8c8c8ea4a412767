// Pages that the program writes about itself when it is built: the manual page, and the completions of shells.
#pragma once

#include <string>

namespace pl {

/// The page of a kind: "man", "complete-bash" or "complete-zsh". All are made of the tables of subcommands and options. Throws
/// Error(Usage) for another kind.
std::string generated_page(const std::string& kind);

}  // namespace pl
