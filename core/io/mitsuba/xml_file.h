// A Mitsuba scene file as a tree of objects, with its parameters replaced and its includes in place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include <glm/glm.hpp>
#include <pugixml.hpp>

#include "core/io/load_settings.h"
#include "core/io/mitsuba/spectra.h"

namespace pl {

struct MitsubaText;
struct MitsubaShared;

/// One element, `<bsdf type="diffuse">` or `<float name="fov">`. Names of elements, types and properties are compared in the
/// spelling of Mitsuba 3: `toWorld` of 0.x is `to_world`, `light` is `emitter`. Missing properties are nothing; malformed ones throw
/// Error(Input) with file and line. A `ref` stands for the object that it names. MitsubaFile::note_unused() tells of properties that
/// nobody asked for.
class MitsubaObject {
public:
    MitsubaObject() = default;
    MitsubaObject(pugi::xml_node node, const MitsubaText& text) : node_(node), text_(&text) {}

    explicit operator bool() const { return !node_.empty(); }
    std::string element() const;
    /// An attribute with its parameters replaced; empty if there is none.
    std::string attribute(const char* name) const;
    std::string type() const { return attribute("type"); }
    std::string name() const;

    std::vector<MitsubaObject> children() const;
    /// The object that this one stands for: the one with its id if it is a `ref`. Throws Error(Input) if there is none.
    MitsubaObject target() const;
    /// What the first child with this name stands for, whatever its element.
    MitsubaObject property(const std::string& name) const;
    /// All objects of a kind of element that are inside, in their order.
    std::vector<MitsubaObject> parts(const std::string& element) const;
    /// The first of them, or nothing.
    MitsubaObject part(const std::string& element) const;

    std::optional<float> number(const std::string& name) const;
    std::optional<bool> boolean(const std::string& name) const;
    std::optional<std::string> text(const std::string& name) const;
    std::optional<glm::vec3> color(const std::string& name) const;
    std::optional<glm::dvec3> point(const std::string& name) const;
    /// A path inside of the folder of the scene, or of one that its `path` elements name.
    std::filesystem::path file(const std::string& name) const;
    glm::dmat4 transform(const std::string& name) const;

    /// Whether the file says that it is of Mitsuba 0.x.
    bool is_of_version_0() const;

    std::string place() const;
    /// The same for the same element of a file alone: several may begin in one line.
    const void* identity() const { return node_.internal_object(); }
    [[noreturn]] void fail(const std::string& what) const;
    void note(const std::string& kind) const;
    /// A note about an object as a whole: nothing else is told of it.
    void leave_out(const std::string& kind) const;

private:
    friend class MitsubaFile;

    std::vector<double> numbers(const std::string& words) const;
    double number_or(const char* attribute, double standard) const;
    std::filesystem::path file_named(const std::string& name, const std::string& value) const;
    glm::dmat4 step() const;
    bool is_color() const;
    glm::vec3 own_color() const;
    glm::vec3 color_of_type(const std::string& type) const;
    glm::vec3 color_of_words(const std::string& words) const;
    glm::vec3 color_of_pairs(const std::string& words) const;
    glm::vec3 spectrum_color(const WavelengthSpectrum& spectrum) const;
    bool shines() const;
    void note_unused() const;

    pugi::xml_node node_;
    const MitsubaText* text_ = nullptr;
};

/// The objects of a scene in the order of the file, the objects of included files in the place of their `include`.
class MitsubaFile {
public:
    using Parameters = std::vector<std::pair<std::string, std::string>>;

    /// `given`: values of $parameters, before the values of `default` elements. Throws Error(Input): no XML, no
    /// `scene`, includes that are outside of the folder, in a circle or more than kMostIncludes; Error(Usage) for a
    /// given parameter that no file mentions.
    explicit MitsubaFile(const std::filesystem::path& path, const Parameters& given = {});
    ~MitsubaFile();
    MitsubaFile(const MitsubaFile&) = delete;
    MitsubaFile& operator=(const MitsubaFile&) = delete;

    static constexpr int kMostIncludes = 64;

    const std::vector<MitsubaObject>& objects() const { return objects_; }
    SceneNotes& notes();
    /// Notes what is inside of objects that were read, but was not asked for. To be called after all else.
    void note_unused();
    const std::vector<std::filesystem::path>& files() const { return files_; }

private:
    void read(const std::filesystem::path& path, int depth);
    void take(const MitsubaText& text, int depth);
    void take(const MitsubaObject& object, int depth);
    void add_folder(const MitsubaObject& path);
    std::vector<std::string> parameter_names() const;

    std::unique_ptr<MitsubaShared> shared_;
    std::vector<std::unique_ptr<MitsubaText>> texts_;
    std::vector<MitsubaObject> objects_;
    std::vector<std::filesystem::path> files_;
};

/// Words between blanks and commas.
std::vector<std::string_view> mitsuba_words(std::string_view text);

/// "toWorld" and "to_world" as "to_world", "intIOR" as "int_ior".
std::string mitsuba_name(const std::string& name);

// Files of a Mitsuba scene, and what all of them share.

struct MitsubaShared {
    std::filesystem::path folder;  ///< of the scene
    std::vector<std::filesystem::path>
        others;  ///< of `path` elements, which are searched first, the last one first of all
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

    /// Calls `visit` for every element, however deep, outer elements first.
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
