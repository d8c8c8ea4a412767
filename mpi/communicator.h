// Messages between the ranks of a job, as few kinds as the driver needs. MPI implements it; tests also run ranks as threads.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace pl {

using Bytes = std::vector<std::byte>;

/// Messages of a rank, and the time that it spent in communication, waiting included.
struct Traffic {
    std::uint64_t messages = 0;    ///< calls
    std::uint64_t bytes_sent = 0;  ///< that this rank has handed over, however often the network carries them
    double seconds = 0.0;
};

/// Every call is collective, but send() and receive(): all ranks make the same calls in the same order. Errors, such as a rank that
/// has died, are Error(Unavailable), after which no further call succeeds.
class Communicator {
public:
    virtual ~Communicator() = default;

    virtual int rank() const = 0;
    virtual int size() const = 0;
    /// A rank has died or a message was lost: every further call throws.
    virtual bool is_broken() const { return false; }
    /// "rank 2 (host)", for messages.
    virtual std::string name_of(int rank) const = 0;
    virtual std::string host() const = 0;  ///< of this rank

    /// Rank 0's bytes to all.
    virtual void broadcast(std::span<std::byte> bytes) = 0;
    /// The bytes of all ranks, as many from each, to rank 0; in the order of ranks, empty elsewhere.
    virtual Bytes gather(std::span<const std::byte> own) = 0;
    /// The bytes of all ranks, in any number, to all.
    virtual std::vector<Bytes> exchange(std::span<const std::byte> own) = 0;
    /// Sums over all ranks, in place, of both arrays at once: each message of its own would wait for the network again.
    virtual void sum(std::span<std::int64_t> values, std::span<std::uint32_t> counts) = 0;

    /// From one rank to another, in the order of sending. send() may return before the bytes are received; they are copied.
    virtual void send(int to, std::span<const std::byte> bytes) = 0;
    virtual void receive(int from, std::span<std::byte> bytes) = 0;
    /// Whether receive() from this rank would not have to wait.
    virtual bool has_message(int from) = 0;

    const Traffic& traffic() const { return traffic_; }

protected:
    Traffic traffic_;
};

template <class T>
std::span<std::byte> bytes_of_value(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_writable_bytes(std::span(&value, 1));
}
template <class T>
std::span<const std::byte> bytes_of_value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_bytes(std::span(&value, 1));
}

/// Rank 0's array to all, its length first.
template <class T, class Allocator>
void broadcast_array(Communicator& ranks, std::vector<T, Allocator>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::uint64_t count = values.size();
    ranks.broadcast(bytes_of_value(count));
    values.resize(count);
    if (count > 0) ranks.broadcast(std::as_writable_bytes(std::span(values)));
}

/// The same of an array that stays as it is on rank 0, into `received` on the others.
template <class T, class Allocator>
void broadcast_array(Communicator& ranks, const std::vector<T, Allocator>& sent,
                     std::vector<T, Allocator>& received) {
    if (ranks.rank() != 0) return broadcast_array(ranks, received);
    std::uint64_t count = sent.size();
    ranks.broadcast(bytes_of_value(count));
    // Rank 0's bytes are only read.
    const auto bytes = std::as_bytes(std::span(sent));
    if (count > 0) ranks.broadcast({const_cast<std::byte*>(bytes.data()), bytes.size()});
}

/// send() of a text, whose length goes before it.
inline void send_text(Communicator& ranks, int to, const std::string& text) {
    const std::uint64_t length = text.size();
    ranks.send(to, bytes_of_value(length));
    ranks.send(to, std::as_bytes(std::span(text)));
}
inline std::string receive_text(Communicator& ranks, int from) {
    std::uint64_t length = 0;
    ranks.receive(from, bytes_of_value(length));
    std::string text(length, '\0');
    ranks.receive(from, std::as_writable_bytes(std::span(text)));
    return text;
}

}  // namespace pl
