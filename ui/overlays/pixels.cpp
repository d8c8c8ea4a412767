// Numbers in the pixels of a zoomed picture, and the magnifier's label.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/kernel/film/tonemap.h"
#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/overlays/overlays.h"

namespace pl::ui {
namespace {

constexpr float kSmallTextShare = 0.75f;  ///< height of the numbers in small pixels, of the font's
constexpr float kLeastPixelEm = 3.4f;     ///< four small lines of six characters fit
constexpr float kLargePixelEm = 5.0f;     ///< lines of the font's own height fit

/// One line of a pixel's text, in the color of its channel.
struct ValueLine {
    std::string text;
    ImU32 color;
};

std::array<ValueLine, 4> lines_of(Vec3f value) {
    return {{{short_value(value.x), IM_COL32(255, 150, 140, 255)},
             {short_value(value.y), IM_COL32(140, 235, 150, 255)},
             {short_value(value.z), IM_COL32(150, 190, 255, 255)},
             {"L " + short_value(luminance(value)), IM_COL32_WHITE}}};
}

bool is_valid(Vec3f value) { return std::isfinite(value.x + value.y + value.z); }

/// With a shade below, so that it can be read on any color.
void draw_line(ImDrawList& list, ImVec2 corner, float size, const ValueLine& line) {
    for (const ImVec2 shift : {ImVec2{1.0f, 1.0f}, ImVec2{-1.0f, 1.0f}, ImVec2{1.0f, -1.0f}, ImVec2{-1.0f, -1.0f}})
        list.AddText(ImGui::GetFont(), size, {corner.x + shift.x, corner.y + shift.y}, IM_COL32(0, 0, 0, 200),
                     line.text.c_str());
    list.AddText(ImGui::GetFont(), size, corner, line.color, line.text.c_str());
}

void draw_value(ImDrawList& list, const Rect& place, Vec3f value) {
    const float height = (place.width >= em(kLargePixelEm) ? 1.0f : kSmallTextShare) * ImGui::GetFontSize();
    const ImVec2 corner{place.x + 0.25f * height, place.y + 0.5f * (place.height - 4.0f * height)};
    if (!is_valid(value)) {
        list.AddRect({place.x + 1.0f, place.y + 1.0f}, {place.x + place.width - 1.0f, place.y + place.height - 1.0f},
                     colors::kError, 0.0f, 0, 2.0f);
        return draw_line(list, corner, height, {"invalid", colors::kError});
    }
    float y = corner.y;
    for (const ValueLine& line : lines_of(value)) {
        draw_line(list, {corner.x, y}, height, line);
        y += height;
    }
}

/// The values of all pixels of a picture of width x height inside `seen`.
template <class ValueOf>
void draw_values(const Rect& image, const Rect& seen, int width, int height, const ValueOf& value_of_pixel) {
    if (image.width < em(kLeastPixelEm) * static_cast<float>(width) || !(seen.width > 0.0f)) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({seen.x, seen.y}, {seen.x + seen.width, seen.y + seen.height}, true);
    const PixelPosition first = pixel_under(image, {seen.x, seen.y}, width, height);
    const PixelPosition last = pixel_under(image, {seen.x + seen.width, seen.y + seen.height}, width, height);
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
            if (const auto value = value_of_pixel(PixelPosition{x, y}))
                draw_value(list, pixel_place(image, {x, y}, width, height), *value);
    list.PopClipRect();
}

void draw_label(ImDrawList& list, const Magnifier& magnifier, const PointedPixel& pointed) {
    std::string text = fmt::format("{},{}", pointed.at.x, pointed.at.y);
    if (const auto& value = pointed.value)
        text += fmt::format("\n{}  {}  {}\n{}", short_value(value->x), short_value(value->y), short_value(value->z),
                            is_valid(*value) ? "luminance " + short_value(luminance(*value)) : "invalid");
    const Rect& box = magnifier.box;
    const ImVec2 low{box.x - 2.0f, box.y + box.height};
    const float height = ImGui::CalcTextSize(text.c_str()).y + em(0.4f);
    list.AddRectFilled(low, {box.x + box.width + 2.0f, low.y + height}, ImGui::GetColorU32(ImGuiCol_PopupBg, 0.94f));
    list.AddText({low.x + em(0.4f), low.y + em(0.2f)}, colors::kText, text.c_str());
}

/// The box itself is drawn by the window over everything.
void draw_magnifier(const Magnifier& magnifier, const PointedPixel& pointed) {
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const Rect& box = magnifier.box;
    list.AddRectFilled({box.x - 2.0f, box.y - 2.0f}, {box.x + box.width + 2.0f, box.y + box.height + 2.0f},
                       colors::kAccent);
    // The row and the column of the pixel, on the border.
    const Rect& middle = magnifier.middle;
    list.AddRectFilled({middle.x, box.y - 4.0f}, {middle.x + middle.width, box.y}, colors::kText);
    list.AddRectFilled({box.x - 4.0f, middle.y}, {box.x, middle.y + middle.height}, colors::kText);
    list.AddRectFilled({box.x + box.width, middle.y}, {box.x + box.width + 4.0f, middle.y + middle.height},
                       colors::kText);
    draw_label(list, magnifier, pointed);
}

}  // namespace

void draw_pixels(ViewerModel& model, const Layout& layout, const Rect& image, const ComparePlan& plan,
                 const Magnifier* magnifier) {
    WindowState& window = model.window();
    if (magnifier != nullptr && window.pointed) {
        window.values_shown = true;
        draw_magnifier(*magnifier, *window.pointed);
    }
    if (window.zoom.scale() < em(kLeastPixelEm) || model.frame() == nullptr) return;
    window.values_shown = true;
    const PublishedFrame& frame = *model.frame();
    for (const CompareTile& tile : plan.tiles) {
        const TileContent& content = tile.content;
        const int width = content.frame ? content.frame->snapshot.width : content.picture->width;
        const int height = content.frame ? content.frame->snapshot.height : content.picture->height;
        draw_values(tile.place, tile.clip, width, height, [&](PixelPosition at) { return value_of(content, at); });
    }
    if (plan.tiles.empty())
        draw_values(image, common_part(image, layout.view), frame.snapshot.width, frame.snapshot.height,
                    [&](PixelPosition at) { return value_of(frame, at); });
}

}  // namespace pl::ui
