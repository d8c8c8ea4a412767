#include "ui/draw/imgui_draw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

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

/// The clip rectangle of a command within `bounds`; empty if it is invisible.
SDL_Rect clip_of(const ImDrawCmd& command, const Rect& bounds) {
    const int x0 = static_cast<int>(std::max(command.ClipRect.x, bounds.x));
    const int y0 = static_cast<int>(std::max(command.ClipRect.y, bounds.y));
    const int x1 = static_cast<int>(std::min(command.ClipRect.z, bounds.x + bounds.width));
    const int y1 = static_cast<int>(std::min(command.ClipRect.w, bounds.y + bounds.height));
    return {x0, y0, x1 - x0, y1 - y0};
}

bool is_whole(float x) { return x == std::floor(x); }

/// The window that the list draws, if it begins with an opaque rectangle and stays inside of it; else empty.
Rect opaque_place(const ImDrawList& list, ImVec2 size) {
    if (list.IdxBuffer.Size < 6 || list.VtxBuffer.Size < 4) return {};
    const ImDrawVert* const corners = list.VtxBuffer.Data;
    const ImVec2 low = corners[0].pos;
    const ImVec2 high = corners[2].pos;
    const std::array<ImVec2, 4> expected{low, ImVec2{high.x, low.y}, high, ImVec2{low.x, high.y}};
    for (std::size_t i = 0; i < expected.size(); ++i)
        if (corners[i].pos.x != expected[i].x || corners[i].pos.y != expected[i].y ||
            (corners[i].col & IM_COL32_A_MASK) != IM_COL32_A_MASK)
            return {};
    const bool is_pixels = is_whole(low.x) && is_whole(low.y) && is_whole(high.x) && is_whole(high.y);
    if (!is_pixels || low.x < 0.0f || low.y < 0.0f || high.x > size.x || high.y > size.y) return {};
    // Frames are not clipped to their window: the faded edges of their lines may end a pixel outside.
    const auto is_inside = [&](ImVec2 at) {
        return at.x >= low.x - 1.0f && at.y >= low.y - 1.0f && at.x <= high.x + 1.0f && at.y <= high.y + 1.0f;
    };
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.UserCallback != nullptr) return {};
        const ImVec4& clip = command.ClipRect;
        if (is_inside({clip.x, clip.y}) && is_inside({clip.z, clip.w})) continue;
        const ImDrawIdx* const first = list.IdxBuffer.Data + command.IdxOffset;
        if (!std::all_of(first, first + command.ElemCount,
                         [&](ImDrawIdx i) { return is_inside(list.VtxBuffer.Data[command.VtxOffset + i].pos); }))
            return {};
    }
    return {low.x, low.y, high.x - low.x, high.y - low.y};
}

bool are_equal(const ImDrawCmd& a, const ImDrawCmd& b) {
    return a.ClipRect.x == b.ClipRect.x && a.ClipRect.y == b.ClipRect.y && a.ClipRect.z == b.ClipRect.z &&
           a.ClipRect.w == b.ClipRect.w && a.GetTexID() == b.GetTexID() && a.VtxOffset == b.VtxOffset &&
           a.IdxOffset == b.IdxOffset && a.ElemCount == b.ElemCount;
}

template <class T>
bool are_equal(const std::vector<T>& kept, const ImVector<T>& now) {
    const std::size_t count = kept.size();
    return count == static_cast<std::size_t>(now.Size) &&
           (count == 0 || std::memcmp(kept.data(), now.Data, count * sizeof(T)) == 0);
}

}  // namespace

bool ImGuiDraw::KeptWindow::equals(const ImDrawList& list) const {
    return are_equal(vertices, list.VtxBuffer) && are_equal(indices, list.IdxBuffer) &&
           std::equal(commands.begin(), commands.end(), list.CmdBuffer.begin(), list.CmdBuffer.end(),
                      [](const ImDrawCmd& a, const ImDrawCmd& b) { return are_equal(a, b); });
}

void ImGuiDraw::KeptWindow::take(const ImDrawList& list) {
    vertices.assign(list.VtxBuffer.begin(), list.VtxBuffer.end());
    indices.assign(list.IdxBuffer.begin(), list.IdxBuffer.end());
    commands.assign(list.CmdBuffer.begin(), list.CmdBuffer.end());
    if (texture != nullptr) SDL_DestroyTexture(texture);
    texture = nullptr;
}

ImGuiDraw::ImGuiDraw(SDL_Renderer* renderer) : renderer_(renderer) {
    SDL_RendererInfo info{};
    keeps_windows_ = SDL_GetRendererInfo(renderer, &info) == 0 && (info.flags & SDL_RENDERER_SOFTWARE) != 0;
}

