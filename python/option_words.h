// Keywords of Python as options of the command line.
#pragma once

#include <string>
#include <vector>

#include <nanobind/nanobind.h>

namespace pl {

/// nee=False: --nee=off; eye=(1, 2, 3): --eye=1,2,3; size=(64, 48): --size=64x48; why=True: --why; learn={'passes': 4}: --learn=passes=4; time_limit=2: --time-limit=2; a camera's dict:
/// its JSON. None: nothing.
std::vector<std::string> option_words(const nanobind::kwargs& options);

}  // namespace pl
