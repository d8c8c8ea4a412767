#include "core/io/gltf/gltf_file.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/line_reader.h"
#include "core/io/texture_file.h"

namespace pl {

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
