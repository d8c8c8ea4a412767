// Counter of one kind of ignored or corrected statements of a loader, for one warning with their number and first
// line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace pl {

struct Tally {
    std::size_t count = 0;
    int first_line = 0;
    std::string first;  ///< what is particular to the first one

    void add(int line) {
        first_line = count == 0 ? line : first_line;
        ++count;
    }

    /// Adds one of any line; `particular` gives its text.
    template <class Particular>
    void add(int line, Particular&& particular) {
        if (count == 0 || line < first_line) {
            first_line = line;
            first = particular();
        }
        ++count;
    }

    /// Adds a tally of statements below the statements of this tally. The lines of `later` count from behind
    /// `lines_before`.
    void add(const Tally& later, int lines_before = 0) {
        if (count == 0) {
            first_line = later.first_line + lines_before;
            first = later.first;
        }
        count += later.count;
    }

    /// Appends "file:line: first: what (3 in all)" if anything was counted.
    void tell(std::vector<std::string>& warnings, const std::filesystem::path& path, const std::string& what) const {
        if (count > 0) {
            warnings.push_back(path.string() + ":" + std::to_string(first_line) + ": " +
                               (first.empty() ? "" : first + ": ") + what + " (" + std::to_string(count) +
                               " in all)");
        }
    }
};

}  // namespace pl
