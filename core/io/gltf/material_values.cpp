#include "core/io/gltf/material_values.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/texture_file.h"
#include "core/scene/anisotropy.h"

namespace pl {
namespace {

constexpr const char* kMoved = "a number out of the range of the format is moved into it";

/// Widths of facets along u and v.
glm::vec2 widths_of(float roughness, float strength) {
    const float width = roughness * roughness;
    return {width + (1.0f - width) * strength * strength, width};
}

}  // namespace

float clamped_number(GltfFile& file, const std::string& pointer, float standard, float least, float most) {
    const float value = file.json().number(pointer).value_or(standard);
    if (value < least || value > most) file.note(kMoved, pointer);
    return std::clamp(value, least, most);
}

glm::vec4 clamped_shares(GltfFile& file, const std::string& pointer, std::size_t length) {
    const auto given = file.json().numbers(pointer, length);
    glm::vec4 value(1.0f);
    for (std::size_t i = 0; given && i < length; ++i) value[static_cast<int>(i)] = static_cast<float>((*given)[i]);
    const glm::vec4 inside = glm::clamp(value, glm::vec4(0.0f), glm::vec4(1.0f));
    if (value != inside) file.note(kMoved, pointer);
    return inside;
}

Metalness metalness_of(const SceneDescription& scene, std::uint32_t texture, float factor) {
    if (texture == kNoTexture) return {factor, factor, factor};
    Metalness metalness{.least = 1.0f};
    double sum = 0.0;
    const std::vector<glm::vec4>& texels = scene.textures[texture].texels;
    for (const glm::vec4& texel : texels) {
        const float value = factor * texel.z;
        metalness.least = std::min(metalness.least, value);
        metalness.most = std::max(metalness.most, value);
        sum += static_cast<double>(value);
    }
    metalness.mean = static_cast<float>(sum / static_cast<double>(texels.size()));
    return metalness;
}

bool stretch_facets(SceneDescription& scene, float strength, MaterialDescription& metal) {
    std::uint32_t& texture = metal.textures.roughness;
    if (texture == kNoTexture) {
        const glm::vec2 widths = widths_of(metal.roughness, strength);
        return set_widths(metal, widths.x, widths.y);
    }
    TextureDescription image = scene.textures[texture];
    double sum = 0.0;
    for (glm::vec4& texel : image.texels) {
        const float roughness = metal.roughness * texel.x;
        sum += static_cast<double>(roughness);
        const glm::vec2 widths = widths_of(roughness, strength);
        texel.x = std::sqrt(std::sqrt(widths.x * widths.y));
    }
    const float mean = static_cast<float>(sum / static_cast<double>(image.texels.size()));
    const glm::vec2 widths = widths_of(mean, strength);
    const bool is_within = set_widths(metal, widths.x, widths.y);
    texture = static_cast<std::uint32_t>(scene.textures.size());
    scene.textures.push_back(std::move(image));
    metal.roughness = 1.0f;
    return is_within;
}

glm::vec3 color_or(const JsonDocument& document, const std::string& pointer, const glm::vec3& standard) {
    const auto given = document.numbers(pointer, 3);
    return given ? glm::vec3((*given)[0], (*given)[1], (*given)[2]) : standard;
}

namespace {

/// OpenGL's numbers of sampler modes.
constexpr std::uint64_t kClamp = 33071;
constexpr std::uint64_t kMirror = 33648;
constexpr std::uint64_t kRepeat = 10497;
constexpr std::uint64_t kNearest = 9728;

std::string image_at(std::uint32_t image) { return fmt::format("/images/{}", image); }

}  // namespace

std::uint32_t GltfImages::color(const std::string& info, float alpha_scale) {
    return add(info, Use::Color, alpha_scale);
}

std::uint32_t GltfImages::roughness(const std::string& info) { return add(info, Use::Roughness, 1.0f); }

std::uint32_t GltfImages::metalness(const std::string& info) { return add(info, Use::Metalness, 1.0f); }

std::uint32_t GltfImages::normals(const std::string& info) { return add(info, Use::Normals, 1.0f); }

std::uint32_t GltfImages::roughness_of_gloss(const std::string& info, float factor) {
    return add(info, Use::Gloss, factor);
}

std::uint32_t GltfImages::add(const std::string& info, Use use, float factor) {
    const std::optional<std::uint32_t> texture = file_.index(info + "/index", "textures");
    if (!texture) return kNoTexture;
    const Source source = source_of(fmt::format("/textures/{}", *texture));
    const auto [known, is_new] = known_.try_emplace({source.image, use, factor, source.repeats}, kNoTexture);
    if (is_new) known->second = make(source, use, factor);
    return known->second;
}

TextureContent GltfImages::content_of(Use use) {
    switch (use) {
    case Use::Color: return TextureContent::Color;
    case Use::Normals: return TextureContent::Normal;
    case Use::Roughness:
    case Use::Metalness:
    case Use::Gloss: break;
    }
    return TextureContent::Number;
}

GltfImages::Source GltfImages::source_of(const std::string& texture) {
    for (const char* kind : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds"}) {
        const std::string pointer = texture + "/extensions/" + kind;
        if (file_.json().has(pointer) && !file_.json().has(texture + "/source")) {
            file_.note(fmt::format("images of {} cannot be read", kind), pointer);
            return {.image = file_.required_index(pointer + "/source", "images"), .repeats = repeats(texture)};
        }
    }
    return {.image = file_.required_index(texture + "/source", "images"), .repeats = repeats(texture)};
}

bool GltfImages::repeats(const std::string& texture) {
    const std::optional<std::uint32_t> sampler = file_.index(texture + "/sampler", "samplers");
    if (!sampler) return true;
    const std::string at = fmt::format("/samplers/{}", *sampler);
    const auto mode = [&](const char* key, std::uint64_t standard) {
        return file_.whole(at + key, standard, 0, 0xffffu);
    };
    const std::uint64_t u = mode("/wrapS", kRepeat);
    const std::uint64_t v = mode("/wrapT", kRepeat);
    if (u == kMirror || v == kMirror) file_.note("mirrored repetition of images: they repeat without", at);
    if ((u == kClamp) != (v == kClamp))
        file_.note("images that repeat in one direction only: they repeat in both", at);
    if (mode("/magFilter", 0) == kNearest) file_.note("images without interpolation: texels are interpolated", at);
    return u != kClamp || v != kClamp;
}

std::uint32_t GltfImages::make(const Source& source, Use use, float factor) {
    const TextureContent content = content_of(use);
    const std::filesystem::path path = image_path(source.image);
    const std::uint32_t index = add_texture_by(scene_, path, content, source.repeats, [&] {
        return decode_texture(image_bytes(source.image), path, content, source.repeats, scene_.warnings);
    });
    if (index == kNoTexture) return index;
    for (glm::vec4& texel : scene_.textures[index].texels) {
        switch (use) {
        case Use::Color: texel.w = std::min(texel.w * factor, 1.0f); break;
        case Use::Roughness: texel.x = texel.y; break;
        case Use::Metalness: texel.x = texel.z; break;
        case Use::Gloss: texel.x = 1.0f - factor * texel.w; break;
        case Use::Normals: break;
        }
    }
    return index;
}

std::string GltfImages::image_bytes(std::uint32_t image) {
    const std::string at = image_at(image);
    if (const std::optional<std::string> uri = file_.json().text(at + "/uri")) {
        return uri->starts_with("data:") ? file_.uri_bytes(at + "/uri", *uri)
                                         : read_file(file_.uri_path(at + "/uri", *uri));
    }
    return std::string(file_.view_bytes(file_.required_index(at + "/bufferView", "bufferViews")));
}

/// The file that holds the image: its own file, or the file of the scene.
std::filesystem::path GltfImages::image_path(std::uint32_t image) const {
    const std::string pointer = image_at(image) + "/uri";
    const std::optional<std::string> uri = file_.json().text(pointer);
    return uri && !uri->starts_with("data:") ? file_.uri_path(pointer, *uri) : file_.path();
}

}  // namespace pl
