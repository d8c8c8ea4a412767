#include "core/io/mitsuba/serialized.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <stb_image.h>

#include "core/base/error.h"
#include "core/io/files.h"

namespace pl {
namespace {

constexpr std::uint64_t kMagic = 0x041c;
constexpr std::uint64_t kHasNormals = 0x1, kHasUvs = 0x2, kHasColors = 0x8, kIsFlat = 0x10, kIsDouble = 0x2000;

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
    float real(bool is_double) {
        const std::uint64_t bits = whole(is_double ? 8 : 4);
        const auto value = is_double ? static_cast<float>(std::bit_cast<double>(bits))
                                     : std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        if (!std::isfinite(value)) fail("expected a finite number");
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

std::string unpacked(std::string_view packed, const Bytes& file) {
    const auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
    const std::string_view given = packed.substr(0, most);
    for (std::size_t size = 16 * given.size() + 64;; size *= 2) {
        std::string bytes(std::min(size, kMostSerializedBytes), '\0');
        const int got = ::stbi_zlib_decode_buffer(bytes.data(), static_cast<int>(bytes.size()), given.data(),
                                                  static_cast<int>(given.size()));
        if (got >= 0) {
            bytes.resize(static_cast<std::size_t>(got));
            return bytes;
        }
        const bool is_too_small = std::string_view(stbi_failure_reason()) == "output buffer limit";
        if (!is_too_small) file.fail(fmt::format("expected a compressed mesh: {}", stbi_failure_reason()));
        if (size >= kMostSerializedBytes)
            file.fail(fmt::format("expected a mesh of at most {} bytes, got more", kMostSerializedBytes));
    }
}

SerializedMesh read_mesh(Bytes file, std::uint64_t version) {
    const std::uint64_t flags = file.whole(4);
    while (version == 4 && file.whole(1) != 0) continue;  // its name
    const std::uint64_t vertices = file.whole(8);
    const std::uint64_t triangles = file.whole(8);
    if (vertices > file.left() / 12 || triangles > file.left() / 12)
        file.fail(fmt::format("expected counts that fit into {} bytes, got {} vertices and {} triangles", file.left(),
                              vertices, triangles));
    const bool is_double = (flags & kIsDouble) != 0;
    SerializedMesh result{.mesh = {}, .is_flat = (flags & kIsFlat) != 0};
    const auto vectors = [&](auto& to) {
        to.resize(static_cast<std::size_t>(vertices));
        for (auto& v : to)
            for (int k = 0; k < v.length(); ++k) v[k] = file.real(is_double);
    };
    vectors(result.mesh.positions);
    if ((flags & kHasNormals) != 0) vectors(result.mesh.normals);
    if ((flags & kHasUvs) != 0) vectors(result.mesh.uvs);
    if ((flags & kHasColors) != 0) file.skip(vertices * (is_double ? 24 : 12));
    for (std::uint64_t i = 0; i < triangles; ++i) {
        std::array<std::uint32_t, 3> corners{};
        for (std::uint32_t& corner : corners) {
            corner = static_cast<std::uint32_t>(file.whole(4));
            if (corner >= vertices)
                file.fail(fmt::format("expected indices below {}, the number of vertices, got {}", vertices, corner));
        }
        result.mesh.triangles.push_back(corners);
    }
    return result;
}

}  // namespace

SerializedMesh read_serialized(const std::filesystem::path& path, std::int64_t shape) {
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
    const std::string mesh = unpacked(file.rest(), file);
    return read_mesh(Bytes(mesh, path), version);
}

}  // namespace pl
