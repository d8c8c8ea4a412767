#include <cctype>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/io/line_reader.h"
#include "core/io/mitsuba/xml_file.h"
#include "core/io/texture_file.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

/// Replaces $name by its value, the longest name that fits first.
std::string replaced_parameters(std::string text, const std::map<std::string, std::string>& parameters) {
    constexpr std::size_t kLongest = 65536;
    for (auto parameter = parameters.rbegin(); parameter != parameters.rend(); ++parameter) {
        const std::string mark = "$" + parameter->first;
        if (parameter->first.empty()) continue;
        for (std::size_t at = text.find(mark); at != std::string::npos && text.size() < kLongest;
             at = text.find(mark, at + parameter->second.size()))
            text.replace(at, mark.size(), parameter->second);
    }
    return text;
}

}  // namespace

std::vector<std::string_view> mitsuba_words(std::string_view text) {
    std::vector<std::string_view> words;
    constexpr std::string_view kBetween = " ,\t\r\n";
    for (std::size_t at = text.find_first_not_of(kBetween); at != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = text.find_first_not_of(kBetween, end);
    }
    return words;
}

std::string mitsuba_name(const std::string& name) {
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const auto code = static_cast<unsigned char>(name[i]);
        const bool starts =
            std::isupper(code) != 0 && i > 0 && std::isupper(static_cast<unsigned char>(name[i - 1])) == 0;
        if (starts && result.back() != '_') result += '_';
        result += static_cast<char>(std::tolower(code));
    }
    return result;
}

std::string MitsubaObject::attribute(const char* name) const {
    return text_ == nullptr ? "" : replaced_parameters(node_.attribute(name).value(), text_->shared->parameters);
}

std::string MitsubaObject::name() const { return mitsuba_name(attribute("name")); }

std::vector<MitsubaObject> MitsubaObject::children() const {
    std::vector<MitsubaObject> all;
    for (const pugi::xml_node& node : node_.children())
        if (node.type() == pugi::node_element) all.emplace_back(node, *text_);
    return all;
}

std::string MitsubaObject::element() const {
    const std::string name = node_.name();
    return name == "light" ? "emitter" : name == "camera" ? "sensor" : name;
}

MitsubaObject MitsubaObject::target() const {
    if (element() != "ref") return *this;
    std::string id = attribute("id");
    const auto alias = text_->shared->aliases.find(id);
    if (alias != text_->shared->aliases.end()) id = alias->second;
    const auto known = text_->shared->ids.find(id);
    if (known == text_->shared->ids.end())
        fail(fmt::format("'ref': expected the id of an object, got {}", in_quotes(attribute("id"))));
    return known->second;
}

MitsubaObject MitsubaObject::property(const std::string& name) const {
    if (text_ != nullptr) text_->shared->read.insert(identity());
    for (const MitsubaObject& object : children()) {
        if (object.name() != name) continue;
        text_->shared->used.insert(object.identity());
        return object.target();
    }
    return {};
}

std::vector<MitsubaObject> MitsubaObject::parts(const std::string& element) const {
    std::vector<MitsubaObject> all;
    if (text_ != nullptr) text_->shared->read.insert(identity());
    for (const MitsubaObject& object : children()) {
        const MitsubaObject target = object.target();
        if (target.element() != element) continue;
        text_->shared->used.insert(object.identity());
        all.push_back(target);
    }
    return all;
}

MitsubaObject MitsubaObject::part(const std::string& element) const {
    if (text_ != nullptr) text_->shared->read.insert(identity());
    for (const MitsubaObject& object : children()) {
        const MitsubaObject target = object.target();
        if (target.element() != element) continue;
        text_->shared->used.insert(object.identity());
        return target;
    }
    return {};
}

bool MitsubaObject::is_of_version_0() const {
    return std::string_view(node_.root().child("scene").attribute("version").value()).starts_with("0.");
}

std::string MitsubaObject::place() const {
    return text_ == nullptr ? "" : pl::place(text_->path, text_->line_of(node_.offset_debug()));
}

void MitsubaObject::fail(const std::string& what) const { throw Error(ErrorKind::Input, place() + ": " + what); }

void MitsubaObject::note(const std::string& kind) const { text_->shared->notes.add(kind, place()); }

void MitsubaObject::leave_out(const std::string& kind) const {
    note(kind);
    text_->shared->left_out.insert(identity());
}

std::vector<double> MitsubaObject::numbers(const std::string& words) const {
    std::vector<double> values;
    for (const std::string_view word : mitsuba_words(words)) {
        const std::optional<double> value = parse_number(word);
        if (!value) fail(fmt::format("'{}': expected finite numbers, got {}", attribute("name"), in_quotes(word)));
        values.push_back(*value);
    }
    return values;
}

double MitsubaObject::number_or(const char* attribute_name, double standard) const {
    const std::vector<double> values = numbers(attribute(attribute_name));
    return values.empty() ? standard : values[0];
}

