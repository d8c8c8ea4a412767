// Owners of streams and events.
#pragma once

#include <utility>

#include "cuda/runtime/check.h"

namespace pl::cuda {

/// A CUDA stream. Never the default stream, which synchronizes with all others.
class Stream {
public:
    Stream() { check(cudaStreamCreateWithFlags(&handle_, cudaStreamNonBlocking), "creating a stream"); }
    ~Stream() {
        if (handle_ != nullptr) (void)cudaStreamDestroy(handle_);
    }
    Stream(Stream&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Stream& operator=(Stream&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }

    cudaStream_t handle() const { return handle_; }
    /// Blocks the host until all queued work has completed. Reports errors of that work.
    void wait(const char* what) const { check(cudaStreamSynchronize(handle_), what); }

private:
    cudaStream_t handle_ = nullptr;
};

/// A CUDA event. Threads that wait for it sleep.
class Event {
public:
    Event() { check(cudaEventCreateWithFlags(&handle_, cudaEventBlockingSync), "creating an event"); }
    ~Event() {
        if (handle_ != nullptr) (void)cudaEventDestroy(handle_);
    }
    Event(Event&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Event& operator=(Event&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }

    void record(const Stream& stream) { check(cudaEventRecord(handle_, stream.handle()), "recording an event"); }
    void wait(const char* what) const { check(cudaEventSynchronize(handle_), what); }
    /// Makes later work of a stream wait for this event, without blocking the host.
    void hold_back(const Stream& stream) const {
        check(cudaStreamWaitEvent(stream.handle(), handle_, 0), "ordering two streams");
    }
    /// Milliseconds from `start` to this event. Both must have completed.
    float milliseconds_since(const Event& start) const {
        float result = 0.0f;
        check(cudaEventElapsedTime(&result, start.handle_, handle_), "reading two events");
        return result;
    }

private:
    cudaEvent_t handle_ = nullptr;
};

}  // namespace pl::cuda
