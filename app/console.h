// Output of a subcommand: results to standard output, messages to the log.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "app/events.h"
#include "app/option_values.h"
#include "core/base/log.h"
#include "core/scene/description.h"

namespace pl {

class Console {
public:
    /// Takes -q, -v, --json and --log-file from the options.
    void configure(const Options& options);

    Log& log() { return log_; }
    bool json() const { return json_; }

    /// Text for standard output, as printable(), unless --json replaces it by events. -q leaves out `remark`s, never `result`s.
    void result(const std::string& text);
    void remark(const std::string& text);
    /// One line of JSON for standard output, with --json only.
    void event(std::string_view kind, const Json& members);
    void warn_about(const SceneDescription& scene);

    /// Standard output is for data() alone from now on: text goes to the log as notices.
    void keep_output_for_data() { is_for_data_ = true; }
    void data(std::string_view bytes);

    /// Whatever would go to standard output goes to `sink` from now on.
    void write_to(std::function<void(std::string_view)> sink) { sink_ = std::move(sink); }

    /// Throws Error(Runtime) if a write to standard output failed.
    void finish();

private:
    void write(std::string_view text);

    Log log_;
    std::function<void(std::string_view)> sink_;  ///< empty: standard output
    bool json_ = false;
    bool quiet_ = false;
    bool is_for_data_ = false;
    int failure_ = 0;
};

}  // namespace pl
