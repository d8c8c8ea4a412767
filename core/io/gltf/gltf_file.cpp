#include "core/io/gltf/gltf_file.h"

#include <array>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/line_reader.h"
#include "core/io/texture_file.h"

namespace pl {
namespace {

constexpr std::string_view kGlbMagic = "glTF";
constexpr std::size_t kGlbHeader = 12;
constexpr std::size_t kChunkHeader = 8;
constexpr std::uint32_t kJsonChunk = 0x4e4f534au;
constexpr std::uint32_t kBinaryChunk = 0x004e4942u;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

/// Takes the chunks of a .glb one after the other.
class GlbReader {
public:
    GlbReader(std::string_view bytes, const std::filesystem::path& path) : bytes_(bytes), path_(path) {
        need(kGlbHeader, "a header");
        if (const std::uint32_t version = little_endian(bytes_, 4); version != 2)
            fail(4, fmt::format("expected version 2 of the container, got {}", version));
        if (const std::uint32_t length = little_endian(bytes_, 8); length != bytes_.size())
            fail(8, fmt::format("the header says {} bytes, the file has {}", length, bytes_.size()));
        at_ = kGlbHeader;
    }

    GltfParts run() {
        GltfParts parts;
        const auto [first, text] = next_chunk();
        if (first != kJsonChunk)
            fail(kGlbHeader + 4, fmt::format("expected a JSON chunk first, got the type 0x{:08x}", first));
        parts.text = text;
        while (at_ < bytes_.size()) {
            const auto [type, content] = next_chunk();
            if (type == kBinaryChunk && !parts.binary) parts.binary.emplace(content);
        }
        return parts;
    }

private:
    std::pair<std::uint32_t, std::string_view> next_chunk() {
        need(kChunkHeader, "the header of a chunk");
        const std::size_t length = little_endian(bytes_, at_);
        const std::uint32_t type = little_endian(bytes_, at_ + 4);
        at_ += kChunkHeader;
        need(length, "a chunk");
        const std::string_view content = bytes_.substr(at_, length);
        at_ += length;
        return {type, content};
    }

    void need(std::size_t count, const char* what) const {
        if (bytes_.size() - at_ < count)
            fail(at_, fmt::format("expected {} of {} bytes, got {}", what, count, bytes_.size() - at_));
    }

    [[noreturn]] void fail(std::size_t at, const std::string& what) const {
        throw Error(ErrorKind::Input, fmt::format("{}: byte {}: {}", path_.string(), at, what));
    }

    std::string_view bytes_;
    const std::filesystem::path& path_;
    std::size_t at_ = 0;
};

/// -1 for a character that is none of the 64.
int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    return c == '/' || c == '_' ? 63 : -1;
}

/// [RFC 4648, sections 4 and 5]
std::optional<std::string> decode_base64(std::string_view text) {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) return std::nullopt;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<char>(bits >> count & 0xffu));
        }
    }
    return count == 6 ? std::nullopt : std::optional(std::move(bytes));
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

}  // namespace

GltfParts split_gltf(std::string bytes, const std::filesystem::path& path) {
    if (bytes.starts_with(kGlbMagic)) return GlbReader(bytes, path).run();
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
    return {.text = std::move(bytes)};
}

std::optional<std::string> decode_data_uri(std::string_view uri) {
    constexpr std::string_view kMark = ";base64,";
    const std::size_t mark = uri.find(kMark);
    return mark == std::string_view::npos ? std::nullopt : decode_base64(uri.substr(mark + kMark.size()));
}

std::string decode_percent(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool has_two = uri[i] == '%' && i + 2 < uri.size();
        const int high = has_two ? hex_digit(uri[i + 1]) : -1;
        const int low = has_two ? hex_digit(uri[i + 2]) : -1;
        if (high < 0 || low < 0) {
            text += uri[i];
            continue;
        }
        text += static_cast<char>(16 * high + low);
        i += 2;
    }
    return text;
}

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 40;

/// Extensions without which geometry or buffers cannot be read, and the names of what compresses them.
constexpr std::array<std::pair<const char*, const char*>, 3> kCompressions = {
    {{"KHR_draco_mesh_compression", "Draco"},
     {"EXT_meshopt_compression", "meshopt"},
     {"KHR_meshopt_compression", "meshopt"}}};

std::string compressed_by(const std::pair<const char*, const char*>& compression) {
    return fmt::format("expected meshes without compression, got meshes compressed by {} ({})", compression.second,
                       compression.first);
}

void require_version(const JsonDocument& json) {
    const std::string version = json.text("/asset/version").value_or("none");
    if (!version.starts_with("2."))
        json.fail("/asset/version", fmt::format("expected glTF of version 2, got {}", in_quotes(version)));
}

void require_readable(const JsonDocument& json) {
    for (std::size_t i = 0; i < json.array_size("/extensionsRequired"); ++i) {
        const std::string pointer = fmt::format("/extensionsRequired/{}", i);
        const std::string name = json.text(pointer).value_or("");
        for (const auto& compression : kCompressions)
            if (name == compression.first) json.fail(pointer, compressed_by(compression));
    }
}

}  // namespace

GltfFile::GltfFile(const fs::path& path) : GltfFile(path, split_gltf(read_file(path), path)) {}

GltfFile::GltfFile(const fs::path& path, GltfParts parts)
    : path_(path), json_(parts.text, path), binary_(std::move(parts.binary)), files_{path} {
    require_version(json_);
    require_readable(json_);
}

