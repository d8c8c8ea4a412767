#include "ui/model/jobs.h"

#include <exception>
#include <string>

namespace pl::ui {

void Jobs::push(JobThread::Job job) {
    thread_.push([this, job = std::move(job)]() -> JobThread::Report {
        try {
            return job();
        } catch (const std::exception& error) {
            return [this, text = std::string(error.what())] { messages_.say(MessageLevel::Error, text); };
        }
    });
}

void Jobs::update() {
    for (const JobThread::Report& report : thread_.take_reports())
        if (report) report();
}

}  // namespace pl::ui
