// Parsers of option values that take more than a line. Each throws Error(Usage) "expected ..., got '...'".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/option_values.h"

namespace pl {

/// For words of the contract that a later version will understand.
[[noreturn]] void fail_not_yet(std::string_view what);

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
