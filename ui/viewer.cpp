#include "ui/viewer.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <time.h>

#include <SDL.h>

#include "core/base/error.h"
#include "ui/compare/compare_layer.h"
#include "ui/compare/compare_plan.h"
#include "ui/draw/picture_zoom.h"
#include "ui/draw/style.h"
#include "ui/input/input_router.h"
#include "ui/model/window_memory.h"
#include "ui/script/script_player.h"
#include "ui/script/ui_trace.h"
#include "ui/window/frame_pacing.h"
#include "ui/window/gui.h"
#include "ui/window/image_layer.h"

namespace pl::ui {
namespace {

constexpr double kLongestDelta = 0.1;  ///< seconds that one frame may move the camera

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor time of the calling thread.
double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1.0e-9 * static_cast<double>(time.tv_nsec);
}

ByteImage part_of(const ByteImage& image, const Rect& place) {
    const int x = std::clamp(static_cast<int>(place.x), 0, image.width - 1);
    const int y = std::clamp(static_cast<int>(place.y), 0, image.height - 1);
    ByteImage part{.width = std::min(static_cast<int>(place.width), image.width - x),
                   .height = std::min(static_cast<int>(place.height), image.height - y),
                   .rgb = {}};
    const auto row = 3 * static_cast<std::size_t>(part.width);
    for (int line = 0; line < part.height; ++line) {
        const auto first = image.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y + line) * image.width + x);
        part.rgb.insert(part.rgb.end(), first, first + static_cast<std::ptrdiff_t>(row));
    }
    return part;
}

/// Empty: nothing is remembered.
std::filesystem::path memory_file(const ViewerOptions& options) {
    if (!options.remember) return "";
    std::filesystem::path folder = options.remember_folder;
    if (folder.empty()) {
        char* const system_folder = SDL_GetPrefPath("pathlight", "pathlight");
        if (system_folder == nullptr) return "";  // no home
        folder = system_folder;
        SDL_free(system_folder);
    }
    return folder / "viewer.json";
}

/// Scripts see all of the window.
WindowMemory first_memory(const ViewerOptions& options) {
    WindowMemory memory;
    if (options.script) memory.layout = WindowLayout::Research;
    return memory;
}

/// Options have priority over remembered values.
WindowOptions window_options(WindowOptions options, const WindowMemory& memory) {
    if (options.ui_scale == 0.0f) options.ui_scale = memory.ui_scale;
    return options;
}

std::optional<WindowPlace> first_place(const WindowOptions& options, const WindowMemory& memory) {
    return options.width > 0 ? std::nullopt : memory.place;
}

/// The window, its panels and the model behind them.
class Viewer {
public:
    Viewer(const ViewerOptions& options, std::shared_ptr<const SceneDescription> scene, double load_seconds);
    void run();
    void remember();
    void print_trace();

private:
    bool is_over();
    void wait_for_events();
    void dispatch(const SDL_Event& event);
    WindowActivity activity() const;
    bool is_over_card() const;
    bool wants_keys(bool is_escape, bool is_tab) const;
    void trace_inputs();
    void build_panels();
    void zoom_to_pixels();
    void point_at_pixel();
    std::optional<PixelPosition> hovered_pixel() const;
    void show();
    void answer_requests();
    WindowMemory memory_now() const;
    void reset_window();
    bool is_first_look() const { return options_.is_free && memory_.is_new(); }
    void show_learning();
    Layout current_layout() const;
    RenderSettings first_settings(const SceneDescription& scene) const;

    const ViewerOptions& options_;
    RememberedWindow memory_;
    Display display_;
    Gui gui_;
    ImageLayer image_layer_;
    CompareLayer compare_layer_;
    ComparePlan plan_;
    InputRouter input_;
    ViewerModel model_;
    std::optional<ScriptPlayer> script_;
    std::optional<UiTrace> trace_;
    Layout layout_;
    Rect image_;
    std::optional<Magnifier> magnifier_;
    double start_ = steady_seconds();
    FramePacing pacing_{start_};
    std::string title_;
};

