// The outer form of glTF files: JSON text, alone or with a binary chunk; and data that is written into URIs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace pl {

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

}  // namespace pl
