// Owners of device memory, streams and events; error messages.
#include "core/base/error.h"
#include "cuda/availability.h"
#include "cuda/kernels/lane.cuh"
#include "cuda/runtime/device_array.h"
#include "cuda/runtime/launch.h"
#include "tests/cuda/shim/control.h"
#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::test;
using pl::cuda::DeviceArray;
using pl::cuda::Event;

namespace {

std::string error_of(cudaError_t code) {
    try {
        cuda::check(code, "cutting the grass");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::Unavailable);
        return error.what();
    }
    return "";
}

void number_threads(Span<std::uint32_t> out, std::uint32_t offset) {
    const std::uint32_t i = cuda::thread_number();
    if (i < out.count) out[i] = i + offset;
}

}  // namespace

TEST_CASE("An error names call, cause and place") {
    shim::reset();
    CHECK(error_of(cudaSuccess).empty());
    const std::string text = error_of(cudaErrorMemoryAllocation);
    CHECK_THAT(text,
               contains("cutting the grass") && contains("out of memory") && contains("device_array_test.cpp:"));
}

TEST_CASE("Arrays go to the device and come back once the stream was waited for") {
    shim::reset();
    {
        const cuda::Stream stream;
        const HostArray<int> values{1, 2, 3, 4};
        DeviceArray<int> array;
        array.upload(values, stream);
        const cuda::PinnedMemory pinned(4 * sizeof(int));
        auto* early = static_cast<int*>(pinned.data());
        early[3] = 0;
        cuda::copy_to_host(early, array.data(), 4 * sizeof(int), stream);
        CHECK(early[3] == 0);
        stream.wait("copying");
        CHECK(early[3] == 4);
        HostArray<int> back;
        array.download(back, stream);
        stream.wait("copying");
        CHECK(back == values);

        DeviceArray<int> taken = std::move(array);
        CHECK(taken.size() == 4);
        CHECK(shim::device_bytes() == 4 * sizeof(int));
        taken.clear(stream);
        taken.download(back, stream);
        stream.wait("copying");
        CHECK(back == HostArray<int>{0, 0, 0, 0});

        DeviceArray<int> empty;
        empty.upload(HostArray<int>{}, stream);
        empty.download(back, stream);
        stream.wait("copying");
        CHECK(back.empty());
    }
    CHECK(shim::live_objects() == 0);
}

TEST_CASE("Every thread of a launch runs once, with the arguments of its launch") {
    for (const int threads : {1, 3}) {
        shim::reset();
        shim::set_threads(threads);
        const cuda::Stream stream;
        DeviceArray<std::uint32_t> out(1000);
        launch(number_threads, cuda::one_thread_each(1000), stream, "number_threads",
               Span<std::uint32_t>{out.data(), 1000}, 5u);
        HostArray<std::uint32_t> numbers;
        out.download(numbers, stream);
        stream.wait("numbering");
        bool all = true;
        for (std::uint32_t i = 0; i < 1000; ++i) all = all && numbers[i] == i + 5;
        CHECK(all);
    }
    CHECK(cuda::one_thread_each(0).blocks == 0);
    CHECK(cuda::one_thread_each(1).blocks == 1);
    CHECK(cuda::one_thread_each(cuda::kThreadsPerBlock + 1).blocks == 2);
    CHECK(cuda::one_thread_each(0xffffffffu).blocks == (1u << 25));
}

TEST_CASE("A stream that is held back by an event waits for the other stream's work") {
    shim::reset();
    const cuda::Stream first;
    const cuda::Stream second;
    Event written;
    const HostArray<int> values{7};
    DeviceArray<int> array;
    array.upload(values, first);
    written.record(first);
    written.hold_back(second);
    HostArray<int> back;
    array.download(back, second);
    second.wait("reading");
    CHECK(back == values);
}

TEST_CASE("The reason why CUDA is unusable is told in words") {
    shim::reset();
    CHECK(cuda_unavailable_reason().empty());
    REQUIRE(cuda_devices().size() == 1);
    CHECK(cuda_devices()[0].name == "host shim");
    CHECK(cuda_devices()[0].major == 9);

    shim::set_devices(0);
    CHECK_THAT(cuda_unavailable_reason(), contains("no device"));
    shim::set_devices(0, cudaErrorNoDevice);
    CHECK_THAT(cuda_unavailable_reason(), contains("no device"));
    shim::set_devices(1, cudaErrorInsufficientDriver);
    CHECK_THAT(cuda_unavailable_reason(), contains("driver"));
    CHECK(cuda_devices().empty());
    shim::reset();
}

TEST_CASE("Only an opened device has a context, in which waiting threads sleep") {
    shim::reset();
    CHECK(cuda_unavailable_reason().empty());
    CHECK(cuda_devices().size() == 1);
    CHECK_FALSE(shim::has_context());
    cuda::open_device();
    CHECK(shim::has_context());
    CHECK(shim::device_flags() == cudaDeviceScheduleBlockingSync);

    shim::set_code_fits(false);
    CHECK_THROWS_WITH(cuda::open_device(), contains("no code for the first device"));
    shim::reset();
}
