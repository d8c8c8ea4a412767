// The objects that the parts of the viewer model share: options, messages, file jobs, the render thread.
#pragma once

#include "ui/model/jobs.h"
#include "ui/model/messages.h"
#include "ui/model/render_link.h"
#include "ui/viewer.h"

namespace pl::ui {

/// All outlive the parts that are given them.
struct ModelServices {
    const ViewerOptions& options;
    Messages& messages;
    Jobs& jobs;
    RenderLink& link;
};

}  // namespace pl::ui
