#include "core/measure/live_runs.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/timer.h"
#include "core/measure/live_run.h"
#include "core/measure/picture_identity.h"

namespace pl {
namespace {

/// Most runs kept. A day of use makes a few hundred; beyond, the oldest run of another picture is dropped.
constexpr std::size_t kMostRuns = 500;

/// Growth of the charged time after which a new set is made even without a new point.
constexpr double kRenewedAfter = 1.25;

/// Between points: twelve per decade.
const double kPointRatio = std::pow(10.0, 1.0 / 12.0);

/// Clocks of this film alone: the clocks of a warm film exclude placement and precomputation of earlier films.
Clocks own_clocks(Clocks clocks, const FilmOrigin& origin) {
    if (!origin.warm) return clocks;
    clocks.place = std::max(clocks.place - origin.place_seconds, 0.0);
    clocks.precompute = std::max(clocks.precompute - origin.precompute_seconds, 0.0);
    return clocks;
}

/// The clocks that grow with samples. Points spaced by all charged time would omit the first samples after a long
/// precomputation.
double passing_seconds(const Clocks& clocks) { return clocks.learn + clocks.render; }

}  // namespace

LiveRuns::LiveRuns(std::size_t picture_bytes_cap, Details details, double share, Clock clock)
    : picture_bytes_cap_(picture_bytes_cap), details_(std::move(details)), clock_(std::move(clock)), budget_(share) {
    if (!clock_) clock_ = [watch = Stopwatch()] { return watch.seconds(); };
    update_current();
}

void LiveRuns::set_reference(std::shared_ptr<const LiveReference> reference) {
    if (reference) {
        const std::size_t pixels = film_pixels(reference->width, reference->height);
        if (reference->first.size() != pixels || reference->second.size() != pixels)
            throw Error(ErrorKind::Input, "expected halves of " + std::to_string(pixels) + " pixels, got " +
                                              std::to_string(reference->first.size()) + " and " +
                                              std::to_string(reference->second.size()));
    }
    reference_ = std::move(reference);
    const double start = clock_();
    const int threads = usable_threads();
    int caught_up = 0;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        if (!has_reference(runs_[i]->label.picture)) continue;
        change(i, [&](LiveRun& run) {
            for (LivePoint& point : run.points)
                if (point.picture && !point.metrics) {
                    point.metrics = measure_error(pixels_of(*point.picture), reference_halves(), threads);
                    ++caught_up;
                }
        });
    }
    // Points to come are decomposed as well (take_apart), which takes about as long again.
    const double spent = clock_() - start;
    if (caught_up > 0) budget_.expect_more(2.0 * spent / caught_up);
    unbudgeted_seconds_ += spent;
    update_current();
}

bool LiveRuns::observe(const Session& session, FilmSlot slot, bool is_last) {
    const FilmOrigin origin = session.film_origin(slot);
    if (origin.number == 0) return false;
    bool changed = origin.generation != generation_ && leave_generation(origin.generation);
    const bool is_measured = slot.view == View::Beauty;
    changed = work_on(is_measured ? origin.number : 0) || changed;
    changed = (is_measured && is_due(session, slot, origin, is_last) && add_point(session, slot, origin, is_last)) ||
              changed;
    // Points get rare, and viewers show the share of measuring in the charged time.
    const double told = current_->charged_seconds;
    changed = changed || (told > 0.0 && charged_seconds_ > kRenewedAfter * told);
    if (changed) update_current();
    return changed;
}

/// Forgets runs of one point. The films of the old generation are gone, so nothing can be added to its runs.
bool LiveRuns::leave_generation(std::uint64_t next) {
    generation_ = next;
    const std::size_t before = runs_.size();
    std::erase_if(runs_, [this](const std::shared_ptr<const LiveRun>& run) {
        return run->points.size() < 2 && tracks_.count(run->number) > 0;
    });
    tracks_.clear();
    return runs_.size() != before;
}

bool LiveRuns::work_on(std::uint64_t number) {
    if (number == number_) return false;
    number_ = number;
    bool changed = false;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        if (runs_[i]->in_progress == (runs_[i]->number == number)) continue;
        change(i, [&](LiveRun& run) {
            run.in_progress = run.number == number;
            if (const auto track = tracks_.find(run.number); track != tracks_.end())
                run.passes = track->second.passes;
        });
        changed = true;
    }
    return changed;
}

bool LiveRuns::is_due(const Session& session, FilmSlot slot, const FilmOrigin& origin, bool is_last) {
    Track& track = tracks_[origin.number];
    const double charged = charged_seconds(own_clocks(session.clocks(slot), origin));
    charged_seconds_ += charged - track.charged_seconds;
    track.charged_seconds = charged;
    const bool is_measured = is_up_to_date(session, slot);
    if (session.passes(slot) == track.passes && (!is_last || is_measured)) return false;  // a part of a pass
    track.passes = session.passes(slot);
    const double passing = passing_seconds(session.clocks(slot));
    if (track.passes < kFirstMeasured) return false;
    if (!is_last && track.passes > kLastMeasured &&
        (passing < track.next_seconds || !budget_.allows(charged_seconds_)))
        return false;
    track.next_seconds = passing * kPointRatio;
    return true;
}

