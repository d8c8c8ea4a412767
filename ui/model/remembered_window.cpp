#include "ui/model/remembered_window.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace pl::ui {
namespace {

bool is_there(const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
}

}  // namespace

RememberedWindow::RememberedWindow(std::filesystem::path file, const WindowMemory& first)
    : file_(std::move(file)), last_(first) {
    if (!file_.empty() && is_there(file_)) {
        try {
            Json document = read_json_file(file_, kWindowMemorySchema);
            last_ = read_members(file_, [&] { return memory_in(document, first, file_); });
            document_ = std::move(document);
        } catch (const Error& error) {
            problem_ = fmt::format("the window opens as at a first start: {}", error.what());
        }
    }
    waiting_ = last_;
}

std::string RememberedWindow::write(const WindowMemory& now) {
    try {
        write_memory(now, document_);
        make_folder(file_.parent_path());
        write_json_file(file_, document_);
        last_ = now;
        return "";
    } catch (const std::exception& error) {  // also Json's, for names that are not UTF-8
        return fmt::format("the window is not remembered: {}", error.what());
    }
}

void RememberedWindow::update(const WindowMemory& now, double seconds, Messages& messages) {
    if (file_.empty()) return;
    if (seconds < settled_at_) last_ = waiting_ = now;
    if (now != waiting_) {
        waiting_ = now;
        changed_at_ = seconds;
    }
    if (has_failed_ || waiting_ == last_ || seconds - changed_at_ < kRestSeconds) return;
    const std::string failure = write(now);
    if (failure.empty()) return;
    has_failed_ = true;
    messages.say(MessageLevel::Warning, failure);
}

std::string RememberedWindow::finish(const WindowMemory& now) {
    return file_.empty() || now == last_ ? "" : write(now);
}

void RememberedWindow::forget(const WindowMemory& now, double seconds, Messages& messages) {
    last_ = waiting_ = now;
    document_ = Json::object();
    settled_at_ = seconds + kRestSeconds;
    std::error_code error;
    if (!file_.empty()) std::filesystem::remove(file_, error);
    if (error)
        messages.say(MessageLevel::Warning, fmt::format("cannot remove {}: {}", file_.string(), error.message()));
    else
        messages.say(MessageLevel::Info, "the window is as at a first start; nothing of it is remembered");
}

}  // namespace pl::ui
