// The runs of a viewer: error, noise and cost of every method and back end tried so far, recorded while a session renders,
// with the pictures as they were.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/measure/noise.h"
#include "core/measure/run_recorder.h"

namespace pl {

/// What tells one curve from another.
struct RunLabel {
    MethodId method = MethodId::Default;
    std::string backend;
    bool next_event = false;
    /// Began with tables that had learned before: what that took is not among this run's seconds.
    bool warm = false;
    std::uint64_t seed = 0;     ///< runs that differ in nothing else are repetitions
    std::uint64_t picture = 0;  ///< picture_key(): runs with another one show other light and are never compared
    std::string details;        ///< whatever else differs from the defaults, in words
};

/// A picture as it was, to look at: linear, half floats, row 0 on top.
struct HalfPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> rgb;

    std::size_t bytes() const { return rgb.size() * sizeof(std::uint16_t); }
};

HalfPicture half_picture(int width, int height, Pixels pixels);
std::vector<Vec3f> pixels_of(const HalfPicture& picture);

struct LivePoint {
    std::uint32_t spp = 0;
    Clocks clocks;  ///< of this run: charged_seconds() is what it is plotted over
    PassCounters counters;
    double noise = 0.0;      ///< Noise::relmse of the picture's own halves: needs no reference
    double noise_off = 0.0;  ///< standard error of that over this picture's blocks: other seeds may differ by more
    /// Against the reference of the same picture; empty without one. Of a point that was measured before its reference
    /// was there, from half floats (three digits) and without the three below.
    std::optional<Metrics> metrics{};
    std::optional<double> relmse_off{};  ///< standard error of Metrics::relmse, as of noise_off
    std::optional<Estimate> squared_bias{};
    std::optional<Estimate> signed_bias{};
    std::shared_ptr<const HalfPicture> picture{};  ///< null once dropped for memory
};

/// All passes of one method into one picture, from empty on; switching away and back goes on with it.
struct LiveRun {
    std::uint64_t number = 0;  ///< of the picture in its session: never given twice
    RunLabel label;
    std::vector<LivePoint> points;  ///< at least one
    bool in_progress = false;       ///< the session works on it
};

/// Everything at one moment; never changes, so threads may share it.
struct LiveRunSet {
    std::vector<std::shared_ptr<const LiveRun>> runs;  ///< in the order in which they were first measured
    std::size_t picture_bytes = 0;
    std::size_t picture_bytes_cap = 0;
    double measure_seconds = 0.0;  ///< spent on all of this, charged to no run
    double charged_seconds = 0.0;  ///< to all runs until then, also to those that were forgotten
};

/// A converged picture in two halves.
struct LiveReference {
    std::uint64_t picture = 0;  ///< picture_key() of what it shows
    int width = 0;
    int height = 0;
    std::vector<Vec3f> first;
    std::vector<Vec3f> second;
};

/// Follows one session, in its thread. Pictures other than View::Beauty are not measured.
class LiveRuns {
public:
    /// Words for what a session's settings are besides those in RunLabel; asked at each point, because some may change
    /// while a picture stays.
    using Details = std::function<std::string(const Session&, FilmSlot)>;

    /// What measuring may take of the time that is charged.
    struct Allowance {
        /// A fifth below what is promised: it is held to what the last measurement took, and the next may take longer.
        double share = 0.8 * MeasureBudget::kDefaultShare;
        /// Of one thread, for the first measurement, which has to be paid for like the others; twice as much where there is a
        /// reference.
        double guessed_seconds_per_pixel = 70e-9;
    };

    explicit LiveRuns(std::size_t picture_bytes_cap, Details details = {});
    LiveRuns(std::size_t picture_bytes_cap, Details details, const Allowance& allowance);

    /// Errors are measured against it from now on where pictures are the same, and for points of the past that still
    /// have their pictures: that takes about as long as measuring them did. Errors that were measured stay. Null: none.
    /// Throws Error(Input) if the halves do not have the size that is told.
    void set_reference(std::shared_ptr<const LiveReference> reference);

    /// After each piece of work on a film; true if current() is another set now. A point is added after the first pass that is a
    /// twelfth of a decade of rendering and learning behind the last point, if there are two halves and if measuring
    /// stays within its share of the time charged to all runs together. A run whose picture is emptied before its second
    /// point is forgotten: that is what moving the camera leaves behind.
    bool observe(const Session& session, FilmSlot slot);

    /// A run that the session works on begins anew with its next point.
    void forget(std::uint64_t number);
    void forget_all();

    std::shared_ptr<const LiveRunSet> current() const { return current_; }

private:
    /// What is known of a film between two observations, measured or not.
    struct Track {
        double charged_seconds = 0.0;  ///< as far as charged_seconds_ has them
        double next_seconds = 0.0;     ///< of rendering and learning, before which there is no next point
        std::uint32_t passes = 0;
    };

    bool leave_generation(std::uint64_t next);
    bool work_on(std::uint64_t number);
    bool is_due(const Session& session, FilmSlot slot, const FilmOrigin& origin);
    bool add_point(const Session& session, FilmSlot slot, const FilmOrigin& origin);
    RunLabel label_of(const Session& session, FilmSlot slot, const FilmOrigin& origin) const;
    std::optional<LivePoint> measure(const Session& session, FilmSlot slot, const FilmOrigin& origin,
                                     std::uint64_t picture) const;
    bool has_reference(std::uint64_t picture) const;
    ReferenceHalves reference_halves() const;
    std::optional<std::size_t> find(std::uint64_t number) const;
    template <class Change>
    void change(std::size_t index, Change&& change);
    void limit_runs();
    void limit_pictures(std::uint64_t present);
    std::size_t picture_bytes() const;
    void publish();

    std::size_t picture_bytes_cap_;
    Details details_;
    std::shared_ptr<const LiveReference> reference_;
    std::vector<std::shared_ptr<const LiveRun>> runs_;
    std::map<std::uint64_t, Track> tracks_;  ///< by number, of the present generation
    std::uint64_t number_ = 0;               ///< of the film that was last observed; 0 for one that is not measured
    std::uint64_t generation_ = 0;
    Allowance allowance_;
    MeasureBudget budget_;
    double charged_seconds_ = 0.0;      ///< to all runs
    double catching_up_seconds_ = 0.0;  ///< of set_reference(), which was asked for and is on no budget
    std::shared_ptr<const LiveRunSet> current_;
};

}  // namespace pl
