// Inputs of comparisons for tests.
#pragma once

#include "tests/ui/hand_made_runs.h"
#include "ui/compare/compare_plan.h"

namespace pl::test {
using namespace pl::ui;

inline constexpr Rect kView{10.0f, 20.0f, 400.0f, 200.0f};  // a picture of 4 x 2 fills it

inline ReferencePicture reference_of(std::uint64_t picture = kThisPicture) {
    return {.picture = picture, .pixels = plain_picture(0x3c00), .label = "reference", .noise_relmse = 1e-4};
}

inline CompareInput input_of(const Runs& runs, const ReferencePicture* reference = nullptr, Cursor cursor = {}) {
    return {.runs = runs, .picture = kThisPicture, .kind = {}, .cursor = cursor, .reference = reference};
}

inline CompareState state_of(CompareMode mode) {
    CompareState state;
    state.mode = mode;
    return state;
}

}  // namespace pl::test
