// The ranks of a job of Open MPI. Waits sleep: ranks may share cores, and a rank that waits must not take one from a rank that works.
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include <mpi.h>
#include <sched.h>
#include <time.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "mpi/job.h"
#include "mpi/job_environment.h"

namespace pl {
namespace {

/// Bytes of one call of MPI, whose counts are of type int.
constexpr std::size_t kMostBytes = std::size_t{1} << 30;
/// Polls of a wait before it sleeps between them: a few tenths of a millisecond.
constexpr int kPollsAwake = 2000;
/// Seconds of sleep between two polls. Naps grow with the wait: ranks take next to no time while a window is at rest, and are late by a
/// fraction of what they have waited.
constexpr double kShortestNap = 50e-6;
constexpr double kLongestNap = 1e-3;
constexpr double kNapOfWait = 1.0 / 64.0;
/// Seconds between two looks at whether the processes of this machine still run.
constexpr double kLookInterval = 0.05;

struct Process {
    std::array<char, 64> host{};
    std::array<char, 128> version{};
    std::int64_t number = 0;
};

class MpiJob final : public Communicator {
public:
    explicit MpiJob(const std::string& version) {
        int provided = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
        MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &size_);
        meet(version);
    }
    ~MpiJob() override {
        if (!is_broken_) MPI_Finalize();
    }
    MpiJob(const MpiJob&) = delete;
    MpiJob& operator=(const MpiJob&) = delete;

    int rank() const override { return rank_; }
    int size() const override { return size_; }
    bool is_broken() const override { return is_broken_; }
    std::string name_of(int rank) const override {
        return "rank " + std::to_string(rank) + " (" + processes_[static_cast<std::size_t>(rank)].host.data() + ")";
    }

    std::string host() const override { return processes_[static_cast<std::size_t>(rank_)].host.data(); }

