#include "core/bench/make_reference.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/hash.h"
#include "core/base/timer.h"
#include "core/io/camera_file.h"

namespace pl::bench {
namespace {

/// Length of a stretch of passes, which a crash may lose; the first ones are shorter, so that both halves soon have samples.
constexpr double kPartSeconds = 10.0;
constexpr double kFirstPartSeconds = 1.0;

/// Far from the small seeds that users choose, and different for every stretch of passes.
std::uint64_t part_seed(std::uint64_t seed, std::size_t half, std::uint32_t part) {
    Fnv1a hash;
    hash.add(seed);
    hash.add(std::uint64_t{half});
    hash.add(std::uint64_t{part});
    return hash.value();
}

class ReferenceMaker {
public:
    ReferenceMaker(Session& session, const ReferencePlan& plan, const ReferenceStore& store)
        : session_(session), plan_(plan), store_(store), seed_(session.settings().seed) {
        const PictureContent content = content_of(session.scene(), session.settings());
        if (auto found = store.find(content)) {
            reference_ = *std::move(found);
        } else {
            reference_.name = fmt::format("{}-{}", session.scene().source.stem().string(), content.picture_hash);
            reference_.content = content;
        }
    }

    ReferenceOutcome run() {
        make_folder(store_.folder());
        while (!is_done() && !may_stop()) {
            const std::size_t half = reference_.halves[0].spp <= reference_.halves[1].spp ? 0 : 1;
            render_part(half);
            store_.save_half(reference_, half);
            store_.save_manifest(reference_, about());
        }
        const bool interrupted = !is_done();
        std::filesystem::path manifest = store_.save_manifest(reference_, about());
        return {std::move(reference_), std::move(manifest), interrupted};
    }

private:
    bool has_time() const { return !plan_.seconds || watch_.seconds() < *plan_.seconds; }

    std::uint32_t spp() const { return std::min(reference_.halves[0].spp, reference_.halves[1].spp); }
    bool is_done() const { return spp() > 0 && (spp() >= plan_.spp || !has_time()); }

    bool is_stopped() const { return plan_.stop != nullptr && *plan_.stop; }
    bool may_stop() const { return is_stopped() && (spp() > 0 || !plan_.in_both_halves); }

    double part_seconds() const {
        const double part = std::clamp(watch_.seconds(), kFirstPartSeconds, kPartSeconds);
        return plan_.seconds ? std::min(part, 0.25 * *plan_.seconds) : part;
    }

    /// One stretch of passes into a half. Passes are always finished, so that all pixels have the same samples.
    void render_part(std::size_t index) {
        ReferenceHalf& half = reference_.halves[index];
        session_.apply(EditSeed{part_seed(seed_, index, half.parts)});
        const FilmSlot slot = slot_of(session_.settings());
        const std::uint32_t wanted = plan_.spp - half.spp;
        const Stopwatch watch;
        do {
            session_.advance(slot);
            show(half.spp + session_.passes(slot), index);
        } while (session_.passes(slot) == 0 ||
                 (session_.passes(slot) < wanted && !is_stopped() && watch.seconds() < part_seconds()));
        add(half, session_.snapshot(slot), watch.seconds());
    }

    static void add(ReferenceHalf& half, const Snapshot& part, double seconds) {
        half.image.width = part.width;
        half.image.height = part.height;
        half.image.pixels =
            half.spp == 0 ? part.pixels : weighted_mean(half.image.pixels, half.spp, part.pixels, part.passes);
        half.spp += part.passes;
        half.seconds += seconds;
        ++half.parts;
    }

    void show(std::uint32_t half_spp, std::size_t index) const {
        if (!plan_.show) return;
        const double both = static_cast<double>(half_spp) + reference_.halves[1 - index].spp;
        double share = 0.5 * both / plan_.spp;
        if (plan_.seconds) share = std::max(share, watch_.seconds() / *plan_.seconds);
        plan_.show(
            {.activity = "reference",
             .share = std::min(share, 1.0),
             .spp = half_spp,
             .detail = fmt::format("half {}, {} spp, {}", index + 1, half_spp, duration_text(watch_.seconds()))});
    }

    Json about() const {
        const RenderSettings& settings = session_.settings();
        return {{"scene", plan_.scene},
                {"camera", camera_json(settings.camera)},
                {"method", info_of(settings.method).name},
                {"nee", settings.next_event},
                {"seed", seed_},
                {"complete", is_done()}};
    }

    Session& session_;
    const ReferencePlan& plan_;
    const ReferenceStore& store_;
    Stopwatch watch_;
    std::uint64_t seed_;
    Reference reference_;
};

}  // namespace

ReferenceOutcome make_reference(Session& session, const ReferencePlan& plan, const ReferenceStore& store) {
    return ReferenceMaker(session, plan, store).run();
}

}  // namespace pl::bench
