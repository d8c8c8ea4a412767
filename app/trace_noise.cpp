#include "app/trace_noise.h"

#include "app/noise_report.h"
#include "app/run_passes.h"

namespace pl {
namespace {

/// A loaded field is taken as it is, unless limits ask for more training. `default` has nothing to learn.
bool is_trained(const Options& options) {
    const MethodInfo& method = info_of(options.render.method);
    const bool is_loaded = !options.load_field.empty() && method.learns && !options.spp;
    return !method.uses_field || is_loaded;
}

}  // namespace

int trace_noise(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console) {
    if (!is_trained(options)) run_passes(session, options, interrupt, console, Until::Learned);
    const FilmSlot slot = slot_of(options.render);
    const auto pixel = static_cast<std::uint32_t>(options.pixel->y * options.render.width + options.pixel->x);
    diagnose::PixelNoiseTracer tracer(diagnose::pass_pair(session, slot), pixel);
    while (tracer.paths() < options.why_samples && tracer.advance(interrupt.flag())) {
    }
    if (!tracer.has_all_groups()) {
        console.log().warning("interrupted: too few paths for an estimate");
        return kExitInterrupted;
    }
    const diagnose::PixelNoise noise = tracer.noise();
    const std::optional<FieldStatus> field = session.field_status(slot.method);
    const NoiseOfPicture report{noise, options.render.width, field ? field->passes : 0};
    if (console.json())
        console.event("noise", noise_json(report));
    else
        console.result(noise_text(report));
    return interrupt.raised() ? kExitInterrupted : 0;
}

}  // namespace pl
