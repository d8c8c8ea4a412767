#include "app/console.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "core/base/error.h"
#include "core/base/printable.h"

namespace pl {

void Console::configure(const Options& options) {
    json_ = options.json;
    quiet_ = options.quiet;
    if (options.quiet)
        log_.set_level(LogLevel::Error);
    else if (options.verbosity > 0)
        log_.set_level(LogLevel::Detail);
    if (!options.log_file.empty()) log_.open_file(options.log_file);
}

void Console::result(const std::string& text) {
    if (json_) return;
    if (is_for_data_)
        log_.notice(text.substr(0, text.find_last_not_of('\n') + 1));
    else
        write(printable(text));
}

void Console::remark(const std::string& text) {
    if (!quiet_) result(text);
}

void Console::event(std::string_view kind, const Json& members) {
    if (json_) write(printable(event_line(kind, members)));
}

void Console::warn_about(const SceneDescription& scene) {
    for (const std::string& warning : scene.warnings) {
        log_.warning(warning);
        event("warning", {{"message", warning}});
    }
}

void Console::data(std::string_view bytes) { write(bytes); }

void Console::write(std::string_view text) {
    if (sink_) return sink_(text);
    log_.clear_status();
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) failure_ = errno;
}

void Console::finish() {
    if (failure_ != 0)
        throw Error(ErrorKind::Runtime,
                    std::string("standard output: cannot be written: ") + std::strerror(failure_));
}

}  // namespace pl
