#include "ui/viewer.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <time.h>

#include <SDL.h>

#include "core/base/error.h"
#include "ui/compare/compare_layer.h"
#include "ui/draw_interface.h"
#include "ui/gui.h"
#include "ui/image_layer.h"
#include "ui/input_router.h"
#include "ui/script_player.h"
#include "ui/ui_trace.h"

namespace pl {
namespace {

constexpr double kFrameSeconds = 1.0 / 60.0;
constexpr int kIdleWaitMs = 250;        ///< nothing changes: only look now and then
constexpr double kStatusSeconds = 0.1;  ///< while rendering: counters move although no new picture is there
constexpr double kSettleSeconds = 0.6;  ///< after an event: panels come to rest, tooltips appear
constexpr double kIdleSeconds = 1.0;    ///< between two frames that show nothing new
constexpr double kLongestDelta = 0.1;

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Processor time of the calling thread.
double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1.0e-9 * static_cast<double>(time.tv_nsec);
}

/// A window, its panels and the model behind them.
class Viewer {
public:
    Viewer(const ViewerOptions& options, std::shared_ptr<const SceneDescription> scene, double load_seconds);
    void run();
    void print_trace();

private:
    void wait_for_events();
    void dispatch(const SDL_Event& event);
    bool needs_redraw(double now);
    void trace_inputs();
    void build_panels();
    void show();
    void do_window_wishes();
    Layout current_layout() const;
    RenderSettings first_settings(const SceneDescription& scene) const;

