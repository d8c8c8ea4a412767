#include "cuda/runtime/memory.h"

#include <fmt/format.h>

namespace pl::cuda {
namespace {

std::string allocating(const char* kind, std::size_t bytes) {
    return fmt::format("allocating {:.1f} MB of {} memory", static_cast<double>(bytes) * 1e-6, kind);
}

}  // namespace

void* DeviceHeap::allocate(std::size_t bytes) {
    void* data = nullptr;
    check(cudaMalloc(&data, bytes), allocating("device", bytes));
    return data;
}
void DeviceHeap::release(void* data) noexcept { (void)cudaFree(data); }

void* PinnedHeap::allocate(std::size_t bytes) {
    void* data = nullptr;
    check(cudaMallocHost(&data, bytes), allocating("pinned host", bytes));
    return data;
}
void PinnedHeap::release(void* data) noexcept { (void)cudaFreeHost(data); }

void copy_to_device(void* device, const void* host, std::size_t bytes, const Stream& stream) {
    if (bytes > 0)
        check(cudaMemcpyAsync(device, host, bytes, cudaMemcpyHostToDevice, stream.handle()), "copying to the device");
}
void copy_to_host(void* host, const void* device, std::size_t bytes, const Stream& stream) {
    if (bytes > 0)
        check(cudaMemcpyAsync(host, device, bytes, cudaMemcpyDeviceToHost, stream.handle()),
              "copying from the device");
}
void clear(void* device, std::size_t bytes, const Stream& stream) {
    if (bytes > 0) check(cudaMemsetAsync(device, 0, bytes, stream.handle()), "clearing device memory");
}

}  // namespace pl::cuda
