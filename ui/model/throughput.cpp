#include "ui/model/throughput.h"

namespace pl::ui {

void Throughput::observe(const Snapshot& snapshot, const std::string& backend) {
    const std::uint64_t paths = snapshot.counters.paths;
    const bool is_other_film = snapshot.slot != slot_ || backend != backend_ || paths < paths_;
    if (is_other_film) {
        slot_ = snapshot.slot;
        backend_ = backend;
        paths_ = 0;
        seconds_ = 0.0;
    }
    const double elapsed = snapshot.clocks.render - seconds_;
    if (elapsed <= 0.0 || (elapsed < kIntervalSeconds && paths_ > 0)) return;
    mpaths_per_second_ = 1.0e-6 * static_cast<double>(paths - paths_) / elapsed;
    paths_ = paths;
    seconds_ = snapshot.clocks.render;
}

}  // namespace pl::ui