    const ViewerOptions& options_;
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
    double start_ = steady_seconds();
    double last_frame_ = start_;
    double last_shown_ = -1.0;
    std::uint64_t shown_frames_ = 0;  ///< of the render thread
    std::uint64_t traced_camera_ = 0;
    std::uint64_t traced_backend_ = 0;
    double settle_until_ = 0.0;  ///< until then every frame is drawn
    bool idle_ = false;
    bool rested_ = true;
    bool hidden_ = false;
    std::string title_;
};

Viewer::Viewer(const ViewerOptions& options, std::shared_ptr<const SceneDescription> scene, double load_seconds)
    : options_(options), display_("pathlight", options.width, options.height, options.software),
      gui_(display_, options.font, 1.0f), image_layer_(display_.renderer()), compare_layer_(display_.renderer()),
      input_(display_.window()), model_(options, scene, first_settings(*scene), load_seconds) {
    if (options.script) script_.emplace(load_script(*options.script), display_.window());
    if (options.ui_trace) trace_.emplace(*options.ui_trace);
    model_.note(LogLevel::Info, "window drawn by " + display_.renderer_name());
    layout_ = current_layout();
    image_ = image_layer_.place(model_, layout_.view);
}

Layout Viewer::current_layout() const {
    int width = 0;
    int height = 0;
    SDL_GetRendererOutputSize(display_.renderer(), &width, &height);
    return make_layout(static_cast<float>(width), static_cast<float>(height), kFontPixels * model_.window().ui_scale,
                       model_.window().panels, model_.window().accuracy);
}

RenderSettings Viewer::first_settings(const SceneDescription& scene) const {
    RenderSettings settings = options_.settings;
    if (options_.camera_from_scene) settings.camera = scene.camera;
    if (options_.size_from_window) {
        int width = 0;
        int height = 0;
        SDL_GetRendererOutputSize(display_.renderer(), &width, &height);
        const Layout layout =
            make_layout(static_cast<float>(width), static_cast<float>(height), kFontPixels, true, true);
        const ImageSize size = fit_image(layout.view, settings.width, settings.height);
        settings.width = size.width;
        settings.height = size.height;
    }
    return settings;
}

void Viewer::run() {
    while (!model_.window().quit_asked) {
        wait_for_events();
        const double now = steady_seconds();
        const double cpu_start = thread_seconds();
        const double delta = script_ ? ScriptPlayer::kFrameSeconds : std::min(now - last_frame_, kLongestDelta);
        if (script_) script_->step(model_, image_, now);
        SDL_Event event;
        while (SDL_PollEvent(&event) != 0) dispatch(event);
        model_.update(now - start_);
        model_.fly(input_.move_keys(), delta);
        trace_inputs();
        last_frame_ = now;
        if (!needs_redraw(now)) continue;

        gui_.set_scale(model_.window().ui_scale);
        gui_.frame(delta, [this] { build_panels(); });
        do_window_wishes();
        show();
        const double end = steady_seconds();
        if (trace_)
            trace_->frame_shown(end - start_,
                                {end - now, thread_seconds() - cpu_start, rested_ ? -1.0 : end - last_shown_},
                                model_.frame() != nullptr ? model_.frame()->generation : 0);
        last_shown_ = end;
        rested_ = false;
    }
}

/// Sleeps until the next frame is due; while nothing happens, much longer.
void Viewer::wait_for_events() {
    const WorkerState state = model_.status().state;
    const bool at_rest = (state == WorkerState::Paused || state == WorkerState::Done) && model_.toasts().empty();
    idle_ = !script_ && steady_seconds() > settle_until_ && !input_.active() && !model_.moving() && !model_.busy() &&
            (at_rest || hidden_);
    if (idle_) {
        rested_ = true;
        SDL_WaitEventTimeout(nullptr, kIdleWaitMs);
        return;
    }
    const double left = last_frame_ + kFrameSeconds - steady_seconds();
    if (left <= 0.0) return;
    if (script_)
        SDL_Delay(static_cast<Uint32>(left * 1000.0));
    else
        SDL_WaitEventTimeout(nullptr, std::max(1, static_cast<int>(left * 1000.0)));
}

void Viewer::dispatch(const SDL_Event& event) {
    settle_until_ = steady_seconds() + kSettleSeconds;
    if (event.type == SDL_WINDOWEVENT) {
        if (event.window.event == SDL_WINDOWEVENT_MINIMIZED || event.window.event == SDL_WINDOWEVENT_HIDDEN)
            hidden_ = true;
        if (event.window.event == SDL_WINDOWEVENT_RESTORED || event.window.event == SDL_WINDOWEVENT_SHOWN ||
            event.window.event == SDL_WINDOWEVENT_EXPOSED)
            hidden_ = false;
    }
    const ImGuiIO& io = ImGui::GetIO();
    // Tab goes from field to field only while one is being typed in; else it hides the panels.
    const bool is_tab = event.type == SDL_KEYDOWN && event.key.keysym.scancode == SDL_SCANCODE_TAB;
    if (!is_tab || io.WantTextInput) gui_.handle(event);
    input_.handle(event, model_,
                  {plan_.at_image ? image_ : Rect{}, layout_.view, io.WantCaptureMouse, io.WantTextInput,
                   steady_seconds() - start_});
}

void Viewer::trace_inputs() {
    if (!trace_) return;
    const double now = steady_seconds() - start_;
    if (model_.camera_generation() != traced_camera_) {
        traced_camera_ = model_.camera_generation();
        trace_->camera_moved(now, traced_camera_);
    }
    if (model_.backend_generation() != traced_backend_) {
        traced_backend_ = model_.backend_generation();
        trace_->backend_asked(now, traced_backend_);
    }
}

bool Viewer::needs_redraw(double now) {
    if (hidden_) return false;
    const std::uint64_t frames = model_.frame() != nullptr ? model_.frame()->serial : 0;
    const bool new_picture = frames != shown_frames_;
    shown_frames_ = frames;
    const double longest = idle_ ? kIdleSeconds : kStatusSeconds;
    return script_ || new_picture || now < settle_until_ || input_.active() || !model_.toasts().empty() ||
           now - last_shown_ >= longest;
}

void Viewer::build_panels() {
    layout_ = current_layout();
    image_ = image_layer_.place(model_, layout_.view);
    plan_ = model_.compare_plan(layout_.view);
    model_.window().values_shown = false;  // the tab sets it again if it shows some
    std::optional<HoveredPixel> hovered;
    if (layout_.panels) {
        const PublishedFrame* frame = model_.frame();
        if (frame != nullptr && plan_.at_image && image_.contains(input_.pointer()) &&
            !ImGui::GetIO().WantCaptureMouse) {
            const Vec2f at = input_.pointer() - Vec2f{image_.x, image_.y};
            hovered = HoveredPixel{
                std::min(static_cast<int>(at.x / image_.width * static_cast<float>(frame->snapshot.width)),
                         frame->snapshot.width - 1),
                std::min(static_cast<int>(at.y / image_.height * static_cast<float>(frame->snapshot.height)),
                         frame->snapshot.height - 1)};
        }
    }
    draw_interface(model_, layout_, image_, plan_, hovered);
}

void Viewer::do_window_wishes() {
    WindowState& window = model_.window();
    if (std::exchange(window.full_screen_asked, false)) display_.toggle_full_screen();
    if (std::exchange(window.fit_size_asked, false)) {
        const ImageSize size = fit_image(layout_.view, model_.settings().width, model_.settings().height);
        model_.set_size(size.width, size.height);
    }
    if (std::string title = model_.title(); title != title_) {
        title_ = std::move(title);
        display_.set_title(title_);
    }
}

void Viewer::show() {
    SDL_SetRenderDrawColor(display_.renderer(), 12, 13, 16, 255);
    SDL_RenderClear(display_.renderer());
    if (plan_.tiles.empty()) image_layer_.draw(model_, image_);
    compare_layer_.draw(plan_, model_.display());
    gui_.draw();
    if (std::exchange(model_.window().window_shot_asked, false))
        model_.save_window(display_.read_pixels(), model_.next_window_shot());
    if (script_) {
        if (const auto path = script_->take_shot()) model_.save_window(display_.read_pixels(), *path);
    }
    SDL_RenderPresent(display_.renderer());
}

void Viewer::print_trace() {
    if (trace_) std::fputs(trace_->finish().c_str(), stderr);
}

}  // namespace

int run_viewer(const ViewerOptions& options) {
    // A script needs no screen; a driver that the environment names wins.
    if (options.script && std::getenv("SDL_VIDEODRIVER") == nullptr) SDL_setenv("SDL_VIDEODRIVER", "dummy", 1);
    if (options.script) (void)load_script(*options.script);  // a mistake in it should not cost a window

    std::shared_ptr<const SceneDescription> scene = options.scene;
    double load_seconds = options.load_seconds;
    if (!scene) {
        const double start = steady_seconds();
        scene = options.load_scene(options.scene_name);
        load_seconds = steady_seconds() - start;
    }
    Viewer viewer(options, std::move(scene), load_seconds);
    viewer.run();
    viewer.print_trace();
    return 0;
}

}  // namespace pl
