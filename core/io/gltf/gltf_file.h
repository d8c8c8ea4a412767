// A glTF 2.0 file: its JSON with checked indices, the bytes of its buffers, and notes about parts that are not shown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/json_document.h"
#include "core/io/load_settings.h"

namespace pl {

// The outer form of glTF files: JSON text, alone or with a binary chunk; and data that is written into URIs.

struct GltfParts {
    std::string text;                     ///< JSON
    std::optional<std::string> binary{};  ///< the chunk of a .glb
};

/// Takes a .glb apart, known by its first bytes; all other bytes are the text of a .gltf. Throws Error(Input) with the
/// byte at which a .glb is damaged. [glTF 2.0, section 4]
GltfParts split_gltf(std::string bytes, const std::filesystem::path& path);

/// The bytes of "data:TYPE;base64,TEXT"; nothing if it is malformed.
std::optional<std::string> decode_data_uri(std::string_view uri);

/// Resolves escapes such as %20; those that are malformed stay.
std::string decode_percent(std::string_view uri);

/// All members throw Error(Input) with file, line and JSON pointer for content that breaks the format.
class GltfFile {
public:
    /// Reads the file and requires version 2.
    explicit GltfFile(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    const JsonDocument& json() const { return json_; }
    /// Notes content that is left out or shown otherwise: `kind` is a sentence about it, `pointer` its place in the JSON.
    void note(const std::string& kind, const std::string& pointer);
    const SceneNotes& notes() const { return notes_; }
    /// The file itself and those that its URIs named.
    const std::vector<std::filesystem::path>& files() const { return files_; }

    [[noreturn]] void fail(const std::string& pointer, const std::string& what) const { json_.fail(pointer, what); }

    /// The index at `pointer` into the array `of`, such as "accessors"; nothing if there is none.
    std::optional<std::uint32_t> index(const std::string& pointer, const std::string& of) const;
    /// As index() for a member that must be there.
    std::uint32_t required_index(const std::string& pointer, const std::string& of) const;
    /// A whole number within [least, most]; `standard` if there is none.
    std::uint64_t whole(const std::string& pointer, std::uint64_t standard, std::uint64_t least,
                        std::uint64_t most) const;
    /// A member `name` of the object at `pointer`, else `kind` and the number of the object.
    std::string name_of(const std::string& pointer, const char* kind, std::uint32_t number) const;

    /// Throws if the object at the pointer `at` has an extension of compressed meshes, which are not read.
    void refuse_compressed(const std::string& at) const;
    /// Bytes of a buffer view. Loads its buffer at the first use; valid as long as the file.
    std::string_view view_bytes(std::uint32_t view);
    /// Distance of elements that the view sets, 0 if it sets none.
    std::size_t view_stride(std::uint32_t view) const;

    /// Path of a URI without data, inside of the folder of the file.
    std::filesystem::path uri_path(const std::string& pointer, const std::string& uri) const;
    /// Bytes of the URI at `pointer`: data in the URI, or a file.
    std::string uri_bytes(const std::string& pointer, const std::string& uri);

private:
    GltfFile(const std::filesystem::path& path, GltfParts parts);
    std::string_view buffer_bytes(std::uint32_t buffer);
    bool has_bytes(std::uint32_t buffer) const;
    std::string load_buffer(std::uint32_t buffer);

    std::filesystem::path path_;
    JsonDocument json_;
    std::optional<std::string> binary_;
    std::map<std::uint32_t, std::string> buffers_;  ///< the loaded ones; nodes of a map stay where they are
    std::vector<std::filesystem::path> files_;
    SceneNotes notes_;
};

}  // namespace pl
