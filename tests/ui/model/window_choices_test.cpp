#include "tests/support/described_choice.h"
#include "ui/compare/sides.h"
#include "ui/model/window_choices.h"

using namespace pl;
using namespace pl::ui;
using pl::test::check_choice;

TEST_CASE("Window choices: every value is described, and each by a name and a label of its own") {
    check_choice<diagnose::PassChoice>();
    check_choice<PathSides>();
    check_choice<LobeShape>();
    check_choice<CellQuantity>();
    check_choice<CompareMode>();
}
