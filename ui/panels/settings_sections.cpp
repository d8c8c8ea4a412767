#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/fields/field_choices.h"
#include "core/fields/field_kernels.h"
#include "ui/draw/imgui_draw.h"
#include "ui/draw/stream_texture.h"
#include "ui/draw/value_text.h"
#include "ui/draw/widgets.h"
#include "ui/input/perform_action.h"
#include "ui/model/thumbnail.h"
#include "ui/panels/panels.h"

namespace pl::ui {
namespace {

/// Refinement of the placement. Every change restarts pictures and fields.
void draw_refinement(ViewerModel& model, FieldSettings settings) {
    bool is_auto = settings.refine_share == kRefineByRecords;
    if (toggle_row(
            "Refine",
            "A method that learns splits volumes with many lookups whose neighbors disagree: up to twice as many, "
            "given enough training samples, unless the number of volumes is set.",
            &is_auto)) {
        settings.refine_share = is_auto ? kRefineByRecords : 0.0f;
        model.render().set_field(settings);
    }
    if (!is_auto && slider_row("Added share", "Volumes that refinement may add, as a share of the placed ones.",
                               &settings.refine_share, {0.0f, 1.0f, 0.0f, "%.2f"}))
        model.render().set_field(settings);
}

/// The targets of training samples and the learning rate. Every change restarts pictures and fields.
void draw_learning_targets(ViewerModel& model, FieldSettings settings) {
    bool changed = choice_row("Learn rate", "Step of an update.", &settings.rate);
    changed |= choice_row("Learn target", "Of a training sample. Only tables learn from others than the first.",
                          &settings.learning.target);
    changed |= choice_row("Learn from", "With light samples, what a method learns.", &settings.learning.light);
    if (changed) model.render().set_field(settings);
}

/// Number of passes and training samples of the method on show.
void draw_learned_amount(const ViewerModel& model) {
    const std::optional<FieldStatus>& field = model.status().field;
    const MethodInfo& method = info_of(model.render().method());
    const std::string none = method.uses_field ? "nothing yet" : fmt::format("{} has no field", method.label);
    // A line each, also without a field: what is below them keeps its place.
    text_row("Learned", field ? passes_text(field->passes) : none, "Camera moves keep the field.");
    text_row("Samples", field ? short_number(static_cast<double>(field->records)) : "-",
             "Training samples of the field.");
}

/// The field and the mixture with the BSDF. Changes of the field restart pictures and fields.
void draw_field(ViewerModel& model) {
    MixtureSettings mixture = model.render().settings().mixture;
    bool learned = mixture.learned != 0;
    if (toggle_row("Learned share", "A method that learns also learns the BSDF fraction of each volume.", &learned)) {
        mixture.learned = learned ? 1 : 0;
        model.render().set_mixture(mixture);
    }
    ImGui::BeginDisabled(learned && info_of(model.render().method()).learns);
    if (slider_row("BSDF share",
                   "Of directions sampled from the BSDF instead of the field, where it is not learned: "
                   "--bsdf-fraction.",
                   &mixture.bsdf_fraction, {kMinBsdfFraction, 1.0f, MixtureSettings{}.bsdf_fraction, "%.2f"}))
        model.render().set_mixture(mixture);
    ImGui::EndDisabled();
    FieldSettings settings = model.render().settings().field;
    if (choice_row("Field", "How a method that learns represents directions; precomputed maps are tables.",
                   &settings.representation)) {
        if (!has_target(settings.representation, settings.learning.target))
            settings.learning.target = LearningTarget::ExpectedSarsa;
        model.render().set_field(settings);
    }
    int volumes = settings.volumes;
    if (int_row("Volumes",
                "Number of radiance volumes; 0: as many as the memory holds, at most 1000. More volumes learn more "
                "slowly.",
                &volumes, 100, "automatic")) {
        settings.volumes = std::clamp(volumes, 0, 1000000);
        model.render().set_field(settings);
    }
    draw_refinement(model, settings);
    constexpr int kLeastSide = 2, kMostSide = 32;
    std::vector<std::string> squares;
    for (int side = kLeastSide; side <= kMostSide; ++side) squares.push_back(std::to_string(side * side));
    int step = static_cast<int>(std::lround(std::sqrt(settings.bins))) - kLeastSide;
    if (choice_row("Bins", "Directions of a volume: cells of its hemisphere.", &step, squares)) {
        settings.bins = (kLeastSide + step) * (kLeastSide + step);
        model.render().set_field(settings);
    }
    draw_learning_targets(model, settings);
}

}  // namespace

void draw_learning_section(ViewerModel& model) {
    if (!section("Learning", true)) return;
    draw_learned_amount(model);
    if (is_research(model)) draw_field(model);
    if (wide_button("Forget the learned field", "Ctrl+Shift+R: clears pictures and fields.")) model.render().forget();
}

namespace {

struct BookmarkEdit {
    std::optional<std::size_t> removed;
    std::optional<std::size_t> moved;
    int places = 0;
};

void draw_picture(const CameraBookmarks::Bookmark& bookmark, std::size_t index, bool is_current, ImVec2 low,
                  ImVec2 high) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (SDL_Texture* const texture = bookmark.picture ? texture_of(bookmark.picture) : nullptr)
        list.AddImage(to_texture_id(texture), low, high);
    else
        list.AddRectFilled(low, high, colors::kBadge);
    const std::string number = fmt::format("{}", index + 1);
    const ImVec2 size = ImGui::CalcTextSize(number.c_str());
    list.AddRectFilled(low, {low.x + size.x + em(0.4f), low.y + size.y}, colors::kBadge);
    list.AddText({low.x + em(0.2f), low.y}, colors::kText, number.c_str());
    if (is_current) list.AddRect(low, high, colors::kAccent, 0.0f, 0, 2.0f);
}

void draw_menu(std::size_t index, std::size_t count, BookmarkEdit& edit) {
    if (!ImGui::BeginPopupContextItem("bookmark menu")) return;
    const auto move_item = [&](const char* label, int places, bool is_possible) {
        if (!ImGui::MenuItem(label, nullptr, false, is_possible)) return;
        edit.moved = index;
        edit.places = places;
    };
    move_item("One place earlier", -1, index > 0);
    move_item("One place later", 1, index + 1 < count);
    if (ImGui::MenuItem("Remove")) edit.removed = index;
    ImGui::EndPopup();
}

/// All bookmarks, three in a row.
void draw_bookmarks(ViewerModel& model) {
    constexpr int kColumns = 3;
    CameraBookmarks& bookmarks = model.bookmarks();
    const float gap = em(0.3f);
    const float width = std::floor((ImGui::GetContentRegionAvail().x + gap) / kColumns - gap);
    const float height = std::floor(width * kThumbnailHeight / kThumbnailWidth);
    BookmarkEdit edit;
    std::optional<std::size_t> shown;
    for (std::size_t i = 0; i < bookmarks.list().size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (i % kColumns > 0) ImGui::SameLine(0.0f, gap);
        const ImVec2 low = ImGui::GetCursorScreenPos();
        if (ImGui::InvisibleButton("bookmark", {width, height})) shown = i;
        note_place(fmt::format("bookmark {}", i + 1).c_str());
        tooltip("A click shows it, a right click moves or removes it.");
        draw_menu(i, bookmarks.list().size(), edit);
        draw_picture(bookmarks.list()[i], i, bookmarks.current() == i, low, {low.x + width, low.y + height});
        ImGui::PopID();
    }
    if (shown) bookmarks.show(*shown);
    if (edit.moved) bookmarks.move(*edit.moved, edit.places);
    if (edit.removed) bookmarks.remove(*edit.removed);
}

void draw_sequence(ViewerModel& model) {
    SequenceWriter& sequence = model.sequence();
    SequenceWriter::Options& options = sequence.options();
    if (int_row("Frames", "Pictures from the first bookmark to the last.", &options.frames, 24))
        options.frames = std::clamp(options.frames, 2, 1000000);
    if (int_row("Samples each", "Samples per pixel of a frame. 0: no limit.", &options.spp, 64, "no limit"))
        options.spp = std::clamp(options.spp, 0, 1000000000);
    double seconds = static_cast<double>(options.seconds);
    if (double_row("Seconds each", "Work for a frame; the first limit ends it. 0: no limit.", &seconds, 1.0, "%.1f",
                   "no limit"))
        options.seconds = static_cast<float>(std::max(seconds, 0.0));
    choice_row("Files", "Kind of the pictures.", &options.kind);
    const bool is_writing = sequence.progress().has_value();
    if (wide_button(is_writing ? "Stop writing" : "Write the path as pictures",
                    "Frame by frame, in the window; learning goes on between them. PNG frames also become a film, "
                    "where ffmpeg "
                    "is installed. Esc stops, and the frames so far stay.")) {
        if (is_writing)
            sequence.stop();
        else
            sequence.begin();
    }
    note_place("write path");
}

}  // namespace

void draw_cameras(ViewerModel& model) {
    if (!section("Bookmarks", false)) return;
    draw_bookmarks(model);
    if (wide_button("Bookmark the camera",
                    "F8; F9 and Shift+F9 step through them. They belong to this scene, and stay."))
        perform(model, ActionId::AddBookmark);
    note_place("add bookmark");
    if (model.bookmarks().list().size() < CameraPath::kFewest)
        return faint_text("Two bookmarks or more are a path to fly along.");
    float seconds = model.flight().seconds_per_camera();
    if (slider_row("Seconds", "From each bookmark to the next, when the path is played.", &seconds,
                   {0.2f, 20.0f, 2.0f, "%.1f s", ImGuiSliderFlags_Logarithmic}))
        model.flight().seconds_per_camera() = seconds;
    if (wide_button(model.flight().is_flying() ? "Stop" : "Fly along the path", "F10"))
        perform(model, ActionId::PlayPath);
    note_place("fly path");
    draw_sequence(model);
}

}  // namespace pl::ui
