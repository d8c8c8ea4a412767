#include "app/choices.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/nearest_name.h"

namespace pl {

std::string one_of(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
    return text;
}

void fail_choice(const std::vector<std::string>& names, const std::string& got) {
    throw Error(ErrorKind::Usage,
                fmt::format("expected {}, got '{}' (nearest: '{}')", one_of(names), got, nearest_name(got, names)));
}

}  // namespace pl
