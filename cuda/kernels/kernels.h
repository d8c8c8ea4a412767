// Arguments and dispatch tables of the kernels: their interface to host code. Kernels take structures as
// `const __grid_constant__`, which are read where the launch put them: else each thread would copy to its stack the
// structures whose address is taken, and would read through them as memory of unknown kind.
#pragma once

#include <algorithm>
#include <array>

#include "core/base/kernel_row.h"
#include "core/kernel/film/frame_pixel.h"
#include "core/kernel/guiding/update_volume.h"
#include "core/kernel/inspect/heat_map.h"
#include "core/kernel/integrator/lamp_borders.h"
#include "core/kernel/integrator/probe.h"
#include "core/kernel/methods/method_list.h"
#include "cuda/kernels/thread_mixtures.h"

/// Blocks of a processor in which the threads of guided methods, and of kernels with lobes, go through a segment together, and in how
/// many steps at most, see StepOfBlock; 0: no barriers. Set by the options of these names of the build, so that a device
/// can decide.
#ifndef PL_CUDA_GUIDED_BLOCKS
#define PL_CUDA_GUIDED_BLOCKS 2
#endif
#ifndef PL_CUDA_GUIDED_STEPS
#define PL_CUDA_GUIDED_STEPS 5
#endif
#ifndef PL_CUDA_LOBE_BLOCKS
#define PL_CUDA_LOBE_BLOCKS 1
#endif
#ifndef PL_CUDA_LOBE_STEPS
#define PL_CUDA_LOBE_STEPS 5
#endif

namespace pl::cuda {

/// The blocks of a kernel that traces paths.
struct TraceBlock {
    std::uint32_t threads = kThreadsPerBlock;
    /// Blocks that are resident on a multiprocessor at least: the compiler limits registers by it.
    std::uint32_t resident = 1;
    int steps = 0;  ///< see StepOfBlock

    /// So many threads of a processor, in a number of blocks.
    static constexpr TraceBlock of(std::uint32_t threads, std::uint32_t blocks, int steps) {
        return {.threads = threads / blocks, .resident = blocks, .steps = steps};
    }
};

/// The instructions of a segment fit the instruction caches of a processor in `default` without lobes; the threads of other kernels go
/// through it in steps. The fastest measured variant: docs/notebook/2026-11-27-second-hour-on-a-gpu.md.
template <FeatureSet F, class M>
constexpr TraceBlock trace_block() {
    constexpr int kMostSteps = F.has(Feature::NextEventEstimation) ? 5 : 2;  // 2: the path's ray, and shading
    constexpr std::uint32_t kThreads = F.has_any(kLobeFeatures) ? 384 : 512;
    if constexpr (NetworkMethod<M>)
        return TraceBlock::of(kThreads, kThreads / kThreadsPerBlock, kMostSteps);
    else if constexpr (F.has_any(kLobeFeatures))
        return TraceBlock::of(kThreads, PL_CUDA_LOBE_BLOCKS, PL_CUDA_LOBE_STEPS);
    else if constexpr (GuidedMethod<M>)
        return TraceBlock::of(kThreads, PL_CUDA_GUIDED_BLOCKS, std::min(PL_CUDA_GUIDED_STEPS, kMostSteps));
    else
        return TraceBlock::of(F == FeatureSet{} ? 896 : 640, F == FeatureSet{} ? 7 : 5, 0);
}

/// Path numbers of one launch: [first, end).
struct PathRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
};

/// Memory for the paths that a launch leaves unfinished, at most one per thread; the same thread of the next launch resumes it.
struct Parking {
    void* states = nullptr;                     ///< the kernel's PathState. [thread]
    std::uint8_t* is_waiting = nullptr;         ///< [thread]
    std::uint32_t most_segments = 0xffffffffu;  ///< of a thread in one launch; only with memory for paths
    std::uint32_t resumes = 0;                  ///< 1: paths wait there
};

/// Arguments common to the kernels that trace paths. Persistent threads claim paths until the range is exhausted.
struct TraceSetup {
    SceneView scene;
    PathSettings path;
    PathRange range{};
    std::uint32_t* claimed = nullptr;  ///< number of paths claimed; cleared before the launch
    PassCounters* counters = nullptr;  ///< incremented
    std::uint32_t* longest = nullptr;  ///< raised to the number of segments of the thread that traced most
    void* stores = nullptr;  ///< Store of the kernel's method, of any size if kNeedsStore is false. [thread]
    Parking parking{};
};

