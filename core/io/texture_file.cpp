#include "core/io/texture_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/decode_image.h"
#include "core/io/files.h"

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

void decode(std::vector<glm::vec4>& texels) {
    for (glm::vec4& texel : texels) {
        texel = {decode_srgb(texel.x), decode_srgb(texel.y), decode_srgb(texel.z), texel.w};
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

}  // namespace pl
