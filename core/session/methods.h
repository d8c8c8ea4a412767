// The registry of methods and views: identity, the word on the command line, the words on screen.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/kernel/inspect/views.h"

namespace pl {

enum class MethodId : std::uint32_t { Default, Precomputed, Reinforcement };
inline constexpr int kMethodCount = 3;

struct MethodInfo {
    MethodId id;
    std::string_view name;     ///< on the command line
    std::string_view label;    ///< on screen
    std::string_view summary;  ///< one sentence
    char key;                  ///< in the window
    std::uint32_t color;       ///< opaque ARGB, of its curves
    bool uses_field;           ///< samples directions from a guiding field
    bool precomputes;          ///< fills its field by probes before it renders
    bool learns;               ///< makes training samples while it renders
};

struct ViewInfo {
    View id;
    std::string_view name;
    std::string_view label;
    std::string_view summary;
    bool needs_volumes;  ///< needs the placement of the radiance volumes
    bool needs_tables;   ///< needs something learned
};

std::span<const MethodInfo> all_methods();
std::span<const ViewInfo> all_views();
const MethodInfo& info_of(MethodId id);
/// The method without a field, against which others are compared.
MethodId baseline_method();
/// The first method that learns while it renders.
MethodId learning_method();
/// The method whose tables the views of a field show: default path tracing learns nothing, it shows Reinforcement's.
MethodId table_owner(MethodId method);
const ViewInfo& info_of(View id);
std::optional<MethodId> method_by_name(std::string_view name);
std::optional<View> view_by_name(std::string_view name);

}  // namespace pl
