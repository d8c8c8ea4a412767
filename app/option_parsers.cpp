#include "app/option_parsers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/parse_values.h"
#include "core/base/error.h"
#include "core/base/square_number.h"
#include "core/io/files.h"
#include "core/io/json_document.h"
#include "core/io/nearest_name.h"

namespace pl {

std::string one_of(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
    return text;
}

void fail_choice(const std::vector<std::string>& names, const std::string& got) {
    throw ChoiceError(fmt::format("expected {}, got '{}'{}", one_of(names), got, did_you_mean(got, names)), names);
}

namespace {

constexpr std::array<std::string_view, 3> kBackends{"auto", "cpu", "cuda"};

}  // namespace

std::vector<std::string> method_names() {
    return names_in(all_methods(), [](const MethodInfo& info) { return info.name; });
}

std::vector<std::string> view_names() {
    return names_in(all_views(), [](const ViewInfo& info) { return info.name; });
}

void parse_method(Options& options, const std::string& text) {
    const auto id = method_by_name(text);
    if (!id) fail_choice(method_names(), text);
    options.render.method = *id;
}

void parse_methods(Options& options, const std::string& text) {
    options.methods.clear();
    if (text == "all") return;
    for (const std::string& name : split(text, ',')) {
        const auto id = method_by_name(name);
        if (!id) fail_choice(method_names(), name);
        if (std::find(options.methods.begin(), options.methods.end(), *id) == options.methods.end())
            options.methods.push_back(*id);
    }
}

void parse_backends(Options& options, const std::string& text) {
    options.backends.clear();
    if (text == "auto") return;
    for (const std::string& name : split(text, ',')) {
        parse_backend(options, name);
        if (name == "auto") fail_value("cpu, cuda or both with a comma between; or auto alone", text);
        if (std::find(options.backends.begin(), options.backends.end(), name) == options.backends.end())
            options.backends.push_back(name);
    }
}

void parse_view(Options& options, const std::string& text) {
    const auto id = view_by_name(text);
    if (!id) fail_choice(view_names(), text);
    options.render.view = *id;
}

void parse_backend(Options& options, const std::string& text) {
    if (std::find(kBackends.begin(), kBackends.end(), std::string_view(text)) == kBackends.end())
        fail_choice(names_in(kBackends, [](std::string_view name) { return name; }), text);
    options.backend = text;
}

void parse_bins(Options& options, const std::string& text) {
    const int bins = static_cast<int>(parse_whole(text, 4, 1024));
    if (!is_square(bins)) fail_value("a square number from 4 to 1024, such as 64, 256 or 1024", text);
    options.render.field.bins = bins;
}

void parse_probes(Options& options, const std::string& text) {
    const int probes = static_cast<int>(parse_whole(text, 1, 1024));
    if (!is_square(probes)) fail_value("a square number from 1 to 1024, such as 1, 4 or 16", text);
    options.render.field.precompute_samples = probes;
}

void parse_bsdf_fraction(Options& options, const std::string& text) {
    if (text == "learned") {
        options.render.mixture = {};
        return;
    }
    const float share = static_cast<float>(parse_real(text, 0.1, 1.0, ", or learned"));
    options.render.mixture = {.learned = 0, .bsdf_fraction = std::max(share, kMinBsdfFraction)};
}

std::string print_bsdf_fraction(const MixtureSettings& mixture) {
    return mixture.learned != 0 ? "learned" : print_float(mixture.bsdf_fraction);
}

void parse_fov(Options& options, const std::string& text) {
    const float degrees = parse_float(text);
    if (!(degrees > 0.0f && degrees < 180.0f)) fail_value("an angle between 0 and 180 degrees", text);
    options.camera.fov_deg = degrees;
}

void parse_camera(Options& options, const std::string& text) {
    std::error_code ignored;
    const std::filesystem::path path(text);
    if (text.starts_with('{')) {
        try {
            read_camera_parts(JsonDocument(text, "JSON"), "", options.camera);
        } catch (const Error& error) {
            throw Error(ErrorKind::Usage, error.what());
        }
    } else if (suffix_of(path) == ".json" ||
               (std::filesystem::exists(path, ignored) && !std::filesystem::is_directory(path, ignored))) {
        read_camera_parts(JsonDocument(read_text_file(path), path), "", options.camera);
    } else {
        options.load.camera = text;
    }
}

void parse_field_budget(Options& options, const std::string& text) {
    const double megabytes = parse_real(text, 0.0, 65536.0);
    if (!(megabytes > 0.0)) fail_value("a number of megabytes above 0", text);
    options.render.field.budget_megabytes = megabytes;
}

void parse_refine(Options& options, const std::string& text) {
    options.render.field.refine_share =
        text == "auto" ? kRefineByRecords : static_cast<float>(parse_real(text, 0.0, 1.0, ", or auto"));
}

std::string print_refine(float share) { return share == kRefineByRecords ? "auto" : print_float(share); }

void parse_time_limit(Options& options, const std::string& text) {
    const double seconds = parse_real(text, 0.0, 1.0e9);
    if (!(seconds > 0.0)) fail_value("a number of seconds above 0", text);
    options.time_limit_seconds = seconds;
}

void parse_checkpoint_interval(Options& options, const std::string& text) {
    options.checkpoint_seconds = parse_real(text, 0.0, 1.0e9);
}

void parse_target_error(Options& options, const std::string& text) {
    const double error = parse_real(text, 0.0, 1.0e30);
    if (!(error > 0.0)) fail_value("an error above 0", text);
    options.target_error = error;
}

void parse_window(Options& options, const std::string& text) { options.window = parse_size(text); }

void parse_ui_scale(Options& options, const std::string& text) {
    options.ui_scale = static_cast<float>(parse_real(text, 0.75, 2.0));
}

void parse_remember(Options& options, const std::string& text) {
    if (text.empty()) fail_value("a folder, or off", text);
    options.remember = text;
}

void parse_picture_size(Options& options, const std::string& text) {
    const glm::ivec2 size = parse_size(text);
    options.width = size.x;
    options.height = size.y;
}

void parse_crop(Options& options, const std::string& text) {
    const std::vector<std::string> items = split(text, ',');
    if (items.size() != 4) fail_value("a window X,Y,W,H, four whole numbers", text);
    const auto number = [&](std::size_t item, std::uint64_t low, std::uint64_t high) {
        return static_cast<int>(parse_whole(items[item], low, high));
    };
    constexpr std::uint64_t kSide = kMaxImageSide;
    options.crop = {number(0, 0, kSide - 1), number(1, 0, kSide - 1), number(2, 1, kSide), number(3, 1, kSide)};
}

void parse_representations(Options& options, const std::string& text) {
    options.fields.clear();
    for (const std::string& name : split(text, ',')) {
        const auto field = parse_choice<Representation>(name);
        if (std::ranges::find(options.fields, field) == options.fields.end()) options.fields.push_back(field);
    }
}

std::string print_representations(const Options& options) {
    if (options.fields.empty()) return std::string(name_of(options.render.field.representation));
    return fmt::format("{}",
                       fmt::join(names_in(options.fields, [](Representation field) { return name_of(field); }), ","));
}

void parse_parameter(Options& options, const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos || text.find('\n') != std::string::npos)
        fail_value("NAME=VALUE, such as opening=5", text);
    options.load.parameters.emplace_back(text.substr(0, equals), text.substr(equals + 1));
}

