#include "core/io/json_document.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/io/json_file.h"
#include "core/io/line_reader.h"
#include "core/io/nearest_name.h"

namespace pl {

namespace {

constexpr std::size_t kDeepest = 64;  // every level stores its pointer: memory is quadratic in the depth

/// Input iterator that counts the characters read.
class CountingIterator {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    CountingIterator(const char* at, const char** reached) : at_(at), reached_(reached) {}
    reference operator*() const { return *at_; }
    CountingIterator& operator++() {
        *reached_ = ++at_;
        return *this;
    }
    CountingIterator operator++(int) {
        CountingIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
    bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

private:
    const char* at_;
    const char** reached_;
};

/// SAX handler that records the line of every key.
class LineFinder : public nlohmann::json_sax<Json> {
public:
    LineFinder(std::string_view text, const std::filesystem::path& path, std::map<std::string, int>& lines)
        : path_(path), lines_(lines), counted_(text.data()), reached_(text.data()) {}

    const char** reached() { return &reached_; }

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t&) override { return value(); }
    bool string(string_t&) override { return value(); }
    bool binary(binary_t&) override { return value(); }
    bool start_object(std::size_t) override { return open(false); }
    bool start_array(std::size_t) override { return open(true); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        Level& level = levels_.back();
        level.pointer = level.base + pointer_step(name);
        // The parser has read the key up to its closing quote and nothing after it.
        if (!lines_.try_emplace(level.pointer, current_line()).second) {
            fail_at(path_, current_line(), fmt::format("key {} is given twice", in_quotes(name)));
        }
        return true;
    }

    bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
        // "[json.exception.NAME] parse error at line 1, column 2: what": the place is removed, fail_at() adds it.
        std::string_view message = error.what();
        for (const char* lead : {"] ", "column ", ": "}) {
            const std::size_t at = message.find(lead);
            message.remove_prefix(at == std::string_view::npos ? 0 : at + std::string_view(lead).size());
        }
        fail_at(path_, current_line(), "not valid JSON: " + std::string(message));
    }

private:
    /// An open object or array: its pointer, and the pointer of its current member.
    struct Level {
        std::string base;
        std::string pointer;
        bool is_array;
        std::size_t next_index;
    };

    bool open(bool is_array) {
        enter_element();
        if (levels_.size() >= kDeepest) {
            fail_at(path_, current_line(), fmt::format("nested deeper than {} levels", kDeepest));
        }
        levels_.push_back({levels_.empty() ? "" : levels_.back().pointer, "", is_array, 0});
        return true;
    }

    bool value() {
        enter_element();
        return true;
    }

    bool close() {
        levels_.pop_back();
        return true;
    }

    void enter_element() {
        if (!levels_.empty() && levels_.back().is_array) {
            Level& level = levels_.back();
            level.pointer = level.base + "/" + std::to_string(level.next_index++);
        }
    }

    int current_line() {
        line_ += static_cast<int>(std::count(counted_, reached_, '\n'));
        counted_ = reached_;
        return line_;
    }

    const std::filesystem::path& path_;
    std::map<std::string, int>& lines_;
    std::vector<Level> levels_;
    const char* counted_;
    const char* reached_;
    int line_ = 1;
};

bool fits_float(const Json& value) {
    return value.is_number() &&
           std::abs(value.get<double>()) <= static_cast<double>(std::numeric_limits<float>::max());
}

/// A vector from an array of as many finite numbers; nothing from any other value.
template <typename Vector>
std::optional<Vector> read_floats(const Json& value) {
    constexpr auto kLength = static_cast<std::size_t>(Vector::length());
    if (!value.is_array() || value.size() != kLength || !std::all_of(value.begin(), value.end(), fits_float)) {
        return std::nullopt;
    }
    Vector result(0.0f);
    for (std::size_t i = 0; i < kLength; ++i) {
        result[static_cast<int>(i)] = value[i].get<float>();
    }
    return result;
}

}  // namespace

std::string pointer_step(const std::string& key) {
    std::string step = "/";
    for (const char c : key) {
        step += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
    }
    return step;
}

JsonDocument::JsonDocument(std::string_view text, std::filesystem::path path) : path_(std::move(path)) {
    LineFinder finder(text, path_, lines_);
    const char* const end = text.data() + text.size();
    Json::sax_parse(CountingIterator(text.data(), finder.reached()), CountingIterator(end, finder.reached()),
                    &finder);
    root_ = parse_json(text);
    if (!root_.is_object()) {
        fail_at(path_, 1, "expected an object { ... }");
    }
}

void JsonDocument::fail(const std::string& pointer, const std::string& what) const {
    const auto line = lines_.find(pointer);
    fail_at(path_, line == lines_.end() ? 1 : line->second,
            pointer.empty() ? what : "'" + pointer.substr(1) + "': " + what);
}

const Json* JsonDocument::find(const std::string& pointer) const {
    const Json::json_pointer where(pointer);
    return root_.contains(where) ? &root_.at(where) : nullptr;
}

