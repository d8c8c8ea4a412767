// `pathlight selftest`: scenes with closed forms, on every back end of this machine.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/make_backend.h"
#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/selftest/self_test.h"

namespace pl {
namespace {

void tell(const SelfCheck& check, Console& console) {
    const std::string used =
        check.tolerance > 0.0 ? fmt::format("{:4.0f} % of the tolerance", 100.0 * check.used_share) : "exact";
    console.result(fmt::format("{:<5} {:<6} {:<58} {:>12.6g} {:>12.6g}  {}\n", check.backend,
                               check.passed ? "ok" : "FAILED", check.name, check.expected, check.measured, used));
    console.event("selfcheck", {{"backend", check.backend},
                                {"name", check.name},
                                {"criterion", check.criterion},
                                {"passed", check.passed},
                                {"expected", check.expected},
                                {"measured", check.measured},
                                {"tolerance", check.tolerance},
                                {"used_share", check.used_share},
                                {"seconds", check.seconds}});
}

}  // namespace

int run_selftest(const CommandLine& line, Console& console) {
    const InterruptGuard interrupt;
    const Stopwatch watch;
    const std::vector<std::string> backends =
        line.options.backend == "auto" ? available_backends() : std::vector{line.options.backend};
    console.result(
        fmt::format("{:<5} {:<6} {:<58} {:>12} {:>12}  {}\n", "", "", "check", "expected", "measured", "margin"));
    const std::vector<SelfCheck> checks = run_self_test(
        backends, [&](const std::string& name) { return make_own_backend(name, line.options.threads); },
        [&](const SelfCheck& check) { tell(check, console); }, interrupt.flag());
    const std::size_t run = checks.size();
    const auto failed = static_cast<std::size_t>(
        std::count_if(checks.begin(), checks.end(), [](const SelfCheck& check) { return !check.passed; }));
    const double seconds = watch.seconds();
    console.result(fmt::format("{} of {} checks passed in {:.1f} s on {}\n", run - failed, run, seconds,
                               fmt::join(backends, ", ")));
    console.event("selftest", {{"checks", run},
                               {"failed", failed},
                               {"backends", backends},
                               {"interrupted", interrupt.raised()},
                               {"seconds", seconds}});
    if (interrupt.raised()) return kExitInterrupted;
    if (failed > 0)
        throw Error(ErrorKind::Threshold, fmt::format("{} of {} checks failed: this machine computes something else "
                                                      "than the tests of the program allow",
                                                      failed, run));
    return 0;
}

}  // namespace pl
