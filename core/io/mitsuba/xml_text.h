// Files of a Mitsuba scene, and what all of them share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_set>
#include <vector>

#include <pugixml.hpp>

#include "core/io/mitsuba/xml_file.h"

namespace pl {

struct MitsubaShared {
    std::filesystem::path folder;  ///< of the scene
    std::vector<std::filesystem::path>
        others;  ///< those of `path` elements, which are searched first, the last one first of all
    std::map<std::string, std::string> parameters;
    std::map<std::string, MitsubaObject> ids;
    std::map<std::string, std::string> aliases;  ///< other names of ids
    SceneNotes notes;
    std::unordered_set<const void*> read{};      ///< objects whose properties were asked for
    std::unordered_set<const void*> used{};      ///< properties, and objects inside of others, that were found
    std::unordered_set<const void*> left_out{};  ///< objects of which a note tells
};

struct MitsubaText {
    std::filesystem::path path;
    std::string text;
    pugi::xml_document document{};
    MitsubaShared* shared = nullptr;

    int line_of(std::ptrdiff_t offset) const {
        const auto end = std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(text.size()));
        return 1 + static_cast<int>(std::count(text.begin(), text.begin() + end, '\n'));
    }

    /// Calls `visit` for every element, however deep, with those outside of others first.
    template <class Visit>
    void for_each_object(const Visit& visit) const {
        struct Walker : pugi::xml_tree_walker {
            Walker(const MitsubaText& from, const Visit& call) : text(from), visit(call) {}
            bool for_each(pugi::xml_node& node) override {
                if (node.type() == pugi::node_element) visit(MitsubaObject(node, text));
                return true;
            }
            const MitsubaText& text;
            const Visit& visit;
        };
        Walker walker(*this, visit);
        pugi::xml_node root = document.child("scene");
        root.traverse(walker);
    }
};

}  // namespace pl
