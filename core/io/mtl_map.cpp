#include "core/io/mtl_map.h"

#include <algorithm>
#include <array>

#include "core/io/line_reader.h"
#include "core/scene/description.h"

namespace pl {

namespace {

using Words = std::vector<std::string_view>;

/// Smallest and largest number of arguments of an option; those after the first are numbers.
struct OptionWords {
    std::size_t least, most;
};
OptionWords words_of_option(std::string_view option) {
    if (option == "-s" || option == "-o" || option == "-t") {
        return {1, 3};
    }
    return option == "-mm" ? OptionWords{2, 2} : OptionWords{1, 1};
}

bool all_are(const Words& words, double wanted) {
    return std::all_of(words.begin(), words.end(),
                       [&](std::string_view word) { return parse_number(word) == wanted; });
}

/// Whether an option has no effect on the picture, by its name or by its values.
bool is_silent(std::string_view option, const Words& values) {
    if (option == "-s") {
        return all_are(values, 1.0);
    }
    if (option == "-o" || option == "-t") {
        return all_are(values, 0.0);
    }
    constexpr std::array<std::string_view, 6> kSilent = {"-clamp", "-blendu", "-blendv", "-cc", "-texres", "-type"};
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
        const OptionWords count = words_of_option(option);
        Words values;
        while (values.size() < count.most && at < words.size() &&
               (values.size() < count.least || parse_number(words[at]))) {
            values.push_back(words[at++]);
        }
        if (option == "-clamp") {
            result.map.clamps = !values.empty() && values[0] == "on";
        }
        const std::optional<double> strength =
            option == "-bm" && !values.empty() ? parse_number(values[0]) : std::nullopt;
        if (strength && *strength >= 0.0 && *strength <= static_cast<double>(kMostNormalStrength)) {
            result.map.strength = static_cast<float>(*strength);
        } else if (!is_silent(option, values)) {
            result.unsupported.emplace_back(option);
        }
    }
    if (at < words.size()) {
        const char* const end = words.back().data() + words.back().size();
        result.map.name.assign(words[at].data(), end);
    }
    return result;
}

}  // namespace pl
