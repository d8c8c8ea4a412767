// Numbered file names that never overwrite an existing file.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>

namespace pl::ui {

class NumberedNames {
public:
    /// "DIR/STEM-0001" without suffix. No file of this name with one of the suffixes exists, and it was not returned before.
    std::filesystem::path next(const std::filesystem::path& dir, const std::string& stem,
                               std::initializer_list<const char*> suffixes);

private:
    int last_ = 0;  ///< covers returned names whose files are not written yet
};

/// Letters, digits, '-' and '_' of the text, the rest replaced by '-'.
std::string file_name_part(const std::string& text);

}  // namespace pl::ui
