#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <set>
#include <thread>
#include <vector>

#include "tests/cuda/shim/control.h"

namespace pl::shim {

using Clock = std::chrono::steady_clock;

/// Queued work, not yet executed: it runs when the host synchronizes.
struct Queue {
    std::deque<std::function<void()>> work;
};

struct Mark {
    Queue* queue = nullptr;
    int recorded = 0;  ///< number of times it was queued
    int reached = 0;   ///< index of the last of those that was executed
    Clock::time_point time{};
};

namespace {

struct Machine {
    int devices = 1;
    cudaError_t count_code = cudaSuccess;
    bool code_fits = true;
    int threads = 1;
    std::string failing;
    cudaError_t failure = cudaSuccess;
    int successes = 0;
    bool lasting = false;
    bool broken = false;
    int launches = 0;
    unsigned flags = 0;
    bool has_context = false;
    Observer before{};
    Observer after{};
};

Machine machine;
std::map<void*, std::size_t> device_memory;
std::map<const void*, std::size_t> host_memory;
std::set<Queue*> queues;
std::set<Mark*> marks;

/// The error code that a call returns before any effect.
cudaError_t called(const char* call) {
    if (machine.broken) return machine.failure;
    if (machine.failing != call) return cudaSuccess;
    if (machine.successes-- > 0) return cudaSuccess;
    machine.failing.clear();
    machine.broken = machine.lasting;
    return machine.failure;
}

/// Queues a piece of work, with the observers around it.
void enqueue(Queue& queue, const void* kernel, std::size_t bytes, std::function<void()> work) {
    if (machine.before) machine.before(kernel, bytes, &queue);
    queue.work.push_back(std::move(work));
    if (machine.after) machine.after(kernel, bytes, &queue);
}

void run_next(Queue& queue) {
    const std::function<void()> work = std::move(queue.work.front());
    queue.work.pop_front();
    if (!machine.broken) work();
}
void drain(Queue& queue) {
    while (!queue.work.empty()) run_next(queue);
}
/// Executes queued work up to the last record of the event.
void drain_until(const Mark& mark, Queue* queue, int number) {
    while (mark.reached < number && !queue->work.empty()) run_next(*queue);
}

bool is_pinned(const void* memory) {
    const auto* place = static_cast<const std::byte*>(memory);
    for (const auto& [start, bytes] : host_memory) {
        const auto* first = static_cast<const std::byte*>(start);
        if (place >= first && place < first + bytes) return true;
    }
    return false;
}

void run_grid(dim3 grid, dim3 block, const std::function<void()>& thread) {
    std::atomic<unsigned> next{0};
    const auto worker = [&] {
        gridDim = grid;
        blockDim = block;
        for (blockIdx.x = next++; blockIdx.x < grid.x; blockIdx.x = next++)
            for (threadIdx.x = 0; threadIdx.x < block.x; ++threadIdx.x) thread();
    };
    std::vector<std::thread> helpers;
    for (int i = 1; i < machine.threads; ++i) helpers.emplace_back(worker);
    worker();
    for (std::thread& helper : helpers) helper.join();
}

}  // namespace

void reset() { machine = {}; }
void set_devices(int count, cudaError_t code) {
    machine.devices = count;
    machine.count_code = code;
}
void set_code_fits(bool fits) { machine.code_fits = fits; }
void set_threads(int threads) { machine.threads = threads; }
void fail(const std::string& call, cudaError_t code, int successes, bool lasting) {
    machine.failing = call;
    machine.failure = code;
    machine.successes = successes;
    machine.lasting = lasting;
}
std::size_t device_bytes() {
    std::size_t total = 0;
    for (const auto& [memory, bytes] : device_memory) total += bytes;
    return total;
}
int live_objects() {
    return static_cast<int>(device_memory.size() + host_memory.size() + queues.size() + marks.size());
}
int launches() { return machine.launches; }
unsigned device_flags() { return machine.flags; }
bool has_context() { return machine.has_context; }
void observe(Observer before, Observer after) {
    machine.before = std::move(before);
    machine.after = std::move(after);
}

cudaError_t launch(const void* kernel, dim3 grid, dim3 block, Queue* queue, std::function<void()> thread) {
    const cudaError_t code = called("cudaLaunchKernel");
    if (code != cudaSuccess) return code;
    if (grid.x == 0 || block.x == 0 || block.x > 1024) return cudaErrorInvalidValue;
    ++machine.launches;
    enqueue(*queue, kernel, 0, [=, thread = std::move(thread)] { run_grid(grid, block, thread); });
    return cudaSuccess;
}

}  // namespace pl::shim

