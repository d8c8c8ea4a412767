// What the program does beside sessions: its subcommands and metrics, as dictionaries.
#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <nanobind/stl/string.h>

#include "app/commands.h"
#include "app/interrupt.h"
#include "core/base/error.h"
#include "core/bench/figures_json.h"
#include "python/bindings.h"
#include "python/convert.h"
#include "python/option_words.h"

namespace pl {
namespace {

nb::list run_program(const nb::args& words, const nb::kwargs& options) {
    std::vector<std::string> arguments;
    for (const nb::handle word : words) arguments.emplace_back(nb::str(word).c_str());
    std::ranges::copy(option_words(options), std::back_inserter(arguments));
    arguments.insert(arguments.end(), {"--json", "--quiet"});
    CommandLine line = parse_command_line(arguments);
    if (line.answer || line.command == Command::View)
        throw Error(ErrorKind::Usage,
                    "run: expected a subcommand such as 'bench', which has events; Session.view() opens the window");
    std::string output;
    Console console;
    console.configure(line.options);
    console.write_to([&](std::string_view text) { output += text; });
    int code = 0;
    {
        const nb::gil_scoped_release released;
        code = run_command(line, console);
    }
    if (code == kExitInterrupted) {
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw nb::python_error();
    }
    nb::list events;
    std::istringstream lines(output);
    for (std::string text; std::getline(lines, text);)
        events.append(nb::module_::import_("json").attr("loads")(text));
    return events;
}

using PictureArray = nb::ndarray<const float, nb::shape<-1, -1, 3>, nb::c_contig, nb::device::cpu>;

Pixels pixels_of(const PictureArray& array) {
    return {reinterpret_cast<const Vec3f*>(array.data()), array.size() / 3};
}

nb::object compare_pictures(const PictureArray& picture, const PictureArray& reference) {
    for (std::size_t i = 0; i < 2; ++i)
        if (picture.shape(i) != reference.shape(i))
            throw Error(ErrorKind::Input,
                        fmt::format("compare: expected a reference of {} x {} pixels, got {} x {}", picture.shape(1),
                                    picture.shape(0), reference.shape(1), reference.shape(0)));
    return from_json(bench::metrics_json(measure_error(pixels_of(picture), pixels_of(reference))));
}

}  // namespace

void bind_program(nb::module_& module) {
    module.def(
        "compare", &compare_pictures, nb::arg("picture"), nb::arg("reference"),
        "Metrics of a film against a reference, (height, width, 3), as `pathlight compare` has them: 'relmse', "
        "'bias', ...");
    module.def(
        "run", &run_program, nb::arg("words"), nb::arg("options"),
        "Runs a subcommand of the program and returns the events of its `--json`, a list of dicts that pandas "
        "takes.\n\n"
        "run('bench', 'door', 'cornell', output='results', time_limit=2, seeds=5); run('trace', 'door', "
        "pixel=(200, 300), sample=0, method='reinforcement'); run('inspect', 'door', pixel=(200, 300), "
        "output='volume.json', truth=True). Options are those of the command line, with '_' for '-'. The GIL is "
        "released; Ctrl+C ends it.");
}

}  // namespace pl