void GltfFile::note(const std::string& kind, const std::string& pointer) {
    notes_.add(kind, fmt::format("{}: '{}'", path_.string(), pointer.substr(1)));
}

std::optional<std::uint32_t> GltfFile::index(const std::string& pointer, const std::string& of) const {
    const std::optional<std::int64_t> value = json_.integer(pointer);
    if (!value) return std::nullopt;
    const std::size_t count = json_.array_size("/" + of);
    if (*value < 0 || static_cast<std::uint64_t>(*value) >= count)
        fail(pointer, fmt::format("expected an index into the {} {}, got {}", count, of, *value));
    return static_cast<std::uint32_t>(*value);
}

std::uint32_t GltfFile::required_index(const std::string& pointer, const std::string& of) const {
    const std::optional<std::uint32_t> value = index(pointer, of);
    if (!value) fail(pointer, fmt::format("expected an index into {}, got none", of));
    return *value;
}

std::uint64_t GltfFile::whole(const std::string& pointer, std::uint64_t standard, std::uint64_t least,
                              std::uint64_t most) const {
    const std::optional<std::int64_t> value = json_.integer(pointer);
    const std::uint64_t number = value ? static_cast<std::uint64_t>(*value) : standard;
    if ((value && *value < 0) || number < least || number > most) {
        fail(pointer, fmt::format("expected a whole number within [{}, {}], got {}", least, most,
                                  value ? fmt::format("{}", *value) : "none"));
    }
    return number;
}

std::string GltfFile::name_of(const std::string& pointer, const char* kind, std::uint32_t number) const {
    const std::string name = json_.text(pointer + "/name").value_or("");
    return name.empty() ? fmt::format("{} {}", kind, number) : name;
}

void GltfFile::refuse_compressed(const std::string& at) const {
    for (const auto& compression : kCompressions) {
        const std::string pointer = fmt::format("{}/extensions/{}", at, compression.first);
        if (json_.has(pointer)) fail(pointer, compressed_by(compression));
    }
}

std::string_view GltfFile::view_bytes(std::uint32_t view) {
    const std::string at = fmt::format("/bufferViews/{}", view);
    const std::uint32_t number = required_index(at + "/buffer", "buffers");
    if (!has_bytes(number)) refuse_compressed(at);
    const std::string_view buffer = buffer_bytes(number);
    const std::uint64_t offset = whole(at + "/byteOffset", 0, 0, kMostBytes);
    const std::uint64_t length = whole(at + "/byteLength", 0, 1, kMostBytes);
    if (offset > buffer.size() || length > buffer.size() - offset) {
        fail(at, fmt::format("expected a part of the {} bytes of its buffer, got bytes {} to {}", buffer.size(),
                             offset, offset + length));
    }
    return buffer.substr(offset, length);
}

std::size_t GltfFile::view_stride(std::uint32_t view) const {
    constexpr std::uint64_t kLeastStride = 4;
    constexpr std::uint64_t kMostStride = 252;
    const std::string pointer = fmt::format("/bufferViews/{}/byteStride", view);
    return json_.has(pointer) ? whole(pointer, 0, kLeastStride, kMostStride) : 0;
}

std::string_view GltfFile::buffer_bytes(std::uint32_t buffer) {
    const auto known = buffers_.find(buffer);
    return known != buffers_.end() ? known->second : buffers_.emplace(buffer, load_buffer(buffer)).first->second;
}

bool GltfFile::has_bytes(std::uint32_t buffer) const {
    return json_.has(fmt::format("/buffers/{}/uri", buffer)) || (buffer == 0 && binary_);
}

std::string GltfFile::load_buffer(std::uint32_t buffer) {
    const std::string at = fmt::format("/buffers/{}", buffer);
    const std::uint64_t length = whole(at + "/byteLength", 0, 1, kMostBytes);
    std::string bytes;
    if (const std::optional<std::string> uri = json_.text(at + "/uri"))
        bytes = uri_bytes(at + "/uri", *uri);
    else if (buffer == 0 && binary_)
        bytes = std::move(*binary_);
    else
        fail(at, "expected a 'uri', or for the first buffer the binary chunk of a .glb, got neither");
    if (bytes.size() < length) {
        fail(at + "/byteLength",
             fmt::format("expected at most the {} bytes of the buffer, got {}", bytes.size(), length));
    }
    bytes.resize(length);
    return bytes;
}

fs::path GltfFile::uri_path(const std::string& pointer, const std::string& uri) const {
    const std::string name = decode_percent(uri);
    const fs::path path = path_inside(path_.parent_path(), name);
    if (path.empty() || name.find(':') != std::string::npos || name.find('\0') != std::string::npos)
        fail(pointer, fmt::format("expected data or a file in the folder of the scene, got {}", in_quotes(uri)));
    return path;
}

std::string GltfFile::uri_bytes(const std::string& pointer, const std::string& uri) {
    if (!uri.starts_with("data:")) {
        files_.push_back(uri_path(pointer, uri));
        return read_file(files_.back());
    }
    std::optional<std::string> bytes = decode_data_uri(uri);
    if (!bytes) fail(pointer, fmt::format("expected \"data:TYPE;base64,TEXT\", got {}", in_quotes(uri)));
    return std::move(*bytes);
}

}  // namespace pl
