#include "core/io/load_settings.h"

#include <algorithm>

#include <fmt/format.h>

namespace pl {

void SceneNotes::add(const std::string& kind, const std::string& place) {
    const auto known =
        std::find_if(notes_.begin(), notes_.end(), [&](const Note& note) { return note.kind == kind; });
    if (known == notes_.end())
        notes_.push_back({kind, place, 1});
    else
        ++known->count;
}

void SceneNotes::tell(std::vector<std::string>& warnings) const {
    for (const Note& note : notes_)
        warnings.push_back(fmt::format("{}: {} ({} in all)", note.first, note.kind, note.count));
}

}  // namespace pl
