#include "core/session/backend_text.h"

#include <fmt/format.h>

namespace pl {

std::string device_text(const BackendInfo& info) {
    std::string text = info.device;
    if (info.threads > 0) text += fmt::format(", {} {}", info.threads, info.threads == 1 ? "thread" : "threads");
    if (info.ranks > 1) text += fmt::format(", {} ranks", info.ranks);
    return text;
}

}  // namespace pl
