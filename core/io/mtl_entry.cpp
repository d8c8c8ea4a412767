#include "core/io/mtl_entry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "core/io/line_reader.h"
#include "core/io/obj_names.h"
#include "core/scene/description.h"

namespace pl {

namespace {

using Words = std::vector<std::string_view>;

/// Smallest and largest number of arguments of an option; those after the first are numbers.
std::array<std::size_t, 2> words_of_option(std::string_view option) {
    if (option == "-s" || option == "-o" || option == "-t") {
        return {1, 3};
    }
    const std::size_t count = option == "-mm" ? 2 : 1;
    return {count, count};
}

bool are_numbers(const Words& words, std::initializer_list<double> wanted) {
    return std::equal(words.begin(), words.end(), wanted.begin(), wanted.end(),
                      [](std::string_view word, double number) { return parse_number(word) == number; });
}

/// The factor or distance of u and v. Missing numbers stay; the third number, for the depth, changes no image.
bool read_pair(const Words& values, bool is_factor, glm::vec2& to) {
    constexpr double kMost = 1e6;
    glm::vec2 read = to;
    for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 2); ++i) {
        const std::optional<double> value = parse_number(values[i]);
        if (!value || std::abs(*value) > kMost || (is_factor && *value == 0.0)) {
            return false;
        }
        read[static_cast<int>(i)] = static_cast<float>(*value);
    }
    to = read;
    return !values.empty();
}

/// False if the option would change the picture and does not.
bool read_option(std::string_view option, const Words& values, MtlMap& map) {
    if (option == "-s" || option == "-o") {
        return read_pair(values, option == "-s", option == "-s" ? map.uvs.scale : map.uvs.offset);
    }
    if (option == "-clamp") {
        map.clamps = !values.empty() && values[0] == "on";
        return true;
    }
    if (option == "-bm") {
        const std::optional<double> strength = values.empty() ? std::nullopt : parse_number(values[0]);
        if (!strength || *strength < 0.0 || *strength > static_cast<double>(kMostNormalStrength)) {
            return false;
        }
        map.strength = static_cast<float>(*strength);
        return true;
    }
    if (option == "-mm") {
        return are_numbers(values, {0.0, 1.0});
    }
    if (option == "-t") {
        return std::all_of(values.begin(), values.end(),
                           [](std::string_view word) { return parse_number(word) == 0.0; });
    }
    constexpr std::array<std::string_view, 5> kSilent = {"-blendu", "-blendv", "-cc", "-texres", "-type"};
    return std::find(kSilent.begin(), kSilent.end(), option) != kSilent.end();
}

bool is_option(std::string_view word) { return word.size() > 1 && word[0] == '-'; }

}  // namespace

ParsedMap parse_map(std::string_view arguments) {
    const Words words = split_words(arguments);
    ParsedMap result;
    std::size_t at = 0;
    while (at < words.size() && is_option(words[at])) {
        const std::string_view option = words[at++];
        const auto [least, most] = words_of_option(lower_case(option));
        Words values;
        while (values.size() < most && at < words.size() && (values.size() < least || parse_number(words[at]))) {
            values.push_back(words[at++]);
        }
        if (!read_option(lower_case(option), values, result.map)) {
            result.unsupported.emplace_back(option);
        }
    }
    if (at < words.size()) {
        const std::string_view rest(words[at].data(), arguments.data() + arguments.size());
        const std::string_view name = unquoted(rest);
        const std::string_view bare(words[at].data(), words.back().data() + words.back().size());
        result.map.name = name.size() < rest.size() ? name : bare;
    }
    return result;
}

}  // namespace pl
