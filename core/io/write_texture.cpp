#include "core/io/write_texture.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "core/io/image.h"
#include "core/io/texture_file.h"

namespace pl {
namespace {

/// The channels in use; one channel as gray.
glm::vec3 used_channels(const glm::vec4& texel, TextureContent use) {
    switch (use) {
    case TextureContent::Color:
    case TextureContent::Normal:
    case TextureContent::Height: break;
    case TextureContent::Number: return glm::vec3(texel.x);
    case TextureContent::Opacity: return glm::vec3(texel.w);
    }
    return glm::vec3(texel);
}

/// Values that the codes of 8 bits are read as, rising.
std::array<float, 256> values_of_codes(TextureContent use) {
    std::array<float, 256> values{};
    for (std::size_t code = 0; code < values.size(); ++code) {
        const float linear = static_cast<float>(code) / 255.0f;
        values[code] = use == TextureContent::Color ? decode_srgb(linear) : linear;
    }
    return values;
}

/// The picture in 8 bits; nothing if a value is not that of a code.
std::optional<ByteImage> in_bytes(const LinearImage& image, TextureContent use) {
    const std::array<float, 256> values = values_of_codes(use);
    ByteImage bytes{.width = image.width, .height = image.height, .rgb = {}};
    bytes.rgb.reserve(3 * image.pixels.size());
    for (const glm::vec3& pixel : image.pixels) {
        for (int channel = 0; channel < 3; ++channel) {
            const auto code = std::lower_bound(values.begin(), values.end(), pixel[channel]);
            if (code == values.end() || *code != pixel[channel]) return std::nullopt;
            bytes.rgb.push_back(static_cast<std::uint8_t>(code - values.begin()));
        }
    }
    return bytes;
}

}  // namespace

std::string write_texture(const std::filesystem::path& folder, const std::string& name,
                          const TextureDescription& texture, TextureContent use) {
    LinearImage image{
        .width = static_cast<int>(texture.width), .height = static_cast<int>(texture.height), .pixels = {}};
    image.pixels.reserve(texture.texels.size());
    for (const glm::vec4& texel : texture.texels) image.pixels.push_back(used_channels(texel, use));
    if (const std::optional<ByteImage> bytes = in_bytes(image, use)) {
        write_png8(folder / (name + ".png"), *bytes);
        return name + ".png";
    }
    write_exr(folder / (name + ".exr"), image);
    return name + ".exr";
}

void write_vertex_colors(const std::filesystem::path& path, const std::vector<glm::vec3>& colors) {
    constexpr std::size_t kMostColumns = 4096;
    const std::size_t columns = std::clamp<std::size_t>(colors.size(), 1, kMostColumns);
    const std::size_t rows = (colors.size() + columns - 1) / columns;
    LinearImage image{.width = static_cast<int>(columns), .height = static_cast<int>(rows), .pixels = colors};
    image.pixels.resize(columns * rows, glm::vec3(0.0f));
    write_exr(path, image);
}

void write_environment_map(const std::filesystem::path& path, const EnvironmentMapDescription& map) {
    write_exr(path,
              {.width = static_cast<int>(map.width), .height = static_cast<int>(map.height), .pixels = map.texels});
}

}  // namespace pl
