#include "core/base/log.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/printable.h"

namespace pl {
namespace {

bool is_set(const char* variable) {
    const char* const value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

bool can_redraw() {
    const char* const terminal = std::getenv("TERM");
    return isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::strcmp(terminal, "dumb") != 0;
}

std::string_view word_of(LogLevel level) {
    switch (level) {
    case LogLevel::Error: return "error: ";
    case LogLevel::Warning: return "warning: ";
    case LogLevel::Notice:
    case LogLevel::Detail: return "";
    }
    return "";
}

/// Red for errors, yellow for warnings.
std::string_view color_of(LogLevel level) {
    switch (level) {
    case LogLevel::Error: return "\033[1;31m";
    case LogLevel::Warning: return "\033[1;33m";
    case LogLevel::Notice:
    case LogLevel::Detail: return "";
    }
    return "";
}

void put(std::string_view text, std::FILE* file) {
    // A failure to write to standard error cannot be reported.
    (void)std::fwrite(text.data(), 1, text.size(), file);
}

}  // namespace

Log::Log() : terminal_(can_redraw()), color_(terminal_ && !is_set("NO_COLOR")) {}

Log::~Log() { clear_status(); }

void Log::open_file(const std::filesystem::path& path) {
    std::FILE* const file = std::fopen(path.c_str(), "a");
    if (file == nullptr)
        throw Error(ErrorKind::Runtime,
                    fmt::format("{}: cannot write the log: {}", path.string(), std::strerror(errno)));
    file_.reset(file, std::fclose);
}

void Log::show_status(std::string_view line) {
    const std::lock_guard lock(mutex_);
    if (!terminal_) return;
    put("\r\033[K", stderr);
    put(printable(line), stderr);
    std::fflush(stderr);
    status_shown_ = true;
}

void Log::clear_status() {
    const std::lock_guard lock(mutex_);
    erase_status();
}

void Log::erase_status() {
    if (!status_shown_) return;
    put("\r\033[K", stderr);
    std::fflush(stderr);
    status_shown_ = false;
}

int Log::terminal_width() const {
    winsize size{};
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
    return size.ws_col;
}

void Log::write(LogLevel level, std::string_view given) {
    const std::string message = printable(given);
    const std::lock_guard lock(mutex_);
    write_to_file(level, message);
    if (level > level_) return;
    erase_status();
    const std::string_view word = word_of(level);
    const std::string head =
        color_ && !word.empty() ? fmt::format("{}{}\033[0m", color_of(level), word) : std::string(word);
    put(fmt::format("{}{}{}\n", word.empty() ? "" : "pathlight: ", head, message), stderr);
    std::fflush(stderr);
}

void Log::write_to_file(LogLevel level, std::string_view message) {
    if (!file_) return;
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    localtime_r(&now, &local);
    char stamp[32];
    const std::size_t length = std::strftime(stamp, sizeof stamp, "%Y-%m-%d %H:%M:%S ", &local);
    put({stamp, length}, file_.get());
    put(fmt::format("{}{}\n", word_of(level), message), file_.get());
    std::fflush(file_.get());
}

}  // namespace pl
