// The only virtual interface between a session and the drivers of its kernels; called a few times per pass.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/fields/field_model.h"
#include "core/kernel/film/frame_pixel.h"
#include "core/kernel/film/sample_variance.h"
#include "core/kernel/integrator/camera_emission.h"
#include "core/kernel/methods/learning_target.h"
#include "core/kernel/scene/camera.h"
#include "core/scene/scene_storage.h"
#include "core/session/methods.h"

namespace pl {

/// Films are kept by method and view, so that returning to one resumes its picture.
struct FilmSlot {
    MethodId method = MethodId::Default;
    View view = View::Beauty;

    int index() const { return static_cast<int>(method) * kViewCount + static_cast<int>(view); }
    static constexpr int kCount = kMethodCount * kViewCount;
    friend bool operator==(FilmSlot, FilmSlot) = default;
};

struct BackendInfo {
    std::string name;         ///< "cpu"
    std::string device;       ///< name of the processor
    std::string intersector;  ///< acceleration structure of the uploaded scene
    int threads = 0;          ///< of the host; 0: it runs on a device
    int ranks = 1;            ///< processes that share its work

    /// Threads for work between passes: the threads of the back end, which waits; all if the back end uses no threads of the host.
    int free_threads() const;
};

/// "Xeon, 15 threads", and of a job ", 4 ranks"; without the threads where the back end has none.
std::string device_text(const BackendInfo& info);

/// Stop flag: a running pass starts no further paths. Paths under way are finished: dropping them would drop long
/// paths more often, a bias. Paths start in ascending order, so the finished paths are the first PassCounters::paths of the pass,
/// which can be resumed there without changing a bit of the result.
using StopFlag = std::atomic<bool>;

/// End of a range without bound.
inline constexpr std::uint32_t kToTheLast = 0xffffffffu;

/// One sample for every pixel of a film from `first_pixel` up to, but not including, `end_pixel`. A request for a whole pass may
/// allow several: the back end then renders as many as suit it, one after the other, as if each had been requested. What has
/// been rendered is a prefix of their pixels, pass by pass, of PassCounters::paths pixels.
struct PassRequest {
    FilmSlot slot;
    bool is_guided = true;  ///< false: directions by the BSDF alone, by the kernel of the baseline method
    bool trains = true;     ///< false: the paths of a method that learns make no training samples
    FeatureSet features;    ///< needed; the back end runs the smallest compiled superset
    PathSettings path;
    Camera camera;
    MixtureSettings mixture{};
    LearningSettings learning{};
    std::uint32_t sample = 0;  ///< number of the sample, the same for every pixel; decides the half of the film
    std::uint32_t passes = 1;  ///< of the film, this one included
    PassSchedule schedule{};   ///< of the film
    std::uint32_t first_pixel = 0;
    std::uint32_t end_pixel = kToTheLast;
    std::uint32_t most_passes = 1;
    VarianceMeasure measure{};
    const StopFlag* stop = nullptr;

    /// The method whose field guides the paths, if it has one.
    MethodId method() const { return is_guided ? slot.method : baseline_method(); }
    MethodSettings method_settings() const { return {mixture, learning, trains}; }
    /// Of its samples in the film.
    std::uint32_t weight() const { return schedule.weight_of(passes - 1); }
    EmissionContext emission_context(const PixelGrid& grid) const { return {camera, path, grid, passes, schedule}; }
};

/// One stratified probe for every cell of every volume, or for a range of them, recorded into a method's field.
struct PrecomputeRequest {
    MethodId method = MethodId::Precomputed;
    FeatureSet features;
    PathSettings path;
    std::uint32_t sample = 0;  ///< stratum, below strata_side^2
    std::uint32_t strata_side = 4;
    std::uint32_t first_probe = 0;  ///< numbered as ProbeQuarter says
    std::uint32_t end_probe = kToTheLast;
    const StopFlag* stop = nullptr;
};

/// A film as two disjoint halves of its samples: of even and of odd passes.
struct FilmHalves {
    std::array<std::vector<Vec3f>, 2> mean;  ///< [row][column]; NaN where a half has no valid sample
    std::array<std::uint64_t, 2> weights{};  ///< of valid samples

    /// Whether both halves have samples: not before the second pass, and never if passes replace one another.
    bool are_both_there() const { return weights[0] > 0 && weights[1] > 0; }
};

struct FilmReading {
    int width = 0;
    int height = 0;
    std::vector<Vec3f> mean;    ///< [row][column]; NaN where every sample was invalid
    std::uint64_t weight = 0;   ///< of valid samples
    std::uint64_t invalid = 0;  ///< number of samples
    FilmHalves halves{};        ///< only of read_halves()
};

/// A film as a window shows it; may be in transfer from a device while the next pass runs.
struct DisplayFrame {
    int width = 0;
    int height = 0;
    /// The pixels of frame_pixel(), [row][column], valid as long as this function object. Waits for the transfer and throws if
    /// it fails. Not for two threads at once.
    std::function<const std::uint32_t*()> pixels;
};

class RenderBackend {
public:
    virtual ~RenderBackend() = default;

    virtual BackendInfo info() const = 0;

    /// Replaces the scene. The storage stays alive and unchanged as long as the back end holds it.
    virtual void upload_scene(std::shared_ptr<const HostScene> scene) = 0;

    /// Replaces the placement and drops all fields.
    virtual void upload_volumes(std::shared_ptr<const HostVolumes> volumes, const FieldShape& shape) = 0;
    virtual void upload_field(MethodId method, HostField field) = 0;
    /// Copy of a method's field; empty arrays if it has none.
    virtual HostField download_field(MethodId method) const = 0;
    virtual bool has_field(MethodId method) const = 0;
    virtual FieldReport field_report(MethodId method) const { return report_of(download_field(method)); }

    /// Allocates the film in this size and clears it.
    virtual void reset_film(FilmSlot slot, int width, int height) = 0;
    virtual FilmReading read_film(FilmSlot slot) const = 0;
    /// The same with the film's halves, a consistent snapshot.
    virtual FilmReading read_halves(FilmSlot slot) const = 0;
    /// Number of invalid samples of each pixel. [row][column]
    virtual std::vector<std::uint32_t> invalid_samples(FilmSlot slot) const = 0;
    /// Starts the 8-bit frame of the film's present state; later passes may begin at once.
    virtual DisplayFrame show_film(FilmSlot slot, const FrameStyle& style) = 0;
    /// Largest range_value() of a film: the upper end of some views' color range.
    virtual float largest_value(FilmSlot slot) = 0;

    /// View::Beauty: paths of the slot's method, which train its field if it learns. Other views: first surfaces.
    virtual PassCounters run_pass(const PassRequest& request) = 0;
    virtual PassCounters precompute(const PrecomputeRequest& request) = 0;
    /// Updates a method's field by the training samples since the last update.
    virtual void update_field(MethodId method) = 0;
};

/// Makes a back end by name: "cpu", "cuda". Throws Error(Unavailable) with the reason. May be called from any thread.
using BackendFactory = std::function<std::unique_ptr<RenderBackend>(const std::string& name)>;

/// Pixels of a film of this size. Throws Error(Usage) if there are none, or more than kernels can number.
std::size_t film_pixels(int width, int height);
/// Throws MemoryError if a film of this size does not fit the memory that is left, together with the pictures that are made of it:
/// copies for files, for the window, for its noise. `held`: pixels of films that it replaces, or that are not in this memory.
void require_film_memory(int width, int height, std::size_t held);

}  // namespace pl
