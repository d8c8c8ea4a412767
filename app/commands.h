// The subcommands, one file each. They return the exit code, or throw Error.
#pragma once

#include "app/console.h"
#include "app/options.h"
#include "mpi/communicator.h"

namespace pl {

int run_view(const CommandLine& line, Console& console);
int run_render(const CommandLine& line, Console& console);
int run_replay(const CommandLine& line, Console& console);
int run_info(const CommandLine& line, Console& console);
int run_convert(const CommandLine& line, Console& console);
int run_devices(const CommandLine& line, Console& console);
int run_inspect(const CommandLine& line, Console& console);
int run_trace(const CommandLine& line, Console& console);
int run_compare(const CommandLine& line, Console& console);
int run_bench(const CommandLine& line, Console& console);
int run_report(const CommandLine& line, Console& console);
int run_score(const CommandLine& line, Console& console);
int run_reference(const CommandLine& line, Console& console);
int run_selftest(const CommandLine& line, Console& console);

/// Runs the subcommand that the command line names.
int run_command(const CommandLine& line, Console& console);

/// The part of `bench` of a rank other than 0, when rank 0 deals out runs: makes the plan from the same command line, then runs until
/// there are no more. Rank 0 tells its errors.
void serve_bench(Communicator& ranks, const std::vector<std::string>& arguments);

}  // namespace pl
