#include "ui/model/messages.h"

#include <algorithm>

namespace pl::ui {
namespace {

constexpr double kToastSeconds = 4.0;
constexpr double kErrorToastSeconds = 10.0;

double shown_seconds(MessageLevel level) { return level == MessageLevel::Info ? kToastSeconds : kErrorToastSeconds; }

}  // namespace

void Messages::drop_expired() {
    std::erase_if(toasts_, [&](const LogLine& toast) { return toast.seconds + shown_seconds(toast.level) <= now_; });
}

void Messages::note(MessageLevel level, const std::string& text) {
    if (log_.size() >= kMaxLogLines) log_.erase(log_.begin());
    log_.push_back({now_, level, text});
    ++count_;
}

std::string Messages::texts_after(std::uint64_t count) const {
    const std::uint64_t wanted = std::min<std::uint64_t>(count_ - std::min(count, count_), log_.size());
    std::string texts;
    for (std::size_t i = log_.size() - wanted; i < log_.size(); ++i)
        texts += (texts.empty() ? "" : "\n") + log_[i].text;
    return texts;
}

void Messages::say(MessageLevel level, const std::string& text) {
    note(level, text);
    if (toasts_.size() >= kMaxToasts) toasts_.erase(toasts_.begin());
    toasts_.push_back({now_, level, text});
}

}  // namespace pl::ui
