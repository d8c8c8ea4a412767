// A Mitsuba scene file as a tree of objects, with its parameters replaced and its includes in place.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <pugixml.hpp>

#include "core/io/scene_notes.h"

namespace pl {

struct MitsubaText;

/// One element, `<bsdf type="diffuse">` or `<float name="fov">`. Names of elements, types and properties are compared in the
/// spelling of Mitsuba 3: `toWorld` of 0.x is `to_world`. Missing properties are nothing; malformed ones throw Error(Input) with file
/// and line.
class MitsubaObject {
public:
    MitsubaObject() = default;
    MitsubaObject(pugi::xml_node node, const MitsubaText& text) : node_(node), text_(&text) {}

    explicit operator bool() const { return !node_.empty(); }
    std::string element() const { return node_.name(); }
    /// An attribute with its parameters replaced; empty if there is none.
    std::string attribute(const char* name) const;
    std::string type() const { return attribute("type"); }
    std::string name() const;

    std::vector<MitsubaObject> children() const;
    /// The first child of one of these names of properties, whatever its element.
    MitsubaObject property(const std::string& name) const;
    /// The first child element of this kind.
    MitsubaObject child(const std::string& element) const;

    std::optional<float> number(const std::string& name) const;
    std::optional<bool> boolean(const std::string& name) const;
    std::optional<std::string> text(const std::string& name) const;
    std::optional<glm::vec3> color(const std::string& name) const;
    std::optional<glm::vec3> point(const std::string& name) const;
    /// A path inside of the folder of the scene.
    std::filesystem::path file(const std::string& name) const;
    glm::dmat4 transform(const std::string& name) const;

    /// Color of an element `rgb`, `spectrum` or `float` itself.
    glm::vec3 own_color() const;

    /// Whether the file says that it is of Mitsuba 0.x.
    bool is_of_version_0() const;

    std::string place() const;
    /// The same for the same element of a file alone: several may begin in one line.
    const void* identity() const { return node_.internal_object(); }
    [[noreturn]] void fail(const std::string& what) const;
    void note(const std::string& kind) const;

private:
    std::vector<double> numbers(const std::string& words) const;
    double number_or(const char* attribute, double standard) const;
    glm::dmat4 step() const;

    pugi::xml_node node_;
    const MitsubaText* text_ = nullptr;
};

/// The objects of a scene in the order of the file, those of included files in the place of their `include`.
class MitsubaFile {
public:
    /// Throws Error(Input): no XML, no `scene`, includes that are outside of the folder, in a circle or more than kMostIncludes.
    explicit MitsubaFile(const std::filesystem::path& path);
    ~MitsubaFile();
    MitsubaFile(const MitsubaFile&) = delete;
    MitsubaFile& operator=(const MitsubaFile&) = delete;

    static constexpr int kMostIncludes = 64;

    const std::vector<MitsubaObject>& objects() const { return objects_; }
    /// The object with this id; empty if there is none.
    MitsubaObject by_id(const std::string& id) const;
    SceneNotes& notes() { return notes_; }
    const std::vector<std::filesystem::path>& files() const { return files_; }

private:
    void read(const std::filesystem::path& path, int depth);
    void take(const MitsubaText& text, int depth);

    std::filesystem::path folder_;
    std::map<std::string, std::string> parameters_;
    std::map<std::string, MitsubaObject> ids_;
    std::vector<std::unique_ptr<MitsubaText>> texts_;
    std::vector<MitsubaObject> objects_;
    std::vector<std::filesystem::path> files_;
    SceneNotes notes_;
};

/// "toWorld" and "to_world" as "to_world", "intIOR" as "int_ior".
std::string mitsuba_name(const std::string& name);

}  // namespace pl
