#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/option_parsers.h"
#include "app/options.h"
#include "app/parse_values.h"
#include "core/base/error.h"
#include "core/fields/field_kernels.h"
#include "core/io/files.h"
#include "core/io/json_document.h"
#include "core/scene/crop.h"

namespace pl {
namespace {

int scaled_side(int side, int to, int from) {
    const double scaled = static_cast<double>(side) * to / from;
    return static_cast<int>(std::clamp(std::round(scaled), 1.0, static_cast<double>(kMaxImageSide)));
}

/// A missing width or height follows from the aspect of the size so far.
void settle_size(Options& options) {
    RenderSettings& render = options.render;
    const int width = options.width;
    const int height = options.height;
    if (width > 0 && height == 0) render.height = scaled_side(render.height, width, render.width);
    if (height > 0 && width == 0) render.width = scaled_side(render.width, height, render.height);
    if (width > 0) render.width = width;
    if (height > 0) render.height = height;
    options.width = 0;
    options.height = 0;
}

void settle_camera(Options& options) {
    CameraDescription& camera = options.render.camera;
    camera = replaced(camera, options.camera);
    if (camera.eye == camera.target)
        throw Error(ErrorKind::Usage, fmt::format("--eye, --target: expected two different points, got {} for both",
                                                  print_vector(camera.eye)));
    if (camera.up == glm::vec3(0.0f)) throw Error(ErrorKind::Usage, "--up: expected a direction, got 0,0,0");
}

/// A crop becomes camera and size of the picture.
void settle_crop(Options& options) {
    if (!options.crop) return;
    RenderSettings& render = options.render;
    const PixelWindow& crop = *options.crop;
    if (crop.x + crop.width > render.width || crop.y + crop.height > render.height)
        throw Error(ErrorKind::Usage,
                    fmt::format("--crop: expected a window within the picture of {}x{} pixels, got {}x{} at {},{}",
                                render.width, render.height, crop.width, crop.height, crop.x, crop.y));
    render.camera = cropped(render.camera, static_cast<float>(render.width), static_cast<float>(render.height),
                            {static_cast<float>(crop.x), static_cast<float>(crop.y), static_cast<float>(crop.width),
                             static_cast<float>(crop.height)});
    render.width = crop.width;
    render.height = crop.height;
}

/// Applies one setting of a scene file; error messages name the file and the line.
void apply_setting(const OptionSpec& spec, Options& options, const std::string& text, const SceneDescription& scene) {
    try {
        spec.parse(options, text);
    } catch (const Error& error) {
        const JsonDocument file(read_text_file(scene.source), scene.source);
        file.fail(fmt::format("/settings/{}", spec.name), error.what());
    }
}

void apply_scene(Options& options, const SceneDescription& scene) {
    options.render.camera = scene.camera;
    for (const OptionSpec& spec : option_table())
        for (const auto& [name, text] : scene.settings)
            if (name == spec.name && spec.in_scene_files) apply_setting(spec, options, text, scene);
    settle_size(options);
}

/// An option as it is typed.
std::string words(const OptionSpec& spec, const std::string& value) {
    return fmt::format("--{} {}", spec.name, value);
}

/// Options given along with a loaded field must agree with it.
void adopt_field(const CommandLine& line, const LearnedField& field, Options& options) {
    options.render.method = field.method;
    options.render.field = field.settings;
    for (const auto& [spec, text] : line.given) {
        Options asked = options;
        apply_option(*spec, asked, text);
        if (texts_apart(*spec, asked, options).empty()) continue;
        const std::vector<std::string> own = texts_apart(*spec, options, asked);
        throw Error(ErrorKind::Usage,
                    fmt::format("{}: the field in {} was learned {}: expected that, or nothing", words(*spec, text),
                                line.options.load_field,
                                own.empty() ? fmt::format("without --{}", spec->name)
                                            : fmt::format("with --{} {}", spec->name, fmt::join(own, ","))));
    }
}

/// Throws Error(Usage) for --save-field if the run learns nothing.
void require_learning(const Options& options) {
    const MethodInfo& method = info_of(options.render.method);
    const ViewInfo& view = info_of(options.render.view);
    if (!method.uses_field)
        throw Error(ErrorKind::Usage, fmt::format("--save-field: --method {} learns nothing: expected --method {}",
                                                  method.name, field_method_choices()));
    if (view.id != View::Beauty && !view.needs_tables)
        throw Error(ErrorKind::Usage,
                    fmt::format("--save-field: nothing is learned for --view {}: expected --view {} or one of the "
                                "learned field, such as {}",
                                view.name, info_of(View::Beauty).name, info_of(View::RadianceMap).name));
}

bool makes_pictures(Command command) { return command == Command::Render || command == Command::Replay; }

void check_combinations(Command command, const Options& options) {
    const MethodInfo& method = info_of(options.render.method);
    const bool needs_field = makes_pictures(command) && info_of(options.render.view).needs_tables;
    if (needs_field && !method.uses_field)
        throw Error(
            ErrorKind::Usage,
            fmt::format("--view {}: shows the learned field, and --method {} learns nothing: expected --method {}",
                        info_of(options.render.view).name, method.name, field_method_choices()));
    if (!options.save_field.empty()) require_learning(options);
}

/// Representations other than the table are learned; for a representation that devices have no kernels for, "auto"
/// takes the CPU.
void settle_representation(Options& options) {
    const FieldSettings& field = options.render.field;
    if (field.representation == Representation::Table) return;
    const std::string_view name = name_of(field.representation);
    if (info_of(options.render.method).precomputes)
        throw Error(ErrorKind::Usage,
                    fmt::format("--field {}: expected --field table with --method {}, whose probes fill tables", name,
                                info_of(options.render.method).name));
    if (!has_target(field.representation, field.learning.target))
        throw Error(ErrorKind::Usage, fmt::format("--learn target={}: expected --field table with it, got --field {}",
                                                  name_of(field.learning.target), name));
    if (is_for_devices(field.representation)) return;
    const auto is_cuda = [](const std::string& backend) { return backend == "cuda"; };
    if (is_cuda(options.backend) || std::ranges::any_of(options.backends, is_cuda))
        throw Error(
            ErrorKind::Unavailable,
            fmt::format("--field {}: expected --backend cpu or auto, got cuda, which has no kernels for it", name));
    options.backend = "cpu";
}

/// An inspection needs a learned field, so it does not inherit a method without one from the scene.
void settle_inspection(const CommandLine& line, Options& options) {
    options.render.view = View::Beauty;
    if (info_of(options.render.method).uses_field) return;
    if (is_given(line.given, "method"))
        throw Error(ErrorKind::Usage, fmt::format("--method {}: learns nothing that could be inspected: expected {}",
                                                  info_of(options.render.method).name, field_method_choices()));
    options.render.method = MethodId::Reinforcement;
}

/// A target error of the scene's settings applies to renderings of radiance only.
void settle_target(const CommandLine& line, Options& options) {
    const bool renders = makes_pictures(line.command);
    const bool has_error = options.render.view == View::Beauty;
    if (!is_given(line.given, "target-error")) {
        if (!renders || !has_error) options.target_error.reset();
    } else if (renders && !has_error) {
        throw Error(ErrorKind::Usage, fmt::format("--target-error: expected --view {}, whose error is known, got {}",
                                                  info_of(View::Beauty).name, info_of(options.render.view).name));
    }
}

/// Limits of a scene's settings, made for a good picture, are no limits of a measurement.
void forget_scene_limits(const CommandLine& line, Options& options) {
    if (!is_given(line.given, "time-limit")) options.time_limit_seconds.reset();
    if (!is_given(line.given, "spp")) options.spp.reset();
}

/// A reference shows radiance, whatever view the scene prefers, and has its own default of samples.
void settle_reference(const CommandLine& line, Options& options) {
    options.render.view = View::Beauty;
    constexpr std::uint32_t kReferenceSpp = 4096;
    if (!is_given(line.given, "method")) options.render.method = MethodId::Default;
    if (!is_given(line.given, "nee")) options.render.next_event = true;
    forget_scene_limits(line, options);
    if (!options.spp && !options.time_limit_seconds) options.spp = kReferenceSpp;
}

}  // namespace

std::string shell_word(const std::string& text) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,+:@%=";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

Options resolve_options(const CommandLine& line, const SceneDescription& scene, const LearnedField* loaded) {
    Options options;
    apply_scene(options, scene);
    for (const GivenOption& given : line.given) apply_option(*given.spec, options, given.text);
    options.scene = line.options.scene;
    if (loaded != nullptr) adopt_field(line, *loaded, options);
    settle_size(options);
    settle_camera(options);
    settle_crop(options);
    if (line.command == Command::Inspect) settle_inspection(line, options);
    if (line.command == Command::Trace) options.render.view = View::Beauty;  // other views trace no paths
    if (line.command == Command::Reference) settle_reference(line, options);
    if (line.command == Command::Bench) {
        options.render.view = View::Beauty;
        forget_scene_limits(line, options);
    }
    settle_target(line, options);
    settle_representation(options);
    check_combinations(line.command, options);
    return options;
}

void require_pixel_inside(const Options& options) {
    if (!options.pixel) return;
    const glm::ivec2 pixel = *options.pixel;
    if (pixel.x >= options.render.width || pixel.y >= options.render.height)
        throw Error(ErrorKind::Usage, fmt::format("--pixel: expected a pixel of {}x{}, got {},{}",
                                                  options.render.width, options.render.height, pixel.x, pixel.y));
}

Options scene_defaults(const std::string& scene_name, const SceneDescription& scene) {
    Options options;
    apply_scene(options, scene);
    options.scene = scene_name;
    return options;
}

std::string command_text(Command command, const Options& options, const Options& defaults) {
    std::string text = fmt::format("pathlight {} {}", command_name(command), shell_word(options.scene));
    for (const OptionSpec& spec : option_table()) {
        if (!spec.commands.has(command)) continue;
        const std::string name = spec.name == "output" ? "-o" : "--" + std::string(spec.name);
        for (const std::string& value : texts_apart(spec, options, defaults))
            text += fmt::format(" {} {}", name, shell_word(value));
    }
    return text;
}

}  // namespace pl
