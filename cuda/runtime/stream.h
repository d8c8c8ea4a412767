// Owners of streams and events.
#pragma once

#include <utility>

#include "cuda/runtime/check.h"

namespace pl::cuda {

/// A queue of device work. Never the default stream, which waits for all others.
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
    /// Waits until everything queued so far is done; errors of that work surface here.
    void wait(const char* what) const { check(cudaStreamSynchronize(handle_), what); }

private:
    cudaStream_t handle_ = nullptr;
};

/// A mark in a stream.
class Event {
public:
    Event() { check(cudaEventCreate(&handle_), "creating an event"); }
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
    /// Makes later work of a stream wait for this mark, without the host waiting.
    void hold_back(const Stream& stream) const {
        check(cudaStreamWaitEvent(stream.handle(), handle_, 0), "ordering two streams");
    }
    /// Milliseconds from `start` to this mark; both have been reached.
    float milliseconds_since(const Event& start) const {
        float result = 0.0f;
        check(cudaEventElapsedTime(&result, start.handle_, handle_), "reading two events");
        return result;
    }

private:
    cudaEvent_t handle_ = nullptr;
};

}  // namespace pl::cuda
