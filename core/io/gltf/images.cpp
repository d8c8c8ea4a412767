#include "core/io/gltf/images.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/texture_file.h"

namespace pl {
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

/// The file that holds the image: its own, or that of the scene.
std::filesystem::path GltfImages::image_path(std::uint32_t image) const {
    const std::string pointer = image_at(image) + "/uri";
    const std::optional<std::string> uri = file_.json().text(pointer);
    return uri && !uri->starts_with("data:") ? file_.uri_path(pointer, *uri) : file_.path();
}

}  // namespace pl
