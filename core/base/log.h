// Messages for users on standard error: errors, warnings, progress, and a status line that is redrawn in place.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace pl {

/// Severities, highest first; a log shows messages up to its level.
enum class LogLevel { Error, Warning, Notice, Detail };

/// Thread-safe. Every message of any level also goes to the log file, if there is one. Messages are shown as printable().
class Log {
public:
    Log();
    ~Log();
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;

    void set_level(LogLevel level) { level_ = level; }
    /// Appends all further messages to the file. Throws Error(Runtime) if it cannot be opened.
    void open_file(const std::filesystem::path& path);

    void error(std::string_view message) { write(LogLevel::Error, message); }
    void warning(std::string_view message) { write(LogLevel::Warning, message); }
    void notice(std::string_view message) { write(LogLevel::Notice, message); }
    void detail(std::string_view message) { write(LogLevel::Detail, message); }

    /// Replaces the status line at the bottom of the terminal, below the messages. No effect without a terminal.
    void show_status(std::string_view line);
    void clear_status();

    /// Whether standard error is a terminal that can redraw a line.
    bool is_terminal() const { return terminal_; }
    /// Width of the terminal in characters; 80 if unknown.
    int terminal_width() const;

private:
    void write(LogLevel level, std::string_view message);
    void write_to_file(LogLevel level, std::string_view message);
    void erase_status();

    std::mutex mutex_;
    LogLevel level_ = LogLevel::Notice;
    bool terminal_ = false;
    bool color_ = false;
    bool status_shown_ = false;
    std::shared_ptr<std::FILE> file_;
};

}  // namespace pl
