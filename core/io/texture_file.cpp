#include "core/io/texture_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/decode_image.h"
#include "core/io/files.h"
#include "core/io/image.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

/// Replaces NaN, infinite and negative texels by 0.
void clean(const fs::path& path, std::vector<glm::vec4>& texels, std::vector<std::string>& warnings) {
    std::size_t count = 0;
    for (glm::vec4& texel : texels) {
        bool bad = false;
        for (int channel = 0; channel < 3; ++channel) {
            if (!(texel[channel] >= 0.0f && texel[channel] <= std::numeric_limits<float>::max())) {
                texel[channel] = 0.0f;
                bad = true;
            }
        }
        texel.w = texel.w >= 0.0f ? std::min(texel.w, 1.0f) : 1.0f;
        count += bad ? 1 : 0;
    }
    if (count > 0) {
        warnings.push_back(
            fmt::format("{}: {} texels are negative, infinite or no numbers, and count as 0", path.string(), count));
    }
}

/// Most images have eight bits per channel: 256 codes, whose values are computed once.
void decode(std::vector<glm::vec4>& texels) {
    std::array<float, 256> decoded;
    for (std::size_t i = 0; i < decoded.size(); ++i) {
        decoded[i] = decode_srgb(static_cast<float>(i) / 255.0f);
    }
    const auto value_of = [&](float code) {
        const auto level = static_cast<std::size_t>(std::clamp(code, 0.0f, 1.0f) * 255.0f + 0.5f);
        return static_cast<float>(level) / 255.0f == code ? decoded[level] : decode_srgb(code);
    };
    for (glm::vec4& texel : texels) {
        texel = {value_of(texel.x), value_of(texel.y), value_of(texel.z), texel.w};
    }
}

/// Opacity from the first channel, if alpha is 1 everywhere.
void take_opacity(std::vector<glm::vec4>& texels) {
    if (std::all_of(texels.begin(), texels.end(), [](const glm::vec4& texel) { return texel.w == 1.0f; })) {
        for (glm::vec4& texel : texels) {
            texel.w = std::min(texel.x, 1.0f);
        }
    }
}

/// Placeholder of an image that cannot be read: a conspicuous checkerboard.
TextureDescription checkers(const fs::path& source, bool repeats) {
    constexpr glm::vec4 kMagenta{1.0f, 0.0f, 1.0f, 1.0f};
    constexpr glm::vec4 kBlack{0.0f, 0.0f, 0.0f, 1.0f};
    return {.source = source,
            .width = 2,
            .height = 2,
            .repeats = repeats,
            .texels = {kMagenta, kBlack, kBlack, kMagenta}};
}

}  // namespace

float decode_srgb(float code) { return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f); }

TextureDescription read_texture(const fs::path& path, TextureContent content, bool repeats,
                                std::vector<std::string>& warnings) {
    return decode_texture(read_file(path), path, content, repeats, warnings);
}

TextureDescription decode_texture(const std::string& bytes, const fs::path& source, TextureContent content,
                                  bool repeats, std::vector<std::string>& warnings) {
    DecodedImage image = decode_image(bytes, source, warnings);
    clean(source, image.texels, warnings);
    if (content == TextureContent::Color && image.is_ldr) {
        decode(image.texels);
    } else if (content == TextureContent::Opacity) {
        take_opacity(image.texels);
    }
    return {.source = source,
            .content = content,
            .width = static_cast<std::uint32_t>(image.width),
            .height = static_cast<std::uint32_t>(image.height),
            .repeats = repeats,
            .texels = std::move(image.texels)};
}

std::uint32_t add_texture(SceneDescription& scene, const fs::path& path, TextureContent content, bool repeats) {
    const auto known =
        std::find_if(scene.textures.begin(), scene.textures.end(), [&](const TextureDescription& texture) {
            return texture.source == path && texture.content == content && texture.repeats == repeats;
        });
    if (known != scene.textures.end()) {
        return static_cast<std::uint32_t>(known - scene.textures.begin());
    }
    return add_texture_by(scene, path, content, repeats,
                          [&] { return read_texture(path, content, repeats, scene.warnings); });
}

