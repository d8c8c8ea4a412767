#include "ui/image_layer.h"

#include <SDL.h>

#include "core/base/error.h"

namespace pl {

ImageLayer::ImageLayer(SDL_Renderer* renderer) : renderer_(renderer) {}

ImageLayer::~ImageLayer() {
    if (texture_ != nullptr) SDL_DestroyTexture(texture_);
}

Rect ImageLayer::place(const ViewerModel& model, const Rect& view) const {
    const RenderSettings& settings = model.frame() != nullptr ? model.frame()->settings : model.settings();
    return place_image(view, settings.width, settings.height);
}

void ImageLayer::ensure_texture(int width, int height) {
    if (texture_ != nullptr && width == width_ && height == height_) return;
    if (texture_ != nullptr) SDL_DestroyTexture(texture_);
    // The window's own format: anything else is converted pixel by pixel.
    texture_ = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_STREAMING, width, height);
    if (texture_ == nullptr)
        throw Error(ErrorKind::Runtime, std::string("cannot show the picture: ") + SDL_GetError());
    SDL_SetTextureBlendMode(texture_, SDL_BLENDMODE_NONE);
    width_ = width;
    height_ = height;
    key_ = {};
}

void ImageLayer::fill(const ViewerModel& model, const Key& key) {
    const PublishedFrame& frame = *model.frame();
    try {
        (void)frame.picture.pixels();  // before the texture is locked, whose old pixels are lost then
    } catch (const Error&) {
        return;  // the device is lost: the render thread finds out, tells it, and sends frames of another one
    }
    void* pixels = nullptr;
    int pitch_bytes = 0;
    if (SDL_LockTexture(texture_, nullptr, &pixels, &pitch_bytes) != 0) return;
    CellOverlay overlay{frame.cells.get(), key.opacity, std::nullopt};
    if (key.selected != kNoVolume) overlay.outlined = cell_color(key.selected, cell_table_.view());
    write_picture(frame.picture, overlay, static_cast<std::uint32_t*>(pixels),
                  static_cast<std::size_t>(pitch_bytes) / sizeof(std::uint32_t));
    SDL_UnlockTexture(texture_);
}

void ImageLayer::draw(const ViewerModel& model, const Rect& image) {
    if (model.frame() == nullptr) return;
    const Snapshot& snapshot = model.frame()->snapshot;
    ensure_texture(snapshot.width, snapshot.height);
    const Key key{model.frame()->serial, model.window().cells ? model.window().cells_opacity : 0.0f,
                  model.selected_volume()};
    if (!(key == key_)) {
        fill(model, key);
        key_ = key;
    }
    const bool exact =
        static_cast<int>(image.width) == snapshot.width && static_cast<int>(image.height) == snapshot.height;
    SDL_SetTextureScaleMode(texture_, exact ? SDL_ScaleModeNearest : SDL_ScaleModeLinear);
    const SDL_Rect target{static_cast<int>(image.x), static_cast<int>(image.y), static_cast<int>(image.width),
                          static_cast<int>(image.height)};
    SDL_RenderCopy(renderer_, texture_, nullptr, &target);
}

}  // namespace pl
