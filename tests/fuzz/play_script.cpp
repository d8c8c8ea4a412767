#include "tests/fuzz/play_script.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <new>
#include <stdexcept>
#include <thread>
#include <utility>

#include <SDL.h>

#include "core/base/error.h"
#include "tests/ui/model_bench.h"
#include "ui/draw/imgui_draw.h"
#include "ui/draw/style.h"
#include "ui/input/input_router.h"
#include "ui/script/script_player.h"
#include "ui/script/script_values.h"
#include "ui/window/display.h"
#include "ui/window/gui.h"

namespace pl::test {
using namespace pl::ui;
namespace {

using Kind = ScriptCommand::Kind;

constexpr std::size_t kMostCommands = 64;
constexpr int kLongestPause = 3;  ///< frames
constexpr int kWindowWidth = 960;
constexpr int kWindowHeight = 640;
constexpr double kLargestWindow = 2000.0;  ///< of a resize; the picture takes memory

/// The window's driver and a hidden window, kept for the life of the process.
SDL_Window* hidden_window() {
    // Never destroyed: SDL is not to be shut down after its own atexit.
    alignas(VideoSubsystem) static std::byte memory[sizeof(VideoSubsystem)];
    static const VideoSubsystem* const video = [] {
        SDL_setenv("SDL_VIDEODRIVER", "dummy", 1);
        return ::new (memory) VideoSubsystem;
    }();
    (void)video;
    static SDL_Window* const window =
        SDL_CreateWindow("fuzz", 0, 0, kWindowWidth, kWindowHeight, SDL_WINDOW_HIDDEN | SDL_WINDOW_RESIZABLE);
    return window;
}

/// Dear ImGui without a renderer, new for each script: the state of one would change the next.
class Panels {
public:
    explicit Panels(SDL_Window* window) : window_(window) {
        create_gui_context(memory_);
        init_imgui_platform(window, nullptr);
        apply_style(1.0f);
        load_fonts("", 1.0f);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
    }
    ~Panels() {
        ImGui_ImplSDL2_Shutdown();
        ImGui::DestroyContext();
    }
    Panels(const Panels&) = delete;
    Panels& operator=(const Panels&) = delete;

