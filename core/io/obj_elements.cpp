#include "core/io/obj_elements.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/triangulate.h"

namespace pl {

namespace {

constexpr std::array<std::size_t, kObjLists> kLeastNumbers = {3, 3, 1};
constexpr std::array<std::size_t, kObjLists> kMostNumbers = {3, 3, 2};  ///< that are read if they are there

std::optional<double> usable_number(std::string_view word) {
    const std::optional<double> value = parse_number(word);
    return value && std::abs(*value) <= kLargestCoordinate ? value : std::nullopt;
}

/// Reads a number as most programs write it, in up to 15 digits with a point; returns its end, or null for any other. Digits and
/// power of ten are exact doubles, so that the quotient is rounded correctly. [Clinger 1990]
const char* read_usual_number(const char* at, const char* end, double& value) {
    constexpr std::array<double, 16> kPowers = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    const bool is_negative = at != end && *at == '-';
    at += is_negative ? 1 : 0;
    const char* const most = end - at > 16 ? at + 16 : end;
    const char* point = nullptr;
    std::int64_t digits = 0;
    std::size_t count = 0;
    for (; at != most; ++at) {
        if (*at >= '0' && *at <= '9') {
            digits = 10 * digits + (*at - '0');
            ++count;
        } else if (*at == '.' && point == nullptr) {
            point = at;
        } else {
            break;
        }
    }
    if (count == 0 || count == 16 || (at != end && !is_blank(*at))) {
        return nullptr;
    }
    const double positive =
        static_cast<double>(digits) / kPowers[point != nullptr ? static_cast<std::size_t>(at - point - 1) : 0];
    value = is_negative ? -positive : positive;
    return at;
}

/// Removes the first word of a text, with the blanks around it, and returns whether it is a number.
bool take_number(std::string_view& text, double& value) {
    const char* const end = text.data() + text.size();
    if (const char* at = read_usual_number(text.data(), end, value); at != nullptr) {
        while (at != end && is_blank(*at)) ++at;
        text.remove_prefix(static_cast<std::size_t>(at - text.data()));
        return true;
    }
    const std::optional<double> number = usable_number(take_word(text));
    value = number.value_or(0.0);
    return number.has_value();
}

/// Why words are no element of a list, or an empty text.
std::string fault_of(const std::vector<std::string_view>& words, std::size_t list, std::string_view keyword) {
    if (words.size() < kLeastNumbers[list]) {
        return fmt::format("'{}': expected {} numbers, got {}", keyword, kLeastNumbers[list], words.size());
    }
    for (std::size_t i = 0; i < std::min(words.size(), kMostNumbers[list]); ++i) {
        if (!usable_number(words[i])) {
            return fmt::format("'{}': expected finite numbers up to 1e18, got {}", keyword, in_quotes(words[i]));
        }
    }
    return {};
}

class ElementReader {
public:
    explicit ElementReader(const glm::dvec3& origin) : origin_(origin) {}

    ObjElements run(std::string_view text) {
        LineReader reader(text);
        while (reader.next()) {
            const ObjList list = obj_list_of(reader.keyword());
            if (list != kObjLists) {
                element(list, reader);
            } else {
                ++result_.counts.others;
                result_.counts.faces += reader.keyword() == "f" ? 1 : 0;
            }
        }
        result_.counts.lines = static_cast<std::size_t>(reader.lines());
        return std::move(result_);
    }

private:
    void element(ObjList list, const LineReader& reader) {
        glm::dvec3 values(0.0);
        std::string_view rest = reader.arguments();
        glm::length_t count = 0;
        while (count < static_cast<glm::length_t>(kMostNumbers[list]) && take_number(rest, values[count])) {
            ++count;
        }
        const bool is_usual = static_cast<std::size_t>(count) == kMostNumbers[list];
        if ((!is_usual || (list == kObjVertices && !rest.empty())) && !check(list, reader)) {
            values = {};
        } else if (list == kObjVertices) {
            values -= origin_;
        }
        ++result_.counts.elements[list];
        if (list == kObjUvs) {
            result_.uvs.emplace_back(values);
        } else {
            (list == kObjVertices ? result_.positions : result_.normals).emplace_back(values);
        }
    }

    /// Tells what is odd about an element; false if it has no usable numbers.
    bool check(ObjList list, const LineReader& reader) {
        const std::vector<std::string_view> words = split_words(reader.arguments());
        if (list == kObjVertices && words.size() > 3) {
            (words.size() == 4 ? result_.weights : result_.colors).add(reader.line());
        }
        const std::string fault = fault_of(words, list, reader.keyword());
        if (!fault.empty()) {
            result_.unusable[list].push_back(result_.counts.elements[list]);
            result_.malformed[list].add(reader.line(), [&] { return fault; });
        }
        return fault.empty();
    }

    const glm::dvec3& origin_;
    ObjElements result_;
};

template <class T>
void append_all(std::vector<T>& to, std::vector<T>&& later) {
    to.insert(to.end(), later.begin(), later.end());
    later = {};
}

}  // namespace

bool ObjElements::is_usable(std::size_t list, std::size_t index) const {
    return !std::binary_search(unusable[list].begin(), unusable[list].end(), index);
}

void ObjElements::append(ObjElements&& later) {
    const auto lines = static_cast<int>(counts.lines);
    for (std::size_t list = 0; list < kObjLists; ++list) {
        for (const std::size_t index : later.unusable[list]) unusable[list].push_back(counts.elements[list] + index);
        malformed[list].add(later.malformed[list], lines);
        counts.elements[list] += later.counts.elements[list];
    }
    colors.add(later.colors, lines);
    weights.add(later.weights, lines);
    counts.others += later.counts.others;
    counts.faces += later.counts.faces;
    counts.lines += later.counts.lines;
    append_all(positions, std::move(later.positions));
    append_all(normals, std::move(later.normals));
    append_all(uvs, std::move(later.uvs));
}

ObjElements read_obj_elements(std::string_view text, const glm::dvec3& origin) {
    return ElementReader(origin).run(text);
}

}  // namespace pl
