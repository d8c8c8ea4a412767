// The update of mixtures of lobes: one step of expectation-maximization, with the priors, the splits and the merges of Ruppert et al.
// 2020.
#include "core/fields/lobe_model.h"

#include "core/base/parallel.h"
#include "core/fields/mixture_fit.h"
#include "core/fields/volume_irradiance_update.h"

namespace pl {
namespace {

constexpr std::uint32_t kMixtureChunk = 16;

/// Without any light the mixture stays.
void update_mixture(const FieldShape& shape, HostLobes& lobes, std::uint32_t volume) {
    const std::uint32_t fresh = lobes.pending_samples[volume];
    if (fresh == 0) return;
    const std::uint32_t visits = lobes.samples[volume];
    MixtureFit fit(lobes, volume, static_cast<double>(visits) + fresh);
    fit.absorb(lobes, shape.radiance_unit, fresh, learning_step(visits, fresh, shape.rate));
    if (fit.fit()) fit.store(lobes);
}

}  // namespace

void LobeModel::update(const FieldShape& shape, const HostVolumes&, HostLobes& lobes, int threads) {
    const VolumeUpdateView view = volume_update_view(shape, lobes);
    for_chunks(static_cast<std::uint32_t>(volume_count(lobes)), kMixtureChunk, threads, [&](IndexRange range) {
        for (std::uint32_t volume = range.begin; volume < range.end; ++volume) {
            update_mixture(shape, lobes, volume);
            absorb_volume(view, volume);
            move_mixture(view, volume);
        }
    });
}

}  // namespace pl
