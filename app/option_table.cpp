#include "app/option_table.h"

#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/camera_file.h"
#include "app/option_parsers.h"
#include "app/parse_values.h"
#include "core/base/error.h"
#include "core/scene/needed_effects.h"

namespace pl {
namespace {

using enum Command;
constexpr CommandSet kEverywhere(View, Render, Info, Devices, Inspect, Compare, Reference, Bench, Report, SelfTest);
constexpr CommandSet kWithScene(View, Render, Info, Inspect, Reference, Bench);
constexpr CommandSet kThreaded(View, Render, Info, Inspect, Reference, Bench, SelfTest);
constexpr CommandSet kOneMethod(View, Render, Info, Inspect, Reference);
constexpr CommandSet kPaths(View, Render, Inspect, Reference, Bench);
constexpr CommandSet kSampling(View, Render, Inspect);
constexpr CommandSet kPictures(View, Render);
constexpr CommandSet kHeadless(Render, Info, Devices, Inspect, Compare, Reference, Bench, Report, SelfTest);
constexpr CommandSet kFiles(Render, Inspect);
constexpr CommandSet kWorking(Render, Inspect, Reference, Bench);

constexpr std::string_view kOutput = "Output";
constexpr std::string_view kPicture = "Picture";
constexpr std::string_view kStop = "When to stop (the first one that is met)";
constexpr std::string_view kCompared = "What is compared";
constexpr std::string_view kOutcome = "Outcome";
constexpr std::string_view kCamera = "Camera";
constexpr std::string_view kField = "Learned field";
constexpr std::string_view kPlace = "What to inspect";
constexpr std::string_view kMessages = "Messages";
constexpr std::string_view kViewer = "Viewer";
constexpr std::string_view kHidden = "";

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

template <auto kMember>
void parse_text(Options& options, const std::string& text) {
    options.*kMember = text;
}

template <auto kMember>
void parse_flag(Options& options, const std::string&) {
    options.*kMember = true;
}

template <auto kMember>
void parse_side(Options& options, const std::string& text) {
    options.*kMember = static_cast<int>(parse_whole(text, 1, kMaxImageSide));
}

void parse_spp(Options& options, const std::string& text) {
    options.spp = static_cast<std::uint32_t>(parse_whole(text, 1, 1000000000));
}

void refuse_save_field(Options&, const std::string&) {
    throw Error(ErrorKind::Usage, "the viewer saves what was learned when Ctrl+Shift+S is pressed");
}

using Text = const std::string&;

// clang-format off
const auto kTable = std::to_array<OptionSpec>({
    {.name = "output", .flags = "-o,--output,--outfile", .value = "FILE", .group = kOutput,
     .help = "What to write; the suffix decides the kind: .exr and .pfm linear, .png tone mapped "
             "(inspect: .json, .csv, .png)",
     .commands = kFiles, .parse = parse_text<&Options::output>,
     .print = [](const Options& o) { return o.output; }},
    {.name = "output", .flags = "-o,--output,--outfile", .value = "DIR", .group = kOutput,
     .help = "Folder of references; it may hold others",
     .commands = CommandSet(Reference), .parse = parse_text<&Options::output>},
    {.name = "output", .flags = "-o,--output,--outfile", .value = "DIR", .group = kOutput,
     .help = "Folder of this bench; one that was interrupted goes on",
     .commands = CommandSet(Bench), .parse = parse_text<&Options::output>},
    {.name = "stats", .flags = "--stats", .value = "FILE", .group = kOutput,
     .help = "Write counts and timings as JSON",
     .commands = kFiles, .parse = parse_text<&Options::stats_file>},
    {.name = "diagnostics", .flags = "--diagnostics", .value = "FILE", .group = kOutput,
     .help = "Trace the paths again, and write where samples were invalid, paths escaped, lookups missed, records were "
             "clamped: .png marks them in the picture, .exr and .pfm hold counts; --stats has both as numbers",
     .commands = CommandSet(Render), .parse = parse_text<&Options::diagnostics_file>},

    {.name = "at", .flags = "--at", .value = "X,Y,Z[,NX,NY,NZ]", .group = kPlace,
     .help = "The volume nearest to this point whose normal agrees; without a normal, the point is moved to the "
             "closest surface and the side it lies on counts",
     .commands = CommandSet(Inspect), .parse = parse_at},
    {.name = "pixel", .flags = "--pixel", .value = "X,Y", .group = kPlace,
     .help = "The volume that serves the surface seen there; 0,0 is the top left pixel",
     .commands = CommandSet(Inspect), .parse = parse_pixel},

    {.name = "method", .flags = "--method", .value = "NAME", .group = kPicture,
     .help = "How directions are chosen: default, precomputed, reinforcement (see --list-methods)",
     .commands = kOneMethod, .in_scene_files = true, .parse = parse_method,
     .print = [](const Options& o) { return std::string(info_of(o.render.method).name); }},
    {.name = "method", .flags = "--method", .value = "NAME,..", .group = kCompared,
     .help = "Methods to compare, with commas between (default: all); the first one is what the others are held against",
     .commands = CommandSet(Bench), .parse = parse_methods},
    {.name = "backend", .flags = "--backend", .value = "NAME,..", .group = kCompared,
     .help = "Back ends to compare: cpu, cuda (default: all that are available)",
     .commands = CommandSet(Bench), .parse = parse_backends},
    {.name = "effects", .flags = "--effects", .value = "", .group = kCompared,
     .help = "Compare kernels instead: the one that a scene needs, and those that can do more effects; --seeds is the number of "
             "rounds",
     .commands = CommandSet(Bench), .parse = parse_flag<&Options::effects>},
    {.name = "seeds", .flags = "--seeds", .value = "N", .group = kCompared,
     .help = "Runs of each method on each scene and back end (default 10); intervals need at least 5",
     .commands = CommandSet(Bench),
     .parse = [](Options& o, Text text) { o.seeds = static_cast<int>(parse_whole(text, 1, 100000)); }},
    {.name = "reference", .flags = "--reference", .value = "DIR", .group = kCompared,
     .help = "Folder of references; one that is missing there is refused (default: DIR/references, made as needed)",
     .commands = CommandSet(Bench), .parse = parse_text<&Options::reference_folder>},
    {.name = "reference-spp", .flags = "--reference-spp", .value = "N", .group = kCompared,
     .help = "Samples per pixel in each half of references made here (default 4096)",
     .commands = CommandSet(Bench),
     .parse = [](Options& o, Text text) {
         o.reference_spp = static_cast<std::uint32_t>(parse_whole(text, 1, 1000000000));
     }},
    {.name = "gate", .flags = "--gate", .value = "FILE", .group = kOutcome,
     .help = "Exit with 5 if a method is slower to the same error than in this earlier results.json: by more than the "
             "tolerance even at the near end of its interval",
     .commands = CommandSet(Bench), .parse = parse_text<&Options::gate>},
    {.name = "tolerance", .flags = "--tolerance", .value = "PERCENT", .group = kOutcome,
     .help = "Of the gate (default 10)",
     .commands = CommandSet(Bench),
     .parse = [](Options& o, Text text) { o.tolerance_percent = parse_real(text, 0.0, 1.0e6); }},
    {.name = "measure-share", .flags = "--measure-share", .value = "PERCENT", .group = kOutcome,
     .help = "Of the charged time, what measuring may take besides (default 1); points are left out for it, but for the "
             "first and the last one of a run",
     .commands = CommandSet(Bench),
     .parse = [](Options& o, Text text) { o.measure_percent = parse_real(text, 0.0, 1.0e9); },
     .print = [](const Options& o) { return print_real(o.measure_percent); }},

    {.name = "view", .flags = "--view", .value = "NAME", .group = kPicture,
     .help = "What is shown: beauty, direct, radiance-map, voronoi, normal, albedo, depth; numbers of what is "
             "learned: visits, irradiance, entropy, bsdf-share, change, unvisited (see --list-views)",
     .commands = kPictures, .in_scene_files = true, .parse = parse_view,
     .print = [](const Options& o) { return std::string(info_of(o.render.view).name); }},
    {.name = "backend", .flags = "--backend", .value = "NAME", .group = kPicture,
     .help = "What computes: auto, cpu, cuda",
     .commands = kOneMethod, .in_scene_files = true, .parse = parse_backend,
     .print = [](const Options& o) { return o.backend; }},
    {.name = "backend", .flags = "--backend", .value = "NAME", .group = kCompared,
     .help = "What is tested: cpu, cuda (default: all that are available)",
     .commands = CommandSet(SelfTest), .parse = parse_backend},
    {.name = "threads", .flags = "-t,--threads", .value = "N", .group = kPicture,
     .help = "CPU threads (default: all); the picture does not depend on it",
     .commands = kThreaded, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.threads = static_cast<int>(parse_whole(text, 1, 1024)); },
     .print = [](const Options& o) { return o.threads == 0 ? "" : std::to_string(o.threads); }},
    {.name = "size", .flags = "--size", .value = "WxH", .group = kPicture,
     .help = "Picture size in pixels (default 512x512, or the scene's)",
     .commands = kPaths, .in_scene_files = true, .parse = parse_picture_size,
     .print = [](const Options& o) { return fmt::format("{}x{}", o.render.width, o.render.height); }},
    {.name = "width", .flags = "--width", .value = "N", .group = kPicture,
     .help = "Picture width; alone, the height keeps the scene's aspect",
     .commands = kPaths, .in_scene_files = true, .parse = parse_side<&Options::width>},
    {.name = "height", .flags = "--height", .value = "N", .group = kPicture,
     .help = "Picture height; alone, the width keeps the scene's aspect",
     .commands = kPaths, .in_scene_files = true, .parse = parse_side<&Options::height>},
    {.name = "seed", .flags = "--seed", .value = "N", .group = kPicture,
     .help = "Of the random numbers (default 1): same seed, same bits",
     .commands = kPaths, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.render.seed = parse_whole(text, 0, kNoLimit); },
     .print = [](const Options& o) { return std::to_string(o.render.seed); }},
    {.name = "max-depth", .flags = "--max-depth", .value = "N", .group = kPicture,
     .help = "Most surface points on a path (default 64), a safety net: roulette ends paths",
     .commands = kPaths, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.render.max_depth = static_cast<int>(parse_whole(text, 1, 65536)); },
     .print = [](const Options& o) { return std::to_string(o.render.max_depth); }},
    {.name = "nee", .flags = "--nee", .value = "on|off", .group = kPicture,
     .help = "Next-event estimation: also aim at lights, combined by multiple importance sampling (default off)",
     .commands = kWithScene, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.render.next_event = parse_switch(text); },
     .print = [](const Options& o) { return std::string(o.render.next_event ? "on" : "off"); }},
    {.name = "roulette", .flags = "--roulette", .value = "NAME", .group = kPicture,
     .help = "What ends paths early, and splits them: spare (default): the reflectances end them, what is learned may spare "
             "or split one; albedo: the reflectances alone; field: what is learned alone",
     .commands = kSampling, .in_scene_files = true, .parse = parse_roulette,
     .print = [](const Options& o) { return std::string(name_of(o.render.roulette)); }},
    {.name = "force-effects", .flags = "--force-effects", .value = "NAME,..", .group = kPicture,
     .help = "Use a kernel that can do these effects, too, although the scene lacks them: it is slower, and the picture "
             "stays the same to the bit. Names as 'info' prints them, or all",
     .commands = kWithScene, .parse = parse_forced_effects,
     .print = [](const Options& o) { return fmt::format("{}", fmt::join(effect_names(o.render.forced_effects), ",")); }},
    {.name = "knob", .flags = "--knob", .value = "NAME=VALUE", .group = kPicture,
     .help = "Turn a knob of the scene; may be given several times ('info' lists them)",
     .commands = kWithScene, .repeatable = true, .parse = parse_knobs, .print = print_knobs},
    {.name = "exposure", .flags = "--exposure", .value = "EV", .group = kPicture,
     .help = "Display only: factor 2^EV (default 0)",
     .commands = kPictures, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.display.exposure_ev = static_cast<float>(parse_real(text, -64, 64)); },
     .print = [](const Options& o) { return print_float(o.display.exposure_ev); }},
    {.name = "tonemap", .flags = "--tonemap", .value = "NAME", .group = kPicture,
     .help = "Display only: clamp (default), reinhard, aces",
     .commands = kPictures, .in_scene_files = true, .parse = parse_tone_curve,
     .print = [](const Options& o) { return std::string(tone_curve_name(o.display.curve)); }},

    {.name = "spp", .flags = "--spp,--samples", .value = "N", .group = kStop,
     .help = "Samples per pixel (default 64 unless another limit is given; the viewer goes on)",
     .commands = kSampling, .in_scene_files = true,
     .parse = parse_spp,
     .print = [](const Options& o) { return o.spp ? std::to_string(*o.spp) : ""; }},
    {.name = "spp", .flags = "--spp,--samples", .value = "N", .group = kStop,
     .help = "Samples per pixel in each half (default 4096 unless a time limit is given)",
     .commands = CommandSet(Reference), .parse = parse_spp},
    {.name = "spp", .flags = "--spp,--samples", .value = "N", .group = kStop,
     .help = "Samples per pixel of a run (default 64 unless a time limit or a target error is given)",
     .commands = CommandSet(Bench), .parse = parse_spp,
     .print = [](const Options& o) { return o.spp ? std::to_string(*o.spp) : ""; }},
    {.name = "target-error", .flags = "--target-error", .value = "X", .group = kStop,
     .help = "A relMSE at which runs end; how long they took to it is told",
     .commands = CommandSet(Bench), .parse = parse_target_error,
     .print = [](const Options& o) { return o.target_error ? print_real(*o.target_error) : ""; }},
    {.name = "time-limit", .flags = "--time-limit", .value = "SECONDS", .group = kStop,
     .help = "Of work after loading, looked at after every sample per pixel; at least one is made",
     .commands = kPaths, .in_scene_files = true, .parse = parse_time_limit,
     .print = [](const Options& o) { return o.time_limit_seconds ? print_real(*o.time_limit_seconds) : ""; }},
    {.name = "target-error", .flags = "--target-error", .value = "X", .group = kStop,
     .help = "When relMSE is at most X: against the reference in the folder --reference, or without one the picture's own "
             "noise, told by two halves of its samples and trusted from 16 samples per pixel on. Exit with 5 if another "
             "limit came first",
     .commands = CommandSet(Render), .in_scene_files = true, .parse = parse_target_error,
     .print = [](const Options& o) { return o.target_error ? print_real(*o.target_error) : ""; }},
    {.name = "reference", .flags = "--reference", .value = "DIR", .group = kStop,
     .help = "Folder of references for --target-error; one that is missing there is refused",
     .commands = CommandSet(Render), .parse = parse_text<&Options::reference_folder>,
     .print = [](const Options& o) { return o.reference_folder; }},
    {.name = "target-error", .flags = "--target-error", .value = "X", .group = kHidden, .help = "",
     .commands = CommandSet(View, Inspect),
     .parse = [](Options&, Text) { fail_not_yet("stop by --spp or --time-limit"); }},
    {.name = "target-error", .flags = "--target-error", .value = "X", .group = kOutcome,
     .help = "Exit with 5 if relMSE is above this",
     .commands = CommandSet(Compare), .parse = parse_target_error},
    {.name = "flip", .flags = "--flip", .value = "", .group = kOutcome,
     .help = "Also FLIP, the difference that an eye sees flipping between both pictures on a display: 0 none, 1 the "
             "largest; radiance above 1 is white there",
     .commands = CommandSet(Compare), .parse = parse_flag<&Options::flip>},
    {.name = "pixels-per-degree", .flags = "--pixels-per-degree", .value = "N", .group = kOutcome,
     .help = "With --flip, how fine the display is to the eye (default 67: a 0.7 m wide 4K display from 0.7 m)",
     .commands = CommandSet(Compare),
     .parse = [](Options& o, Text text) { o.pixels_per_degree = parse_real(text, 1.0, 1000.0); }},

    {.name = "camera", .flags = "--camera", .value = "FILE", .group = kCamera,
     .help = "JSON file {\"eye\": [x,y,z], \"target\": [x,y,z], \"up\": [x,y,z], \"fov_deg\": vertical, "
             "\"aperture_radius\": r, \"focus_distance\": d}; goes over the scene's camera, and the options below over both",
     .commands = kPaths, .parse = [](Options& o, Text text) { o.camera = load_camera_file(text); }},
    {.name = "eye", .flags = "--eye", .value = "X,Y,Z", .group = kCamera, .help = "Where the camera is",
     .commands = kPaths, .parse = [](Options& o, Text text) { o.camera.eye = parse_vector(text); },
     .print = [](const Options& o) { return print_vector(o.render.camera.eye); }},
    {.name = "target", .flags = "--target", .value = "X,Y,Z", .group = kCamera,
     .help = "A point in the middle of the picture",
     .commands = kPaths, .parse = [](Options& o, Text text) { o.camera.target = parse_vector(text); },
     .print = [](const Options& o) { return print_vector(o.render.camera.target); }},
    {.name = "up", .flags = "--up", .value = "X,Y,Z", .group = kCamera,
     .help = "A direction that points up in the picture",
     .commands = kPaths, .parse = [](Options& o, Text text) { o.camera.up = parse_vector(text); },
     .print = [](const Options& o) { return print_vector(o.render.camera.up); }},
    {.name = "fov", .flags = "--fov", .value = "DEG", .group = kCamera, .help = "Full vertical angle of view",
     .commands = kPaths, .parse = parse_fov,
     .print = [](const Options& o) { return print_float(o.render.camera.fov_deg); }},
    {.name = "aperture", .flags = "--aperture", .value = "R", .group = kCamera,
     .help = "Radius of the lens; 0 is a pinhole, which is sharp everywhere",
     .commands = kPaths, .parse = parse_aperture,
     .print = [](const Options& o) { return print_float(o.render.camera.aperture_radius); }},
    {.name = "focus", .flags = "--focus", .value = "D", .group = kCamera,
     .help = "Distance that a lens is sharp at, along the view",
     .commands = kPaths, .parse = parse_focus,
     .print = [](const Options& o) { return print_float(o.render.camera.focus_distance); }},

    {.name = "volumes", .flags = "--volumes", .value = "N", .group = kField,
     .help = "Number of radiance volumes (default: what the budget holds, at most 1000)",
     .commands = kPaths, .in_scene_files = true,
     .parse = [](Options& o, Text text) { o.render.field.volumes = static_cast<int>(parse_whole(text, 1, 1000000)); },
     .print = [](const Options& o) {
         return o.render.field.volumes == 0 ? "" : std::to_string(o.render.field.volumes);
     }},
    {.name = "field-budget", .flags = "--field-budget", .value = "MB", .group = kField,
     .help = "Memory of one method's learned field (default 16)",
     .commands = kPaths, .in_scene_files = true, .parse = parse_field_budget,
     .print = [](const Options& o) { return print_real(o.render.field.budget_megabytes); }},
    {.name = "refine", .flags = "--refine", .value = "SHARE|auto", .group = kField,
     .help = "How many more volumes reinforcement may add, 0 to 1 of those placed: after 8 and 16 passes it splits "
             "those that many paths ask and whose neighbours have learned something else; within the budget, unless "
             "--volumes is given. auto (default): up to 1, also after 48, 96 and so on, as far as paths have recorded "
             "enough for them; 0 with --volumes",
     .commands = kPaths, .in_scene_files = true, .parse = parse_refine,
     .print = [](const Options& o) { return print_refine(o.render.field.refine_share); }},
    {.name = "bins", .flags = "--bins", .value = "N", .group = kField,
     .help = "Directions per volume, a square number from 4 to 1024 (default 256)",
     .commands = kPaths, .in_scene_files = true, .parse = parse_bins,
     .print = [](const Options& o) { return std::to_string(o.render.field.bins); }},
    {.name = "bsdf-fraction", .flags = "--bsdf-fraction", .value = "X|learned", .group = kField,
     .help = "Share of directions that follow the surface instead of the field, 0.1 to 1; learned (default): each volume "
             "finds its own, precomputed takes 0.5",
     .commands = kPaths, .in_scene_files = true, .parse = parse_bsdf_fraction,
     .print = [](const Options& o) { return print_bsdf_fraction(o.render.mixture); }},
    {.name = "learning-rate", .flags = "--learning-rate", .value = "NAME", .group = kField,
     .help = "How far a new record moves what is learned: forgetful (default, lets go of the early ones), mean "
             "(1/(1+visits)), power (n^-0.7), or floor (mean, but always 0.05 at least)",
     .commands = kSampling, .in_scene_files = true, .parse = parse_learning_rate,
     .print = [](const Options& o) { return std::string(name_of(o.render.field.rate)); }},
    {.name = "learn-target", .flags = "--learn-target", .value = "NAME", .group = kField,
     .help = "What reinforcement records: expected-sarsa (default, the mean over the next direction), sarsa (the next "
             "direction that was drawn), or monte-carlo (the light that the path brought)",
     .commands = kSampling, .in_scene_files = true, .parse = parse_learn_target,
     .print = [](const Options& o) { return std::string(name_of(o.render.field.learning.target)); }},
    {.name = "learn-from", .flags = "--learn-from", .value = "NAME", .group = kField,
     .help = "With next-event estimation, what reinforcement records: all light (default), or indirect: only what light "
             "samples do not bring",
     .commands = kSampling, .in_scene_files = true, .parse = parse_learn_from,
     .print = [](const Options& o) { return std::string(name_of(o.render.field.learning.light)); }},
    {.name = "lookup", .flags = "--lookup", .value = "NAME", .group = kField,
     .help = "How the volume of a point is found: grid (default), kdtree, or linear, which is slow; all find the same",
     .commands = kPaths, .parse = parse_lookup,
     .print = [](const Options& o) { return std::string(lookup_name(o.render.field.lookup)); }},
    {.name = "load-field", .flags = "--load-field", .value = "FILE", .group = kField,
     .help = "Go on from a field that was saved for this scene: it brings method, volumes, bins and what was learned. "
             "Timings count this run only. 'inspect' then trains only if --spp or --time-limit is given",
     .commands = kSampling, .parse = parse_text<&Options::load_field>,
     .print = [](const Options& o) { return o.load_field; }},
    {.name = "save-field", .flags = "--save-field", .value = "FILE", .group = kField,
     .help = "Write what was learned, also when interrupted; a run that loads it goes on exactly there",
     .commands = kFiles, .parse = parse_text<&Options::save_field>},
    {.name = "save-field", .flags = "--save-field", .value = "FILE", .group = kHidden, .help = "",
     .commands = CommandSet(View), .parse = refuse_save_field},

    {.name = "json", .flags = "--json", .value = "", .group = kMessages,
     .help = "One JSON object per line on standard output instead of text",
     .commands = kEverywhere, .parse = parse_flag<&Options::json>},
    {.name = "quiet", .flags = "-q,--quiet", .value = "", .group = kMessages, .help = "Errors only",
     .commands = kEverywhere, .parse = parse_flag<&Options::quiet>},
    {.name = "verbose", .flags = "-v,--verbose", .value = "", .group = kMessages, .help = "More messages",
     .commands = kEverywhere, .parse = [](Options& o, Text) { ++o.verbosity; }},
    {.name = "log-file", .flags = "--log-file", .value = "FILE", .group = kMessages,
     .help = "Append all messages to a file as well",
     .commands = kEverywhere, .parse = parse_text<&Options::log_file>},
    {.name = "no-progress", .flags = "--no-progress", .value = "", .group = kMessages,
     .help = "No progress bar, no progress lines",
     .commands = kWorking, .parse = parse_flag<&Options::no_progress>},
    {.name = "headless", .flags = "--headless,--no-gui", .value = "", .group = kHidden, .help = "",
     .commands = kHeadless, .parse = [](Options&, Text) {}},

    {.name = "window", .flags = "--window", .value = "WxH", .group = kViewer, .help = "Window size (default 1440x900)",
     .commands = CommandSet(View), .parse = parse_window},
    {.name = "software", .flags = "--software", .value = "", .group = kViewer,
     .help = "Draw the window without a graphics card",
     .commands = CommandSet(View), .parse = parse_flag<&Options::software>},
    {.name = "script", .flags = "--script", .value = "FILE", .group = kViewer,
     .help = "Feed the window with input from a file; needs no display",
     .commands = CommandSet(View), .parse = parse_text<&Options::script>},
    {.name = "ui-trace", .flags = "--ui-trace", .value = "FILE", .group = kViewer,
     .help = "Write the time of every frame of the window",
     .commands = CommandSet(View), .parse = parse_text<&Options::ui_trace>},
});
// clang-format on

}  // namespace

std::span<const OptionSpec> option_table() { return kTable; }

void apply_option(const OptionSpec& spec, Options& options, const std::string& text) {
    try {
        spec.parse(options, text);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::Usage) throw;
        throw Error(ErrorKind::Usage, fmt::format("--{}: {}", spec.name, error.what()));
    }
}

}  // namespace pl