void parse_at(Options& options, const std::string& text) {
    const std::vector<float> v = parse_floats(text, {3, 6}, "three or six numbers X,Y,Z[,NX,NY,NZ]");
    ScenePoint point{.position = {v[0], v[1], v[2]}, .normal = {}};
    if (v.size() == 6) {
        const glm::vec3 normal(v[3], v[4], v[5]);
        const float length = glm::length(normal);
        if (!(length > 0.0f) || !std::isfinite(length)) fail_value("a normal of finite length above 0", text);
        point.normal = normal / length;
    }
    options.at = point;
}

void parse_pixel(Options& options, const std::string& text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) fail_value("two whole numbers X,Y", text);
    const auto side = static_cast<std::uint64_t>(kMaxImageSide - 1);
    options.pixel = glm::ivec2(static_cast<int>(parse_whole(text.substr(0, comma), 0, side)),
                               static_cast<int>(parse_whole(text.substr(comma + 1), 0, side)));
}

void parse_samples(Options& options, const std::string& text) {
    constexpr std::uint64_t kLast = 1000000000;
    constexpr std::uint64_t kMost = 16384;  // all are kept until the brightest is known
    const std::size_t dash = text.find('-');
    SampleNumbers samples;
    samples.first = static_cast<std::uint32_t>(parse_whole(text.substr(0, dash), 0, kLast));
    samples.last = samples.first;
    if (dash != std::string::npos)
        samples.last =
            static_cast<std::uint32_t>(parse_whole(text.substr(dash + 1), samples.first, samples.first + kMost - 1));
    options.samples = samples;
}

std::string field_method_choices() {
    std::vector<std::string> names;
    for (const MethodInfo& info : all_methods())
        if (info.uses_field) names.emplace_back(info.name);
    return one_of(names);
}

std::string print_camera(const Options& options) {
    const CameraDescription& camera = options.render.camera;
    return fmt::format("{}\n{{\"aperture_radius\":{},\"focus_distance\":{}}}\n{{\"shift_x\":{},\"shift_y\":{}}}\n{{"
                       "\"mirrored\":{}}}",
                       options.load.camera, print_float(camera.aperture_radius), print_float(camera.focus_distance),
                       print_float(camera.shift.x), print_float(camera.shift.y), camera.is_mirrored);
}

std::string print_parameters(const Options& options) {
    std::string text;
    for (const auto& [name, value] : options.load.parameters)
        text += fmt::format("{}{}={}", text.empty() ? "" : "\n", name, value);
    return text;
}

std::string print_default_light(const Options& options) {
    if (!options.load.default_light) return "";
    return *options.load.default_light ? "on" : "off";
}

}  // namespace pl