std::optional<float> MitsubaObject::number(const std::string& name) const {
    const MitsubaObject object = property(name);
    if (!object) return std::nullopt;
    if (object.attribute("value").empty()) {
        object.leave_out(
            fmt::format("{} of {} {} is no number, and is not used", in_quotes(name), element(), in_quotes(type())));
        return std::nullopt;
    }
    const std::vector<double> values = object.numbers(object.attribute("value"));
    if (values.size() != 1)
        object.fail(fmt::format("'{}': expected a number, got {}", name, in_quotes(object.attribute("value"))));
    return static_cast<float>(values[0]);
}

std::optional<bool> MitsubaObject::boolean(const std::string& name) const {
    const std::optional<std::string> value = text(name);
    if (value && *value != "true" && *value != "false")
        property(name).fail(fmt::format("'{}': expected true or false, got {}", name, in_quotes(*value)));
    return value ? std::optional(*value == "true") : std::nullopt;
}

std::optional<std::string> MitsubaObject::text(const std::string& name) const {
    const MitsubaObject object = property(name);
    return object ? std::optional(object.attribute("value")) : std::nullopt;
}

std::optional<glm::dvec3> MitsubaObject::point(const std::string& name) const {
    const MitsubaObject object = property(name);
    if (!object) return std::nullopt;
    if (const std::vector<double> values = object.numbers(object.attribute("value")); values.size() == 3)
        return glm::dvec3(values[0], values[1], values[2]);
    return glm::dvec3(object.number_or("x", 0.0), object.number_or("y", 0.0), object.number_or("z", 0.0));
}

fs::path MitsubaObject::file(const std::string& name) const { return file_named(name, text(name).value_or("")); }

fs::path MitsubaObject::file_named(const std::string& name, const std::string& value) const {
    const MitsubaShared& shared = *text_->shared;
    for (auto folder = shared.others.rbegin(); folder != shared.others.rend(); ++folder) {
        const fs::path path = path_inside(*folder, value);
        std::error_code ignored;
        if (!path.empty() && fs::exists(path, ignored)) return path;
    }
    const fs::path path = path_inside(shared.folder, value);
    if (path.empty())
        fail(fmt::format("'{}': expected a file in the folder of the scene, got {}", name, in_quotes(value)));
    return path;
}

glm::dmat4 MitsubaObject::transform(const std::string& name) const {
    MitsubaObject given = property(name);
    if (given.element() == "animation") {
        given.note("motion is left out: shown as at its first time");
        given = given.part("transform");
    }
    glm::dmat4 matrix(1.0);
    for (const MitsubaObject& part : given.children()) matrix = part.step() * matrix;
    return matrix;
}

glm::dmat4 MitsubaObject::step() const {
    const std::string kind = mitsuba_name(element());
    const std::vector<double> values = numbers(attribute("value"));
    const auto vector = [&](const char* name, double standard) {
        const std::vector<double> given = numbers(attribute(name));
        return given.size() == 3 ? glm::dvec3(given[0], given[1], given[2]) : glm::dvec3(standard);
    };
    const glm::dvec3 xyz(number_or("x", 0.0), number_or("y", 0.0), number_or("z", 0.0));
    if (kind == "translate") return glm::translate(glm::dmat4(1.0), values.size() == 3 ? vector("value", 0.0) : xyz);
    if (kind == "scale") {
        const glm::dvec3 each(number_or("x", 1.0), number_or("y", 1.0), number_or("z", 1.0));
        return glm::scale(glm::dmat4(1.0), values.size() == 1   ? glm::dvec3(values[0])
                                           : values.size() == 3 ? vector("value", 1.0)
                                                                : each);
    }
    if (kind == "rotate" && glm::length(values.size() == 3 ? vector("value", 0.0) : xyz) > 0.0) {
        return glm::rotate(glm::dmat4(1.0), glm::radians(number_or("angle", 0.0)),
                           values.size() == 3 ? vector("value", 0.0) : xyz);
    }
    if (kind == "matrix" && (values.size() == 16 || values.size() == 9)) {
        const int side = values.size() == 16 ? 4 : 3;
        glm::dmat4 matrix(1.0);
        for (int i = 0; i < side * side; ++i) matrix[i % side][i / side] = values[static_cast<std::size_t>(i)];
        return matrix;
    }
    if (kind == "lookat" || kind == "look_at") {
        const glm::dvec3 origin = vector("origin", 0.0);
        const glm::dvec3 forward = glm::normalize(vector("target", 0.0) - origin);
        const glm::dvec3 left = glm::normalize(glm::cross(vector("up", 0.0), forward));
        return glm::dmat4(glm::dvec4(left, 0.0), glm::dvec4(glm::cross(forward, left), 0.0), glm::dvec4(forward, 0.0),
                          glm::dvec4(origin, 1.0));
    }
    fail(fmt::format("expected translate, scale, rotate, matrix or lookat with its numbers, got {}",
                     in_quotes(element())));
}

}  // namespace pl