/// Camera paths of one or several passes, numbered pass by pass. Element 0 of `radiance` belongs to the first path of the launch.
struct PixelPaths {
    Camera camera;
    PixelGrid grid;              ///< of the first pass
    std::uint32_t first = 0;     ///< number of the first path
    std::uint32_t per_pass = 1;  ///< paths of a pass: the pixels
    Span<Vec3f> radiance;
};

/// Probes, one per cell of every volume. Their radiance is added to the field's pending sums.
struct ProbePaths {
    TableView field;
    ProbeStratum stratum;
};

/// A view of the first surface; element 0 of `radiance` belongs to the pixel `first`.
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

/// Integrator, KernelMethod and picture kernels of an entry of MethodList.
template <int kEntry>
using IntegratorAt = typename TypeAt<kEntry, MethodList>::Integrator;
template <int kEntry>
using KernelMethodAt = KernelMethod<IntegratorAt<kEntry>>;
template <int kEntry>
using PictureKernels = KernelRow<PictureKernel<KernelMethodAt<kEntry>>>;
template <int kEntry>
const PictureKernels<kEntry>& picture_kernels();
extern const KernelRow<ProbeKernel> kProbeKernels;
extern const KernelRow<ViewKernel> kViewKernels;

/// For refine_emission() of the samples of a launch that are in the film, one thread per pixel; and for mark_lamp_borders(), one
/// thread per light.
struct EmissionSetup {
    SceneView scene;
    EmissionContext context;
    FilmView film;
    PathRange range{};  ///< of pixels
    PassCounters* counters = nullptr;
};
using EmissionKernel = void (*)(EmissionSetup);
extern const KernelRow<EmissionKernel> kEmissionKernels;
extern const KernelRow<EmissionKernel> kBorderKernels;

/// Gathers the records of all volumes. One thread per volume.
using GatherRecordsKernel = void (*)(TableField field, Span<VolumeRecord> records);
extern const GatherRecordsKernel kGatherRecords;

/// Evaluates volume_value(). One thread per volume.
using VolumeValueKernel = void (*)(TableUpdateView field, View view, Span<float> values);
extern const VolumeValueKernel kVolumeValues;

/// Sums over the pixels of a film.
struct FilmTotals {
    std::uint64_t weight = 0;         ///< of valid samples
    std::uint64_t invalid = 0;        ///< number of samples
    std::uint64_t second_weight = 0;  ///< of the second half; set by kReadHalves
};

/// The samples of a launch in one pass. Pixels that see a lamp are known by the launches before it in the stream.
struct LaunchSamples {
    Span<const Vec3f> radiance;
    std::uint32_t first = 0;  ///< pixel of the first one
    std::uint32_t pass = 0;
    VarianceMeasure measure{};
    PassCounters* counters = nullptr;  ///< its variance is incremented
};
/// kAddSamples adds the samples of a launch, kSetSamples replaces the samples of the film. One thread
/// per sample.
using AddSamplesKernel = void (*)(FilmView film, LaunchSamples samples);
extern const AddSamplesKernel kAddSamples;
extern const AddSamplesKernel kSetSamples;

/// Means for display and saving (see mean_or_nan), and the film's totals. One thread per pixel.
using ReadFilmKernel = void (*)(FilmView film, Span<Vec3f> means, FilmTotals* totals);
extern const ReadFilmKernel kReadFilm;

/// Means of both halves (see half_mean), and the weight of the second. One thread per pixel.
using ReadHalvesKernel = void (*)(FilmView film, Span<Vec3f> first, Span<Vec3f> second, std::uint64_t* second_weight);
extern const ReadHalvesKernel kReadHalves;

/// The frame for the window. One thread per pixel.
using ShowFilmKernel = void (*)(FilmView film, FrameStyle style, ToneCodes codes, Span<std::uint32_t> pixels);
extern const ShowFilmKernel kShowFilm;

/// The maximum of range_value() as bits, which have the order of the values. `bits` must be 0. One thread per pixel.
using LargestValueKernel = void (*)(FilmView film, std::uint32_t* bits);
extern const LargestValueKernel kLargestValue;

/// One step of an update. `count` threads, one per cell, row or volume.
using UpdateKernel = void (*)(TableUpdateView field, std::uint32_t count);

/// The items of a step of update_volume(): one thread each.
enum class UpdateItem { Cell, Row, Volume };

struct UpdateStep {
    UpdateKernel kernel;
    UpdateItem item;
    const char* name;
};
inline constexpr int kUpdateStepCount = 8;
/// The steps of update_volume() in order.
extern const std::array<UpdateStep, kUpdateStepCount> kUpdateSteps;

}  // namespace pl::cuda
