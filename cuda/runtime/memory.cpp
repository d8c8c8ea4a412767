#include "cuda/runtime/memory.h"

#include <fmt/format.h>

namespace pl::cuda {
namespace {

std::string allocating(const char* kind, std::size_t bytes) {
    return fmt::format("allocating {:.1f} MB of {} memory", static_cast<double>(bytes) * 1e-6, kind);
}

}  // namespace

DeviceMemory::DeviceMemory(std::size_t bytes) : bytes_(bytes) {
    if (bytes > 0) check(cudaMalloc(&data_, bytes), allocating("device", bytes));
}
DeviceMemory::~DeviceMemory() {
    if (data_ != nullptr) (void)cudaFree(data_);
}
DeviceMemory::DeviceMemory(DeviceMemory&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
DeviceMemory& DeviceMemory::operator=(DeviceMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

PinnedMemory::PinnedMemory(std::size_t bytes) : bytes_(bytes) {
    if (bytes > 0) check(cudaMallocHost(&data_, bytes), allocating("pinned host", bytes));
}
PinnedMemory::~PinnedMemory() {
    if (data_ != nullptr) (void)cudaFreeHost(data_);
}
PinnedMemory::PinnedMemory(PinnedMemory&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
PinnedMemory& PinnedMemory::operator=(PinnedMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

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
