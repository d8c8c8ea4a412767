// Messages to the user: toasts over the picture, which expire, and the log, which keeps them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pl::ui {

enum class MessageLevel { Info, Warning, Error };

struct LogLine {
    double seconds;  ///< since the start of the viewer, by the window's clock
    MessageLevel level;
    std::string text;
};

class Messages {
public:
    static constexpr std::size_t kMaxToasts = 4;
    static constexpr std::size_t kMaxLogLines = 1000;

    /// The window's clock, in seconds since the start; set once per frame of the window.
    void set_time(double seconds) { now_ = seconds; }
    double now() const { return now_; }
    void drop_expired();

    void say(MessageLevel level, const std::string& text);   ///< toast and log
    void note(MessageLevel level, const std::string& text);  ///< log only

    const std::vector<LogLine>& log() const { return log_; }
    /// Messages so far, with those that the log has dropped.
    std::uint64_t count() const { return count_; }
    /// The texts of the messages after the first `count`, each on a line, as far as the log keeps them.
    std::string texts_after(std::uint64_t count) const;
    const std::vector<LogLine>& toasts() const { return toasts_; }

private:
    double now_ = 0.0;
    std::vector<LogLine> log_;
    std::uint64_t count_ = 0;
    std::vector<LogLine> toasts_;
};

}  // namespace pl::ui