Viewer::Viewer(const ViewerOptions& options, std::shared_ptr<const SceneDescription> scene, double load_seconds)
    : options_(options), memory_(memory_file(options), first_memory(options)),
      display_("pathlight", window_options(options.window, memory_.last()),
               first_place(options.window, memory_.last()), options.software),
      gui_(display_, options.font, display_.ui_scale()), image_layer_(display_.renderer()),
      compare_layer_(display_.renderer()), input_(display_.window()),
      model_(options, scene, first_settings(*scene), load_seconds) {
    model_.messages().note(MessageLevel::Info, "window drawn by " + display_.renderer_name());
    restore(memory_.last(), model_);
    if (const auto file = memory_file(options); !file.empty())
        model_.bookmarks().set_folder(file.parent_path() / "cameras");
    if (!memory_.problem().empty()) model_.messages().say(MessageLevel::Warning, memory_.problem());
    model_.window().ui_scale = display_.ui_scale();
    if (options.remember && (!options.script || is_first_look())) model_.tour().offer();
    if (is_first_look()) show_learning();
    if (options.script) script_.emplace(load_script(*options.script), display_.window());
    if (options.ui_trace) trace_.emplace(*options.ui_trace);
    layout_ = current_layout();
    image_ = image_layer_.place(model_, layout_.view);
}

/// Learning beside what happens without it, where it shows: without light samples, and bright.
void Viewer::show_learning() {
    constexpr float kBright = 1.25f;  // stops: the Cornell box is dark at 0
    model_.display().set_exposure(kBright);
    model_.comparison().set_turns(true);
}

Layout Viewer::current_layout() const {
    int width = 0;
    int height = 0;
    SDL_GetRendererOutputSize(display_.renderer(), &width, &height);
    return make_layout(static_cast<float>(width), static_cast<float>(height), kFontPixels * model_.window().ui_scale,
                       model_.window().panels,
                       model_.selection().volume() != kNoVolume || model_.paths().paths() != nullptr);
}

RenderSettings Viewer::first_settings(const SceneDescription& scene) const {
    RenderSettings settings = options_.settings;
    if (options_.camera_from_scene) settings.camera = scene.camera;
    if (is_first_look()) {
        settings.method = learning_method();
        settings.next_event = false;
    }
    if (options_.size_from_window) {
        int width = 0;
        int height = 0;
        SDL_GetRendererOutputSize(display_.renderer(), &width, &height);
        const Layout layout = make_layout(static_cast<float>(width), static_cast<float>(height),
                                          kFontPixels * display_.ui_scale(), memory_.last().panels, false);
        const glm::ivec2 size = fit_image(layout.view, settings.width, settings.height);
        settings.width = size.x;
        settings.height = size.y;
    }
    return settings;
}

bool Viewer::is_over() {
    if (options_.stop != nullptr && *options_.stop) return true;
    bool& quit = model_.window().requests.quit;
    if (script_ && script_->ignores_quit()) quit = false;
    return quit;
}

void Viewer::run() {
    while (!is_over()) {
        wait_for_events();
        const double now = steady_seconds();
        const double cpu_start = thread_seconds();
        const double delta = pacing_.begin(now);
        if (script_) script_->step(model_, image_, now);
        SDL_Event event;
        while (SDL_PollEvent(&event) != 0) dispatch(event);
        model_.update(now - start_);
        const double moved = script_ ? ScriptPlayer::kFrameSeconds : std::min(delta, kLongestDelta);
        model_.camera().fly(model_.has_dialog() ? MoveKeys{} : input_.move_keys(), moved);
        trace_inputs();
        memory_.update(memory_now(), now - start_, model_.messages());
        const std::uint64_t serial = model_.frame() != nullptr ? model_.frame()->serial : 0;
        if (!pacing_.needs_redraw(now, serial, activity())) continue;

        gui_.set_look(model_.window().ui_scale, model_.window().theme);
        gui_.frame(moved, [this] { build_panels(); });
        answer_requests();
        show();
        const double end = steady_seconds();
        const double interval = pacing_.end(end);
        if (trace_)
            trace_->frame_shown(end - start_, {end - now, thread_seconds() - cpu_start, interval},
                                model_.frame() != nullptr ? model_.frame()->generation : 0);
    }
}

WindowActivity Viewer::activity() const {
    const WorkerState state = model_.status().state;
    const bool has_toasts = !model_.messages().toasts().empty();
    return {.is_scripted = script_.has_value(),
            .has_input = input_.active(),
            .is_working = model_.camera().is_moving() || model_.busy(),
            .is_at_rest = (state == WorkerState::Paused || state == WorkerState::Done) && !has_toasts,
            .has_toasts = has_toasts};
}

void Viewer::wait_for_events() {
    const double left = pacing_.sleep_seconds(steady_seconds(), activity());
    if (left <= 0.0) return;
    if (script_)
        SDL_Delay(static_cast<Uint32>(left * 1000.0));
    else
        SDL_WaitEventTimeout(nullptr, std::max(1, static_cast<int>(left * 1000.0)));
}

