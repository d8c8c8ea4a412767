#include "core/base/parallel.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

namespace pl {
namespace {

/// The first line of a file; empty if it cannot be read.
std::string first_line(const char* path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    return line;
}

/// Of the control groups of version 2, or else of version 1, as a container sees its own.
std::optional<int> quota_here() {
    const std::string unified = first_line("/sys/fs/cgroup/cpu.max");
    if (!unified.empty()) return processors_of_quota(unified);
    return processors_of_quota(first_line("/sys/fs/cgroup/cpu/cpu.cfs_quota_us") + " " +
                               first_line("/sys/fs/cgroup/cpu/cpu.cfs_period_us"));
}

int count_usable_threads() {
    const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    return std::min(processors, quota_here().value_or(processors));
}

}  // namespace

int usable_threads() {
    static const int threads = count_usable_threads();
    return threads;
}

std::optional<int> processors_of_quota(std::string_view text) {
    long long quota = 0, period = 0;
    const char* const end = text.data() + text.size();
    const auto [after, error] = std::from_chars(text.data(), end, quota);
    if (error != std::errc{} || after == end || *after != ' ') return std::nullopt;
    const auto [last, failure] = std::from_chars(after + 1, end, period);
    if (failure != std::errc{} || last != end || quota <= 0 || period <= 0) return std::nullopt;
    const long long processors = quota / period + (quota % period != 0 ? 1 : 0);
    return static_cast<int>(std::min<long long>(processors, std::numeric_limits<int>::max()));
}

}  // namespace pl
