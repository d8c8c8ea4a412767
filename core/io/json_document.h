// A JSON text with error messages that name file and line, which the JSON library does not keep.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "core/base/choice.h"
#include "core/io/json_file.h"

namespace pl {

/// A JSON object and the lines of its keys.
class JsonDocument {
public:
    /// Throws Error(Input) with file and line: not JSON, a duplicate key, not an object at the top level.
    JsonDocument(std::string_view text, std::filesystem::path path);

    const Json& root() const { return root_; }

    /// Throws Error(Input) at the line of the member `pointer` (a JSON pointer such as "/camera/eye").
    [[noreturn]] void fail(const std::string& pointer, const std::string& what) const;

    /// The object at `pointer`, null if there is none. Throws Error(Input) if it is not an object or has an unknown
    /// key; the message names the nearest known one.
    const Json* object(const std::string& pointer, const std::vector<std::string>& known_keys) const;

    bool has(const std::string& pointer) const { return find(pointer) != nullptr; }

    // The value at `pointer`, nothing if there is none. They throw Error(Input) for another type or a non-finite
    // number.
    std::optional<std::string> text(const std::string& pointer) const;
    std::optional<bool> boolean(const std::string& pointer) const;
    std::optional<float> number(const std::string& pointer) const;
    std::optional<std::int64_t> integer(const std::string& pointer) const;
    /// An array of so many finite numbers.
    std::optional<std::vector<double>> numbers(const std::string& pointer, std::size_t length) const;
    std::optional<glm::vec3> vector(const std::string& pointer) const;
    /// A vector from the point of count_from().
    std::optional<glm::vec3> point(const std::string& pointer) const;
    /// [low, high] with low < high.
    std::optional<glm::vec2> range(const std::string& pointer) const;
    std::optional<std::vector<std::string>> texts(const std::string& pointer) const;
    /// A value of an enumeration that describes itself, by its name.
    template <Described Enum>
    std::optional<Enum> choice(const std::string& pointer) const {
        const std::optional<std::string> name = text(pointer);
        if (!name) return std::nullopt;
        const std::optional<Enum> value = choice_named<Enum>(*name);
        if (!value) fail_choice(pointer, choice_names<Enum>(), *name);
        return value;
    }
    /// Number of elements of the array at `pointer`, 0 if there is none.
    std::size_t array_size(const std::string& pointer) const;

    /// Throws Error(Input) unless the member "schema" is this one.
    void require_schema(const char* schema) const;

    /// For point(): of a scene that was moved.
    void count_from(const glm::dvec3& origin) { origin_ = origin; }

private:
    const Json* find(const std::string& pointer) const;
    template <class Value, class Read>
    std::optional<Value> value_at(const std::string& pointer, std::string_view expected, Read&& read) const;
    [[noreturn]] void fail_choice(const std::string& pointer, const std::vector<std::string>& names,
                                  const std::string& got) const;

    std::filesystem::path path_;
    std::map<std::string, int> lines_;
    Json root_;
    glm::dvec3 origin_{0.0};
};

/// A key, escaped as one step of a JSON pointer.
std::string pointer_step(const std::string& key);

}  // namespace pl
