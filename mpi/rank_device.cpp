#include "mpi/rank_device.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <vector>

#include "mpi/job.h"
#include "mpi/job_environment.h"

namespace pl {
namespace {

constexpr const char* kVariable = "CUDA_VISIBLE_DEVICES";

/// The devices of a list: CUDA sees the devices before the first that does not exist, by convention -1.
std::vector<std::string> devices_in(std::string_view list) {
    std::vector<std::string> devices;
    while (!list.empty()) {
        const std::size_t comma = std::min(list.find(','), list.size());
        const std::string_view device = list.substr(0, comma);
        if (device.empty() || device == "-1") break;
        devices.emplace_back(device);
        list.remove_prefix(std::min(comma + 1, list.size()));
    }
    return devices;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string visible_device(const char* visible, int devices, int rank_on_machine) {
    if (visible == nullptr) return devices > 0 ? std::to_string(rank_on_machine % devices) : "";
    const std::vector<std::string> listed = devices_in(visible);
    return listed.empty() ? "" : listed[static_cast<std::size_t>(rank_on_machine) % listed.size()];
}

int count_device_files(const std::filesystem::path& folder) {
    constexpr std::string_view kPrefix = "nvidia";
    int count = 0;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
        const std::string name = entry.path().filename();
        if (name.size() > kPrefix.size() && name.starts_with(kPrefix))
            count += std::all_of(name.begin() + kPrefix.size(), name.end(), is_digit) ? 1 : 0;
    }
    return count;
}

void choose_device() {
    if (ranks_on_this_machine() <= 1) return;
    const std::string device = visible_device(std::getenv(kVariable), count_device_files("/dev"),
                                              job_number("OMPI_COMM_WORLD_LOCAL_RANK", 0));
    if (!device.empty()) ::setenv(kVariable, device.c_str(), 1);
}

}  // namespace pl
