// The load of the machine during a measurement.
#pragma once

#include <ctime>
#include <fstream>
#include <string>

#include "core/base/timer.h"

namespace pl::benchmarks {

/// Begun before a measurement and read after it. All in processors: 1 is one busy core.
class MachineLoad {
public:
    MachineLoad() : start_(read()) {}

    struct Shares {
        double own = 0.0;
        double foreign = 0.0;  ///< other processes of this machine
        double stolen = 0.0;   ///< time that the hypervisor gave to others
    };
    Shares shares() const {
        const Reading now = read();
        const double seconds = watch_.seconds();
        const double own = now.own - start_.own;
        return {own / seconds, (now.busy - start_.busy - own) / seconds, (now.stolen - start_.stolen) / seconds};
    }

private:
    /// Seconds of processor time.
    struct Reading {
        double own = 0.0, busy = 0.0, stolen = 0.0;
    };
    static Reading read() {
        constexpr double kTicksPerSecond = 100.0;  // USER_HZ, the same on every Linux
        std::ifstream stat("/proc/stat");
        std::string label;
        double user = 0.0, nice = 0.0, system = 0.0, idle = 0.0, wait = 0.0, irq = 0.0, soft = 0.0, stolen = 0.0;
        stat >> label >> user >> nice >> system >> idle >> wait >> irq >> soft >> stolen;
        return {static_cast<double>(std::clock()) / CLOCKS_PER_SEC,
                (user + nice + system + irq + soft) / kTicksPerSecond, stolen / kTicksPerSecond};
    }

    Stopwatch watch_;
    Reading start_;
};

}  // namespace pl::benchmarks
