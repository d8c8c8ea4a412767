// Methods and views by identity and by name.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "core/kernel/inspect/views.h"
#include "core/kernel/methods/method_list.h"

namespace pl {

struct ViewInfo {
    View id;
    std::string_view name;
    std::string_view label;
    std::string_view summary;
    bool needs_volumes;  ///< needs the placement of the radiance volumes
    bool needs_tables;   ///< needs a learned field
};

std::span<const MethodInfo> all_methods();
std::span<const ViewInfo> all_views();
const MethodInfo& info_of(MethodId id);
/// The baseline: the method without a field, against which others are compared.
MethodId baseline_method();
/// The first method that learns while it renders.
MethodId learning_method();
/// The method whose field the views show: the method itself, or the learning method if it has no field.
MethodId field_owner(MethodId method);
const ViewInfo& info_of(View id);
std::optional<MethodId> method_by_name(std::string_view name);
std::optional<View> view_by_name(std::string_view name);

}  // namespace pl