ImGuiDraw::~ImGuiDraw() {
    forget_windows();
    if (fonts_ != nullptr) SDL_DestroyTexture(fonts_);
}

void ImGuiDraw::forget_windows() {
    for (auto& [name, window] : windows_)
        if (window.texture != nullptr) SDL_DestroyTexture(window.texture);
    windows_.clear();
}

void ImGuiDraw::upload_fonts() {
    if (fonts_ != nullptr) SDL_DestroyTexture(fonts_);
    forget_windows();  // with texts of the old fonts
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

void ImGuiDraw::draw_list(const ImDrawList& list, const ImDrawVert* vertices, const Rect& bounds, ImVec2 origin) {
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.UserCallback != nullptr) continue;  // the viewer uses none
        SDL_Rect clip = clip_of(command, bounds);
        if (clip.w <= 0 || clip.h <= 0) continue;
        clip.x -= static_cast<int>(origin.x);
        clip.y -= static_cast<int>(origin.y);
        SDL_RenderSetClipRect(renderer_, &clip);
        const ImDrawVert* const first = vertices + command.VtxOffset;
        SDL_RenderGeometryRaw(renderer_, from_texture_id(command.GetTexID()), &first->pos.x, sizeof(ImDrawVert),
                              reinterpret_cast<const SDL_Color*>(&first->col), sizeof(ImDrawVert), &first->uv.x,
                              sizeof(ImDrawVert), list.VtxBuffer.Size - static_cast<int>(command.VtxOffset),
                              list.IdxBuffer.Data + command.IdxOffset, static_cast<int>(command.ElemCount),
                              sizeof(ImDrawIdx));
    }
    SDL_RenderSetClipRect(renderer_, nullptr);
}

/// Drawn within its place too, so that a copy is equal to the pixel.
void ImGuiDraw::draw_window(const ImDrawList& list, const Rect& place) {
    KeptWindow& window = windows_[list._OwnerName];
    window.is_open = true;
    if (!window.equals(list)) {
        window.take(list);
        return draw_list(list, list.VtxBuffer.Data, place, {});
    }
    if (window.texture == nullptr) window.texture = make_texture(window, list, place);
    if (window.texture == nullptr) return draw_list(list, list.VtxBuffer.Data, place, {});
    const SDL_Rect target{static_cast<int>(place.x), static_cast<int>(place.y), static_cast<int>(place.width),
                          static_cast<int>(place.height)};
    SDL_RenderCopy(renderer_, window.texture, nullptr, &target);
    ++copied_;
}

/// Null if there is no memory.
SDL_Texture* ImGuiDraw::make_texture(const KeptWindow& window, const ImDrawList& list, const Rect& place) {
    SDL_Texture* const texture = SDL_CreateTexture(renderer_, SDL_PIXELFORMAT_ARGB8888, SDL_TEXTUREACCESS_TARGET,
                                                   static_cast<int>(place.width), static_cast<int>(place.height));
    if (texture == nullptr) return nullptr;
    std::vector<ImDrawVert> moved = window.vertices;
    for (ImDrawVert& vertex : moved) vertex.pos = {vertex.pos.x - place.x, vertex.pos.y - place.y};
    SDL_SetTextureBlendMode(texture, SDL_BLENDMODE_NONE);
    SDL_SetRenderTarget(renderer_, texture);
    draw_list(list, moved.data(), place, {place.x, place.y});
    SDL_SetRenderTarget(renderer_, nullptr);
    return texture;
}

void ImGuiDraw::draw(const ImDrawData& data) {
    SDL_SetRenderDrawBlendMode(renderer_, SDL_BLENDMODE_BLEND);
    const Rect whole{0.0f, 0.0f, data.DisplaySize.x, data.DisplaySize.y};
    copied_ = 0;
    if (std::exchange(textures_made_, gui_memory().textures_made) != gui_memory().textures_made) forget_windows();
    for (auto& [name, window] : windows_) window.is_open = false;
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        const Rect place =
            keeps_windows_ && list._OwnerName != nullptr ? opaque_place(list, data.DisplaySize) : Rect{};
        if (place.width > 0.0f)
            draw_window(list, place);
        else
            draw_list(list, list.VtxBuffer.Data, whole, {});
    }
    std::erase_if(windows_, [](const auto& entry) {
        if (!entry.second.is_open && entry.second.texture != nullptr) SDL_DestroyTexture(entry.second.texture);
        return !entry.second.is_open;
    });
}

}  // namespace pl::ui
