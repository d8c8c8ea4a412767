#include "cuda/cuda_backend.h"

#include <array>
#include <optional>

#include "core/fields/field_kernels.h"
#include "core/kernel/integrator/sampled_lights.h"
#include "core/session/exact_backend.h"
#include "cuda/availability.h"
#include "cuda/device_fields.h"
#include "cuda/device_films.h"
#include "cuda/path_launcher.h"

namespace pl::cuda {
namespace {

using DeviceScene = SceneStorage<DeviceArray>;

class CudaBackend final : public ExactBackend {
public:
    explicit CudaBackend(const CudaOptions& options)
        : device_(cuda_devices().at(0)), launcher_(stream_, options.most_segments) {}

    BackendInfo info() const override {
        return {.name = "cuda", .device = device_.name, .intersector = scene_ ? "bvh" : "none", .threads = 0};
    }

    void upload_scene(std::shared_ptr<const HostScene> scene) override {
        launcher_.forget();
        scene_.reset();
        DeviceScene uploaded;
        zip(*scene, uploaded, [&](const auto& from, auto& to) { to.upload(from, stream_); });
        stream_.wait("uploading a scene");
        scene_ = std::move(uploaded);
    }

    void upload_volumes(std::shared_ptr<const HostVolumes> volumes, const FieldShape& shape) override {
        launcher_.forget();
        fields_.place(std::move(volumes), shape);
    }
    void upload_field(MethodId method, HostField field) override {
        launcher_.forget();
        fields_.upload(method, field);
    }
    HostField download_field(MethodId method) const override { return fields_.download(method); }
    bool has_field(MethodId method) const override { return fields_.has(method); }
    FieldReport field_report(MethodId method) const override { return fields_.report(method); }

    void reset_film(FilmSlot slot, int width, int height) override {
        launcher_.forget();
        films_.reset(slot, width, height, stream_);
    }
    FilmReading read_film(FilmSlot slot) const override { return films_.read(slot, stream_); }
    FilmReading read_halves(FilmSlot slot) const override { return films_.read_halves(slot, stream_); }
    std::vector<std::uint32_t> invalid_samples(FilmSlot slot) const override {
        return films_.invalid_samples(slot, stream_);
    }
    DisplayFrame show_film(FilmSlot slot, const FrameStyle& style) override {
        return films_.show(slot, style, stream_);
    }
    float largest_value(FilmSlot slot) override { return films_.largest_value(slot, stream_); }
    void read_pixels(FilmSlot slot, std::uint32_t first, std::span<FilmPixel> pixels) const override {
        films_.read_pixels(slot, first, pixels, stream_);
    }
    void write_pixels(FilmSlot slot, std::uint32_t first, std::span<const FilmPixel> pixels) override {
        launcher_.forget();
        films_.write_pixels(slot, first, pixels, stream_);
    }

    PassCounters run_pass(const PassRequest& request) override;
    PassCounters precompute(const PrecomputeRequest& request) override;
    void change_pending(MethodId method, const std::function<void(PendingSums)>& change) override {
        fields_.change_pending(method, change);
    }
    void settle_when_stopped() override { launcher_.settle_when_stopped(); }
    void update_field(MethodId method) override {
        launcher_.forget();
        fields_.update(method);
    }

private:
    const DeviceScene& existing_scene() const {
        if (!scene_) throw Error(ErrorKind::Runtime, "CUDA back end: expected a scene, got none");
        return *scene_;
    }
    template <class M, class Paths>
    void launch_paths(void (*kernel)(TraceSetup, M, Paths), const PathSettings& path, const M& method,
                      const Paths& paths) {
        const SampledScene sampled = with_delta_lights(existing_scene().view(), path);
        launcher_.launch_paths(kernel, {.scene = sampled.scene, .path = sampled.path}, method, paths);
    }
    void launch_picture(const PassRequest& request, const PixelPaths& pixels);
    void launch_view(const PassRequest& request, const ViewContext& context, PathRange range);
    void add_samples(const PassRequest& request, PathRange range, const FilmView& film);
    void add_pass(const PassRequest& request, PathRange pixels, std::uint32_t offset, const FilmView& film);
    void refine_launch(const PassRequest& request, PathRange range, const FilmView& film);

