#include "app/version.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cpu/base/lane_kernels.h"

namespace pl {
namespace {

std::string compiler_text() {
#if defined(__clang__)
    return fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    return fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    return "unknown";
#endif
}

}  // namespace

std::string version_text() {
    const auto line = [](const char* name, const std::string& value) {
        return fmt::format("{:<10} {}\n", name, value);
    };
    return "pathlight " PL_VERSION "\n" + line("commit", std::string(commit_id())) +
           line("compiler", compiler_text()) +
           line("back ends", PL_WITH_CUDA ? "cpu, cuda" : "cpu (built without cuda)") +
           line("vectors",
                fmt::format("{} (this machine: {})", fmt::join(compiled_lane_names(), ", "), used_lane_name())) +
           line("MPI", PL_WITH_MPI ? "yes" : "no");
}

std::string program_identity() { return fmt::format("pathlight {} commit {}", PL_VERSION, commit_id()); }

}  // namespace pl
