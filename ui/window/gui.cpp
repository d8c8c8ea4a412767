#include "ui/window/gui.h"

#include <array>
#include <utility>

#include <SDL.h>

#include "core/base/error.h"
#include "ui/draw/style.h"

namespace pl::ui {

Gui::Gui(const Display& display, std::filesystem::path font, float ui_scale)
    : display_(display), font_(std::move(font)), draw_(display.renderer()), textures_(display.renderer()) {
    memory_.textures = &textures_;
    create_gui_context(memory_);
    if (!init_imgui_platform(display.window(), display.renderer())) {
        ImGui::DestroyContext();
        throw Error(ErrorKind::Unavailable, "cannot connect the user interface to the window");
    }
    set_look(ui_scale, Theme::Dark);
}

Gui::~Gui() {
    ImGui_ImplSDL2_Shutdown();
    ImGui::DestroyContext();
}

void Gui::set_look(float ui_scale, Theme theme) {
    if (ui_scale == scale_ && theme == theme_) return;
    theme_ = theme;
    apply_style(ui_scale, theme);
    if (ui_scale == scale_) return;
    scale_ = ui_scale;
    load_fonts(font_, ui_scale);
    draw_.upload_fonts();
}

bool Gui::close_popups() {
    if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) return false;
    ImGui::SetWindowFocus(nullptr);  // without keyboard navigation Dear ImGui itself leaves them open
    return true;
}

void Gui::handle(const SDL_Event& event) {
    ImGui_ImplSDL2_ProcessEvent(&event);
    mouse_.handle(event);
}

void Gui::frame(double delta_seconds, const std::function<void()>& build) {
    ImGui_ImplSDL2_NewFrame();
    mouse_.write_to_imgui();
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = static_cast<float>(delta_seconds > 1.0e-4 ? delta_seconds : 1.0e-4);
    // Older platform code takes the scale of the pixels from OpenGL, which is not used here.
    int width = 0;
    int height = 0;
    SDL_GetRendererOutputSize(display_.renderer(), &width, &height);
    io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    io.DisplayFramebufferScale = {1.0f, 1.0f};
    ImGui::NewFrame();
    const bool moves = io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f;
    memory_.pointer_rest_seconds = moves ? 0.0f : memory_.pointer_rest_seconds + io.DeltaTime;
    memory_.places.clear();
    memory_.cut.clear();
    textures_.drop_unused();
    build();
    ImGui::Render();
}

void Gui::draw() { draw_.draw(*ImGui::GetDrawData()); }

namespace {

/// Lets arrows move between the controls of the chosen panel, or of a dialog.
void give_keys(const ViewerModel& model) {
    ImGuiIO& io = ImGui::GetIO();
    const auto& wanted = model.window().keyed_panel;
    if (wanted || model.open_dialog().is_shown())
        io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    else
        io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
    const int now = wanted ? static_cast<int>(*wanted) : -1;
    if (std::exchange(gui_memory().keyed_panel, now) == now) return;
    constexpr std::array kNames{"menu", "settings", "knowledge", "accuracy"};
    ImGui::SetWindowFocus(wanted ? kNames[static_cast<std::size_t>(now)] : nullptr);
}

}  // namespace

void draw_interface(ViewerModel& model, const Layout& layout, const Rect& image, const ComparePlan& plan,
                    const std::optional<PixelPosition>& hovered, const Magnifier* magnifier) {
    give_keys(model);
    if (layout.panels) {
        draw_menu_bar(model, layout);
        if (layout.left.width > 0.0f) draw_settings_panel(model, layout);
        if (layout.right.width > 0.0f) draw_knowledge_panel(model, layout, hovered);
        if (layout.accuracy.height > 0.0f) draw_accuracy_panel(model, layout);
        draw_status_bar(model, layout);
        draw_borders(model, layout);
    }
    for (const PicturePlace& picture : picture_places(plan, image, layout.view)) {
        ImDrawList& list = *ImGui::GetBackgroundDrawList();
        list.PushClipRect({picture.clip.x, picture.clip.y},
                          {picture.clip.x + picture.clip.width, picture.clip.y + picture.clip.height});
        draw_flowers(model, picture.place);
        draw_hemisphere(model, picture.place);
        draw_gain_marks(model, picture.place);
        draw_path_lines(model, picture.place);
        list.PopClipRect();
    }
    draw_pixels(model, layout, image, plan, magnifier);
    draw_comparison(model, plan);
    if (layout.panels) draw_badges(model, layout, plan);
    draw_tour(model, layout, common_part(image, layout.view), plan);
    if (!layout.panels) draw_show_panels(model);
    draw_toasts(model, layout, plan);
    draw_self_test(model, layout);
    draw_open_dialog(model, layout);
    draw_help(model, layout);
    draw_about(model, layout);
}

}  // namespace pl::ui