void Viewer::dispatch(const SDL_Event& event) {
    pacing_.note_event(steady_seconds());
    if (event.type == SDL_WINDOWEVENT) {
        if (event.window.event == SDL_WINDOWEVENT_MINIMIZED || event.window.event == SDL_WINDOWEVENT_HIDDEN)
            pacing_.set_hidden(true);
        if (event.window.event == SDL_WINDOWEVENT_RESTORED || event.window.event == SDL_WINDOWEVENT_SHOWN ||
            event.window.event == SDL_WINDOWEVENT_EXPOSED)
            pacing_.set_hidden(false);
    }
    const ImGuiIO& io = ImGui::GetIO();
    // Tab moves between fields only while text is typed; else it hides the panels.
    const bool is_tab = event.type == SDL_KEYDOWN && event.key.keysym.scancode == SDL_SCANCODE_TAB;
    if (!is_tab || io.WantTextInput) gui_.handle(event);
    // Esc closes the topmost only: a menu or list before anything behind it.
    const bool is_escape = event.type == SDL_KEYDOWN && event.key.keysym.scancode == SDL_SCANCODE_ESCAPE;
    if (is_escape && !io.WantTextInput && gui_.close_popups()) return;
    input_.handle(event, model_,
                  {place_under(picture_places(plan_, image_, layout_.view), input_.pointer()), layout_.view,
                   io.WantCaptureMouse || is_over_card(), wants_keys(is_escape, is_tab),
                   script_ ? script_->seconds() : steady_seconds() - start_});
}

/// Dear ImGui knows only in the next frame that the pointer is on a card: the press of a finger comes with its motion.
bool Viewer::is_over_card() const {
    if (model_.tour().phase() == GuidedTour::Phase::Off)
        return false;  // clicks go through a headline without buttons
    const auto& places = gui_memory().places;
    return std::ranges::any_of(std::array{"tour", "headline"}, [&](const char* name) {
        const auto card = places.find(name);
        return card != places.end() && card->second.contains(input_.pointer());
    });
}

/// Whether a dialog, a text field or the panels have the keyboard; Esc and the key of the panels lead out of them.
bool Viewer::wants_keys(bool is_escape, bool is_tab) const {
    if (model_.has_dialog()) return !is_escape;
    if (model_.window().keyed_panel && !ImGui::GetIO().WantTextInput) return !is_escape && !is_tab;
    return ImGui::GetIO().WantTextInput;
}

void Viewer::trace_inputs() {
    if (!trace_) return;
    const double now = steady_seconds() - start_;
    trace_->camera_moved(now, model_.camera().generation());
    trace_->backend_asked(now, model_.render().backend_generation());
}

void Viewer::build_panels() {
    layout_ = current_layout();
    model_.window().one_side = layout_.one_side;
    if (std::exchange(model_.window().requests.zoom, false)) zoom_to_pixels();
    image_ = image_layer_.place(model_, layout_.view);
    plan_ = model_.comparison().plan(layout_.view, model_.window().zoom);
    point_at_pixel();
    model_.window().is_dragging = ImGui::IsAnyItemActive();
    model_.window().values_shown = false;  // panels that show values set it again
    draw_interface(model_, layout_, image_, plan_, layout_.panels ? hovered_pixel() : std::nullopt,
                   magnifier_ ? &*magnifier_ : nullptr);
}

/// 1:1 around the pointer, or the whole picture.
void Viewer::zoom_to_pixels() {
    const RenderSettings settings = model_.render().settings();
    const Vec2f pointer = layout_.view.contains(input_.pointer()) ? input_.pointer() : layout_.view.center();
    model_.window().zoom.toggle(pointer, layout_.view, settings.width, settings.height);
}

/// The pixel under the pointer: of the compared picture there, else of the picture.
void Viewer::point_at_pixel() {
    WindowState& window = model_.window();
    const bool is_over = layout_.view.contains(input_.pointer()) && !ImGui::GetIO().WantCaptureMouse;
    window.pointed = is_over && model_.frame() != nullptr
                         ? pointed_pixel(plan_, *model_.frame(), image_, input_.pointer())
                         : std::nullopt;
    magnifier_.reset();
    window.magnifier = window.pointed && input_.is_held(ActionId::Magnify);
    if (window.magnifier)
        magnifier_ = magnifier_at(plan_, *model_.frame(), image_, input_.pointer(), layout_.view, em(1.0f));
}

