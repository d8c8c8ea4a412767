// The program: parses the command line, runs a subcommand, turns errors into messages and exit codes.
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "app/commands.h"
#include "core/base/error.h"

namespace {

using namespace pl;

int run(const std::vector<std::string>& arguments, Console& console) {
    const CommandLine line = parse_command_line(arguments);
    if (line.answer) {
        console.result(*line.answer);
        return 0;
    }
    console.configure(line.options);
    switch (line.command) {
    case Command::View: return run_view(line, console);
    case Command::Render: return run_render(line, console);
    case Command::Replay: return run_replay(line, console);
    case Command::Info: return run_info(line, console);
    case Command::Devices: return run_devices(line, console);
    case Command::Inspect: return run_inspect(line, console);
    case Command::Trace: return run_trace(line, console);
    case Command::Compare: return run_compare(line, console);
    case Command::Bench: return run_bench(line, console);
    case Command::Report: return run_report(line, console);
    case Command::Reference: return run_reference(line, console);
    case Command::SelfTest: return run_selftest(line, console);
    }
    return static_cast<int>(ErrorKind::Usage);
}

int tell(const std::string& message, ErrorKind kind, Console& console) {
    console.log().error(message);
    console.event("error", {{"message", message}, {"exit_code", static_cast<int>(kind)}});
    return static_cast<int>(kind);
}

}  // namespace

int main(int argc, char** argv) {
    Console console;
    try {
        const int code = run({argv + 1, argv + argc}, console);
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