using namespace pl::shim;

const char* cudaGetErrorString(cudaError_t code) {
    switch (code) {
    case cudaSuccess: return "no error";
    case cudaErrorInvalidValue: return "invalid argument";
    case cudaErrorMemoryAllocation: return "out of memory";
    case cudaErrorInsufficientDriver: return "CUDA driver version is insufficient for CUDA runtime version";
    case cudaErrorNoDevice: return "no CUDA-capable device is detected";
    case cudaErrorNoKernelImageForDevice: return "no kernel image is available for execution on the device";
    case cudaErrorIllegalAddress: return "an illegal memory access was encountered";
    case cudaErrorLaunchFailure: return "unspecified launch failure";
    default: return "unknown error";
    }
}
const char* cudaGetErrorName(cudaError_t code) { return code == cudaSuccess ? "cudaSuccess" : "cudaErrorOfTheShim"; }
cudaError_t cudaGetLastError() { return machine.broken ? machine.failure : cudaSuccess; }

cudaError_t cudaGetDeviceCount(int* count) {
    if (machine.count_code == cudaSuccess) *count = machine.devices;
    return machine.count_code;
}
cudaError_t cudaGetDeviceProperties(cudaDeviceProp* properties, int) {
    *properties = {"host shim", 1u << 30, 9, 0};
    return cudaSuccess;
}
cudaError_t cudaDeviceGetAttribute(int* value, cudaDeviceAttr attribute, int) {
    *value = attribute == cudaDevAttrClockRate ? 1000000 : 2;  // kHz
    return cudaSuccess;
}
cudaError_t cudaSetDeviceFlags(unsigned flags) {
    const cudaError_t code = called("cudaSetDeviceFlags");
    if (code == cudaSuccess) machine.flags = flags;
    return code;
}
cudaError_t cudaFuncGetAttributes(cudaFuncAttributes* attributes, const void*) {
    const cudaError_t code = called("cudaFuncGetAttributes");
    if (code != cudaSuccess) return code;
    attributes->maxThreadsPerBlock = 128;
    machine.has_context = true;
    return machine.code_fits ? cudaSuccess : cudaErrorNoKernelImageForDevice;
}

