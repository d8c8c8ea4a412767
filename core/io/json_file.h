// JSON files that the program writes for itself and reads again.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/kernel/base/math.h"

namespace pl {

// The one type of JSON values. Its members are compiled in json_file.cpp alone: every file that uses them would else take seconds for
// them.

/// Members stay in the order in which they were written.
using Json = nlohmann::ordered_json;

}  // namespace pl

extern template class nlohmann::basic_json<nlohmann::ordered_map>;

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

/// Makes the folder and the folders above it. Throws Error(Runtime).
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
