#include "tests/cuda/shim/control.h"
#include "tests/parity/launch_hooks.h"

namespace pl::parity {

void set_launch_hooks(LaunchHooks hooks) {
    const auto observer = [](std::function<void(const QueuedWork&)> hook) -> shim::Observer {
        if (!hook) return {};
        return [hook = std::move(hook)](const void* kernel, std::size_t bytes, cudaStream_t stream) {
            hook({.kernel = kernel, .bytes = bytes, .stream = stream});
        };
    };
    shim::observe(observer(std::move(hooks.before)), observer(std::move(hooks.after)));
}

}  // namespace pl::parity
