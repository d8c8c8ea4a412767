#include "ui/model/jobs.h"

#include <exception>

namespace pl::ui {

void Jobs::push(Job job) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back(std::move(job));
        ++pending_;
    }
    wake_.notify_all();
}

Jobs::Report Jobs::report_of(const Job& job) {
    try {
        return job();
    } catch (const std::exception& error) {
        return [this, text = std::string(error.what())] { messages_.say(MessageLevel::Error, text); };
    }
}

void Jobs::update() {
    const auto reports = [&] {
        const std::lock_guard lock(mutex_);
        return std::exchange(reports_, {});
    }();
    for (const Report& report : reports)
        if (report) report();
}

}  // namespace pl::ui