cudaError_t cudaMalloc(void** memory, std::size_t bytes) {
    const cudaError_t code = called("cudaMalloc");
    if (code != cudaSuccess) return code;
    constexpr std::size_t kAlignment = 256;  // as on a device
    *memory = std::aligned_alloc(kAlignment, (bytes + kAlignment - 1) / kAlignment * kAlignment);
    std::memset(*memory, 0xff, bytes);  // NaNs: exposes reads of uninitialized memory
    device_memory[*memory] = bytes;
    return cudaSuccess;
}
cudaError_t cudaFree(void* memory) {
    for (Queue* queue : queues) drain(*queue);  // as on a device
    device_memory.erase(memory);
    std::free(memory);
    return cudaSuccess;
}
cudaError_t cudaMallocHost(void** memory, std::size_t bytes) {
    const cudaError_t code = called("cudaMallocHost");
    if (code != cudaSuccess) return code;
    *memory = std::malloc(bytes);
    host_memory[*memory] = bytes;
    return cudaSuccess;
}
cudaError_t cudaFreeHost(void* memory) {
    for (Queue* queue : queues) drain(*queue);
    host_memory.erase(memory);
    std::free(memory);
    return cudaSuccess;
}
/// Pinned memory is copied in stream order. Pageable memory is staged at once, or the call blocks.
cudaError_t cudaMemcpyAsync(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind, cudaStream_t stream) {
    const cudaError_t code = called("cudaMemcpyAsync");
    if (code != cudaSuccess) return code;
    const bool to_device = kind == cudaMemcpyHostToDevice;
    if (kind == cudaMemcpyDeviceToDevice || is_pinned(to_device ? from : to)) {
        enqueue(*stream, nullptr, bytes, [=] { std::memcpy(to, from, bytes); });
    } else if (to_device) {
        const auto* first = static_cast<const std::byte*>(from);
        enqueue(*stream, nullptr, bytes, [to, staged = std::vector<std::byte>(first, first + bytes)] {
            std::memcpy(to, staged.data(), staged.size());
        });
    } else {
        enqueue(*stream, nullptr, bytes, [=] { std::memcpy(to, from, bytes); });
        drain(*stream);
    }
    return cudaSuccess;
}
cudaError_t cudaMemsetAsync(void* memory, int value, std::size_t bytes, cudaStream_t stream) {
    const cudaError_t code = called("cudaMemsetAsync");
    if (code == cudaSuccess) enqueue(*stream, nullptr, bytes, [=] { std::memset(memory, value, bytes); });
    return code;
}

cudaError_t cudaStreamCreateWithFlags(cudaStream_t* stream, unsigned) {
    const cudaError_t code = called("cudaStreamCreateWithFlags");
    if (code != cudaSuccess) return code;
    *stream = new Queue;
    queues.insert(*stream);
    return cudaSuccess;
}
cudaError_t cudaStreamDestroy(cudaStream_t stream) {
    drain(*stream);
    queues.erase(stream);
    delete stream;
    return cudaSuccess;
}
cudaError_t cudaStreamSynchronize(cudaStream_t stream) {
    const cudaError_t code = called("cudaStreamSynchronize");
    drain(*stream);
    return code;
}
cudaError_t cudaStreamWaitEvent(cudaStream_t stream, cudaEvent_t event, unsigned) {
    stream->work.push_back(
        [=, queue = event->queue, number = event->recorded] { drain_until(*event, queue, number); });
    return called("cudaStreamWaitEvent");
}

cudaError_t cudaEventCreateWithFlags(cudaEvent_t* event, unsigned) {
    const cudaError_t code = called("cudaEventCreateWithFlags");
    if (code != cudaSuccess) return code;
    *event = new Mark;
    marks.insert(*event);
    return cudaSuccess;
}
cudaError_t cudaEventDestroy(cudaEvent_t event) {
    for (Queue* queue : queues) drain(*queue);
    marks.erase(event);
    delete event;
    return cudaSuccess;
}
cudaError_t cudaEventRecord(cudaEvent_t event, cudaStream_t stream) {
    const cudaError_t code = called("cudaEventRecord");
    if (code != cudaSuccess) return code;
    event->queue = stream;
    stream->work.push_back([event, number = ++event->recorded] {
        event->reached = number;
        event->time = Clock::now();
    });
    return cudaSuccess;
}
cudaError_t cudaEventSynchronize(cudaEvent_t event) {
    const cudaError_t code = called("cudaEventSynchronize");
    drain_until(*event, event->queue, event->recorded);
    return code;
}
cudaError_t cudaEventElapsedTime(float* milliseconds, cudaEvent_t start, cudaEvent_t end) {
    const cudaError_t code = called("cudaEventElapsedTime");
    if (code == cudaSuccess)
        *milliseconds = std::chrono::duration<float, std::milli>(end->time - start->time).count();
    return code;
}
