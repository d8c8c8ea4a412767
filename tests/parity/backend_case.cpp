#include "tests/parity/backend_case.h"

#include <cmath>

#include "core/base/timer.h"
#include "core/session/choices.h"
#include "cuda/cuda_backend.h"
#include "tests/parity/record.h"
#include "tests/support/session/same_bits.h"

namespace pl::parity {
namespace {

struct Rendered {
    test::State state;
    double seconds = 0.0;
};

Rendered render(std::unique_ptr<RenderBackend> backend, const BackendCase& compared) {
    const Stopwatch watch;
    Session session(std::move(backend), compared.scene, compared.settings);
    test::render_passes(session, compared.passes);
    return {test::state_of(session), watch.seconds()};
}

}  // namespace

std::string BackendCase::label() const {
    const FieldSettings& field = settings.field;
    std::string words = fmt::format(
        "scene={} method={} view={} nee={} size={}x{} passes={} seed={} depth={} roulette={} guiding={} effects={}",
        scene->name, info_of(settings.method).name, info_of(settings.view).name, settings.next_event ? "on" : "off",
        settings.width, settings.height, passes, settings.seed, settings.max_depth, name_of(settings.roulette),
        name_of(settings.guiding), settings.forced_effects.bits);
    if (info_of(settings.method).uses_field)
        words += fmt::format(
            " field={} target={} light={} rate={} volumes={} bins={} precompute={} refine={} mixture={}:{}",
            name_of(field.representation), name_of(field.learning.target), name_of(field.learning.light),
            name_of(field.rate), field.volumes, field.bins, field.precompute_samples, field.refine_share,
            settings.mixture.learned, settings.mixture.bsdf_fraction);
    return words;
}

CaseResult compare_backends(const BackendCase& compared, bool spoil) {
    const Rendered cpu = render(make_cpu_backend(), compared);
    Rendered cuda = render(make_cuda_backend(), compared);
    if (spoil) {
        float& first = cuda.state.snapshot.pixels.at(0).x;
        first = std::nextafter(first, kInfinity);
    }
    const Snapshot& a = cpu.state.snapshot;
    const Snapshot& b = cuda.state.snapshot;
    CaseResult result{.cpu_seconds = cpu.seconds, .cuda_seconds = cuda.seconds};
    compare_arrays(result.film, a.pixels, b.pixels);
    for (std::size_t half = 0; half < 2; ++half)
        compare_arrays(result.film, a.halves.mean[half], b.halves.mean[half]);
    const auto compare = [&](const auto& x, const auto& y) { compare_arrays(result.tables, x, y); };
    zip(cpu.state.tables, cuda.state.tables, compare);
    test::zip_alike(cpu.state.other, cuda.state.other, compare);
    result.same_counters =
        a.passes == b.passes && a.halves.weights == b.halves.weights && test::same_events(a.counters, b.counters);
    return result;
}

void print_result(const std::string& kind, const std::string& name, const BackendCase& compared,
                  const CaseResult& result) {
    Record record(kind);
    record.field("case", name)
        .field("result", result.is_equal() ? "equal" : "differs")
        .field("film_values", result.film.values)
        .field("film_share", result.film.share())
        .field("film_largest", result.film.largest)
        .field("table_values", result.tables.values)
        .field("table_share", result.tables.share())
        .field("table_largest", result.tables.largest)
        .field("counters", result.same_counters ? "equal" : "differ")
        .field("cpu_seconds", fmt::format("{:.3f}", result.cpu_seconds))
        .field("cuda_seconds", fmt::format("{:.3f}", result.cuda_seconds))
        .field("settings", compared.label());
}

}  // namespace pl::parity