    void broadcast(std::span<std::byte> bytes) override {
        const Call call(*this, rank_ == 0 ? bytes.size() : 0);
        for_pieces(bytes, [&](std::byte* data, int count, MPI_Request& request) {
            return MPI_Ibcast(data, count, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
        });
    }

    Bytes gather(std::span<const std::byte> own) override {
        const Call call(*this, own.size());
        Bytes all(rank_ == 0 ? own.size() * static_cast<std::size_t>(size_) : 0);
        const int count = static_cast<int>(own.size());
        MPI_Request request;
        require(MPI_Igather(own.data(), count, MPI_BYTE, all.data(), count, MPI_BYTE, 0, MPI_COMM_WORLD, &request));
        wait(request);
        return all;
    }

    std::vector<Bytes> exchange(std::span<const std::byte> own) override {
        const Call call(*this, own.size());
        std::uint64_t length = own.size();
        std::vector<std::uint64_t> lengths(static_cast<std::size_t>(size_));
        MPI_Request request;
        require(MPI_Iallgather(&length, 1, MPI_UINT64_T, lengths.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD, &request));
        wait(request);
        std::vector<int> counts;
        std::vector<int> places;
        std::size_t total = 0;
        for (const std::uint64_t bytes : lengths) {
            counts.push_back(static_cast<int>(bytes));
            places.push_back(static_cast<int>(total));
            total += bytes;
            if (total > kMostBytes) fail("more bytes to exchange than one message of MPI holds");
        }
        Bytes joined(total);
        require(MPI_Iallgatherv(own.data(), static_cast<int>(own.size()), MPI_BYTE, joined.data(), counts.data(),
                                places.data(), MPI_BYTE, MPI_COMM_WORLD, &request));
        wait(request);
        std::vector<Bytes> all;
        for (std::size_t rank = 0; rank < counts.size(); ++rank) {
            const auto begin = joined.begin() + places[rank];
            all.emplace_back(begin, begin + counts[rank]);
        }
        return all;
    }

    void sum(std::span<std::int64_t> values, std::span<std::uint32_t> counts) override {
        const Call call(*this, values.size_bytes() + counts.size_bytes());
        std::vector<MPI_Request> requests;
        begin_sums(values, MPI_INT64_T, requests);
        begin_sums(counts, MPI_UINT32_T, requests);
        for (MPI_Request& request : requests) wait(request);
    }

    void send(int to, std::span<const std::byte> bytes) override {
        const Call call(*this, bytes.size());
        Bytes copy(bytes.begin(), bytes.end());
        std::vector<MPI_Request> pieces;
        for (std::size_t begin = 0; begin < copy.size(); begin += kMostBytes) {
            const auto count = static_cast<int>(std::min(kMostBytes, copy.size() - begin));
            require(MPI_Isend(copy.data() + begin, count, MPI_BYTE, to, 0, MPI_COMM_WORLD, &pieces.emplace_back()));
        }
        sent_.push_back({std::move(copy), std::move(pieces)});
        drop_sent();
    }
    void receive(int from, std::span<std::byte> bytes) override {
        const Call call(*this, 0);
        for_pieces(bytes, [&](std::byte* data, int count, MPI_Request& request) {
            return MPI_Irecv(data, count, MPI_BYTE, from, 0, MPI_COMM_WORLD, &request);
        });
    }

    bool has_message(int from) override {
        if (is_broken_) fail("another rank has ended");
        require_alive();
        int found = 0;
        require(MPI_Iprobe(from, 0, MPI_COMM_WORLD, &found, MPI_STATUS_IGNORE));
        return found != 0;
    }

private:
    /// Accounts for one call of the interface.
    class Call {
    public:
        Call(MpiJob& job, std::size_t bytes) : traffic_(job.traffic_) {
            if (job.is_broken_) job.fail("another rank has ended");
            ++traffic_.messages;
            traffic_.bytes_sent += bytes;
        }
        ~Call() { traffic_.seconds += watch_.seconds(); }
        Call(const Call&) = delete;
        Call& operator=(const Call&) = delete;

    private:
        Traffic& traffic_;
        Stopwatch watch_;
    };

    struct Sent {
        Bytes bytes;
        std::vector<MPI_Request> pieces;
    };

    /// Every rank learns of every other one.
    void meet(const std::string& version) {
        Process own{.number = ::getpid()};
        ::gethostname(own.host.data(), own.host.size() - 1);
        version.copy(own.version.data(), own.version.size() - 1);
        processes_.resize(static_cast<std::size_t>(size_));
        const int bytes = sizeof(Process);
        require(MPI_Allgather(&own, bytes, MPI_BYTE, processes_.data(), bytes, MPI_BYTE, MPI_COMM_WORLD));
        for (int rank = 1; rank < size_; ++rank) {
            const std::string other = processes_[static_cast<std::size_t>(rank)].version.data();
            if (other == processes_[0].version.data()) continue;
            const std::string expected = processes_[0].version.data();
            const std::string name = name_of(rank);
            finalize_behind_rank_0();
            throw Error(ErrorKind::Unavailable,
                        name + ": another version of the program: expected " + expected + ", got " + other);
        }
    }

    /// Leaves a job that is refused. The message of rank 0 is the one that is shown: the others wait until it has ended, since a launcher
    /// kills all ranks once one has failed.
    void finalize_behind_rank_0() const {
        constexpr auto kMeetAndFinalize = [] {
            MPI_Barrier(MPI_COMM_WORLD);
            MPI_Finalize();
        };
        if (rank_ == 0)
            std::atexit(kMeetAndFinalize);
        else
            kMeetAndFinalize();
    }

    template <class Value>
    void begin_sums(std::span<Value> values, MPI_Datatype type, std::vector<MPI_Request>& requests) {
        constexpr std::size_t kMost = kMostBytes / sizeof(Value);
        for (std::size_t begin = 0; begin < values.size(); begin += kMost) {
            const auto count = static_cast<int>(std::min(kMost, values.size() - begin));
            require(MPI_Iallreduce(MPI_IN_PLACE, values.data() + begin, count, type, MPI_SUM, MPI_COMM_WORLD,
                                   &requests.emplace_back()));
        }
    }

    template <class Start>
    void for_pieces(std::span<std::byte> bytes, Start&& start) {
        for (std::size_t begin = 0; begin < bytes.size(); begin += kMostBytes) {
            MPI_Request request;
            require(
                start(bytes.data() + begin, static_cast<int>(std::min(kMostBytes, bytes.size() - begin)), request));
            wait(request);
        }
    }

    void wait(MPI_Request& request) {
        const Stopwatch watch;
        double next_look = kLookInterval;
        for (int polls = 0;; ++polls) {
            int done = 0;
            require(MPI_Test(&request, &done, MPI_STATUS_IGNORE));
            if (done != 0) return;
            if (polls < kPollsAwake) {
                ::sched_yield();
                continue;
            }
            sleep(std::clamp(watch.seconds() * kNapOfWait, kShortestNap, kLongestNap));
            if (watch.seconds() < next_look) continue;
            next_look += kLookInterval;
            require_alive();
        }
    }

    static void sleep(double seconds) {
        const timespec nap{0, static_cast<long>(seconds * 1e9)};
        ::nanosleep(&nap, nullptr);
    }

    void drop_sent() {
        std::erase_if(sent_, [this](Sent& sent) {
            int done = 0;
            require(
                MPI_Testall(static_cast<int>(sent.pieces.size()), sent.pieces.data(), &done, MPI_STATUSES_IGNORE));
            return done != 0;
        });
    }

    /// Shared memory tells nothing of a process that has died.
    void require_alive() {
        const Process& own = processes_[static_cast<std::size_t>(rank_)];
        for (int rank = 0; rank < size_; ++rank) {
            const Process& other = processes_[static_cast<std::size_t>(rank)];
            if (other.host != own.host) continue;
            if (::kill(static_cast<pid_t>(other.number), 0) != 0 && errno == ESRCH)
                fail(name_of(rank) + ": its process " + std::to_string(other.number) + " has ended");
        }
    }

    void require(int code) {
        if (code == MPI_SUCCESS) return;
        char text[MPI_MAX_ERROR_STRING];
        int length = 0;
        MPI_Error_string(code, text, &length);
        fail(std::string("MPI: ") + std::string(text, static_cast<std::size_t>(length)));
    }

    [[noreturn]] void fail(const std::string& why) {
        is_broken_ = true;
        throw Error(ErrorKind::Unavailable, why + ": the job cannot go on");
    }

    int rank_ = 0;
    int size_ = 1;
    bool is_broken_ = false;
    std::vector<Process> processes_;
    std::vector<Sent> sent_;  ///< messages that may be under way
};

}  // namespace

std::unique_ptr<Communicator> join_job(const std::string& version) {
    if (job_size() <= 1) return nullptr;
    return std::make_unique<MpiJob>(version);
}

bool tells_why_not_joined() { return job_number("OMPI_COMM_WORLD_RANK", 0) == 0; }

}  // namespace pl