std::optional<PixelPosition> Viewer::hovered_pixel() const {
    const auto& pointed = model_.window().pointed;
    if (!pointed) return std::nullopt;
    const Snapshot& snapshot = model_.frame()->snapshot;
    const Rect place = place_under(picture_places(plan_, image_, layout_.view), input_.pointer());
    return pixel_under(place, input_.pointer(), snapshot.width, snapshot.height);
}

void Viewer::answer_requests() {
    WindowRequests& requests = model_.window().requests;
    if (std::exchange(requests.full_screen, false)) display_.toggle_full_screen();
    if (std::exchange(requests.paste, false)) {
        const char* const text = ImGui::GetClipboardText();  // null without text
        model_.files().paste(text != nullptr ? text : "");
    }
    if (std::exchange(requests.reset, false)) reset_window();
    if (std::exchange(requests.fit_size, false)) {
        const RenderSettings settings = model_.render().settings();
        const glm::ivec2 size = fit_image(layout_.view, settings.width, settings.height);
        model_.render().set_size(size.x, size.y);
    }
    if (std::string title = model_.title(); title != title_) {
        title_ = std::move(title);
        display_.set_title(title_);
    }
}

/// A size or scale from the command line is for this run only.
WindowMemory Viewer::memory_now() const {
    WindowMemory memory = memory_of(model_, memory_.last());
    if (options_.window.width == 0) memory.place = display_.place(memory.place);
    if (model_.window().ui_scale != display_.ui_scale()) memory.ui_scale = model_.window().ui_scale;
    return memory;
}

void Viewer::reset_window() {
    const WindowMemory first = first_memory(options_);
    display_.reset();
    restore(first, model_);
    model_.window().panels.shown = true;
    model_.window().ui_scale = display_.ui_scale();
    memory_.forget(first, model_.messages().now(), model_.messages());
}

void Viewer::remember() {
    if (const std::string failure = memory_.finish(memory_now()); !failure.empty())
        std::fprintf(stderr, "pathlight: warning: %s\n", failure.c_str());
}

void Viewer::show() {
    SDL_SetRenderDrawColor(display_.renderer(), 12, 13, 16, 255);
    SDL_RenderClear(display_.renderer());
    if (plan_.tiles.empty()) image_layer_.draw(model_, image_, layout_.view);
    compare_layer_.draw(plan_, model_.display().settings(), image_layer_.overlay(model_));
    gui_.draw();
    if (magnifier_) {  // over the overlays, whose lines are not magnified
        if (plan_.tiles.empty()) image_layer_.magnify(*magnifier_);
        compare_layer_.magnify(plan_, *magnifier_);
    }
    if (std::exchange(model_.window().requests.window_shot, false))
        model_.files().pictures().save_window(display_.read_pixels(), model_.files().pictures().next_window_shot());
    if (std::exchange(model_.window().requests.view_shot, false))
        model_.files().pictures().save_window(part_of(display_.read_pixels(), layout_.clear),
                                              model_.files().pictures().next_view_shot());
    if (std::exchange(model_.window().requests.view_copy, false))
        model_.files().pictures().copy_view(part_of(display_.read_pixels(), layout_.clear));
    if (model_.past_film().wants_pixels()) model_.past_film().add(display_.read_pixels());
    if (script_) {
        if (const auto path = script_->take_shot())
            model_.files().pictures().save_window(display_.read_pixels(), *path);
    }
    SDL_RenderPresent(display_.renderer());
}

void Viewer::print_trace() {
    if (trace_) std::fputs(trace_->finish().c_str(), stderr);
}

}  // namespace

int run_viewer(const ViewerOptions& options) {
    // A script needs no screen; a driver named in the environment has priority.
    if (options.script && std::getenv("SDL_VIDEODRIVER") == nullptr) SDL_setenv("SDL_VIDEODRIVER", "dummy", 1);
    if (options.script) (void)load_script(*options.script);  // report its mistakes before a window opens

    std::shared_ptr<const SceneDescription> scene = options.scene;
    double load_seconds = options.load_seconds;
    if (!scene) {
        const double start = steady_seconds();
        scene = options.load_scene({options.scene_name});
        load_seconds = steady_seconds() - start;
    }
    Viewer viewer(options, std::move(scene), load_seconds);
    viewer.run();
    viewer.remember();
    viewer.print_trace();
    return 0;
}

}  // namespace pl::ui
