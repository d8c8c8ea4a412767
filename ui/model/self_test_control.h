// The self test in the window: its dialog, its start and end. Rendering rests while it runs.
#pragma once

#include "ui/model/self_test_run.h"
#include "ui/model/services.h"

namespace pl::ui {

class SelfTestControl {
public:
    explicit SelfTestControl(const ModelServices& services)
        : options_(services.options), messages_(services.messages), link_(services.link) {}

    /// Takes results; once per frame of the window.
    void update();

    const SelfTestRun& run() const { return run_; }
    bool& is_shown() { return is_shown_; }  ///< the dialog is open
    bool is_shown() const { return is_shown_; }
    /// Also opens the dialog.
    void start();
    void stop() { run_.stop(); }

private:
    const ViewerOptions& options_;
    Messages& messages_;
    RenderLink& link_;
    SelfTestRun run_;
    bool is_shown_ = false;
};

}  // namespace pl::ui
