#include "app/choices.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/io/nearest_name.h"

namespace pl {

std::vector<std::string> split_at_commas(const std::string& text) {
    std::vector<std::string> items;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find(',', start), text.size());
        items.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    return items;
}

std::string one_of(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
    return text;
}

void fail_choice(const std::vector<std::string>& names, const std::string& got) {
    throw ChoiceError(fmt::format("expected {}, got '{}'{}", one_of(names), got, did_you_mean(got, names)), names);
}

}  // namespace pl