std::uint32_t add_texture_by(SceneDescription& scene, const fs::path& source, TextureContent content, bool repeats,
                             const std::function<TextureDescription()>& read) {
    try {
        scene.textures.push_back(read());
    } catch (const MemoryError&) {
        throw;  // a picture does not depend on the memory of the machine
    } catch (const Error& error) {
        const bool shows = content == TextureContent::Color;
        const std::string told =
            fmt::format("{}: {}", error.what(), shows ? "shown as checkers" : "this texture is left out");
        if (std::find(scene.warnings.begin(), scene.warnings.end(), told) == scene.warnings.end()) {
            scene.warnings.push_back(told);
        }
        if (!shows) {
            return kNoTexture;
        }
        scene.textures.push_back(checkers(source, repeats));
    }
    return static_cast<std::uint32_t>(scene.textures.size() - 1);
}

EnvironmentMapDescription read_environment_map(const fs::path& path, float scale, float rotation_deg,
                                               std::vector<std::string>& warnings) {
    const TextureDescription image = read_texture(path, TextureContent::Color, true, warnings);
    if (image.width != 2 * image.height) {
        warnings.push_back(fmt::format("{}: {}x{}: an image over all directions is twice as wide as high: stretched",
                                       path.string(), image.width, image.height));
    }
    EnvironmentMapDescription map{
        .source = path, .width = image.width, .height = image.height, .rotation_deg = rotation_deg, .texels = {}};
    map.texels.reserve(image.texels.size());
    for (const glm::vec4& texel : image.texels) {
        map.texels.push_back(scale * glm::vec3(texel));
    }
    return map;
}

fs::path path_inside(const fs::path& folder, const std::string& name) {
    std::string slashes = name;
    std::replace(slashes.begin(), slashes.end(), '\\', '/');
    const fs::path relative(slashes);
    const bool has_drive = slashes.size() > 1 && slashes[1] == ':';
    return relative.empty() || has_drive || !stays_inside(folder, relative) ? fs::path() : folder / relative;
}

namespace {

/// Indices of the texels before and behind one of a row or column, and how far apart they are.
struct Neighbors {
    std::uint32_t before, behind;
    float distance;
};

Neighbors neighbors_of(std::uint32_t i, std::uint32_t count, bool repeats) {
    if (repeats) return {(i + count - 1) % count, (i + 1) % count, 2.0f};
    const std::uint32_t before = i > 0 ? i - 1 : 0;
    const std::uint32_t behind = std::min(i + 1, count - 1);
    return {before, behind, static_cast<float>(std::max(behind - before, 1u))};
}

float finite_or_none(float slope) { return std::isfinite(slope) ? slope : 0.0f; }

}  // namespace

void turn_into_normals(TextureDescription& heights, glm::vec2 rise) {
    std::vector<glm::vec4> normals(heights.texels.size());
    for (std::uint32_t row = 0; row < heights.height; ++row) {
        // Rows go down, v goes up.
        const Neighbors v = neighbors_of(row, heights.height, heights.repeats);
        for (std::uint32_t column = 0; column < heights.width; ++column) {
            const Neighbors u = neighbors_of(column, heights.width, heights.repeats);
            const auto height = [&](std::uint32_t x, std::uint32_t y) {
                return heights.texels[std::size_t{y} * heights.width + x].x;
            };
            const float along_u = rise.x * (height(u.behind, row) - height(u.before, row)) / u.distance;
            const float along_v = rise.y * (height(column, v.before) - height(column, v.behind)) / v.distance;
            const glm::vec3 normal =
                glm::normalize(glm::vec3(-finite_or_none(along_u), -finite_or_none(along_v), 1.0f));
            normals[std::size_t{row} * heights.width + column] = glm::vec4(0.5f * normal + 0.5f, 1.0f);
        }
    }
    heights.texels = std::move(normals);
}

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

/// The picture in 8 bits; nothing if a value has no code.
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
