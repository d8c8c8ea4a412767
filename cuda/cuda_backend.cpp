#include "cuda/cuda_backend.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "cuda/availability.h"
#include "cuda/device_films.h"
#include "cuda/launch_size.h"
#include "cuda/runtime/launch.h"

namespace pl::cuda {
namespace {

using DeviceScene = SceneStorage<DeviceArray>;
using DeviceVolumes = VolumeStorage<DeviceArray>;
using DeviceField = FieldArrays<DeviceArray>;

int processors_of_device() {
    int count = 0;
    check(cudaDeviceGetAttribute(&count, cudaDevAttrMultiProcessorCount, 0), "asking for the number of processors");
    return count;
}

class CudaBackend final : public RenderBackend {
public:
    CudaBackend() : device_(cuda_devices().at(0)), processors_(processors_of_device()) {}

    BackendInfo info() const override {
        return {.name = "cuda", .device = device_.name, .intersector = scene_ ? "bvh" : "none", .threads = 0};
    }

    void upload_scene(std::shared_ptr<const HostScene> scene) override {
        scene_.reset();
        DeviceScene uploaded;
        zip(*scene, uploaded, [&](const auto& from, auto& to) { to.upload(from, stream_); });
        stream_.wait("uploading a scene");
        scene_ = std::move(uploaded);
    }

    void upload_volumes(std::shared_ptr<const HostVolumes> volumes, const FieldShape& shape) override {
        fields_ = {};
        volumes_ = {};
        zip(*volumes, volumes_, [&](const auto& from, auto& to) { to.upload(from, stream_); });
        stream_.wait("uploading radiance volumes");
        shape_ = shape;
    }

    void upload_field(MethodId method, HostField field) override {
        if (volumes_.normals.size() == 0)
            throw Error(ErrorKind::Runtime, "CUDA back end: expected volumes before tables, got none");
        DeviceField uploaded;
        zip_fields(field, uploaded, [&](const auto& from, auto& to) { to.upload(from, stream_); });
        stream_.wait("uploading a field");
        fields_[index_of(method)] = std::move(uploaded);
    }
    HostField download_field(MethodId method) const override {
        HostField field;
        if (!has_field(method)) return field;
        zip_fields(*fields_[index_of(method)], field,
                   [&](const auto& from, auto& to) { from.download(to, stream_); });
        stream_.wait("downloading a field");
        return field;
    }
    bool has_field(MethodId method) const override { return fields_[index_of(method)].has_value(); }

    void reset_film(FilmSlot slot, int width, int height) override { films_.reset(slot, width, height, stream_); }
    FilmReading read_film(FilmSlot slot) const override { return films_.read(slot, stream_); }
    FilmReading read_halves(FilmSlot slot) const override { return films_.read_halves(slot, stream_); }
    std::vector<std::uint32_t> invalid_samples(FilmSlot slot) const override {
        return films_.invalid_samples(slot, stream_);
    }
    DisplayFrame show_film(FilmSlot slot, const FrameStyle& style) override {
        return films_.show(slot, style, stream_);
    }
    float largest_value(FilmSlot slot) override { return films_.largest_value(slot, stream_); }

    PassCounters run_pass(const PassRequest& request) override;
    PassCounters precompute(const PrecomputeRequest& request) override;
    void update_field(MethodId method) override;

private:
    static std::size_t index_of(MethodId method) { return static_cast<std::size_t>(method); }

    const DeviceScene& existing_scene() const {
        if (!scene_) throw Error(ErrorKind::Runtime, "CUDA back end: expected a scene, got none");
        return *scene_;
    }
    DeviceField& existing_field(MethodId method) {
        std::optional<DeviceField>& field = fields_[index_of(method)];
        if (!field)
            throw Error(ErrorKind::Runtime,
                        fmt::format("CUDA back end: expected tables of '{}', got none", info_of(method).name));
        return *field;
    }
    AnyFieldView learned_field(MethodId method) { return field_view(shape_, volumes_, existing_field(method)); }
    ShownField shown_field(const FilmSlot& slot);
    Span<const float> volume_values(const FilmSlot& slot);

    /// Calls launch_range() on successive ranges of [first, end). Polls `stop` between launches.
    template <class LaunchRange>
    PassCounters run_launches(LaunchSize& size, std::uint32_t first, std::uint32_t end, const StopFlag* stop,
                              LaunchRange&& launch_range);

