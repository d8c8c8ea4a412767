// Binary files: values in a stream, and a checksum over the whole.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/fields/placement_storage.h"

namespace pl {

// Values as bytes of binary files: little endian, without padding; one description of a layout serves writing and reading.

[[noreturn]] inline void fail_damaged(const std::filesystem::path& path, std::string_view what,
                                      const std::string& why) {
    throw Error(ErrorKind::Input, fmt::format("{}: damaged {}: {}", path.string(), what, why));
}

/// Converts a number between the byte orders of file and host.
template <class T>
std::array<char, sizeof(T)> little_endian(std::array<char, sizeof(T)> bytes) {
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
    return bytes;
}

/// Serializes values into a buffer.
class BinaryWriter {
public:
    template <class T>
    void number(const T& value) {
        const auto bytes = little_endian<T>(std::bit_cast<std::array<char, sizeof(T)>>(value));
        bytes_.append(bytes.data(), bytes.size());
    }
    void text(const std::string& value) {
        number(std::uint64_t{value.size()});
        bytes_ += value;
    }
    template <class T, class Allocator>
    void count(const std::vector<T, Allocator>& array) {
        number(std::uint64_t{array.size()});
    }
    void raw(std::string_view bytes) { bytes_ += bytes; }
    /// Overwrites an earlier number.
    void patch(std::size_t offset, std::uint64_t value) {
        BinaryWriter other;
        other.number(value);
        bytes_.replace(offset, sizeof value, other.bytes_);
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// Deserializes values from a buffer; never reads past its end or allocates more than its size.
class BinaryReader {
public:
    /// `path` is for messages: of the file, which holds `what`.
    BinaryReader(std::string_view bytes, const std::filesystem::path& path, std::string_view what)
        : rest_(bytes), path_(path), what_(what) {}

    template <class T>
    void number(T& value) {
        std::array<char, sizeof(T)> bytes;
        std::ranges::copy(take(1, sizeof(T)), bytes.begin());
        value = std::bit_cast<T>(little_endian<T>(bytes));
    }
    void text(std::string& value) {
        std::uint64_t size = 0;
        number(size);
        value = take(size, 1);
    }
    template <class T, class Allocator>
    void count(std::vector<T, Allocator>& array) {
        // Elements have the same size in files and in memory.
        static_assert(sizeof(SurfacePoint) == 13 * 4 && sizeof(KdNode) == 8 * 4);
        std::uint64_t size = 0;
        number(size);
        require(size, sizeof(T));
        array.resize(size);
    }
    /// Throws unless everything has been read.
    void require_end() const {
        if (!rest_.empty()) fail(fmt::format("expected its end, got {} more bytes", rest_.size()));
    }
    [[noreturn]] void fail(const std::string& why) const { fail_damaged(path_, what_, why); }
    const std::filesystem::path& path() const { return path_; }
    std::string_view what() const { return what_; }

private:
    void require(std::uint64_t count, std::size_t size) const {
        if (count > rest_.size() / size)
            fail(fmt::format("expected {} more values of {} bytes, got {} bytes", count, size, rest_.size()));
    }
    std::string_view take(std::uint64_t count, std::size_t size) {
        require(count, size);
        const std::string_view taken = rest_.substr(0, count * size);
        rest_.remove_prefix(taken.size());
        return taken;
    }

    std::string_view rest_;
    const std::filesystem::path& path_;
    std::string_view what_;
};

/// Writes or reads one value: one description of the layout for both. No padding.
template <class Stream, class T>
void transfer(Stream& stream, T& value) {
    using Value = std::remove_const_t<T>;
    if constexpr (std::is_same_v<Value, Vec3f>) {
        for (int axis = 0; axis < 3; ++axis) stream.number(value[axis]);
    } else if constexpr (std::is_same_v<Value, KdNode>) {
        transfer(stream, value.position);
        stream.number(value.volume);
        transfer(stream, value.normal);
        stream.number(value.axis);
    } else if constexpr (std::is_same_v<Value, SurfacePoint>) {
        transfer(stream, value.position);
        transfer(stream, value.geometric_normal);
        transfer(stream, value.shading_normal);
        stream.number(value.position_error);
        stream.number(value.primitive);
        stream.number(value.material);
        std::uint32_t front = value.front ? 1 : 0;
        stream.number(front);
        if constexpr (!std::is_const_v<T>) value.front = front != 0;
    } else {
        static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value>);
        stream.number(value);
    }
}

template <class Stream, class Array>
void transfer_array(Stream& stream, Array& array) {
    stream.count(array);
    for (auto& value : array) transfer(stream, value);
}

// Binary files with a kind, a version, their size and a checksum, so that a reader refuses any that is not whole and its own:
//   magic, 8 bytes | u32 version | u64 bytes of the file | content | u64 Fnv1a of all preceding bytes

struct SealedKind {
    std::string_view magic;  ///< 8 bytes, the last one a line feed
    std::uint32_t version = 1;
    std::string_view title;  ///< in messages: "learned field"
    std::string_view word;   ///< the same, shorter: "field"
};

/// A writer that has begun a file; the content follows.
BinaryWriter begin_sealed(const SealedKind& kind);
/// Seals the content of begin_sealed() and writes it atomically (write_file_atomic). Throws Error(Runtime) if that fails.
void write_sealed(const std::filesystem::path& path, BinaryWriter writer);

/// The content of a file's bytes. Throws Error(Input) unless kind, version, size and checksum are right.
std::string_view sealed_content(std::string_view bytes, const std::filesystem::path& path, const SealedKind& kind);

}  // namespace pl