bool LiveRuns::add_point(const Session& session, FilmSlot slot, const FilmOrigin& origin, bool is_last) {
    const double start = clock_();
    const std::optional<std::size_t> known = find(origin.number);
    RunLabel label = known ? runs_[*known]->label : label_of(session, slot, origin);
    if (known && details_) label.details = details_(session, slot);
    std::optional<LivePoint> point = measure(session, slot, origin, label.picture);
    tracks_[origin.number].measured = session.passes(slot);
    if (point) {
        if (!known)
            runs_.push_back(std::make_shared<const LiveRun>(
                LiveRun{.number = origin.number, .label = label, .settings = {}, .points = {}, .in_progress = true}));
        change(known.value_or(runs_.size() - 1), [&](LiveRun& run) {
            run.label.details = label.details;
            run.settings = session.settings_for(slot);
            run.passes = session.passes(slot);
            run.points.push_back(*std::move(point));
        });
        limit_runs();
        limit_pictures(label.picture);
    }
    const double spent = clock_() - start;
    if (session.passes(slot) > kLastMeasured && !is_last) {
        budget_.spend(spent);
    } else {
        budget_.note(spent);
        unbudgeted_seconds_ += spent;
    }
    return point.has_value();
}

bool LiveRuns::is_up_to_date(const Session& session, FilmSlot slot) const {
    const auto track = tracks_.find(session.film_origin(slot).number);
    return slot.view != View::Beauty || session.passes(slot) < kFirstMeasured || track == tracks_.end() ||
           track->second.measured == session.passes(slot);
}

RunLabel LiveRuns::label_of(const Session& session, FilmSlot slot, const FilmOrigin& origin) const {
    return {.method = slot.method,
            .backend = session.backend().name,
            .next_event = session.settings().next_event,
            .warm = origin.warm,
            .seed = session.settings().seed,
            .picture = picture_key(session.scene_hash(), session.settings()),
            .details = details_ ? details_(session, slot) : std::string()};
}

/// Empty if a half holds no valid sample at all.
std::optional<LivePoint> LiveRuns::measure(const Session& session, FilmSlot slot, const FilmOrigin& origin,
                                           std::uint64_t picture) const {
    const int threads = measuring_threads(session);
    const Snapshot snapshot = session.snapshot_with_halves(slot);
    if (!snapshot.halves.are_both_there()) return std::nullopt;
    const PictureHalves halves = halves_of(snapshot.halves);
    const Noise noise = estimate_noise(halves, snapshot.width, threads);
    LivePoint point{.spp = snapshot.passes,
                    .clocks = own_clocks(snapshot.clocks, origin),
                    .counters = snapshot.counters,
                    .noise = noise.relmse,
                    .noise_off = noise.relmse_off};
    if (has_reference(picture)) {
        const ErrorParts parts = take_apart(halves, reference_halves(), snapshot.width, threads);
        point.metrics = measure_error(snapshot.pixels, reference_halves(), threads);
        point.relmse_off = parts.error_off;
        point.squared_bias = parts.squared_bias;
        point.signed_bias = parts.signed_bias;
    }
    point.picture =
        std::make_shared<const HalfPicture>(half_picture(snapshot.width, snapshot.height, snapshot.pixels));
    return point;
}

void LiveRuns::forget(std::uint64_t number) {
    std::erase_if(runs_, [&](const std::shared_ptr<const LiveRun>& run) { return run->number == number; });
    if (const auto track = tracks_.find(number); track != tracks_.end()) track->second.next_seconds = 0.0;
    update_current();
}

bool LiveRuns::has_reference(std::uint64_t picture) const {
    return reference_ != nullptr && reference_->picture == picture;
}

PictureHalves LiveRuns::reference_halves() const { return {reference_->first, reference_->second}; }

std::optional<std::size_t> LiveRuns::find(std::uint64_t number) const {
    for (std::size_t i = 0; i < runs_.size(); ++i)
        if (runs_[i]->number == number) return i;
    return std::nullopt;
}

/// Replaces a run by a changed copy: sets returned by current() stay unchanged.
template <class Change>
void LiveRuns::change(std::size_t index, Change&& change) {
    LiveRun copy = *runs_[index];
    change(copy);
    runs_[index] = std::make_shared<const LiveRun>(std::move(copy));
}

void LiveRuns::limit_runs() {
    while (runs_.size() > kMostRuns) {
        const std::uint64_t present = runs_.back()->label.picture;
        const auto oldest = [&](bool of_another_picture) {
            return std::find_if(runs_.begin(), runs_.end(), [&](const std::shared_ptr<const LiveRun>& run) {
                return !run->in_progress && (!of_another_picture || run->label.picture != present);
            });
        };
        const auto other = oldest(true);
        runs_.erase(other != runs_.end() ? other : oldest(false));
    }
}

void LiveRuns::limit_pictures(std::uint64_t present) {
    std::size_t bytes = picture_bytes();
    if (bytes <= picture_bytes_cap_) return;
    while (bytes > picture_bytes_cap_) {
        const PicturePlace first = least_needed_picture(runs_, present);
        bytes -= runs_[first.run]->points[first.point].picture->bytes();
        change(first.run, [&](LiveRun& run) { run.points[first.point].picture = nullptr; });
    }
}

std::size_t LiveRuns::picture_bytes() const {
    std::size_t bytes = 0;
    for (const auto& run : runs_)
        for (const LivePoint& point : run->points) bytes += point.picture ? point.picture->bytes() : 0;
    return bytes;
}

void LiveRuns::update_current() {
    current_ = std::make_shared<const LiveRunSet>(
        LiveRunSet{.runs = runs_,
                   .picture_bytes = picture_bytes(),
                   .picture_bytes_cap = picture_bytes_cap_,
                   .measure_seconds = budget_.spent_seconds() + unbudgeted_seconds_,
                   .charged_seconds = charged_seconds_});
}

}  // namespace pl
