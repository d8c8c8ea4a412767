#include "ui/draw/imgui_draw.h"

#include <algorithm>

#include <SDL.h>

#include "core/base/error.h"

namespace pl::ui {

void create_gui_context(GuiMemory& memory) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.UserData = &memory;
}

GuiMemory& gui_memory() { return *static_cast<GuiMemory*>(ImGui::GetIO().UserData); }

namespace {

/// The clip rectangle of a command; empty if it is invisible.
SDL_Rect clip_of(const ImDrawCmd& command, const ImDrawData& data) {
    const int x0 = static_cast<int>(std::max(command.ClipRect.x - data.DisplayPos.x, 0.0f));
    const int y0 = static_cast<int>(std::max(command.ClipRect.y - data.DisplayPos.y, 0.0f));
    const int x1 = static_cast<int>(std::min(command.ClipRect.z - data.DisplayPos.x, data.DisplaySize.x));
    const int y1 = static_cast<int>(std::min(command.ClipRect.w - data.DisplayPos.y, data.DisplaySize.y));
    return {x0, y0, x1 - x0, y1 - y0};
}

void draw_command(SDL_Renderer* renderer, const ImDrawList& list, const ImDrawCmd& command, const SDL_Rect& clip) {
    SDL_RenderSetClipRect(renderer, &clip);
    const ImDrawVert* vertices = list.VtxBuffer.Data + command.VtxOffset;
    const int vertex_count = list.VtxBuffer.Size - static_cast<int>(command.VtxOffset);
    SDL_RenderGeometryRaw(renderer, from_texture_id(command.GetTexID()), &vertices->pos.x, sizeof(ImDrawVert),
                          reinterpret_cast<const SDL_Color*>(&vertices->col), sizeof(ImDrawVert), &vertices->uv.x,
                          sizeof(ImDrawVert), vertex_count, list.IdxBuffer.Data + command.IdxOffset,
                          static_cast<int>(command.ElemCount), sizeof(ImDrawIdx));
}

}  // namespace

ImGuiDraw::~ImGuiDraw() {
    if (fonts_ != nullptr) SDL_DestroyTexture(fonts_);
}

void ImGuiDraw::upload_fonts() {
    if (fonts_ != nullptr) SDL_DestroyTexture(fonts_);
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    fonts_ = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ABGR8888, SDL_TEXTUREACCESS_STATIC, width, height);
    if (fonts_ == nullptr)
        throw Error(ErrorKind::Unavailable, std::string("cannot make the font: ") + SDL_GetError());
    SDL_UpdateTexture(fonts_, nullptr, pixels, width * 4);
    SDL_SetTextureBlendMode(fonts_, SDL_BLENDMODE_BLEND);
    io.Fonts->SetTexID(to_texture_id(fonts_));
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
}

void ImGuiDraw::draw(const ImDrawData& data) {
    SDL_SetRenderDrawBlendMode(renderer_, SDL_BLENDMODE_BLEND);
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback != nullptr) continue;  // the viewer uses none
            const SDL_Rect clip = clip_of(command, data);
            if (clip.w > 0 && clip.h > 0) draw_command(renderer_, list, command, clip);
        }
    }
    SDL_RenderSetClipRect(renderer_, nullptr);
}

}  // namespace pl::ui
