#include "core/io/mitsuba/serialized.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <stb_image.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/files.h"
#include "core/io/image.h"

namespace pl {
namespace {

constexpr std::uint64_t kMagic = 0x041c;
constexpr std::uint64_t kHasNormals = 0x1, kHasUvs = 0x2, kHasColors = 0x8, kIsFlat = 0x10, kIsDouble = 0x2000;
constexpr std::uint64_t kBytesOfTriangle = 12;

/// Little-endian numbers, one after the other.
class Bytes {
public:
    Bytes(std::string_view bytes, const std::filesystem::path& path) : bytes_(bytes), path_(path) {}

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorKind::Input, fmt::format("{}: byte {}: {}", path_.string(), at_, what));
    }
    std::uint64_t left() const { return bytes_.size() - at_; }
    void go_to(std::uint64_t at) {
        if (at > bytes_.size()) fail(fmt::format("expected a place within {} bytes, got {}", bytes_.size(), at));
        at_ = static_cast<std::size_t>(at);
    }
    void skip(std::uint64_t count) { go_to(at_ + std::min(count, left() + 1)); }
    std::uint64_t whole(std::size_t bytes) {
        if (left() < bytes) fail(fmt::format("expected {} bytes of a number, got the end", bytes));
        std::uint64_t value = 0;
        for (std::size_t i = bytes; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes_[at_ + i]);
        at_ += bytes;
        return value;
    }
    /// In the range of floats.
    double real(bool is_double) {
        const std::uint64_t bits = whole(is_double ? 8 : 4);
        const double value = is_double ? std::bit_cast<double>(bits)
                                       : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
        if (!std::isfinite(static_cast<float>(value))) fail("expected a finite number");
        return value;
    }
    std::string_view rest() const { return bytes_.substr(at_); }

private:
    std::string_view bytes_;
    const std::filesystem::path& path_;
    std::size_t at_ = 0;
};

/// Where a shape begins: from the list at the end of the file, which ends with the number of shapes.
std::uint64_t place_of(Bytes file, std::uint64_t version, std::int64_t shape, std::uint64_t size) {
    const std::uint64_t bytes_of_place = version == 4 ? 8 : 4;
    file.go_to(size - 4);
    const std::uint64_t shapes = file.whole(4);
    if (shape < 0 || static_cast<std::uint64_t>(shape) >= shapes)
        file.fail(fmt::format("expected the number of one of {} shapes, from 0, got {}", shapes, shape));
    if (shapes > (size - 4) / bytes_of_place) file.fail(fmt::format("expected a list of {} shapes", shapes));
    file.go_to(size - 4 - bytes_of_place * (shapes - static_cast<std::uint64_t>(shape)));
    return file.whole(static_cast<std::size_t>(bytes_of_place));
}

/// The first bytes of a compressed stream, or all if they are fewer.
std::string unpacked(std::string_view packed, std::size_t most, const Bytes& file) {
    // A block that begins before the limit is unpacked as a whole, so that it has its room behind.
    constexpr std::size_t kLargestStoredBlock = 65535;
    const auto size = static_cast<int>(std::min<std::size_t>(packed.size(), std::numeric_limits<int>::max()));
    std::string bytes(most + kLargestStoredBlock, '\0');
    // A failure without a reason leaves the reason of an earlier failure, which must not be the limit.
    ::stbi_zlib_decode_buffer(bytes.data(), 0, "", 0);
    const int got = ::stbi_zlib_decode_buffer(bytes.data(), static_cast<int>(bytes.size()), packed.data(), size);
    if (got < 0 && stb_failure() != "output buffer limit") file.fail("expected a compressed mesh, got a damaged one");
    bytes.resize(got < 0 ? most : std::min(static_cast<std::size_t>(got), most));
    return bytes;
}

/// The numbers before the arrays of a mesh.
struct MeshHead {
    std::uint64_t flags = 0, vertices = 0, triangles = 0;

    bool has(std::uint64_t flag) const { return (flags & flag) != 0; }
};