const Json* JsonDocument::object(const std::string& pointer, const std::vector<std::string>& known_keys) const {
    const Json* const value = find(pointer);
    if (value == nullptr) {
        return nullptr;
    }
    if (!value->is_object()) {
        fail(pointer, "expected an object { ... }");
    }
    for (const auto& [key, member] : value->items()) {
        if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end()) {
            fail(pointer + pointer_step(key), "unknown key" + known_names(key, known_keys));
        }
    }
    return value;
}

/// What `read` makes of the value at `pointer`, nothing if there is no value. Fails with the expected kind of value where it makes nothing.
template <class Value, class Read>
std::optional<Value> JsonDocument::value_at(const std::string& pointer, std::string_view expected,
                                            Read&& read) const {
    const Json* const value = find(pointer);
    if (value == nullptr) return std::nullopt;
    std::optional<Value> result = read(*value);
    if (!result) fail(pointer, fmt::format("expected {}, got {}", expected, in_quotes(value->dump())));
    return result;
}

std::optional<std::string> JsonDocument::text(const std::string& pointer) const {
    return value_at<std::string>(pointer, "a text in quotes", [](const Json& value) {
        return value.is_string() ? std::optional(value.get<std::string>()) : std::nullopt;
    });
}

std::optional<bool> JsonDocument::boolean(const std::string& pointer) const {
    return value_at<bool>(pointer, "true or false", [](const Json& value) {
        return value.is_boolean() ? std::optional(value.get<bool>()) : std::nullopt;
    });
}

std::optional<float> JsonDocument::number(const std::string& pointer) const {
    return value_at<float>(pointer, "a number that fits in a float", [](const Json& value) {
        return fits_float(value) ? std::optional(value.get<float>()) : std::nullopt;
    });
}

std::optional<std::int64_t> JsonDocument::integer(const std::string& pointer) const {
    constexpr double kLargest = 9007199254740992.0;  // from here on doubles skip whole numbers
    return value_at<std::int64_t>(pointer, "a whole number", [](const Json& value) -> std::optional<std::int64_t> {
        const double number = value.is_number() ? value.get<double>() : kLargest;
        if (!(std::abs(number) < kLargest) || std::trunc(number) != number) return std::nullopt;
        return static_cast<std::int64_t>(number);
    });
}

std::optional<std::vector<double>> JsonDocument::numbers(const std::string& pointer, std::size_t length) const {
    using Numbers = std::vector<double>;
    return value_at<Numbers>(pointer, fmt::format("an array of {} numbers", length), [&](const Json& value) {
        const bool fits = value.is_array() && value.size() == length && std::ranges::all_of(value, fits_float);
        return fits ? std::optional(value.get<Numbers>()) : std::nullopt;
    });
}

std::optional<glm::vec3> JsonDocument::vector(const std::string& pointer) const {
    return value_at<glm::vec3>(pointer, "three numbers [x, y, z]", read_floats<glm::vec3>);
}

std::optional<glm::vec3> JsonDocument::point(const std::string& pointer) const {
    const std::optional<glm::vec3> rounded = vector(pointer);
    if (!rounded || origin_ == glm::dvec3(0.0)) {
        return rounded;
    }
    const std::vector<double> exact = *numbers(pointer, 3);
    return glm::vec3(glm::dvec3(exact[0], exact[1], exact[2]) - origin_);
}

std::optional<glm::vec2> JsonDocument::range(const std::string& pointer) const {
    return value_at<glm::vec2>(pointer, "two numbers [low, high], low below high", [](const Json& value) {
        const auto range = read_floats<glm::vec2>(value);
        return range && range->x < range->y ? range : std::nullopt;
    });
}

std::optional<std::vector<std::string>> JsonDocument::texts(const std::string& pointer) const {
    using Texts = std::vector<std::string>;
    return value_at<Texts>(pointer, "texts in quotes [\"a\", ...]", [](const Json& value) {
        const bool fits = value.is_array() && !value.empty() &&
                          std::ranges::all_of(value, [](const Json& item) { return item.is_string(); });
        return fits ? std::optional(value.get<Texts>()) : std::nullopt;
    });
}

std::size_t JsonDocument::array_size(const std::string& pointer) const {
    const auto size = value_at<std::size_t>(pointer, "an array [ ... ]", [](const Json& value) {
        return value.is_array() ? std::optional(value.size()) : std::nullopt;
    });
    return size.value_or(0);
}

void JsonDocument::fail_choice(const std::string& pointer, const std::vector<std::string>& names,
                               const std::string& got) const {
    fail(pointer, fmt::format("expected one of {}, got '{}'", fmt::join(names, ", "), got));
}

void JsonDocument::require_schema(const char* schema) const {
    const std::optional<std::string> found = text("/schema");
    if (found != schema)
        fail("/schema", fmt::format("expected \"{}\", got {}", schema, found ? "\"" + *found + "\"" : "none"));
}

}  // namespace pl
