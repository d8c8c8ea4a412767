#include "core/io/hdr_check.h"

namespace pl {
namespace {

/// Removes and returns the first line, without its line feed.
std::string_view take_line(std::string_view& rest) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    return line;
}

/// The bytes after the header and the line with the size.
std::string_view behind_header(std::string_view rest) {
    while (!rest.empty()) {
        const std::string_view line = take_line(rest);
        if (line.empty() || line.front() == '\0') break;
    }
    take_line(rest);
    return rest;
}

std::size_t byte_at(std::string_view text, std::size_t at) { return static_cast<unsigned char>(text[at]); }

/// Removes the runs of one channel of a scanline; false if they are invalid.
bool take_channel(std::string_view& rest, std::size_t width) {
    constexpr std::size_t kRun = 128;  // larger counts: a run of one value
    for (std::size_t done = 0; done < width;) {
        if (rest.empty()) return false;
        const std::size_t code = byte_at(rest, 0);
        const std::size_t count = code > kRun ? code - kRun : code;
        const std::size_t bytes = 1 + (code > kRun ? 1 : count);
        if (count == 0 || count > width - done || bytes > rest.size()) return false;
        rest.remove_prefix(bytes);
        done += count;
    }
    return true;
}

}  // namespace

bool has_whole_hdr_lines(std::string_view file, std::size_t width, std::size_t height) {
    constexpr std::size_t kChannels = 4;
    constexpr std::size_t kMark = 4;  // 2, 2, and the width
    std::string_view rest = behind_header(file);
    const auto is_coded = [&] {
        return width >= 8 && width < 32768 && rest.size() >= kMark && byte_at(rest, 0) == 2 &&
               byte_at(rest, 1) == 2 && byte_at(rest, 2) < 128;
    };
    for (std::size_t row = 0; row < height; ++row) {
        // Only the first line decides whether the picture is uncompressed: the decoder restarts at a later one.
        if (!is_coded()) return row == 0 && rest.size() >= kChannels * width * height;
        if ((byte_at(rest, 2) << 8 | byte_at(rest, 3)) != width) return false;
        rest.remove_prefix(kMark);
        for (std::size_t channel = 0; channel < kChannels; ++channel)
            if (!take_channel(rest, width)) return false;
    }
    return true;
}

}  // namespace pl
