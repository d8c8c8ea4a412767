#include "app/frame_names.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl {

FrameNames::FrameNames(const std::string& pattern) {
    const std::size_t percent = pattern.find('%');
    std::string_view rest = percent == std::string::npos ? "" : std::string_view(pattern).substr(percent + 1);
    if (rest.size() >= 2 && rest[0] == '0' && rest[1] >= '1' && rest[1] <= '9') {
        digits_ = rest[1] - '0';
        rest.remove_prefix(2);
    }
    if (rest.empty() || rest[0] != 'd' || rest.find('%') != std::string_view::npos)
        throw Error(ErrorKind::Usage,
                    fmt::format("--output: expected a name with the place of the frame's number once, such as "
                                "frame_%04d.exr, got '{}'",
                                pattern));
    before_ = pattern.substr(0, percent);
    after_ = rest.substr(1);
}

std::string FrameNames::name(int number) const { return fmt::format("{}{:0{}}{}", before_, number, digits_, after_); }

}  // namespace pl
