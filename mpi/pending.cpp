#include "mpi/pending.h"

#include <algorithm>
#include <cstring>

namespace pl {
namespace {

/// The values of all arrays that are not 0. For each array: their number, their indices, the values.
class SparseSums {
public:
    template <class T>
    void add(std::span<const T> values) {
        std::vector<std::uint32_t> places;
        std::vector<T> found;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (values[i] == 0) continue;
            places.push_back(static_cast<std::uint32_t>(i));
            found.push_back(values[i]);
        }
        append(static_cast<std::uint32_t>(found.size()));
        append_all(places);
        append_all(found);
        dense_bytes_ += values.size_bytes();
    }

    const Bytes& bytes() const { return bytes_; }
    std::uint64_t dense_bytes() const { return dense_bytes_; }

private:
    template <class T>
    void append(const T& value) {
        const auto bytes = bytes_of_value(value);
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    template <class T>
    void append_all(const std::vector<T>& values) {
        const auto bytes = std::as_bytes(std::span(values));
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }

    Bytes bytes_;
    std::uint64_t dense_bytes_ = 0;
};

/// Reads the bytes of SparseSums, array by array.
class SparseReader {
public:
    explicit SparseReader(const Bytes& bytes) : rest_(bytes) {}

    template <class T>
    void add_to(std::span<T> values) {
        std::uint32_t count = 0;
        take(&count, 1);
        std::vector<std::uint32_t> places(count);
        std::vector<T> found(count);
        take(places.data(), count);
        take(found.data(), count);
        for (std::uint32_t i = 0; i < count; ++i) values[places[i]] += found[i];
    }

private:
    template <class T>
    void take(T* values, std::size_t count) {
        if (count > 0) std::memcpy(values, rest_.data(), count * sizeof(T));
        rest_ = rest_.subspan(count * sizeof(T));
    }

    std::span<const std::byte> rest_;
};

void add_others(Communicator& ranks, ExactBackend& backend, MethodId method, const Bytes& own) {
    const std::vector<Bytes> all = ranks.exchange(own);
    std::vector<SparseReader> readers;
    for (int rank = 0; rank < ranks.size(); ++rank)
        if (rank != ranks.rank()) readers.emplace_back(all[static_cast<std::size_t>(rank)]);
    backend.change_pending(method, [&](PendingSums sums) {
        std::visit(
            [&](auto values) {
                for (SparseReader& reader : readers) reader.add_to(values);
            },
            sums);
    });
}

/// All arrays in a row.
struct JoinedSums {
    std::vector<std::int64_t> values;
    std::vector<std::uint32_t> counts;

    std::vector<std::int64_t>& row(std::span<std::int64_t>) { return values; }
    std::vector<std::uint32_t>& row(std::span<std::uint32_t>) { return counts; }
};

void sum_arrays(Communicator& ranks, ExactBackend& backend, MethodId method) {
    JoinedSums all;
    backend.change_pending(method, [&](PendingSums sums) {
        std::visit([&](auto array) { all.row(array).insert(all.row(array).end(), array.begin(), array.end()); },
                   sums);
    });
    ranks.sum(all.values, all.counts);
    auto value = all.values.cbegin();
    auto count = all.counts.cbegin();
    const auto take = [](auto array, auto& from) {
        std::copy_n(from, array.size(), array.begin());
        from += static_cast<std::ptrdiff_t>(array.size());
    };
    backend.change_pending(method, [&](PendingSums sums) {
        if (const auto* array = std::get_if<std::span<std::int64_t>>(&sums))
            take(*array, value);
        else
            take(std::get<std::span<std::uint32_t>>(sums), count);
    });
}

}  // namespace

void sum_pending(Communicator& ranks, ExactBackend& backend, MethodId method) {
    SparseSums own;
    backend.change_pending(method, [&](PendingSums sums) {
        std::visit([&](auto values) { own.add(std::span<const typename decltype(values)::element_type>(values)); },
                   sums);
    });
    auto bytes = static_cast<std::int64_t>(own.bytes().size());
    ranks.sum(std::span(&bytes, 1), {});
    // Along a ring each rank passes on the lists of all others; or the arrays twice, to sum them and to spread the sums.
    if (static_cast<std::uint64_t>(bytes) < 2 * own.dense_bytes())
        return add_others(ranks, backend, method, own.bytes());
    sum_arrays(ranks, backend, method);
}

void clear_pending(ExactBackend& backend, MethodId method) {
    backend.change_pending(
        method, [](PendingSums sums) { std::visit([](auto values) { std::ranges::fill(values, 0); }, sums); });
}

}  // namespace pl
