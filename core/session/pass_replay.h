// The passes of a picture as data: enough to trace any of their paths again in another thread and at a later time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/session/backend.h"

namespace pl {

/// Passes of a picture, one after the other, that draw the numbers of first vertices from the same sequences.
struct PassRun {
    std::uint32_t first_pass = 0;    ///< within the picture
    std::uint32_t first_sample = 0;  ///< number of that pass for its random numbers
    VertexSequences sequences{};
    bool is_guided = true;  ///< also for methods without a field
    bool trains = false;    ///< the passes train the field
    bool decides = false;   ///< the passes decide about guiding

    bool is_like(const PassRun& other) const {
        return is_guided == other.is_guided && trains == other.trains && decides == other.decides;
    }
    /// Sequences that no other run has begun.
    VertexSequences own_sequences() const { return {2 * first_sample, first_sample}; }
    /// The rest of the sequences of the last run before this one that is like it, if the choice of guiding has not changed since. Own
    /// ones where the halves of the film would exchange theirs.
    VertexSequences sequences_behind(std::span<const PassRun> runs) const;

    friend bool operator==(const PassRun&, const PassRun&) = default;
};

inline VertexSequences PassRun::sequences_behind(std::span<const PassRun> runs) const {
    std::uint32_t end = first_pass;
    for (std::size_t i = runs.size(); i-- > 0 && (runs[i].decides || runs[i].is_guided == is_guided);
         end = runs[i].first_pass) {
        if (!is_like(runs[i])) continue;
        const VertexSequences& last = runs[i].sequences;
        const std::uint32_t drawn = runs[i].first_sample + (end - runs[i].first_pass) - last.first_sample;
        const VertexSequences rest{last.name, first_sample - drawn};
        return (rest.first_sample - last.first_sample) % 2 == 0 ? rest : own_sequences();
    }
    return own_sequences();
}

/// Taken from a session at one moment; see Session::pass_replay(). May move to another thread.
struct PassReplay {
    int width = 0;
    int height = 0;
    PassSchedule schedule{};
    std::uint32_t samples = 0;     ///< complete passes
    std::uint32_t next_pixel = 0;  ///< of the pass under way: pixels before it have one more sample
    /// Invalid samples of each pixel, as the film counts them; empty if there are none. [row][column]
    std::vector<std::uint32_t> invalid{};

    std::shared_ptr<const HostScene> scene{};
    PathSettings path{};
    Camera camera{};
    bool is_closed = false;         ///< closed surfaces surround the camera
    std::vector<PassRun> runs{{}};  ///< in the order of their passes; at least one

    /// The run that a pass of this number within the picture belongs to.
    const PassRun& run_of(std::uint32_t pass) const {
        const auto next = std::ranges::upper_bound(runs, pass, {}, &PassRun::first_pass);
        return *(next == runs.begin() ? next : next - 1);
    }
    /// Whether that pass is guided; true also for methods without a field.
    bool is_guided(std::uint32_t pass) const { return run_of(pass).is_guided; }

    std::shared_ptr<const HostVolumes> volumes{};  ///< null for methods without a field, for which the rest is unset
    FieldShape shape{};
    HostField field{};
    MixtureSettings mixture{};
    LearningSettings learning{};
    PathSettings unguided_path{};    ///< of passes that are not guided
    bool has_moving_tables = false;  ///< updates have changed the tables since they were sampled by the passes
    bool repeats_training = false;   ///< a path traced again makes the same training samples as in its pass
};

}  // namespace pl
