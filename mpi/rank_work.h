// One rank's part of every command: rank 0 leads, the others follow, and all run the same code.
#pragma once

#include <array>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include "core/base/error.h"
#include "core/session/exact_backend.h"
#include "mpi/communicator.h"
#include "mpi/shares.h"

namespace pl {

enum class Order : std::uint32_t {
    End,
    Call,
    Open,
    Close,
    Scene,
    Volumes,
    Field,
    ResetFilm,
    WritePixels,
    GatherFilm,
    Pass,
    Precompute,
    Update,
    Collect,
};

/// From rank 0 to all. Members beyond `order` count as far as it needs them.
struct RankCommand {
    Order order = Order::End;
    std::int32_t backend_number = 0;  ///< counted by Open; a session may keep several
    MethodId method{};
    FilmSlot slot{};
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::uint32_t first = 0;  ///< pixel
    PassRequest pass{};
    PrecomputeRequest probes{};
    std::array<char, 16> backend_name{};  ///< asked for
    std::int32_t threads = 0;
    std::uint32_t share_pixels = 0;  ///< of Open
};

/// Arguments and results of commands that are no plain values; arguments and results of rank 0 go to all ranks.
struct Payload {
    std::shared_ptr<const HostScene> scene{};
    std::shared_ptr<const HostVolumes> volumes{};
    FieldShape shape{};
    HostField field{};
    std::vector<FilmPixel> pixels{};
    const StopFlag* stop = nullptr;  ///< of rank 0 alone
    PassCounters counters{};         ///< of this rank
};

class RankWork {
public:
    /// `share_pixels`: see Shares; the same on all ranks.
    RankWork(Communicator& ranks, std::shared_ptr<ExactBackend> backend, std::uint32_t share_pixels)
        : ranks_(ranks), backend_(std::move(backend)), share_pixels_(share_pixels) {}

    /// On rank 0: sends a command and takes part in it. Returns the sum of the counters of all ranks. Throws the error of the first
    /// rank that failed, see report().
    PassCounters lead(RankCommand command, Payload& payload);
    /// On the other ranks: takes part in a command.
    void follow(const RankCommand& command);

    ExactBackend& backend() { return *backend_; }

private:
    struct Film {
        std::uint32_t pixels = 0;
        Shares shares;
        std::vector<double> seconds{};  ///< of this rank in the last pass of each block
        bool is_gathered = true;        ///< rank 0 has the newest pixels of all
    };

    PassCounters run(const RankCommand& command, Payload& payload);
    /// Calls of this rank's back end. A failure is kept for report(), so that all ranks come to the end of the command.
    template <class Fn>
    void locally(Fn&& fn);

    void take_scene(Payload& payload);
    void take_volumes(Payload& payload);
    void take_field(MethodId method, Payload& payload);
    void reset_film(const RankCommand& command);
    void write_pixels(const RankCommand& command, Payload& payload);
    void gather_film(FilmSlot slot);
    void run_pass(const PassRequest& request, Payload& payload);
    void run_block(const PassRequest& request, Film& film, std::size_t block, IndexRange numbers, Payload& payload);
    void precompute(const PrecomputeRequest& request, Payload& payload);

    bool goes_on(const StopFlag* stop);
    Shares no_shares() const { return Shares(ranks_.size(), share_pixels_); }
    void balance(FilmSlot slot, Film& film);
    std::vector<double> seconds_of_all(const Film& film);
    void move_pixels(FilmSlot slot, const Shares& from, const Shares& to);
    void mark_borders(const PassRequest& request, Film& film, Payload& payload);
    void share_emission(FilmSlot slot, const Film& film);

    Communicator& ranks_;
    std::shared_ptr<ExactBackend> backend_;
    std::uint32_t share_pixels_;
    std::shared_ptr<const HostScene> scene_;
    std::uint32_t probes_ = 0;
    std::array<Film, FilmSlot::kCount> films_{};
    std::optional<Error> failure_;  ///< of this rank in the command under way
};

/// The end of every command: counters and failures go to rank 0. Returns the sum of the counters there; throws Error, on rank 0 alone,
/// with the kind and message of the first rank that failed.
PassCounters report(Communicator& ranks, const std::optional<Error>& failure, const PassCounters& own);

template <class Fn>
void RankWork::locally(Fn&& fn) {
    if (failure_) return;
    try {
        fn();
    } catch (const Error& error) {
        failure_ = error;
    } catch (const std::bad_alloc&) {
        failure_ = Error(ErrorKind::Runtime, "out of memory");
    } catch (const std::exception& error) {
        failure_ = Error(ErrorKind::Runtime, error.what());
    }
}

}  // namespace pl
