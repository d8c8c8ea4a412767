// `pathlight devices`: what can compute here, and why something cannot.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/make_backend.h"
#include "cuda/availability.h"

namespace pl {

int run_devices(const CommandLine&, Console& console) {
    const BackendInfo cpu = make_backend("cpu", 0)->info();
    console.result(fmt::format("{:<6} available    {}, {} threads\n", cpu.name, cpu.device, cpu.threads));
    console.event("device", {{"backend", cpu.name},
                             {"available", true},
                             {"device", cpu.device},
                             {"threads", cpu.threads},
                             {"reason", nullptr}});

    const std::string reason = cuda_unavailable_reason();
    console.result(fmt::format("{:<6} unavailable  {}\n", "cuda", reason));
    console.event(
        "device",
        {{"backend", "cuda"}, {"available", false}, {"device", nullptr}, {"threads", nullptr}, {"reason", reason}});
    return 0;
}

}  // namespace pl
