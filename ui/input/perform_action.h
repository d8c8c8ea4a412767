// The effects of keys and menu items on the viewer.
#pragma once

#include "ui/input/actions.h"
#include "ui/model/viewer_model.h"

namespace pl::ui {

/// False for held keys, which InputRouter adds up.
bool perform(ViewerModel& model, const Action& action);

/// Whether what the action switches is on: menus mark it.
bool is_on(const ViewerModel& model, const Action& action);

/// An action without a parameter.
bool perform(ViewerModel& model, ActionId id);

}  // namespace pl::ui
