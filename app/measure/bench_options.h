// From the command line of `pathlight bench` to its plan, and back to a command.
#pragma once

#include "app/console.h"
#include "app/options.h"
#include "core/bench/bench_plan.h"

namespace pl {

/// Opens scenes and back ends. Throws Error(Usage) also for two scenes of one name.
bench::BenchPlan make_bench_plan(const CommandLine& line, Console& console);

/// The shell command that repeats a bench in any folder.
std::string repeating_command(const CommandLine& line);

}  // namespace pl
