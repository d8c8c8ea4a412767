#include "core/io/texture_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <stb_image.h>

#include "core/base/memory.h"
#include "core/io/files.h"
#include "core/io/hdr_check.h"
#include "core/io/image.h"
#include "core/io/image_checks.h"
#include "core/io/image_ends.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

/// Required first bytes of a file: without them stb tries all its decoders, some of them little tested.
std::string_view signature_of(const std::string& suffix) {
    if (suffix == ".png") {
        return "\x89PNG\r\n\x1a\n";
    }
    if (suffix == ".jpg" || suffix == ".jpeg") {
        return "\xff\xd8\xff";
    }
    if (suffix == ".bmp") {
        return "BM";
    }
    if (suffix == ".hdr") {
        return "#?";
    }
    return "";
}

bool is_known(const std::string& suffix) {
    constexpr std::array<std::string_view, 5> kKnown = {".png", ".jpg", ".jpeg", ".tga", ".bmp"};
    return suffix == ".hdr" || std::find(kKnown.begin(), kKnown.end(), suffix) != kKnown.end();
}

void require_size(const fs::path& path, long long width, long long height) {
    constexpr auto kSide = static_cast<long long>(kMostTextureSide);
    if (width <= 0 || height <= 0 || width > kSide || height > kSide ||
        static_cast<std::size_t>(width * height) > kMostTexels) {
        fail_image(path, fmt::format("a texture of {}x{}: sides up to {} and {} texels are supported", width, height,
                                     kMostTextureSide, kMostTexels));
    }
    constexpr std::uint64_t kTexelBytes = 40;  // as decoded, as four floats, and as packed
    require_memory(path.string(), static_cast<std::uint64_t>(width * height) * kTexelBytes, ErrorKind::Input);
}

template <class Sample>
using StbPixels = std::unique_ptr<Sample, decltype(&stbi_image_free)>;

/// Decoded by stb: [texel][4], in [0, 1] for LDR files; alpha is 1 if the file has none.
struct RawImage {
    int width = 0;
    int height = 0;
    bool is_ldr = true;
    std::vector<glm::vec4> texels{};
};

template <class Sample>
std::vector<glm::vec4> unpack(const StbPixels<Sample>& pixels, const RawImage& image, float largest) {
    std::vector<glm::vec4> texels(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    const Sample* at = pixels.get();
    for (glm::vec4& texel : texels) {
        for (int channel = 0; channel < 4; ++channel) {
            texel[channel] = static_cast<float>(*at++) / largest;
        }
    }
    return texels;
}

RawImage read_by_stb(const std::string& bytes, const fs::path& path, const std::string& suffix) {
    const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
    if (!bytes.starts_with(signature_of(suffix)) || bytes.size() > std::numeric_limits<int>::max()) {
        fail_image(path, "not a file of this kind: " + suffix);
    }
    const auto size = static_cast<int>(bytes.size());
    RawImage image;
    int channels = 0;
    if (stbi_info_from_memory(data, size, &image.width, &image.height, &channels) == 0) {
        fail_image(path, std::string("damaged: ") + stbi_failure_reason());
    }
    require_size(path, image.width, image.height);
    const auto read = [&](auto load, float largest) {
        int width = 0;
        int height = 0;
        auto* const loaded = load(data, size, &width, &height, &channels, 4);
        const StbPixels<std::remove_pointer_t<decltype(loaded)>> pixels(loaded, &stbi_image_free);
        if (!pixels || width != image.width || height != image.height) {
            fail_image(path, std::string("damaged: ") + (pixels ? "two sizes" : stbi_failure_reason()));
        }
        image.texels = unpack(pixels, image, largest);
    };
    if (ends_early(suffix, bytes, static_cast<std::size_t>(image.width), static_cast<std::size_t>(image.height))) {
        fail_image(path, "damaged: it ends too early");
    }
    image.is_ldr = suffix != ".hdr";
    if (!image.is_ldr) {
        if (!has_whole_hdr_lines(bytes, static_cast<std::size_t>(image.width),
                                 static_cast<std::size_t>(image.height))) {
            fail_image(path, "damaged: truncated, or with an invalid scanline");
        }
        read(stbi_loadf_from_memory, 1.0f);
    } else if (stbi_is_16_bit_from_memory(data, size) != 0) {
        read(stbi_load_16_from_memory, 65535.0f);
    } else {
        read(stbi_load_from_memory, 255.0f);
    }
    return image;
}

RawImage read_raw(const fs::path& path) {
    const std::string suffix = suffix_of(path);
    if (suffix == ".exr" || suffix == ".pfm") {
        const LinearImage linear = read_linear(path);
        require_size(path, linear.width, linear.height);
        RawImage image{.width = linear.width, .height = linear.height, .is_ldr = false};
        image.texels.reserve(linear.pixels.size());
        for (const glm::vec3& pixel : linear.pixels) {
            image.texels.emplace_back(pixel, 1.0f);
        }
        return image;
    }
    if (!is_known(suffix)) {
        fail_image(path, fmt::format("expected an image (.png, .jpg, .tga, .bmp, .hdr, .exr or .pfm), got {}",
                                     suffix.empty() ? "a file without suffix" : suffix));
    }
    return read_by_stb(read_file(path), path, suffix);
}

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

TextureDescription make_texture(RawImage image, const fs::path& path, TextureContent content, bool repeats,
                                std::vector<std::string>& warnings) {
    clean(path, image.texels, warnings);
    if (content == TextureContent::Color && image.is_ldr) {
        decode(image.texels);
    } else if (content == TextureContent::Opacity) {
        take_opacity(image.texels);
    }
    return {.source = path,
            .content = content,
            .width = static_cast<std::uint32_t>(image.width),
            .height = static_cast<std::uint32_t>(image.height),
            .repeats = repeats,
            .texels = std::move(image.texels)};
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
    return make_texture(read_raw(path), path, content, repeats, warnings);
}

TextureDescription decode_texture(const std::string& bytes, const fs::path& source, TextureContent content,
                                  bool repeats, std::vector<std::string>& warnings) {
    const std::string suffix = bytes.starts_with(signature_of(".png")) ? ".png" : ".jpg";
    return make_texture(read_by_stb(bytes, source, suffix), source, content, repeats, warnings);
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