MeshHead read_head(Bytes& file, std::uint64_t version) {
    MeshHead head{.flags = file.whole(4)};
    while (version == 4 && file.whole(1) != 0) continue;  // its name
    head.vertices = file.whole(8);
    head.triangles = file.whole(8);
    return head;
}

std::uint64_t bytes_of_vertex(const MeshHead& head) {
    const std::uint64_t numbers =
        3 + (head.has(kHasNormals) ? 3 : 0) + (head.has(kHasUvs) ? 2 : 0) + (head.has(kHasColors) ? 3 : 0);
    return numbers * (head.has(kIsDouble) ? 8 : 4);
}

std::uint64_t bytes_of_arrays(const MeshHead& head) {
    return head.vertices * bytes_of_vertex(head) + head.triangles * kBytesOfTriangle;
}

void require_room(const MeshHead& head, std::uint64_t most, const Bytes& file) {
    // Each count by itself first: products of huge ones wrap around.
    if (head.vertices > most || head.triangles > most || bytes_of_arrays(head) > most)
        file.fail(fmt::format("expected counts that fit into {} bytes, got {} vertices and {} triangles", most,
                              head.vertices, head.triangles));
}

/// Unpacks no more than the counts at the beginning of the mesh say.
std::string unpacked_mesh(std::string_view packed, std::uint64_t version, const Bytes& file,
                          const std::filesystem::path& path) {
    constexpr std::size_t kMostHead = 65536;
    const std::string start = unpacked(packed, kMostHead, file);
    Bytes bytes(start, path);
    const MeshHead head = read_head(bytes, version);
    constexpr std::size_t kMostRatio = 1032;  // of deflate   [zlib, Technical Details]
    const std::uint64_t most = std::min(kMostSerializedBytes, kMostRatio * packed.size());
    require_room(head, most, bytes);
    const std::uint64_t size = start.size() - bytes.left() + bytes_of_arrays(head);
    require_memory(path.string(), size, ErrorKind::Input);
    return unpacked(packed, static_cast<std::size_t>(size), file);
}

PlyMesh read_mesh(Bytes file, std::uint64_t version) {
    const MeshHead head = read_head(file, version);
    const std::uint64_t vertices = head.vertices;
    require_room(head, file.left(), file);
    const bool is_double = head.has(kIsDouble);
    PlyMesh result;
    result.is_flat = head.has(kIsFlat);
    const auto vectors = [&](auto& to) {
        to.resize(static_cast<std::size_t>(vertices));
        for (auto& v : to)
            for (int k = 0; k < v.length(); ++k)
                v[k] = static_cast<std::remove_reference_t<decltype(v[k])>>(file.real(is_double));
    };
    vectors(result.positions);
    if (head.has(kHasNormals)) vectors(result.normals);
    if (head.has(kHasUvs)) vectors(result.uvs);
    if (head.has(kHasColors)) file.skip(vertices * (is_double ? 24 : 12));
    for (std::uint64_t i = 0; i < head.triangles; ++i) {
        std::array<std::uint32_t, 3> corners{};
        for (std::uint32_t& corner : corners) {
            corner = static_cast<std::uint32_t>(file.whole(4));
            if (corner >= vertices)
                file.fail(fmt::format("expected indices below {}, the number of vertices, got {}", vertices, corner));
        }
        result.triangles.push_back(corners);
    }
    return result;
}

}  // namespace

PlyMesh read_serialized(const std::filesystem::path& path, std::int64_t shape) {
    const std::string bytes = read_file(path);
    Bytes file(bytes, path);
    const std::uint64_t magic = file.whole(2);
    const std::uint64_t version = file.whole(2);
    if (magic != kMagic || (version != 3 && version != 4))
        file.fail(
            fmt::format("expected a serialized mesh of version 3 or 4, got {:#x} and version {}", magic, version));
    if (file.left() < 4) file.fail("expected a list of shapes, got the end");
    file.go_to(place_of(file, version, shape, bytes.size()));
    if (file.whole(2) != kMagic) file.fail("expected the beginning of a shape");
    file.skip(2);
    const std::string mesh = unpacked_mesh(file.rest(), version, file, path);
    return read_mesh(Bytes(mesh, path), version);
}

}  // namespace pl
