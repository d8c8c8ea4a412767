// Portable float map: a text header of three lines, then floats from the bottom row to the top.
#include "core/io/image.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/line_reader.h"

namespace pl {

static_assert(std::endian::native == std::endian::little, "floats are copied to and from little-endian files");

namespace {

struct Header {
    int width = 0;
    int height = 0;
    int channels = 3;
    bool big_endian = false;
    std::size_t size = 0;  ///< bytes up to the first float
};

/// The next word. Skips exactly one byte of white space after it: the floats follow the last word.
std::string_view take_word(std::string_view bytes, std::size_t& at) {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::size_t first = std::min(bytes.find_first_not_of(kSpace, at), bytes.size());
    const std::size_t end = std::min(bytes.find_first_of(kSpace, first), bytes.size());
    at = std::min(end + 1, bytes.size());
    return bytes.substr(first, end - first);
}

Header read_header(const LinearSettings& settings, std::string_view bytes) {
    const std::filesystem::path& path = settings.path;
    Header header;
    const std::string_view kind = take_word(bytes, header.size);
    if (kind != "PF" && kind != "Pf") {
        fail_image(path, "not a PFM file: expected 'PF' or 'Pf' at its start");
    }
    header.channels = kind == "PF" ? 3 : 1;
    const std::optional<std::int64_t> width = parse_integer(take_word(bytes, header.size));
    const std::optional<std::int64_t> height = parse_integer(take_word(bytes, header.size));
    const std::optional<double> scale = parse_number(take_word(bytes, header.size));
    if (!width || !height || !scale || *scale == 0.0) {
        fail_image(path, "PFM header: expected width, height and a scale other than 0");
    }
    settings.require_size(path, *width, *height);
    header.width = static_cast<int>(*width);
    header.height = static_cast<int>(*height);
    header.big_endian = *scale > 0.0;
    return header;
}

float swap_bytes(float number) {
    auto bytes = std::bit_cast<std::array<char, sizeof(float)>>(number);
    std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<float>(bytes);
}

}  // namespace

std::string encode_pfm(const LinearImage& image) {
    std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height);
    const std::size_t start = bytes.size();
    const std::size_t row = static_cast<std::size_t>(image.width) * sizeof(glm::vec3);
    const auto rows = static_cast<std::size_t>(image.height);
    bytes.resize(start + rows * row);
    for (std::size_t y = 0; y < rows; ++y) {
        const glm::vec3* const from = image.pixels.data() + (rows - 1 - y) * static_cast<std::size_t>(image.width);
        std::memcpy(bytes.data() + start + y * row, from, row);
    }
    return bytes;
}

void write_pfm(const std::filesystem::path& path, const LinearImage& image) {
    require_complete(path, image.width, image.height, image.pixels.size(), 1);
    write_file_atomic(path, encode_pfm(image));
}

LinearImage decode_pfm(std::string_view bytes, const LinearSettings& settings) {
    const Header header = read_header(settings, bytes);
    const auto width = static_cast<std::size_t>(header.width);
    const auto height = static_cast<std::size_t>(header.height);
    const std::size_t row = width * static_cast<std::size_t>(header.channels) * sizeof(float);
    if (bytes.size() - header.size != height * row) {
        fail_image(settings.path, fmt::format("a PFM of {}x{} has {} bytes of pixels, got {}", width, height,
                                              height * row, bytes.size() - header.size));
    }
    LinearImage image{.width = header.width, .height = header.height, .pixels = {}};
    image.pixels.reserve(width * height);
    for (std::size_t y = height; y-- > 0;) {
        const char* from = bytes.data() + header.size + y * row;
        for (std::size_t x = 0; x < width; ++x) {
            glm::vec3 pixel;
            for (int c = 0; c < header.channels; ++c, from += sizeof(float)) {
                std::memcpy(&pixel[c], from, sizeof(float));
                if (header.big_endian) pixel[c] = swap_bytes(pixel[c]);
            }
            image.pixels.push_back(header.channels == 1 ? glm::vec3(pixel.x) : pixel);
        }
    }
    return image;
}

}  // namespace pl
