#include "ui/model/numbered_names.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace pl::ui {

std::filesystem::path NumberedNames::next(const std::filesystem::path& dir, const std::string& stem,
                                          std::initializer_list<const char*> suffixes) {
    while (true) {
        const std::string name = fmt::format("{}-{:04}", stem, ++last_);
        const bool taken = std::any_of(suffixes.begin(), suffixes.end(), [&](const char* suffix) {
            std::error_code ignored;
            return std::filesystem::exists(dir / (name + suffix), ignored);
        });
        if (!taken) return dir / name;
    }
}

std::string file_name_part(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const bool safe = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
        result += safe ? c : '-';
    }
    return result.empty() ? "picture" : result;
}

}  // namespace pl::ui
