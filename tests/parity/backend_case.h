// One picture on both back ends, compared to the bit: film with its halves, learned tables, counters.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/session/settings.h"
#include "tests/parity/difference.h"

namespace pl::parity {

struct BackendCase {
    std::shared_ptr<const SceneDescription> scene;
    RenderSettings settings{};
    std::uint32_t passes = 1;  ///< samples per pixel

    /// The settings that vary among cases, as "key=value" words.
    std::string label() const;
};

struct CaseResult {
    Difference film{};
    Difference tables{};
    bool same_counters = true;
    double cpu_seconds = 0.0;
    double cuda_seconds = 0.0;

    bool is_equal() const { return film.is_none() && tables.is_none() && same_counters; }
};

/// Renders with all threads of the CPU, and on the first CUDA device. `spoil`: the first float of the device's film is raised by one
/// unit in its last place before the comparison, so that whoever reads the result can be tested. Throws Error as the back ends do.
CaseResult compare_backends(const BackendCase& compared, bool spoil = false);

/// Prints a record of this kind; `name` tells cases apart.
void print_result(const std::string& kind, const std::string& name, const BackendCase& compared,
                  const CaseResult& result);

}  // namespace pl::parity
