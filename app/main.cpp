// The program: parses the command line, runs a subcommand, turns errors into messages and exit codes.
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/make_backend.h"
#include "app/version.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "mpi/job.h"
#include "mpi/mpi_backend.h"
#include "mpi/rank_device.h"

namespace {

using namespace pl;

int run(const std::vector<std::string>& arguments, Console& console) {
    const CommandLine line = parse_command_line(arguments);
    if (line.answer) {
        console.result(*line.answer);
        return 0;
    }
    console.configure(line.options);
    return run_command(line, console);
}

int tell(const std::string& message, ErrorKind kind, Console& console) {
    console.log().error(message);
    console.event("error", {{"message", message}, {"exit_code", static_cast<int>(kind)}});
    return static_cast<int>(kind);
}

/// run(), with errors turned into messages and exit codes.
int run_guarded(const std::vector<std::string>& arguments, Console& console) {
    try {
        const int code = run(arguments, console);
        console.finish();
        return code;
    } catch (const Error& error) {
        return tell(error.what(), error.kind(), console);
    } catch (const std::bad_alloc&) {
        return tell("out of memory", ErrorKind::Runtime, console);
    } catch (const std::exception& error) {
        return tell(error.what(), ErrorKind::Runtime, console);
    }
}

/// The job of mpirun; empty without one, or if this program cannot take part in it: then `code` is the exit code of
/// the error.
std::unique_ptr<Communicator> join(Console& console, int& code) {
    try {
        choose_device();
        set_processes_here(ranks_on_this_machine());
        return join_job(program_identity());
    } catch (const Error& error) {
        code = tells_why_not_joined() ? tell(error.what(), error.kind(), console) : static_cast<int>(error.kind());
        return nullptr;
    }
}

/// A rank other than 0 prints nothing, unless its own failure ends the job. Rank 0 alone takes requests to stop.
int follow(Communicator& job, const std::vector<std::string>& arguments, Console& console) {
    for (const int signal : kStopSignals) std::signal(signal, SIG_IGN);
    try {
        follow_rank_0(job, make_own_backend, [&] { serve_bench(job, arguments); });
        return 0;
    } catch (const std::exception& error) {
        const std::string message = job.name_of(job.rank()) + ": " + error.what();
        return job.is_broken() ? static_cast<int>(ErrorKind::Unavailable)
                               : tell(message, ErrorKind::Unavailable, console);
    }
}

/// Rank 0 of a job: the other ranks end with it.
int lead(Communicator& job, const std::vector<std::string>& arguments, Console& console) {
    share_over(&job);
    const int code = run_guarded(arguments, console);
    share_over(nullptr);
    try {
        end_ranks(job);
    } catch (const Error&) {
        // A rank has died, which has been told.
    }
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    Console console;
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    int code = 0;
    const std::unique_ptr<Communicator> job = join(console, code);
    if (code != 0) return code;
    if (job) return job->rank() == 0 ? lead(*job, arguments, console) : follow(*job, arguments, console);
    return run_guarded(arguments, console);
}
