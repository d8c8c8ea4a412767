// The values that a script can wait for or expect: the state of the viewer as words and numbers.
#pragma once

#include <string>
#include <string_view>

namespace pl::ui {

class ViewerModel;

bool is_script_value(std::string_view name);
/// All names, separated by commas.
std::string script_value_names();
/// The present value. The name must be a known one.
std::string script_value(const ViewerModel& model, std::string_view name);

}  // namespace pl::ui
