// Counts of diagnostics.
#include "core/diagnose/diagnostics.h"

#include "tests/support/catch.hpp"

using namespace pl;
using namespace pl::diagnose;

TEST_CASE("Diagnostics: clamped training samples are those of the passes, of a radiance map those of its probes") {
    Snapshot snapshot{};
    snapshot.slot.method = MethodId::Reinforcement;
    snapshot.counters.path.method.clamped_records = 3;
    snapshot.field = FieldStatus{.records = 9, .clamped_records = 5};
    const auto clamped = [&] { return counted_diagnostics(snapshot)[index_of(DiagnosticKind::ClampedSample)]; };
    CHECK(clamped() == 3);
    snapshot.slot.method = MethodId::Precomputed;
    CHECK(clamped() == 5);
}

TEST_CASE("Diagnostics: a summary names kinds, counts and pixels, and how far the search came") {
    DiagnosticsMap map{.width = 2, .height = 1, .samples = 8, .traced = 8, .is_complete = true};
    map.pixels = {{3, 0, 0, 0}, {1, 2, 0, 0}};
    CHECK(summary_of(map) == "nothing wrong found");
    map.found = {4, 2, 0, 0};
    CHECK(summary_of(map) == "4 invalid in 2 pixels, 2 escaped in 1 pixel");
    map.has_moving_tables = true;
    CHECK(summary_of(map) == "4 invalid in 2 pixels, 2 escaped in 1 pixel, with the field as learned by now");
    map.is_complete = false;
    map.traced = 5;
    CHECK(summary_of(map) == "4 invalid in 2 pixels, 2 escaped in 1 pixel; traced 5 of 8 samples a pixel");
}