    void handle(const SDL_Event& event) {
        ImGui_ImplSDL2_ProcessEvent(&event);
        mouse_.handle(event);
    }
    Layout layout(const ViewerModel& model) const {
        int width = 0, height = 0;
        SDL_GetWindowSize(window_, &width, &height);
        return make_layout(static_cast<float>(width), static_cast<float>(height), kFontPixels, model.window().panels,
                           model.selection().volume() != kNoVolume);
    }
    void frame(ViewerModel& model, const Layout& layout, const Rect& image, const ComparePlan& plan) {
        ImGui_ImplSDL2_NewFrame();
        mouse_.write_to_imgui();
        ImGuiIO& io = ImGui::GetIO();
        io.DeltaTime = static_cast<float>(ScriptPlayer::kFrameSeconds);
        int width = 0, height = 0;
        SDL_GetWindowSize(window_, &width, &height);
        io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
        ImGui::NewFrame();
        memory_.places.clear();
        memory_.pointer_rest_seconds = 1.0f;  // tooltips, too
        draw_interface(model, layout, image, plan, PixelPosition{}, nullptr);
        ImGui::Render();
    }

private:
    SDL_Window* window_;
    MouseTracker mouse_;
    GuiMemory memory_;
};

/// A model without files: scenes come from memory, and no folder can be written to or read from.
ModelBench make_bench() {
    ModelBench bench(32);
    ViewerOptions& options = bench.options;
    options.settings.field.volumes = 16;
    options.settings.field.bins = 16;
    options.backends = {{"cpu", "", ""}, {"cuda", "", ""}, {"other", "", "there is none"}};
    options.load_scene = [](const SceneRequest& request) {
        if (request.name.size() % 2 == 0) throw Error(ErrorKind::Input, request.name + ":1: expected a scene");
        return small_scene();
    };
    options.screenshot_dir = "/dev/null/pictures";
    options.reference_dir = "/dev/null/references";
    options.command_line = [](const ViewerPicture&) { return std::string("pathlight"); };
    return bench;
}

/// In frames of their own that follow each other closely, without conditions and too large windows.
std::vector<ScriptCommand> shortened(std::vector<ScriptCommand> commands) {
    std::erase_if(commands, [](const ScriptCommand& c) { return c.kind == Kind::Wait || c.kind == Kind::Expect; });
    if (commands.size() > kMostCommands) commands.resize(kMostCommands);
    int before = 0, now = 0;
    for (ScriptCommand& command : commands) {
        now += std::min(command.frame - before, kLongestPause);
        before = std::exchange(command.frame, now);
        if (command.kind != Kind::Resize) continue;
        command.x = std::min(command.x, kLargestWindow);
        command.y = std::min(command.y, kLargestWindow);
    }
    return commands;
}

/// Every value can be read, and the settings of the picture are finite.
void check(const ViewerModel& model, const std::vector<ScriptCommand>& conditions) {
    for (const ScriptCommand& command : conditions)
        holds(command.condition, script_value(model, command.condition.name));
    const CameraDescription& camera = model.camera().camera();
    for (const glm::vec3& v : {camera.eye, camera.target, camera.up})
        for (int axis = 0; axis < 3; ++axis)
            if (!std::isfinite(v[axis])) throw std::logic_error("a camera that is no number");
    if (!std::isfinite(model.display().settings().exposure_ev) || !(model.camera().speed() > 0.0f))
        throw std::logic_error("an exposure or a speed that is no number");
    if (model.render().settings().width < 1 || model.render().settings().height < 1)
        throw std::logic_error("a picture without pixels");
}

/// Events that an earlier script left behind.
void drop_events() {
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0)
        if (event.type == SDL_DROPFILE) SDL_free(event.drop.file);
}

}  // namespace

void play_script(std::vector<ScriptCommand> commands) {
    SDL_Window* const window = hidden_window();
    SDL_SetWindowSize(window, kWindowWidth, kWindowHeight);
    SDL_SetModState(KMOD_NONE);
    drop_events();
    std::vector<ScriptCommand> conditions = commands;
    std::erase_if(conditions, [](const ScriptCommand& c) { return c.kind != Kind::Wait && c.kind != Kind::Expect; });
    Panels panels(window);
    ModelBench bench = make_bench();
    ViewerModel model(bench.options, small_scene(), bench.options.settings, 0.0);
    if (!bench.run_until(model, [&] { return model.frame() != nullptr; })) throw std::logic_error("no picture");
    InputRouter input(window);
    ScriptPlayer player(shortened(std::move(commands)), window);
    double seconds = bench.clock;
    while (!model.window().requests.quit) {
        std::this_thread::sleep_for(std::chrono::microseconds(100));  // for passes of the fake back end
        seconds += ScriptPlayer::kFrameSeconds;
        const Layout layout = panels.layout(model);
        const Rect image =
            place_image(layout.view, model.render().settings().width, model.render().settings().height);
        const ComparePlan plan = model.comparison().plan(layout.view);
        player.step(model, image, seconds);
        const ImGuiIO& io = ImGui::GetIO();
        SDL_Event event;
        while (SDL_PollEvent(&event) != 0) {
            panels.handle(event);
            input.handle(event, model,
                         {place_under(picture_places(plan, image, layout.view), input.pointer()), layout.view,
                          io.WantCaptureMouse, io.WantTextInput, seconds});
        }
        model.update(seconds);
        model.camera().fly(input.move_keys(), ScriptPlayer::kFrameSeconds);
        panels.frame(model, layout, image, plan);
        check(model, conditions);
    }
}

}  // namespace pl::test
