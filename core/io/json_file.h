// JSON files that the program writes for itself and reads again.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/io/json.h"
#include "core/kernel/base/math.h"

namespace pl {

/// [x, y, z].
inline Json vector_json(const Vec3f& v) { return Json::array({v.x, v.y, v.z}); }

/// Whether JSON text can hold these bytes.
bool is_utf8(const std::string& text);

/// Throws Json::parse_error.
Json parse_json(std::string_view text);

/// Throws Error(Input): missing, not JSON, not of this "schema".
Json read_json_file(const std::filesystem::path& path, std::string_view schema);

/// The file appears under its name only when it is complete.
void write_json_file(const std::filesystem::path& path, const Json& document);

/// Makes the folder and those above it. Throws Error(Runtime).
void make_folder(const std::filesystem::path& folder);

/// The result of `read`; missing members and wrong types become an Error(Input) that names the file.
template <class Read>
auto read_members(const std::filesystem::path& path, Read&& read) {
    try {
        return read();
    } catch (const Json::exception& error) {
        throw Error(ErrorKind::Input, path.string() + ": " + error.what());
    }
}

}  // namespace pl
