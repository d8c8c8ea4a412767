#include "core/io/field_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/io/field_checks.h"
#include "core/io/files.h"

namespace pl {
namespace {

constexpr std::string_view kMagic = "PLFIELD\n";
constexpr std::uint32_t kVersion = 7;
constexpr std::size_t kChecksumBytes = sizeof(std::uint64_t);
constexpr std::size_t kPrefixBytes = kMagic.size() + sizeof kVersion + sizeof(std::uint64_t);

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), why));
}

/// Converts a number between the byte orders of file and host.
template <class T>
std::array<char, sizeof(T)> little_endian(std::array<char, sizeof(T)> bytes) {
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
    return bytes;
}

std::uint64_t checksum_of(std::string_view bytes) {
    Fnv1a hash;
    hash.add(bytes);
    return hash.value();
}

/// Serializes values into a buffer.
class Writer {
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
        Writer other;
        other.number(value);
        bytes_.replace(offset, sizeof value, other.bytes_);
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// Deserializes values from a buffer; never reads past its end or allocates more than its size.
class Reader {
public:
    Reader(std::string_view bytes, const std::filesystem::path& path) : rest_(bytes), path_(path) {}

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
    std::size_t left() const { return rest_.size(); }

private:
    void require(std::uint64_t count, std::size_t size) const {
        if (count > rest_.size() / size)
            fail(path_, fmt::format("damaged field: expected {} more values of {} bytes, got {} bytes", count, size,
                                    rest_.size()));
    }
    std::string_view take(std::uint64_t count, std::size_t size) {
        require(count, size);
        const std::string_view taken = rest_.substr(0, count * size);
        rest_.remove_prefix(taken.size());
        return taken;
    }

    std::string_view rest_;
    const std::filesystem::path& path_;
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

template <class Stream, class Field>
void transfer_header(Stream& stream, Field& field) {
    stream.text(field.scene_hash);
    const auto all = [&](auto&... values) { (transfer(stream, values), ...); };
    auto& settings = field.settings;
    all(settings.volumes, settings.budget_megabytes, settings.bins, settings.rate, settings.learning.target,
        settings.learning.light, settings.uniform_floor, settings.precompute_samples, settings.lookup,
        settings.refine_share);
    auto& shape = field.shape;
    all(shape.cells.side, shape.light_clusters, shape.radiance_unit, shape.extent, shape.rate, shape.uniform_floor,
        shape.lookup);
    all(field.refinement.rounds, field.refinement.added);
    auto& progress = field.progress;
    all(progress.passes, progress.records, progress.clamped_records, progress.lookup_misses,
        progress.precomputed_slices, progress.next_probe, progress.precompute_seconds);
}

/// Parses the content between prefix and checksum.
LearnedField read_content(std::string_view content, const std::filesystem::path& path) {
    Reader reader(content, path);
    LearnedField field;
    std::string method;
    reader.text(method);
    const std::optional<MethodId> known = method_by_name(method);
    if (!known || !info_of(*known).uses_field)
        fail(path, fmt::format("damaged field: expected a method that learns, got '{}'", method));
    field.method = *known;
    transfer_header(reader, field);
    HostVolumes volumes;
    const auto read = [&](const auto&, auto& array) { transfer_array(reader, array); };
    zip_placement(volumes, volumes, read);
    std::visit([&](auto& arrays) { zip(arrays, arrays, read); }, field.field);
    if (reader.left() != 0)
        fail(path, fmt::format("damaged field: expected its end, got {} more bytes", reader.left()));
    field.volumes = std::make_shared<const HostVolumes>(std::move(volumes));
    return field;
}

/// The content between prefix and checksum. Throws unless kind, version, size and checksum are right.
std::string_view checked_content(std::string_view bytes, const std::filesystem::path& path) {
    if (!bytes.starts_with(kMagic))
        fail(path, fmt::format("not a learned field: expected a file that begins with PLFIELD, got {:02x}",
                               fmt::join(bytes.substr(0, kMagic.size()), " ")));
    if (bytes.size() < kPrefixBytes + kChecksumBytes)
        fail(path, fmt::format("damaged field: expected at least {} bytes, got {}", kPrefixBytes + kChecksumBytes,
                               bytes.size()));
    Reader prefix(bytes.substr(kMagic.size()), path);
    std::uint32_t version = 0;
    prefix.number(version);
    if (version != kVersion)
        fail(path, fmt::format("learned field of another version: expected {}, got {}", kVersion, version));
    std::uint64_t size = 0;
    prefix.number(size);
    if (size != bytes.size()) fail(path, fmt::format("damaged field: expected {} bytes, got {}", size, bytes.size()));
    const std::string_view guarded = bytes.substr(0, bytes.size() - kChecksumBytes);
    std::uint64_t checksum = 0;
    Reader(bytes.substr(guarded.size()), path).number(checksum);
    if (checksum != checksum_of(guarded))
        fail(path, fmt::format("damaged field: expected the checksum {:016x}, got {:016x}", checksum,
                               checksum_of(guarded)));
    return guarded.substr(kPrefixBytes);
}

}  // namespace

void write_field(const std::filesystem::path& path, const LearnedField& field) {
    Writer writer;
    writer.raw(kMagic);
    writer.number(kVersion);
    writer.number(std::uint64_t{0});
    writer.text(std::string(info_of(field.method).name));
    transfer_header(writer, field);
    const auto write = [&](const auto& array, const auto&) { transfer_array(writer, array); };
    zip_placement(*field.volumes, *field.volumes, write);
    std::visit([&](const auto& arrays) { zip(arrays, arrays, write); }, field.field);
    writer.patch(kMagic.size() + sizeof kVersion, writer.bytes().size() + kChecksumBytes);
    writer.number(checksum_of(writer.bytes()));
    write_file_atomic(path, writer.bytes());
}

LearnedField read_field(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    LearnedField field = read_content(checked_content(bytes, path), path);
    require_usable(field, path);
    return field;
}

}  // namespace pl
