// The linker sends calls of F to __wrap_F, and calls of __real_F to F: see --wrap in CMakeLists.txt.
#include <utility>

#include "tests/parity/launch_hooks.h"

namespace pl::parity {
namespace {

LaunchHooks hooks;

template <class Call>
cudaError_t between_hooks(const QueuedWork& work, Call call) {
    if (hooks.before) hooks.before(work);
    const cudaError_t code = call();
    if (hooks.after) hooks.after(work);
    return code;
}

}  // namespace

void set_launch_hooks(LaunchHooks replacement) { hooks = std::move(replacement); }

}  // namespace pl::parity

extern "C" {

cudaError_t __real_cudaLaunchKernel(const void* kernel, dim3 grid, dim3 block, void** arguments, std::size_t shared,
                                    cudaStream_t stream);
cudaError_t __wrap_cudaLaunchKernel(const void* kernel, dim3 grid, dim3 block, void** arguments, std::size_t shared,
                                    cudaStream_t stream) {
    return pl::parity::between_hooks({.kernel = kernel, .stream = stream}, [&] {
        return __real_cudaLaunchKernel(kernel, grid, block, arguments, shared, stream);
    });
}

cudaError_t __real_cudaMemcpyAsync(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind,
                                   cudaStream_t stream);
cudaError_t __wrap_cudaMemcpyAsync(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind,
                                   cudaStream_t stream) {
    return pl::parity::between_hooks({.bytes = bytes, .stream = stream},
                                     [&] { return __real_cudaMemcpyAsync(to, from, bytes, kind, stream); });
}

cudaError_t __real_cudaMemsetAsync(void* memory, int value, std::size_t bytes, cudaStream_t stream);
cudaError_t __wrap_cudaMemsetAsync(void* memory, int value, std::size_t bytes, cudaStream_t stream) {
    return pl::parity::between_hooks({.bytes = bytes, .stream = stream},
                                     [&] { return __real_cudaMemsetAsync(memory, value, bytes, stream); });
}

}  // extern "C"
