// Records the runs of a viewer while its session renders: error, noise and cost of every method and back end so far,
// and their pictures.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/measure/live_run.h"
#include "core/measure/noise.h"
#include "core/measure/run_recorder.h"

namespace pl {

/// Follows one session, and those made beside it, in their thread. Only pictures of View::Beauty are measured.
class LiveRuns {
public:
    /// Words for settings of a session besides the settings in RunLabel; called at each point, because some may
    /// change while a picture stays.
    using Details = std::function<std::string(const Session&, FilmSlot)>;

    /// Share of the charged time for measuring. A fifth below the promised share: the budget rests on the last
    /// measurement, and the next may take longer.
    static constexpr double kShare = 0.8 * MeasureBudget::kDefaultShare;
    static constexpr std::uint32_t kFirstMeasured = 2;  ///< the first pass after which a film has two halves
    static constexpr std::uint32_t kLastMeasured = kFirstMeasured + 9;

    /// Seconds since any fixed moment. It times the measuring; empty: the steady clock of the machine.
    using Clock = std::function<double()>;

    explicit LiveRuns(std::size_t picture_bytes_cap, Details details = {}, double share = kShare, Clock clock = {});

    /// Errors of its picture are measured against it from now on, and for past points that still have their pictures,
    /// in about the time of their first measurement. Existing errors stay. Null: no reference. Throws Error(Input) if
    /// the halves do not have the stated size.
    void set_reference(std::shared_ptr<const LiveReference> reference);

    /// To be called after each piece of work; returns whether current() has changed. Points are added after passes
    /// kFirstMeasured to kLastMeasured in any case, on no budget, so that a curve begins with the picture; from then on
    /// after the first pass that is a twelfth of a decade of rendering and learning behind the last point, if measuring
    /// keeps within its share of the time charged to all runs together. A run whose film is cleared
    /// before its second point is dropped: camera moves leave such runs behind. `is_last`: no pass follows for now, so that the picture
    /// as it stays is measured in any case, on no budget.
    bool observe(const Session& session, FilmSlot slot, bool is_last = false);

    /// Whether the last point of the film has all of its passes; true for films that are not measured.
    bool is_up_to_date(const Session& session, FilmSlot slot) const;

    /// If the session renders the run, it begins anew with its next point.
    void forget(std::uint64_t number);

    std::shared_ptr<const LiveRunSet> current() const { return current_; }

private:
    /// State of a film between two observations, measured or not.
    struct Track {
        double charged_seconds = 0.0;  ///< of the film, included in charged_seconds_
        double next_seconds = 0.0;     ///< of rendering and learning, at which the next point is due
        std::uint32_t passes = 0;
        std::uint32_t measured = 0;  ///< passes at the last point
    };

    bool leave_generation(std::uint64_t next);
    bool work_on(std::uint64_t number);
    bool is_due(const Session& session, FilmSlot slot, const FilmOrigin& origin, bool is_last);
    bool add_point(const Session& session, FilmSlot slot, const FilmOrigin& origin, bool is_last);
    RunLabel label_of(const Session& session, FilmSlot slot, const FilmOrigin& origin) const;
    std::optional<LivePoint> measure(const Session& session, FilmSlot slot, const FilmOrigin& origin,
                                     std::uint64_t picture) const;
    bool has_reference(std::uint64_t picture) const;
    PictureHalves reference_halves() const;
    std::optional<std::size_t> find(std::uint64_t number) const;
    template <class Change>
    void change(std::size_t index, Change&& change);
    void limit_runs();
    void limit_pictures(std::uint64_t present);
    std::size_t picture_bytes() const;
    void update_current();

    std::size_t picture_bytes_cap_;
    Details details_;
    std::shared_ptr<const LiveReference> reference_;
    std::vector<std::shared_ptr<const LiveRun>> runs_;
    std::map<std::uint64_t, Track> tracks_;  ///< by number of their film, of the present generation
    std::uint64_t number_ = 0;               ///< of the film observed last; 0 for one that is not measured
    std::uint64_t generation_ = 0;
    Clock clock_;
    MeasureBudget budget_;
    double charged_seconds_ = 0.0;     ///< to all runs
    double unbudgeted_seconds_ = 0.0;  ///< for measuring first passes, and past points in set_reference()
    std::shared_ptr<const LiveRunSet> current_;
};

}  // namespace pl
