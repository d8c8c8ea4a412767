// Small pictures as textures of the window's renderer, for controls of Dear ImGui; each is uploaded once.
#pragma once

#include <map>
#include <memory>

#include "core/io/image.h"
#include "ui/draw/imgui_compat.h"

namespace pl::ui {

class PictureTextures {
public:
    explicit PictureTextures(SDL_Renderer* renderer) : renderer_(renderer) {}
    ~PictureTextures();
    PictureTextures(const PictureTextures&) = delete;
    PictureTextures& operator=(const PictureTextures&) = delete;

    /// The picture must not change; it is kept. Null if the renderer has no room.
    SDL_Texture* of(const std::shared_ptr<const ByteImage>& picture);

private:
    SDL_Renderer* renderer_;
    std::map<std::shared_ptr<const ByteImage>, SDL_Texture*> textures_;
};

}  // namespace pl::ui
