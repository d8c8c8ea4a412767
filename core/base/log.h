// Messages for people, on standard error: warnings, progress, and the one line that is redrawn in place.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace pl {

/// From what must be read to what only a developer wants; a log shows everything up to its level.
enum class LogLevel { Error, Warning, Notice, Detail };

/// Usable from any thread. Every message also goes to the log file, if there is one, whatever the level.
class Log {
public:
    Log();
    ~Log();
    Log(const Log&) = delete;
    Log& operator=(const Log&) = delete;

    void set_level(LogLevel level) { level_ = level; }
    /// Messages are appended to the file from now on. Throws Error(Runtime) if it cannot be written.
    void open_file(const std::filesystem::path& path);

    void error(std::string_view message) { write(LogLevel::Error, message); }
    void warning(std::string_view message) { write(LogLevel::Warning, message); }
    void notice(std::string_view message) { write(LogLevel::Notice, message); }
    void detail(std::string_view message) { write(LogLevel::Detail, message); }

    /// Replaces the line at the bottom of the terminal; messages are put above it. Only on a terminal.
    void show_status(std::string_view line);
    void clear_status();

    /// Standard error is a terminal that can redraw a line.
    bool is_terminal() const { return terminal_; }
    /// Characters in a line of the terminal; 80 if that is not known.
    int terminal_width() const;

private:
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    void write(LogLevel level, std::string_view message);
    void write_to_file(LogLevel level, std::string_view message);
    void erase_status();

    std::mutex mutex_;
    LogLevel level_ = LogLevel::Notice;
    bool terminal_ = false;
    bool color_ = false;
    bool status_shown_ = false;
    std::unique_ptr<std::FILE, CloseFile> file_;
};

}  // namespace pl
