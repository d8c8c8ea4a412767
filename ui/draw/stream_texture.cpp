#include "ui/draw/stream_texture.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <SDL.h>

#include "core/base/error.h"
#include "ui/draw/picture_zoom.h"

namespace pl::ui {
namespace {

SDL_Rect to_sdl(const Rect& rect) {
    // By its edges, so that neighbors meet.
    const auto pixel = [](float at) { return static_cast<int>(std::lround(at)); };
    const int x = pixel(rect.x);
    const int y = pixel(rect.y);
    return {x, y, pixel(rect.x + rect.width) - x, pixel(rect.y + rect.height) - y};
}

}  // namespace

StreamTexture::~StreamTexture() {
    if (texture_ != nullptr) SDL_DestroyTexture(texture_);
}

bool StreamTexture::resize(int width, int height) {
    if (texture_ != nullptr && width == width_ && height == height_) return false;
    if (texture_ != nullptr) SDL_DestroyTexture(texture_);
    // The window's own format: others are converted pixel by pixel.
    texture_ = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_STREAMING, width, height);
    if (texture_ == nullptr)
        throw Error(ErrorKind::Runtime, std::string("cannot show the picture: ") + SDL_GetError());
    SDL_SetTextureBlendMode(texture_, SDL_BLENDMODE_NONE);
    width_ = width;
    height_ = height;
    return true;
}

void StreamTexture::fill(const std::function<void(std::uint32_t* out, std::size_t pitch)>& write) {
    void* pixels = nullptr;
    int pitch_bytes = 0;
    if (SDL_LockTexture(texture_, nullptr, &pixels, &pitch_bytes) != 0) return;
    write(static_cast<std::uint32_t*>(pixels), static_cast<std::size_t>(pitch_bytes) / sizeof(std::uint32_t));
    SDL_UnlockTexture(texture_);
}

void StreamTexture::draw(const Rect& target, const Rect& clip, Scaling scaling) {
    if (texture_ == nullptr) return;
    if (scaling == Scaling::Nearest && target.width > static_cast<float>(width_)) return draw_slices(target, clip);
    const SDL_Rect place = to_sdl(target);
    const SDL_Rect part = to_sdl(clip);
    const bool exact = place.w == width_ && place.h == height_;
    SDL_SetTextureScaleMode(texture_, exact ? SDL_ScaleModeNearest : SDL_ScaleModeLinear);
    SDL_RenderSetClipRect(renderer_, &part);
    SDL_RenderCopy(renderer_, texture_, nullptr, &place);
    SDL_RenderSetClipRect(renderer_, nullptr);
}

/// The renderer cuts a large target at whole pixels of the texture, and would show them too wide or too narrow.
void StreamTexture::draw_slices(const Rect& target, const Rect& clip) {
    SDL_SetTextureScaleMode(texture_, SDL_ScaleModeNearest);
    for (const PictureSlice& slice : visible_slices(target, clip, width_, height_)) {
        const SDL_Rect from{slice.x, slice.y, slice.width, slice.height};
        const SDL_Rect to = to_sdl(slice.place);
        if (to.w > 0 && to.h > 0) SDL_RenderCopy(renderer_, texture_, &from, &to);
    }
}

PictureTextures::~PictureTextures() {
    for (const auto& [picture, texture] : textures_)
        if (texture != nullptr) SDL_DestroyTexture(texture);
    for (const MeshTexture& kept : meshes_)
        if (kept.texture != nullptr) SDL_DestroyTexture(kept.texture);
}

SDL_Texture* PictureTextures::of(const std::shared_ptr<const ByteImage>& picture) {
    const auto [entry, is_new] = textures_.try_emplace(picture, nullptr);
    if (!is_new) return entry->second;
    ++gui_memory().textures_made;
    SDL_Texture* const texture = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_RGB24, SDL_TEXTUREACCESS_STATIC,
                                                   picture->width, picture->height);
    if (texture != nullptr) {
        SDL_UpdateTexture(texture, nullptr, picture->rgb.data(), picture->width * 3);
        SDL_SetTextureScaleMode(texture, SDL_ScaleModeLinear);
    }
    return entry->second = texture;
}

void PictureTextures::drop_unused() {
    std::erase_if(textures_, [](const auto& entry) {
        const bool is_unused = entry.first.use_count() == 1;
        if (is_unused && entry.second != nullptr) SDL_DestroyTexture(entry.second);
        return is_unused;
    });
}

SDL_Texture* PictureTextures::of(const std::shared_ptr<const ScreenMesh>& mesh, const Rect& part) {
    for (const MeshTexture& kept : meshes_)
        if (kept.mesh == mesh && kept.part == part) return kept.texture;
    if (meshes_[1].texture != nullptr) SDL_DestroyTexture(meshes_[1].texture);
    meshes_[1] = std::exchange(meshes_[0], {mesh, part, draw(*mesh, part)});
    return meshes_[0].texture;
}

SDL_Texture* PictureTextures::draw(const ScreenMesh& mesh, const Rect& part) {
    SDL_Texture* const texture = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_TARGET,
                                                   static_cast<int>(part.width), static_cast<int>(part.height));
    if (texture == nullptr) return nullptr;
    std::vector<SDL_Vertex> corners;
    corners.reserve(mesh.indices.size());
    for (const std::uint32_t i : mesh.indices) {
        const auto channel = [&](int shift) { return static_cast<Uint8>(mesh.colors[i] >> shift & 255); };
        corners.push_back({{mesh.points[i].x - part.x, mesh.points[i].y - part.y},
                           {channel(IM_COL32_R_SHIFT), channel(IM_COL32_G_SHIFT), channel(IM_COL32_B_SHIFT), 255},
                           {0.0f, 0.0f}});
    }
    SDL_SetTextureBlendMode(texture, SDL_BLENDMODE_BLEND);
    SDL_SetRenderTarget(renderer_, texture);
    SDL_SetRenderDrawColor(renderer_, 0, 0, 0, 0);
    SDL_RenderClear(renderer_);
    SDL_RenderGeometry(renderer_, nullptr, corners.data(), static_cast<int>(corners.size()), nullptr, 0);
    SDL_SetRenderTarget(renderer_, nullptr);
    return texture;
}

}  // namespace pl::ui
