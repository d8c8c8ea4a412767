// Notes about parts of a file that the program does not show, or shows otherwise.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pl {

/// Each kind is told once, with its first place and how often it occurs.
class SceneNotes {
public:
    /// `kind` is a sentence about the content.
    void add(const std::string& kind, const std::string& place);
    /// Appends "place: kind (3 in all)", in the order of first places.
    void tell(std::vector<std::string>& warnings) const;

private:
    struct Note {
        std::string kind;
        std::string first;
        std::size_t count = 0;
    };
    std::vector<Note> notes_;
};

}  // namespace pl
