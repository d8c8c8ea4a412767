// Arguments of the kernels, and tables of those compiled: all that host code sees of them.
#pragma once

#include <array>

#include "core/base/kernel_row.h"
#include "core/kernel/guiding/update_volume.h"
#include "core/kernel/film/frame_pixel.h"
#include "core/kernel/inspect/heat_map.h"
#include "core/kernel/integrator/probe.h"
#include "core/kernel/methods/method_list.h"

namespace pl::cuda {

/// Numbers of the paths of one launch: first to end, exclusive.
struct PathRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

/// Common arguments of the kernels that trace paths. Threads take paths from the range until none is left.
struct TraceSetup {
    SceneView scene;
    PathSettings path;
    PathRange range;
    std::uint32_t* claimed = nullptr;  ///< paths taken so far; cleared before the launch
    PassCounters* counters = nullptr;  ///< added to
};

/// Paths from the camera, one per pixel. Their radiance goes to `radiance`, from the first pixel of the launch on.
struct PixelPaths {
    Camera camera;
    PixelGrid grid;
    std::uint32_t first = 0;
    Span<Vec3f> radiance;
};

/// Paths from the volumes, one per cell. Their radiance goes to the field's pending sums.
struct ProbePaths {
    TableView field;
    ProbeStratum stratum;
};

/// A view of the first surface; `first` and `radiance` as in PixelPaths.
struct ViewSetup {
    SceneView scene;
    ViewContext context;
    std::uint32_t first = 0;
    Span<Vec3f> radiance;
    PassCounters* counters = nullptr;
};

template <class M>
using PictureKernel = void (*)(TraceSetup, M, PixelPaths);
using ProbeKernel = void (*)(TraceSetup, ProbeMethod, ProbePaths);
using ViewKernel = void (*)(ViewSetup);

/// Those of an entry of MethodList.
template <int kEntry>
using IntegratorAt = typename TypeAt<kEntry, MethodList>::Integrator;
template <int kEntry>
using PictureKernels = KernelRow<PictureKernel<IntegratorAt<kEntry>>>;
template <int kEntry>
const PictureKernels<kEntry>& picture_kernels();
extern const KernelRow<ProbeKernel> kProbeKernels;
extern const KernelRow<ViewKernel> kViewKernels;

/// One thread per volume: volume_value().
using VolumeValueKernel = void (*)(TableUpdateView field, View view, Span<float> values);
extern const VolumeValueKernel kVolumeValues;

/// Numbers of valid and invalid samples of a film.
struct FilmTotals {
    std::uint64_t samples = 0;
    std::uint64_t invalid = 0;
    std::uint64_t second_samples = 0;  ///< valid ones of the second half; only of kReadHalves
};

/// One thread per sample: adds the samples of a launch, whose first is that of pixel `first`, to the film, or puts them
/// in the place of what is there. `pass` is their number.
using AddSamplesKernel = void (*)(FilmView film, Span<const Vec3f> samples, std::uint32_t first, std::uint32_t pass);
extern const AddSamplesKernel kAddSamples;
extern const AddSamplesKernel kSetSamples;

/// One thread per pixel: means for display and saving (see mean_or_nan), and the film's totals.
using ReadFilmKernel = void (*)(FilmView film, Span<Vec3f> means, FilmTotals* totals);
extern const ReadFilmKernel kReadFilm;

/// One thread per pixel: means of both halves (see half_mean), and the number of the second one's samples.
using ReadHalvesKernel = void (*)(FilmView film, Span<Vec3f> first, Span<Vec3f> second,
                                  std::uint64_t* second_samples);
extern const ReadHalvesKernel kReadHalves;

/// One thread per pixel: the frame that a window shows.
using ShowFilmKernel = void (*)(FilmView film, FrameStyle style, ToneCodes codes, Span<std::uint32_t> pixels);
extern const ShowFilmKernel kShowFilm;

/// One thread per pixel: the bits of the largest range_value(), which are ordered as the values are. Cleared before.
using LargestValueKernel = void (*)(FilmView film, std::uint32_t* bits);
extern const LargestValueKernel kLargestValue;

/// One step of an update for `count` cells, rows or volumes: one thread each.
using UpdateKernel = void (*)(TableUpdateView field, std::uint32_t count);

/// The items of a step of update_volume().
enum class UpdateItem { Cell, Row, Volume };

struct UpdateStep {
    UpdateKernel kernel;
    UpdateItem item;
    const char* name;
};
inline constexpr int kUpdateStepCount = 7;
/// The steps of update_volume(), in their order.
extern const std::array<UpdateStep, kUpdateStepCount> kUpdateSteps;

}  // namespace pl::cuda
