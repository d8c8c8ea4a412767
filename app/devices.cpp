// `pathlight devices`: the back ends on this machine, and the reasons why one is unavailable.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/make_backend.h"
#include "cuda/availability.h"

namespace pl {
namespace {

/// One line of the list. Without a reason it is available.
struct DeviceLine {
    std::string backend;
    std::string device;  ///< empty if there is none
    std::string extent;  ///< threads, memory
    std::string reason;
    Json numbers;  ///< the extent, for programs
};

void tell(const DeviceLine& line, Console& console) {
    std::string text;
    for (const std::string& part : {line.device, line.extent, line.reason})
        if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
    const bool available = line.reason.empty();
    console.result(fmt::format("{:<6} {:<12} {}\n", line.backend, available ? "available" : "unavailable", text));
    Json event{{"backend", line.backend},
               {"available", available},
               {"device", line.device.empty() ? Json(nullptr) : Json(line.device)}};
    event.update(line.numbers);
    event["reason"] = available ? Json(nullptr) : Json(line.reason);
    console.event("device", event);
}

DeviceLine cpu_line() {
    const BackendInfo cpu = make_own_backend("cpu", 0)->info();
    return {.backend = cpu.name,
            .device = cpu.device,
            .extent = fmt::format("{} {}", cpu.threads, cpu.threads == 1 ? "thread" : "threads"),
            .reason = "",
            .numbers = {{"threads", cpu.threads}}};
}

DeviceLine cuda_line(const CudaDevice& device, const std::string& reason) {
    const double gib = static_cast<double>(device.memory_bytes) / (1024.0 * 1024.0 * 1024.0);
    return {.backend = "cuda",
            .device = device.name,
            .extent = fmt::format("{:.1f} GiB, compute capability {}.{}", gib, device.major, device.minor),
            .reason = reason,
            .numbers = {{"threads", nullptr},
                        {"memory_bytes", device.memory_bytes},
                        {"compute_capability", fmt::format("{}.{}", device.major, device.minor)}}};
}

}  // namespace

int run_devices(const CommandLine&, Console& console) {
    tell(cpu_line(), console);
    const std::string reason = why_no_cuda();
    const std::vector<CudaDevice> devices = cuda_devices();
    if (devices.empty())
        tell({.backend = "cuda", .device = "", .extent = "", .reason = reason, .numbers = {{"threads", nullptr}}},
             console);
    for (const CudaDevice& device : devices) tell(cuda_line(device, reason), console);
    return 0;
}

}  // namespace pl
