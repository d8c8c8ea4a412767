#include "python/bound_session.h"

#include <atomic>
#include <chrono>
#include <future>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "app/make_backend.h"
#include "app/options/groups.h"
#include "app/picture_target.h"
#include "app/stats_json.h"
#include "core/base/error.h"
#include "core/io/field_file.h"
#include "core/io/picture_file.h"
#include "core/io/write_scene.h"
#include "python/bindings.h"
#include "python/bound_learner.h"
#include "python/option_words.h"

namespace pl {
namespace {

bool is_of_session(const GivenOption& given) {
    const std::string_view group = given.spec->group;
    return (group == kPicture || group == kCamera || group == kField) && given.spec->name != "save-field";
}

bool is_of_scene(const LoadSettings& load) {
    return !load.parameters.empty() || !load.camera.empty() || !load.materials.empty() || load.default_light ||
           load.up_axis;
}

constexpr const char* kNoFile = "none.exr";  // the command needs a name; no file is written

CommandLine render_line(const std::string& scene, const nb::kwargs& options) {
    std::vector<std::string> arguments{"render", scene, std::string("--output=") + kNoFile};
    std::ranges::copy(option_words(options), std::back_inserter(arguments));
    return parse_command_line(arguments);
}

/// The command line that renders with these options, which are those of a session.
CommandLine session_line(const std::string& scene, const nb::kwargs& options) {
    CommandLine line = render_line(scene, options);
    for (const GivenOption& given : line.given)
        if (!is_of_session(given) && given.text != kNoFile)
            throw Error(ErrorKind::Usage, fmt::format("--{}: is no option of a session", given.spec->name));
    if (is_of_scene(line.options.load))
        throw Error(ErrorKind::Usage,
                    "--define, --materials, --default-light, --up-axis, --camera NAME: expected where the scene "
                    "is opened, Scene(..., parameters={...}, materials=..., ...)");
    return line;
}

/// Runs work without the GIL on a thread of its own, so that this one sees Ctrl+C, and calls `watch` now and then.
template <class Work, class Watch>
auto interruptibly(StopFlag& stop, Work&& work, Watch&& watch) {
    auto result = std::async(std::launch::async, std::forward<Work>(work));
    std::optional<nb::python_error> raised;
    {
        const nb::gil_scoped_release released;
        while (result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
            const nb::gil_scoped_acquire held;
            if (raised) continue;
            try {
                if (PyErr_CheckSignals() != 0) throw nb::python_error();
                watch();
            } catch (const nb::python_error& error) {
                raised.emplace(error);
                stop = true;
            }
        }
    }
    if (raised) throw *raised;
    return result.get();
}

NumpyArray<float> picture_array(std::vector<Vec3f> pixels, int width, int height) {
    return own_array<float>(std::move(pixels),
                            {static_cast<std::size_t>(height), static_cast<std::size_t>(width), 3});
}

}  // namespace

BoundSession::BoundSession(const BoundScene& scene, const nb::object& learner, const nb::kwargs& options)
    : scene_(scene) {
    const CommandLine line = session_line(scene.name, options);
    {
        const nb::gil_scoped_release released;
        FieldFiles fields(line.options);
        options_ = resolve_options(line, *scene.description, fields.loaded());
        options_.load = scene.load;
        session_.emplace(make_backend(options_.backend, options_.threads), scene.description, options_.render,
                         scene.load_seconds + fields.load_seconds());
        Console console;
        fields.hand_over(*session_, options_, console);
    }
    if (!learner.is_none()) set_learner(learner);
}

void BoundSession::set_learner(const nb::object& learner) {
    const SoleUse held = use();
    if (learner.is_none()) return drop_called();
    FieldLearner bound = bound_learner(learner);
    if (!info_of(options_.render.method).learns)
        throw Error(ErrorKind::Usage,
                    fmt::format("learner: --method {} does not learn while it renders: expected reinforcement",
                                info_of(options_.render.method).name));
    session_->set_learner(std::move(bound));
    learner_ = learner;
}

void BoundSession::render(const nb::object& spp, const nb::object& seconds, const nb::object& target_error) {
    const SoleUse held = use();
    nb::kwargs given;
    given["spp"] = spp;
    given["time_limit"] = seconds;
    given["target_error"] = target_error;
    const Options told = render_line(scene_.name, given).options;
    Options limits = options_;
    if (told.spp || told.time_limit_seconds || told.target_error) {
        limits.spp = told.spp;
        limits.time_limit_seconds = told.time_limit_seconds;
        limits.target_error = told.target_error;
    }
    target_.reset();
    if (limits.target_error) target_.emplace(*limits.target_error);
    limits.no_progress = true;  // of the console
    StopFlag stop{false};
    std::atomic<std::shared_ptr<const ProgressState>> newest;  // from the thread that renders
    nb::object bar;                                            // made when there is something to show
    const auto show = [&] {
        const std::shared_ptr<const ProgressState> state = newest.exchange(nullptr);
        if (!state) return;
        if (!bar.is_valid()) bar = nb::module_::import_("pathlight._progress").attr("Bar")();
        bar.attr("show")(state->activity, state->share, state->detail);
    };
    const auto work = [&] {
        Console console;
        const RunAids aids{.target = target_ ? &*target_ : nullptr, .show_progress = [&](const ProgressState& state) {
                               newest = std::make_shared<const ProgressState>(state);
                           }};
        return run_passes(*session_, limits, stop, console, Until::Rendered, aids);
    };
    outcome_ = interruptibly(stop, work, show);
    if (bar.is_valid()) show();
}

Snapshot BoundSession::snapshot() const {
    const nb::gil_scoped_release released;
    return session_->snapshot(slot());
}

std::uint32_t BoundSession::passes() const {
    const SoleUse held = use();
    return session_->passes(slot());
}

NumpyArray<float> BoundSession::film() const {
    const SoleUse held = use();
    Snapshot picture = snapshot();
    return picture_array(std::move(picture.pixels), picture.width, picture.height);
}

nb::tuple BoundSession::halves() const {
    const SoleUse held = use();
    Snapshot picture = session_->snapshot_with_halves(slot());
    if (!picture.halves.are_both_there())
        throw Error(ErrorKind::Usage, fmt::format("halves: expected two passes at least, got {}", picture.passes));
    return nb::make_tuple(picture_array(std::move(picture.halves.mean[0]), picture.width, picture.height),
                          picture_array(std::move(picture.halves.mean[1]), picture.width, picture.height));
}

Json BoundSession::statistics_of(const Snapshot& snapshot) const {
    return stats_json(*session_, snapshot, options_, outcome_, target_ ? &*target_ : nullptr);
}

nb::object BoundSession::statistics() const {
    const SoleUse held = use();
    return from_json(statistics_of(snapshot()));
}

BoundField BoundSession::field() const {
    const SoleUse held = use();
    return {session_->export_field(options_.render.method)};
}

void BoundSession::save(const std::filesystem::path& path) const {
    const SoleUse held = use();
    const Snapshot picture = snapshot();
    Options shown = options_;
    shown.output = path.string();
    save_picture(path, picture, options_.display,
                 metadata_of(*session_, picture, statistics_of(picture), command(Command::Render, shown),
                             outcome_.interrupted()));
}

std::string BoundSession::command(Command subcommand, const Options& shown) const {
    return command_text(subcommand, shown, scene_defaults(shown.scene, *scene_.description));
}

std::string BoundSession::view_command(const std::filesystem::path& folder, const nb::kwargs& options) const {
    const SoleUse held = use();
    Options shown = options_;
    if (scene_.is_from_arrays) {
        shown.scene = (folder / "scene.json").string();
        write_scene(*scene_.description, shown.scene);
    }
    if (session_->field_status(options_.render.method)) {
        shown.load_field = (folder / "learned.field").string();
        write_field(shown.load_field, session_->export_field(options_.render.method));
    }
    std::string text = command(Command::View, shown);
    for (const std::string& word : option_words(options)) text += fmt::format(" {}", shell_word(word));
    return text;
}

nb::bytes BoundSession::png() const {
    const SoleUse held = use();
    const std::string bytes = encode_picture(ImageKind::Png, snapshot(), options_.display, {});
    return nb::bytes(bytes.data(), bytes.size());
}

std::string BoundSession::text() const {
    return fmt::format("<pathlight.Session: {}, {}, {}x{}>", scene_.name, info_of(options_.render.method).name,
                       options_.render.width, options_.render.height);
}

void BoundSession::drop_called() {
    session_->set_learner({});
    learner_.reset();
}

void bind_session(nb::module_& module) {
    nb::class_<BoundSession>(module, "Session", nb::type_slots(CallerSlots<BoundSession>::slots),
                             "A scene that is rendered: a film, and what is learned for it.")
        .def(nb::init<const BoundScene&, const nb::object&, const nb::kwargs&>(), nb::arg("scene"),
             nb::arg("learner") = nb::none(), nb::arg("options"),
             "options: those of `pathlight render`, with '_' for '-', such as method='reinforcement', width=512, "
             "height=512, seed=1, nee=False, guiding='always', field='table', volumes=1000, bins=256, "
             "learn={'passes': 16}, camera={'fov_deg': 40}, backend='cpu', threads=2. What is not given is the "
             "scene's, or the program's default: the same settings give the same bits.\n\n"
             "learner: a Learner, or any object with a method update(samples: Samples) that returns an array "
             "(volumes, cells) of probabilities, of each volume up to a factor, or, if its attribute `returns` "
             "is 'radiance', of incident radiance. It is called at every update of the table in place of the "
             "program's own learning. The program normalizes, keeps a uniform share and the BSDF's part of the "
             "mixture, and knows the exact densities: the mean of the picture stays right whatever it returns. "
             "Another shape, nan, infinite and negative numbers are an InputError of render(), which says where; "
             "the film stays sound.")
        .def("render", &BoundSession::render, nb::kw_only(), nb::arg("spp") = nb::none(),
             nb::arg("seconds") = nb::none(), nb::arg("target_error") = nb::none(),
             nb::sig("def render(self, *, spp: int | None = None, seconds: float | None = None, "
                     "target_error: float | None = None) -> None"),
             "Renders until the film has `spp` samples per pixel, for `seconds` of this call, or down to a "
             "relMSE of its noise; the first limit that is reached ends it. Without any as the command line. "
             "Other threads of Python go on; Ctrl+C ends it, and the next call continues. A bar of tqdm, where "
             "that is installed, shows how far it is.")
        .def_prop_rw(
            "learner",
            [](const BoundSession& session) {
                return session.called().is_valid() ? session.called() : nb::object(nb::none());
            },
            &BoundSession::set_learner, nb::for_setter(nb::arg("learner").none()),
            "Of all later updates; None: the table's own learning.")
        .def_prop_ro("passes", &BoundSession::passes, "Samples per pixel of the film.")
        .def("film", &BoundSession::film,
             "Mean radiance, linear RGB, or the values of a view. (height, width, 3) float32, top row first")
        .def("halves", &BoundSession::halves,
             "The film by its even and by its odd passes, for estimates of its noise.")
        .def("statistics", &BoundSession::statistics, "Counts and timings, the members of `--stats`.")
        .def_prop_ro("field", &BoundSession::field, "A copy of what the method has learned so far.")
        .def("save", &BoundSession::save, nb::arg("path"),
             "Writes the picture: .exr and .pfm linear, .png tone mapped.")
        .def("view", python_method("_window", "open_window"), nb::sig("def view(self, **options: object) -> None"),
             "Opens the window of the program, which PATHLIGHT_PROGRAM names or the PATH has, on the same scene "
             "and settings and a copy of what has been learned. Returns when it is closed; the session stays as "
             "it is.\n\n"
             "options: of `pathlight view` beside those of the session, such as window=(1280, 800), ui_scale=1.5.")
        .def("_view_command", &BoundSession::view_command, nb::arg("folder"), nb::arg("options"))
        .def("_repr_png_", &BoundSession::png)
        .def("__repr__", &BoundSession::text);
}

}  // namespace pl
