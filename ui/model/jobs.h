// File jobs on the helper thread; an exception of a job becomes an error message.
#pragma once

#include "ui/model/job_thread.h"
#include "ui/model/messages.h"

namespace pl::ui {

class Jobs {
public:
    explicit Jobs(Messages& messages) : messages_(messages) {}

    /// `job` runs on the helper thread, the report it returns on the window's thread.
    void push(JobThread::Job job);
    /// Runs the reports of finished jobs; once per frame of the window.
    void update();
    /// Jobs whose report has not run yet.
    int pending() const { return thread_.pending(); }
    /// Waits for all queued jobs; none may follow.
    void finish() { thread_.finish(); }

private:
    Messages& messages_;
    JobThread thread_;
};

}  // namespace pl::ui
