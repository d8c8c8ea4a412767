#include "ui/worker/field_history.h"

#include <algorithm>

#include "core/session/path_settings.h"

namespace pl::ui {
namespace {

constexpr std::uint64_t kFirstPasses = 16;

/// A quarter more, rounded up.
std::uint64_t grown(std::uint64_t passes) { return (5 * passes + 3) / 4; }

bool is_continued(const FieldKeyFrame& last, const FieldKeyFrame& next) {
    return last.method() == next.method() && last.bins() == next.bins() && last.volumes() <= next.volumes() &&
           last.passes() < next.passes() && last.scene_hash() == next.scene_hash();
}

}  // namespace

FieldKeyFrame::FieldKeyFrame(LearnedField learned, std::uint64_t passes, std::optional<float> bsdf_fraction)
    : learned_(std::move(learned)), passes_(passes), bsdf_fraction_(bsdf_fraction),
      view_(field_view(learned_.shape, *learned_.volumes, learned_.field)), bytes_(field_bytes(learned_.field)) {}

VolumeInspection FieldKeyFrame::inspect(std::int32_t volume) const {
    VolumeInspection inspection = inspect_volume(view_, volume);
    if (bsdf_fraction_) inspection.bsdf_fraction = *bsdf_fraction_;
    return inspection;
}

std::uint64_t next_key_frame(std::uint64_t passes) { return passes < kFirstPasses ? passes + 1 : grown(passes); }

std::size_t frame_to_evict(const std::vector<std::uint64_t>& passes) {
    std::size_t best = 1;
    double least = 0.0;
    for (std::size_t i = 1; i + 1 < passes.size(); ++i) {
        const double growth =
            static_cast<double>(passes[i + 1]) / static_cast<double>(std::max(passes[i - 1], std::uint64_t{1}));
        if (i > 1 && growth >= least) continue;
        best = i;
        least = growth;
    }
    return best;
}

namespace {

/// The first and the last frame stay.
void give_up_beyond(std::size_t limit, FieldHistory& history) {
    while (history.bytes > limit && history.frames.size() > 2) {
        std::vector<std::uint64_t> passes;
        for (const auto& kept : history.frames) passes.push_back(kept->passes());
        const auto evicted = history.frames.begin() + static_cast<std::ptrdiff_t>(frame_to_evict(passes));
        history.bytes -= (*evicted)->bytes();
        history.frames.erase(evicted);
        ++history.evicted;
    }
}

}  // namespace

void FieldHistoryRecorder::set_limit(std::size_t bytes) {
    limit_ = bytes;
    FieldHistory kept = bytes > 0 ? *history_ : FieldHistory{};
    give_up_beyond(bytes, kept);
    history_ = std::make_shared<const FieldHistory>(std::move(kept));
}

bool FieldHistoryRecorder::is_due(std::uint64_t passes) const {
    if (history_->frames.empty()) return true;
    const std::uint64_t last = history_->frames.back()->passes();
    if (passes <= last) return passes < last;
    return passes <= kFirstPasses || passes >= grown(last);
}

void FieldHistoryRecorder::add(std::shared_ptr<const FieldKeyFrame> frame) {
    FieldHistory next = *history_;
    if (!next.frames.empty() && !is_continued(*next.frames.back(), *frame)) next = {};
    next.bytes += frame->bytes();
    next.frames.push_back(std::move(frame));
    give_up_beyond(limit_, next);
    history_ = std::make_shared<const FieldHistory>(std::move(next));
}

bool FieldHistoryRecorder::observe(const Session& session, MethodId method) {
    if (limit_ == 0) return false;
    const MethodId owner = field_owner(method);
    const std::optional<FieldStatus> status = session.field_status(owner);
    if (!status || status->precomputed_share < 1.0 || (info_of(owner).learns && status->passes == 0)) return false;
    const bool is_other = !history_->frames.empty() && history_->frames.back()->method() != owner;
    if (!is_other && !is_due(status->passes)) return false;
    const MixtureSettings mixture = mixture_of(session.settings(), owner);
    add(std::make_shared<const FieldKeyFrame>(session.export_field(owner), status->passes,
                                              mixture.learned == 0 ? std::optional(mixture.bsdf_fraction)
                                                                   : std::nullopt));
    return true;
}

}  // namespace pl::ui
