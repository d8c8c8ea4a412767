// Suites of scenes and protocols of measuring for `bench`: abbreviations for scenes and options that could be typed out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/console.h"
#include "app/options.h"

namespace pl {

/// The command line with the scenes of its suite and the options of --quick and --protocol that are not given in it. A scene that the
/// folder lacks is left out with a warning. Throws Error(Usage) for --scenes or a missing one, Error(Input) for a folder without any.
CommandLine expanded(CommandLine line, Console& console);

std::vector<std::string> suite_names();
std::vector<std::string> protocol_names();
/// Every suite with its scenes, every protocol with its options and source, a line each.
std::string describe_suites();
std::string describe_protocols();
std::string describe_quick();

}  // namespace pl
