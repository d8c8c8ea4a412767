#include "ui/window/offscreen.h"

#include <SDL.h>

#include "core/base/error.h"
#include "ui/draw/style.h"

namespace pl::ui {
namespace {

[[noreturn]] void fail(ErrorKind kind, const char* what) {
    throw Error(kind, std::string(what) + ": " + SDL_GetError());
}

}  // namespace

ByteImage read_pixels(SDL_Renderer* renderer) {
    ByteImage pixels;
    SDL_GetRendererOutputSize(renderer, &pixels.width, &pixels.height);
    pixels.rgb.resize(static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height) * 3);
    if (SDL_RenderReadPixels(renderer, nullptr, SDL_PIXELFORMAT_RGB24, pixels.rgb.data(), pixels.width * 3) != 0)
        fail(ErrorKind::Runtime, "cannot read the pixels that were drawn");
    return pixels;
}

Offscreen::Offscreen(int width, int height, const std::filesystem::path& font, float ui_scale)
    : width_(width), height_(height) {
    surface_ = SDL_CreateRGBSurfaceWithFormat(0, width, height, 32, SDL_PIXELFORMAT_ARGB8888);
    if (surface_ != nullptr) renderer_ = SDL_CreateSoftwareRenderer(surface_);
    if (renderer_ == nullptr) {
        SDL_FreeSurface(surface_);
        fail(ErrorKind::Unavailable, "cannot draw into memory");
    }
    create_gui_context(memory_);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    io.DeltaTime = 1.0f;
    apply_style(ui_scale);
    load_fonts(font, ui_scale);
    draw_ = std::make_unique<ImGuiDraw>(renderer_);
    draw_->upload_fonts();
}

Offscreen::~Offscreen() {
    draw_.reset();
    ImGui::DestroyContext();
    SDL_DestroyRenderer(renderer_);
    SDL_FreeSurface(surface_);
}

void Offscreen::put(const std::uint32_t* background) {
    SDL_Texture* texture =
        SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_STATIC, width_, height_);
    if (texture == nullptr) fail(ErrorKind::Unavailable, "cannot draw into memory");
    SDL_UpdateTexture(texture, nullptr, background, width_ * 4);
    SDL_SetTextureBlendMode(texture, SDL_BLENDMODE_NONE);
    SDL_RenderCopy(renderer_, texture, nullptr, nullptr);
    SDL_RenderFlush(renderer_);
    SDL_DestroyTexture(texture);
}

ByteImage Offscreen::paint(const std::uint32_t* background, const std::function<void()>& build) {
    SDL_SetRenderDrawColor(renderer_, 0x1b, 0x1e, 0x24, 255);
    SDL_RenderClear(renderer_);
    if (background != nullptr) put(background);
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
    ImGui::Begin("picture", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoSavedSettings);
    build();
    ImGui::End();
    ImGui::Render();
    draw_->draw(*ImGui::GetDrawData());
    ByteImage pixels = read_pixels(renderer_);
    return {.width = pixels.width, .height = pixels.height, .rgb = std::move(pixels.rgb)};
}

}  // namespace pl::ui
