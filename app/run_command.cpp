#include "app/commands.h"

namespace pl {

int run_command(const CommandLine& line, Console& console) {
    switch (line.command) {
    case Command::View: return run_view(line, console);
    case Command::Render: return run_render(line, console);
    case Command::Replay: return run_replay(line, console);
    case Command::Info: return run_info(line, console);
    case Command::Convert: return run_convert(line, console);
    case Command::Devices: return run_devices(line, console);
    case Command::Inspect: return run_inspect(line, console);
    case Command::Trace: return run_trace(line, console);
    case Command::Compare: return run_compare(line, console);
    case Command::Bench: return run_bench(line, console);
    case Command::Report: return run_report(line, console);
    case Command::Score: return run_score(line, console);
    case Command::Reference: return run_reference(line, console);
    case Command::SelfTest: return run_selftest(line, console);
    }
    return static_cast<int>(ErrorKind::Usage);
}

}  // namespace pl