    template <class M, class Paths>
    void launch_paths(void (*kernel)(TraceSetup, M, Paths), const PathSettings& path, PathRange range,
                      const M& method, const Paths& paths);
    void launch_picture(const PassRequest& request, PathRange range, const PixelPaths& pixels);
    void launch_view(const PassRequest& request, const ViewContext& context, const PixelPaths& pixels);
    void refine_launch(const PassRequest& request, PathRange range, const FilmView& film);

    CudaDevice device_;
    int processors_ = 1;
    Stream stream_;
    Event launched_;
    Event finished_;
    std::optional<DeviceScene> scene_;
    DeviceVolumes volumes_;
    FieldShape shape_;
    std::array<std::optional<DeviceField>, kMethodCount> fields_;
    DeviceFilms films_;
    DeviceArray<float> volume_values_;  ///< of the latest heat map
    DeviceArray<Vec3f> samples_;        ///< radiance of the paths of one launch
    DeviceArray<std::uint32_t> claimed_{1};
    DeviceArray<PassCounters> counters_{1};
    PinnedMemory read_counters_{sizeof(PassCounters)};
    std::array<LaunchSize, FilmSlot::kCount> picture_sizes_;
    LaunchSize probe_size_;
};

template <class LaunchRange>
PassCounters CudaBackend::run_launches(LaunchSize& size, std::uint32_t first, std::uint32_t end, const StopFlag* stop,
                                       LaunchRange&& launch_range) {
    PassCounters total;
    while (first < end && !(stop != nullptr && *stop)) {
        const std::uint32_t count = size.next(end - first);
        counters_.clear(stream_);
        launched_.record(stream_);
        launch_range(PathRange{first, first + count});
        finished_.record(stream_);
        copy_to_host(read_counters_.data(), counters_.data(), sizeof(PassCounters), stream_);
        stream_.wait("tracing paths");
        total += *static_cast<const PassCounters*>(read_counters_.data());
        size.observe(count, finished_.milliseconds_since(launched_));
        first += count;
    }
    return total;
}

template <class M, class Paths>
void CudaBackend::launch_paths(void (*kernel)(TraceSetup, M, Paths), const PathSettings& path, PathRange range,
                               const M& method, const Paths& paths) {
    claimed_.clear(stream_);
    const TraceSetup setup{.scene = existing_scene().view(),
                           .path = path,
                           .range = range,
                           .claimed = claimed_.data(),
                           .counters = counters_.data()};
    const std::uint32_t blocks = std::min(resident_blocks(kernel, processors_), blocks_for(range.end - range.first));
    launch(kernel, blocks, stream_, "trace_paths", setup, method, paths);
}

void CudaBackend::launch_picture(const PassRequest& request, PathRange range, const PixelPaths& pixels) {
    const MethodId id = request.method();
    const AnyFieldView field = info_of(id).uses_field ? learned_field(id) : AnyFieldView{};
    with_method_kernel(id, request.learning, request.path.next_event != 0, [&]<int kEntry>() {
        IntegratorAt<kEntry> method;
        configure_method(method, field, request.mixture, request.learning);
        launch_paths(picture_kernels<kEntry>()[covering_set(request.features)], request.path, range, method, pixels);
    });
}

void CudaBackend::launch_view(const PassRequest& request, const ViewContext& context, const PixelPaths& pixels) {
    launch(kViewKernels[covering_set(request.features)], blocks_for(pixels.radiance.count), stream_, "show_view",
           ViewSetup{.scene = existing_scene().view(),
                     .context = context,
                     .first = pixels.first,
                     .radiance = pixels.radiance,
                     .counters = counters_.data()});
}

PassCounters CudaBackend::run_pass(const PassRequest& request) {
    const FilmView film = films_.view(request.slot, request.weights);
    const bool is_picture = request.slot.view == View::Beauty;
    const PixelGrid grid{film.width, film.height, request.sample};
    const ViewContext context{.view = request.slot.view,
                              .shown = is_picture ? ShownField{} : shown_field(request.slot),
                              .camera = request.camera,
                              .settings = request.path,
                              .grid = grid};
    const AddSamplesKernel add = is_heat_map(request.slot.view) ? kSetSamples : kAddSamples;
    LaunchSize& size = picture_sizes_[static_cast<std::size_t>(request.slot.index())];
    const std::uint32_t end = std::min(request.end_pixel, request.subset.count(film.pixels.count));
    const bool refines =
        is_picture && request.use != SampleUse::Trial && has_visible_emission(existing_scene().view());
    return run_launches(size, request.first_pixel, end, request.stop, [&](PathRange range) {
        const std::uint32_t count = range.end - range.first;
        if (samples_.size() < count) samples_ = DeviceArray<Vec3f>(count);
        const PixelPaths pixels{.camera = request.camera,
                                .grid = grid,
                                .first = range.first,
                                .subset = request.subset,
                                .radiance = {samples_.data(), count}};
        if (is_picture)
            launch_picture(request, range, pixels);
        else
            launch_view(request, context, pixels);
        launch(add, blocks_for(count), stream_, "add_samples", film,
               LaunchSamples{.radiance = pixels.radiance,
                             .first = range.first,
                             .pass = request.sample,
                             .subset = request.subset,
                             .use = request.use,
                             .counters = counters_.data()});
        if (refines) refine_launch(request, range, film);
    });
}

/// Refines the emission in the samples that a launch has added.
void CudaBackend::refine_launch(const PassRequest& request, PathRange range, const FilmView& film) {
    const SceneView scene = existing_scene().view();
    const EmissionSetup setup{
        .scene = scene,
        .context = {request.camera, request.path, {film.width, film.height, request.sample}, request.passes},
        .film = film,
        .range = range,
        .counters = counters_.data()};
    const std::size_t features = covering_set(request.features);
    if (request.passes == kMarkingPass && range.first == 0 && !scene.lights.empty())
        launch(kBorderKernels[features], blocks_for(scene.lights.count), stream_, "mark_borders", setup);
    launch(kEmissionKernels[features], blocks_for(range.end - range.first), stream_, "refine_film", setup);
}

PassCounters CudaBackend::precompute(const PrecomputeRequest& request) {
    const ProbePaths paths{.field = std::get<TableField>(learned_field(request.method)),
                           .stratum = {request.sample, request.strata_side}};
    const auto kernel = kProbeKernels[covering_set(request.features)];
    return run_launches(probe_size_, request.first_probe, probe_count(paths.field), request.stop,
                        [&](PathRange range) { launch_paths(kernel, request.path, range, ProbeMethod{}, paths); });
}

void CudaBackend::update_field(MethodId method) {
    const TableUpdateView field = update_view(shape_, std::get<TableStorage<DeviceArray>>(existing_field(method)));
    const std::uint32_t volumes = field.mean_radiance.count;
    for (const UpdateStep& step : kUpdateSteps) {
        std::uint32_t count = volumes;
        if (step.item == UpdateItem::Cell) count *= static_cast<std::uint32_t>(field.cells.count());
        if (step.item == UpdateItem::Row) count *= static_cast<std::uint32_t>(field.cells.side);
        launch(step.kernel, blocks_for(count), stream_, step.name, field, count);
    }
    stream_.wait("updating a field");
}

/// The placement and, for heat maps, one value per volume; empty for views that need neither.
ShownField CudaBackend::shown_field(const FilmSlot& slot) {
    const ViewInfo& view = info_of(slot.view);
    if (!view.needs_volumes && !view.needs_tables) return {};
    if (volumes_.normals.size() == 0) throw Error(ErrorKind::Runtime, "CUDA back end: expected volumes, got none");
    ShownField shown{placement_view(volumes_, shape_.lookup, shape_.extent), {}};
    if (needs_volume_values(slot.view)) shown.volume_values = volume_values(slot);
    return shown;
}

/// Queued: complete before later work of the stream.
Span<const float> CudaBackend::volume_values(const FilmSlot& slot) {
    const TableUpdateView field =
        update_view(shape_, std::get<TableStorage<DeviceArray>>(existing_field(field_owner(slot.method))));
    const std::uint32_t volumes = field.mean_radiance.count;
    if (volume_values_.size() != volumes) volume_values_ = DeviceArray<float>(volumes);
    launch(kVolumeValues, blocks_for(volumes), stream_, "volume_values", field, slot.view,
           Span<float>{volume_values_.data(), volumes});
    return Span<const float>{volume_values_.data(), volumes};
}

}  // namespace
}  // namespace pl::cuda

namespace pl {

std::unique_ptr<RenderBackend> make_cuda_backend() {
    const std::string reason = cuda_unavailable_reason();
    if (!reason.empty()) throw Error(ErrorKind::Unavailable, "CUDA: " + reason);
    return std::make_unique<cuda::CudaBackend>();
}

}  // namespace pl
