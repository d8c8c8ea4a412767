#include "core/io/json_file.h"

#include <fmt/format.h>

#include "core/io/files.h"

template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace pl {

bool is_utf8(const std::string& text) {
    try {
        return !Json(text).dump().empty();
    } catch (const Json::type_error&) {
        return false;
    }
}

Json parse_json(std::string_view text) { return Json::parse(text); }

Json read_json_file(const std::filesystem::path& path, std::string_view schema) {
    const std::string text = read_text_file(path);
    return read_members(path, [&] {
        Json document = parse_json(text);
        const std::string found = document.at("schema").get<std::string>();
        if (found != schema)
            throw Error(ErrorKind::Input,
                        fmt::format("{}: expected schema {}, got {}", path.string(), schema, found));
        return document;
    });
}

void write_json_file(const std::filesystem::path& path, const Json& document) {
    write_file_atomic(path, document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error || !std::filesystem::is_directory(folder))
        throw Error(ErrorKind::Runtime, fmt::format("{}: cannot be made: {}", folder.string(),
                                                    error ? error.message() : "there is a file of this name"));
}

}  // namespace pl
