#include "ui/window/draw_interface.h"

namespace pl::ui {

void draw_interface(ViewerModel& model, const Layout& layout, const Rect& image, const ComparePlan& plan,
                    const std::optional<HoveredPixel>& hovered, const Magnifier* magnifier) {
    if (layout.panels) {
        draw_menu_bar(model, layout);
        if (layout.left.width > 0.0f) draw_settings_panel(model, layout);
        if (layout.right.width > 0.0f) draw_knowledge_panel(model, layout, hovered);
        if (layout.accuracy.height > 0.0f) draw_accuracy_panel(model, layout);
        draw_status_bar(model, layout);
        draw_borders(model, layout);
    }
    if (plan.at_image) draw_flowers(model, image);
    if (plan.at_image) draw_hemisphere(model, image);
    if (plan.at_image) draw_gain_marks(model, image);
    if (plan.at_image) draw_path_lines(model, image);
    draw_pixels(model, layout, image, plan, magnifier);
    draw_comparison(model, plan);
    if (layout.panels) draw_badges(model, layout, plan);
    draw_tour(model, layout, common_part(image, layout.view));
    if (!layout.panels) draw_show_panels(model);
    draw_toasts(model, layout, plan);
    draw_self_test(model, layout);
    draw_open_dialog(model, layout);
    draw_help(model, layout);
}

}  // namespace pl::ui
