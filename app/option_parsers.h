// Option values that take more than a line: words of a list, and values with parts.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/option_values.h"
#include "core/base/choice.h"
#include "core/base/error.h"

namespace pl {

// Option values that are one of several words, or some of them.

/// "a, b or c"
std::string one_of(const std::vector<std::string>& names);

/// A word that is none of the known ones. Completions of shells are made of them.
class ChoiceError : public Error {
public:
    ChoiceError(const std::string& message, const std::vector<std::string>& names)
        : Error(ErrorKind::Usage, message), names_(names) {}
    const std::vector<std::string>& names() const { return names_; }

private:
    std::vector<std::string> names_;
};

/// Throws ChoiceError with all words, and the nearest one if any is near.
[[noreturn]] void fail_choice(const std::vector<std::string>& names, const std::string& got);

/// The value of this name. Throws ChoiceError.
template <Described Enum>
Enum parse_choice(const std::string& text) {
    const std::optional<Enum> value = choice_named<Enum>(text);
    if (!value) fail_choice(choice_names<Enum>(), text);
    return *value;
}

/// "spare (default): what it says of itself; albedo: ...", as the help goes on.
template <Described Enum>
std::string describe_choices(std::optional<Enum> standard = {}) {
    std::string text;
    for (const ChoiceInfo<Enum>& info : kChoices<Enum>) {
        if (!text.empty()) text += "; ";
        text += info.name;
        if (info.value == standard) text += " (default)";
        if (!info.sentence.empty()) text.append(": ").append(info.sentence);
    }
    return text;
}

template <class Range, class Name>
std::vector<std::string> names_in(const Range& range, Name name) {
    std::vector<std::string> names;
    for (const auto& item : range) names.emplace_back(name(item));
    return names;
}

// Parsers of option values that take more than a line. Each throws Error(Usage) "expected ..., got '...'".

std::vector<std::string> method_names();
std::vector<std::string> view_names();

void parse_method(Options& options, const std::string& text);
/// "NAME,NAME..." or "all".
void parse_methods(Options& options, const std::string& text);
void parse_backends(Options& options, const std::string& text);
void parse_view(Options& options, const std::string& text);
void parse_backend(Options& options, const std::string& text);
void parse_bins(Options& options, const std::string& text);
void parse_probes(Options& options, const std::string& text);
void parse_bsdf_fraction(Options& options, const std::string& text);
std::string print_bsdf_fraction(const MixtureSettings& mixture);
void parse_fov(Options& options, const std::string& text);
/// A file or a text of read_camera_parts(), else the name of a camera of the scene.
void parse_camera(Options& options, const std::string& text);
void parse_field_budget(Options& options, const std::string& text);
void parse_refine(Options& options, const std::string& text);
std::string print_refine(float share);
void parse_time_limit(Options& options, const std::string& text);
void parse_checkpoint_interval(Options& options, const std::string& text);
void parse_target_error(Options& options, const std::string& text);
void parse_window(Options& options, const std::string& text);
void parse_ui_scale(Options& options, const std::string& text);
void parse_remember(Options& options, const std::string& text);
void parse_picture_size(Options& options, const std::string& text);
void parse_crop(Options& options, const std::string& text);
/// "NAME,NAME...".
void parse_representations(Options& options, const std::string& text);
std::string print_representations(const Options& options);
/// "NAME=VALUE". The scene decides whether it takes it.
void parse_parameter(Options& options, const std::string& text);
void parse_at(Options& options, const std::string& text);
void parse_pixel(Options& options, const std::string& text);
void parse_samples(Options& options, const std::string& text);

/// "precomputed or reinforcement": the methods with a learned field to show.
std::string field_method_choices();

/// The name of the scene's camera, then what --eye and its like do not have, part by part in lines.
std::string print_camera(const Options& options);
std::string print_parameters(const Options& options);
/// Empty if it was not given.
std::string print_default_light(const Options& options);

}  // namespace pl
