// The ranks of a job as threads of one process: the driver over several ranks without MPI.
#pragma once

#include <algorithm>
#include <barrier>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "cpu/cpu_backend.h"
#include "mpi/mpi_backend.h"

namespace pl::test {

/// The memory that the ranks share.
struct ThreadJob {
    explicit ThreadJob(int size) : all_here(size), slots(static_cast<std::size_t>(size)) {}

    std::barrier<> all_here;
    std::vector<Bytes> slots;  ///< by rank
    std::mutex mutex;
    std::condition_variable arrived;
    std::map<std::pair<int, int>, std::deque<Bytes>> mail;  ///< by sender and receiver
};

class ThreadRank final : public Communicator {
public:
    ThreadRank(std::shared_ptr<ThreadJob> job, int rank) : job_(std::move(job)), rank_(rank) {}

    int rank() const override { return rank_; }
    int size() const override { return static_cast<int>(job_->slots.size()); }
    std::string name_of(int rank) const override { return "rank " + std::to_string(rank) + " (thread)"; }

    std::string host() const override { return "thread"; }

    void broadcast(std::span<std::byte> bytes) override {
        const std::vector<Bytes> all =
            exchange(rank_ == 0 ? std::span<const std::byte>(bytes) : std::span<const std::byte>());
        std::ranges::copy(all[0], bytes.begin());
    }
    Bytes gather(std::span<const std::byte> own) override {
        Bytes joined;
        for (const Bytes& bytes : exchange(own)) joined.insert(joined.end(), bytes.begin(), bytes.end());
        return rank_ == 0 ? joined : Bytes{};
    }
    std::vector<Bytes> exchange(std::span<const std::byte> own) override {
        ++traffic_.messages;
        traffic_.bytes_sent += own.size();
        if (on_message_) on_message_();
        job_->slots[static_cast<std::size_t>(rank_)].assign(own.begin(), own.end());
        job_->all_here.arrive_and_wait();
        std::vector<Bytes> all = job_->slots;
        job_->all_here.arrive_and_wait();
        return all;
    }
    void sum(std::span<std::int64_t> values, std::span<std::uint32_t> counts) override {
        sum_all(values);
        sum_all(counts);
    }

    void send(int to, std::span<const std::byte> bytes) override {
        const std::lock_guard lock(job_->mutex);
        job_->mail[{rank_, to}].emplace_back(bytes.begin(), bytes.end());
        job_->arrived.notify_all();
    }
    void receive(int from, std::span<std::byte> bytes) override {
        std::unique_lock lock(job_->mutex);
        std::deque<Bytes>& queue = job_->mail[{from, rank_}];
        job_->arrived.wait(lock, [&] { return !queue.empty(); });
        std::ranges::copy(queue.front(), bytes.begin());
        queue.pop_front();
    }

    /// Called with every message to all ranks, before it goes.
    void set_on_message(std::function<void()> call) { on_message_ = std::move(call); }

    bool has_message(int from) override {
        const std::lock_guard lock(job_->mutex);
        return !job_->mail[{from, rank_}].empty();
    }

private:
    template <class T>
    void sum_all(std::span<T> values) {
        const std::vector<Bytes> all = exchange(std::as_bytes(values));
        std::ranges::fill(values, T{});
        for (const Bytes& bytes : all) {
            const auto* other = reinterpret_cast<const T*>(bytes.data());
            for (std::size_t i = 0; i < values.size(); ++i) values[i] += other[i];
        }
    }

    std::shared_ptr<ThreadJob> job_;
    int rank_;
    std::function<void()> on_message_;
};

inline std::unique_ptr<RenderBackend> small_batches(const std::string&, int threads) {
    return make_cpu_backend({.threads = threads, .batch_paths = 64});
}

/// Rank 0 is the caller; the others run until the end of this object.
class ThreadRanks {
public:
    explicit ThreadRanks(int size, RankBackendFactory make = small_batches)
        : make_(std::move(make)), job_(std::make_shared<ThreadJob>(size)), first_(job_, 0) {
        for (int rank = 1; rank < size; ++rank)
            others_.emplace_back([this, rank] {
                ThreadRank own(job_, rank);
                follow_rank_0(own, [this, rank](const std::string& name, int threads) {
                    return make_(name + std::to_string(rank), threads);
                });
            });
    }
    ~ThreadRanks() {
        end_ranks(first_);
        for (std::thread& thread : others_) thread.join();
    }
    ThreadRanks(const ThreadRanks&) = delete;
    ThreadRanks& operator=(const ThreadRanks&) = delete;

    std::shared_ptr<RenderBackend> backend(int threads, std::uint32_t share_pixels = Shares::kMostPixels) {
        return make_mpi_backend(first_, make_, "cpu", threads, share_pixels);
    }
    ThreadRank& first() { return first_; }

private:
    RankBackendFactory make_;  ///< gets the name with the number of the rank behind it
    std::shared_ptr<ThreadJob> job_;
    ThreadRank first_;
    std::vector<std::thread> others_;
};

}  // namespace pl::test