    CudaDevice device_;
    Stream stream_;
    PathLauncher launcher_;
    std::optional<DeviceScene> scene_;
    DeviceFields fields_{stream_};
    DeviceFilms films_;
    DeviceArray<Vec3f> samples_;  ///< radiance of the paths of one launch
    std::array<LaunchSize, FilmSlot::kCount> picture_sizes_;
    LaunchSize probe_size_;
};

void CudaBackend::launch_picture(const PassRequest& request, const PixelPaths& pixels) {
    const MethodId id = request.method();
    const AnyFieldView field = info_of(id).uses_field ? fields_.view(id) : AnyFieldView{};
    with_kernel_of(representation_of(field), request.method(), request.learning, request.trains, [&]<int kEntry>() {
        // Fields with other kernels, of the host alone, are refused when they are uploaded.
        if constexpr (kEntry < MethodList::kCount) {
            IntegratorAt<kEntry> method;
            configure_method(method, field, request.method_settings());
            launch_paths(picture_kernels<kEntry>()[covering_set(request.features)], request.path, to_kernel(method),
                         pixels);
        }
    });
}

void CudaBackend::launch_view(const PassRequest& request, const ViewContext& context, PathRange range) {
    const std::uint32_t count = range.end - range.first;
    launch(kViewKernels[covering_set(request.features)], one_thread_each(count), stream_, "show_view",
           ViewSetup{.scene = existing_scene().view(),
                     .context = context,
                     .first = range.first,
                     .radiance = {samples_.data(), count},
                     .counters = launcher_.counters()});
}

PassCounters CudaBackend::run_pass(const PassRequest& request) {
    const FilmView film = films_.view(request.slot, request.weight());
    const bool is_picture = request.slot.view == View::Beauty;
    const PixelGrid grid{film.width, film.height, request.sample};
    const ViewContext context{.view = request.slot.view,
                              .shown = is_picture ? ShownField{} : fields_.shown(request.slot),
                              .camera = request.camera,
                              .settings = request.path,
                              .grid = grid};
    LaunchSize& size = picture_sizes_[static_cast<std::size_t>(request.slot.index())];
    const std::uint32_t per_pass = film.pixels.count;
    const std::uint32_t passes = size.passes(per_pass, request.most_passes);
    const std::uint32_t end = passes > 1 ? passes * per_pass : std::min(request.end_pixel, per_pass);
    const auto trace = [&](PathRange range) {
        const std::uint32_t count = range.end - range.first;
        if (samples_.size() < count) samples_ = DeviceArray<Vec3f>(count);
        if (!is_picture) return launch_view(request, context, range);
        launch_picture(request, {.camera = request.camera,
                                 .grid = grid,
                                 .first = range.first,
                                 .per_pass = per_pass,
                                 .radiance = {samples_.data(), count}});
    };
    return launcher_.run({request.slot.index(), request.sample, request.path.stream}, size,
                         {request.first_pixel, end}, request.stop, request.path, trace,
                         [&](PathRange range) { add_samples(request, range, film); });
}

/// Adds the samples of a launch to the film, pass by pass.
void CudaBackend::add_samples(const PassRequest& request, PathRange range, const FilmView& film) {
    const std::uint32_t per_pass = film.pixels.count;
    for (std::uint32_t first = range.first; first < range.end;) {
        const std::uint32_t pass = first / per_pass;
        const std::uint32_t end = std::min(range.end, (pass + 1) * per_pass);
        PassRequest one = request;
        one.sample += pass;
        one.passes += pass;
        add_pass(one, {first - pass * per_pass, end - pass * per_pass}, first - range.first, film);
        first = end;
    }
}

/// The same for some pixels of one pass, whose samples begin at `offset`.
void CudaBackend::add_pass(const PassRequest& request, PathRange pixels, std::uint32_t offset, const FilmView& film) {
    const std::uint32_t count = pixels.end - pixels.first;
    launch(is_heat_map(request.slot.view) ? kSetSamples : kAddSamples, one_thread_each(count), stream_, "add_samples",
           film,
           LaunchSamples{.radiance = {samples_.data() + offset, count},
                         .first = pixels.first,
                         .pass = request.sample,
                         .measure = request.measure,
                         .counters = launcher_.counters()});
    const bool refines = request.slot.view == View::Beauty && has_visible_emission(existing_scene().view());
    if (refines) refine_launch(request, pixels, film);
}

/// Refines the emission in the samples that a launch has added.
void CudaBackend::refine_launch(const PassRequest& request, PathRange range, const FilmView& film) {
    const SceneView scene = existing_scene().view();
    const EmissionSetup setup{.scene = scene,
                              .context = request.emission_context({film.width, film.height, request.sample}),
                              .film = film,
                              .range = range,
                              .counters = launcher_.counters()};
    const std::size_t features = covering_set(request.features);
    if (setup.context.looks() == kMarkingLook && range.first == 0 && !scene.lights.empty())
        launch(kBorderKernels[features], one_thread_each(scene.lights.count), stream_, "mark_borders", setup);
    launch(kEmissionKernels[features], one_thread_each(range.end - range.first), stream_, "refine_film", setup);
}

PassCounters CudaBackend::precompute(const PrecomputeRequest& request) {
    const ProbePaths paths{.field = std::get<TableField>(fields_.view(request.method)),
                           .stratum = {request.sample, request.strata_side}};
    const auto kernel = kProbeKernels[covering_set(request.features)];
    return launcher_.run(
        {.sample = request.sample, .stream = request.path.stream}, probe_size_,
        {request.first_probe, std::min(request.end_probe, probe_count(paths.field))}, request.stop, request.path,
        [&](PathRange) { launch_paths(kernel, request.path, ProbeMethod{}, paths); }, [](PathRange) {});
}

}  // namespace
}  // namespace pl::cuda

namespace pl {

std::unique_ptr<RenderBackend> make_cuda_backend(const CudaOptions& options) {
    const std::string reason = cuda_unavailable_reason();
    if (!reason.empty()) throw Error(ErrorKind::Unavailable, "CUDA: " + reason);
    cuda::open_device();
    return std::make_unique<cuda::CudaBackend>(options);
}

}  // namespace pl
