// One file of a Mitsuba scene.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include <pugixml.hpp>

#include "core/io/mitsuba/xml_file.h"

namespace pl {

/// With the parameters and notes that all files share.
struct MitsubaText {
    std::filesystem::path path;
    std::filesystem::path folder;  ///< of the scene
    std::string text;
    pugi::xml_document document{};
    const std::map<std::string, std::string>* parameters = nullptr;
    SceneNotes* notes = nullptr;

    int line_of(std::ptrdiff_t offset) const {
        const auto end = std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text.size()));
        return 1 + static_cast<int>(std::count(text.begin(), text.begin() + end, '\n'));
    }
};

}  // namespace pl
