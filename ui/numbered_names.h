// File names with a number that never hit a file that is there.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>

namespace pl {

class NumberedNames {
public:
    /// "DIR/STEM-0001" without suffix: neither it with one of the suffixes nor an earlier answer exists.
    std::filesystem::path next(const std::filesystem::path& dir, const std::string& stem,
                               std::initializer_list<const char*> suffixes);

private:
    int last_ = 0;  ///< files of earlier answers may still be on their way to the disk
};

/// A name that is safe in a file name: letters, digits, '-' and '_', the rest as '-'.
std::string file_name_part(const std::string& text);

}  // namespace pl
