#include "core/base/memory.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

namespace pl {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

// A fact of the whole process.
std::uint64_t processes_here = 1;

/// Empty if the file cannot be read.
std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The number that a text begins with, after spaces; none if it begins with another word, such as "max".
std::optional<std::uint64_t> number_in(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    std::uint64_t value = 0;
    const auto error = std::from_chars(text.data(), text.data() + text.size(), value).ec;
    return error == std::errc{} ? std::optional(value) : std::nullopt;
}

/// The number behind a word that begins a line; 0 if there is none.
std::uint64_t number_behind(std::string_view text, std::string_view word) {
    while (!text.empty()) {
        if (text.starts_with(word)) return number_in(text.substr(word.size())).value_or(0);
        text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    }
    return 0;
}

std::uint64_t left_of(std::uint64_t limit, std::uint64_t used) { return limit > used ? limit - used : 0; }

std::uint64_t sum_of(std::uint64_t a, std::uint64_t b) { return a > kNoLimit - b ? kNoLimit : a + b; }

/// The names of a version of control groups.
struct GroupFiles {
    const char* folder;
    const char* limit;
    const char* used;
    const char* cached_prefix;  ///< of the lines of memory.stat about the group and those below it
};

constexpr GroupFiles kVersion2{"sys/fs/cgroup", "memory.max", "memory.current", ""};
constexpr GroupFiles kVersion1{"sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_"};

std::uint64_t left_in_group(const fs::path& group, const GroupFiles& names, std::uint64_t swap) {
    const std::optional<std::uint64_t> limit = number_in(text_of(group / names.limit));
    const std::optional<std::uint64_t> used = number_in(text_of(group / names.used));
    if (!limit || !used) return kNoLimit;
    const std::string statistics = text_of(group / "memory.stat");
    std::uint64_t cached = 0;
    for (const char* kind : {"active_file ", "inactive_file "})
        cached += number_behind(statistics, std::string(names.cached_prefix) + kind);
    const std::uint64_t most_swap = number_in(text_of(group / "memory.swap.max")).value_or(kNoLimit);
    const std::uint64_t used_swap = number_in(text_of(group / "memory.swap.current")).value_or(0);
    return sum_of(left_of(*limit, left_of(*used, cached)), std::min(swap, left_of(most_swap, used_swap)));
}

/// The least of a group, and of all that it is in. A container sees its own group as the root, whatever its path is called.
std::uint64_t left_in_groups(const fs::path& root, const std::string& path, const GroupFiles& names,
                             std::uint64_t swap) {
    const fs::path top = root / names.folder;
    std::uint64_t left = left_in_group(top, names, swap);
    fs::path group = top;
    for (const fs::path& name : fs::path(path).relative_path()) {
        group /= name;
        left = std::min(left, left_in_group(group, names, swap));
    }
    return left;
}

/// Address space below the limit of `ulimit -v`.
std::uint64_t address_space_left() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kNoLimit;
    const std::uint64_t pages = number_in(text_of("/proc/self/statm")).value_or(0);
    return left_of(limit.rlim_cur, pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)));
}

std::string bytes_text(std::uint64_t bytes) {
    return fmt::format("{} bytes ({:.3g} GB)", bytes, static_cast<double>(bytes) / 1e9);
}

}  // namespace

std::uint64_t memory_left_by_files(const fs::path& root) {
    constexpr std::uint64_t kKilobyte = 1024;
    const std::string machine = text_of(root / "proc/meminfo");
    const std::uint64_t swap = kKilobyte * number_behind(machine, "SwapFree:");
    std::uint64_t left = machine.find("MemAvailable:") == std::string::npos
                             ? kNoLimit
                             : kKilobyte * number_behind(machine, "MemAvailable:") + swap;
    // Lines "NUMBER:CONTROLLERS:PATH": of version 2 without controllers.
    std::ifstream groups(root / "proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
        const std::string path = line.substr(second + 1);
        if (controllers == ",,") left = std::min(left, left_in_groups(root, path, kVersion2, swap));
        if (controllers.find(",memory,") != std::string::npos)
            left = std::min(left, left_in_groups(root, path, kVersion1, 0));
    }
    return left;
}

std::uint64_t memory_left() { return std::min(memory_left_by_files("/"), address_space_left()); }

void set_processes_here(int count) { processes_here = static_cast<std::uint64_t>(std::max(1, count)); }

void require_memory(std::string_view subject, std::uint64_t bytes, ErrorKind kind, std::uint64_t bytes_of_each) {
    constexpr std::uint64_t kLittle = std::uint64_t{1} << 20;  // not worth a look at the system
    const bool is_beyond = bytes_of_each > kNoLimit / processes_here;
    const std::uint64_t all = is_beyond ? kNoLimit : sum_of(bytes, bytes_of_each * processes_here);
    if (all < kLittle) return;
    const std::uint64_t left = memory_left();
    if (all <= left) return;
    const std::string where = bytes_of_each > 0 && processes_here > 1
                                  ? fmt::format(" in the {} processes of this machine", processes_here)
                                  : "";
    throw MemoryError(kind, fmt::format("{}: expected to need at most the memory that is left here, {}, got {}{}",
                                        subject, bytes_text(left), bytes_text(all), where));
}

}  // namespace pl
