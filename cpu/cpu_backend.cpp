#include "cpu/cpu_backend.h"

#include <array>
#include <fstream>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/fields/field_kernels.h"
#include "core/kernel/inspect/heat_map.h"
#include "core/kernel/integrator/sampled_lights.h"
#include "core/scene/pack_scene.h"
#include "core/session/exact_backend.h"
#include "cpu/base/lane_kernels.h"
#include "cpu/base/parallel_for.h"
#include "cpu/learning/field_update.h"
#include "cpu/passes/film_store.h"
#include "cpu/passes/pass_kernels.h"
#include "cpu/rays/batch_tracer.h"

namespace pl {
namespace {

/// Display name of the processor: "AMD EPYC 9654"; "CPU" if the system reports no name.
std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (!line.starts_with("model name")) continue;
        const std::size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
        if (start != std::string::npos) return line.substr(start);
    }
    return "CPU";
}

/// The kernel of a pass, for the representation of its field.
PictureKernel kernel_for(const PassRequest& request, const AnyFieldView& field) {
    PictureKernel kernel = nullptr;
    with_kernel_of(representation_of(field), request.method(), request.learning, request.trains,
                   [&]<int kEntry>() { kernel = picture_kernel<kEntry>(request.features); });
    return kernel;
}

/// The field of one method.
struct StoredField {
    HostField arrays;
    bool is_updated = false;  ///< all volumes, since the arrays were made, split or loaded
};

class CpuBackend final : public ExactBackend {
public:
    explicit CpuBackend(const CpuSettings& settings) : settings_(settings) {}

    BackendInfo info() const override {
        return {.name = "cpu",
                .device = device_,
                .intersector = tracer_ ? tracer_->name() : "none",
                .threads = settings_.threads};
    }

    /// Keeps the acceleration structure if only materials differ.
    void upload_scene(std::shared_ptr<const HostScene> scene) override {
        const bool is_built = tracer_ && same_triangles(*scene_, *scene);
        if (!is_built) tracer_.reset();
        scene_ = std::move(scene);
        if (is_built)
            tracer_->move_to(scene_->view());
        else
            tracer_.emplace(scene_->view());
        lights_ = LightTable(scene_->view());
    }

    void upload_volumes(std::shared_ptr<const HostVolumes> volumes, const FieldShape& shape) override {
        volumes_ = std::move(volumes);
        shape_ = shape;
        fields_.fill(std::nullopt);
    }

    void upload_field(MethodId method, HostField field) override {
        if (!volumes_) throw Error(ErrorKind::Runtime, "CPU back end: expected volumes before tables, got none");
        fields_[index_of(method)] = StoredField{std::move(field)};
    }
    HostField download_field(MethodId method) const override {
        const std::optional<StoredField>& field = fields_[index_of(method)];
        return field ? field->arrays : HostField{};
    }
    bool has_field(MethodId method) const override { return fields_[index_of(method)].has_value(); }
    FieldReport field_report(MethodId method) const override {
        const std::optional<StoredField>& field = fields_[index_of(method)];
        return field ? report_of(field->arrays) : FieldReport{};
    }

    void reset_film(FilmSlot slot, int width, int height) override {
        films_.reset(slot, width, height, settings_.threads);
    }
    FilmReading read_film(FilmSlot slot) const override { return films_.read(slot, settings_.threads); }
    FilmReading read_halves(FilmSlot slot) const override { return films_.read_halves(slot, settings_.threads); }
    std::vector<std::uint32_t> invalid_samples(FilmSlot slot) const override { return films_.invalid_samples(slot); }
    DisplayFrame show_film(FilmSlot slot, const FrameStyle& style) override {
        return films_.show(slot, style, settings_.threads);
    }
    float largest_value(FilmSlot slot) override { return films_.largest_value(slot, settings_.threads); }
    void read_pixels(FilmSlot slot, std::uint32_t first, std::span<FilmPixel> pixels) const override {
        films_.read_pixels(slot, first, pixels);
    }
    void write_pixels(FilmSlot slot, std::uint32_t first, std::span<const FilmPixel> pixels) override {
        films_.write_pixels(slot, first, pixels);
    }

    PassCounters run_pass(const PassRequest& request) override {
        const PassSetup setup = make_setup(request.path, {request.first_pixel, request.end_pixel}, request.stop);
        if (request.slot.view != View::Beauty) return run_view(setup, request);
        const MethodId method = request.method();
        const AnyFieldView field = info_of(method).uses_field ? learned_field(method) : AnyFieldView{};
        PassCounters counters = kernel_for(request, field)({.setup = setup,
                                                            .tracer = *tracer_,
                                                            .field = field,
                                                            .settings = request.method_settings(),
                                                            .camera = request.camera,
                                                            .sample = request.sample,
                                                            .film = films_.view(request.slot, request.weight()),
                                                            .measure = request.measure});
        counters += refine_emission_of(request, static_cast<std::uint32_t>(counters.paths));
        return counters;
    }

    PassCounters precompute(const PrecomputeRequest& request) override {
        return launch(
            kProbeKernels, request.features,
            ProbePass{.setup = make_setup(request.path, {request.first_probe, request.end_probe}, request.stop),
                      .tracer = *tracer_,
                      .field = std::get<TableField>(learned_field(request.method)),
                      .stratum = {request.sample, request.strata_side}});
    }

    void change_pending(MethodId method, const std::function<void(PendingSums)>& change) override {
        std::visit(
            [&](auto& arrays) { for_each_pending_array(arrays, [&](auto& array) { change(std::span(array)); }); },
            existing_field(method).arrays);
    }

    void update_field(MethodId method) override {
        StoredField& learned = existing_field(method);
        pl::update_field(shape_, *volumes_, learned.arrays, learned.is_updated, settings_.threads);
        learned.is_updated = true;
    }

private:
    static std::size_t index_of(MethodId method) { return static_cast<std::size_t>(method); }

    PassSetup make_setup(const PathSettings& path, IndexRange paths, const StopFlag* stop) const {
        if (!tracer_) throw Error(ErrorKind::Runtime, "CPU back end: expected a scene, got none");
        const SampledScene sampled = with_delta_lights(scene_->view(), path);
        return {.scene = sampled.scene,
                .lights = &lights_,
                .path = sampled.path,
                .paths = paths,
                .stop = stop,
                .threads = settings_.threads,
                .batch_paths = settings_.batch_paths};
    }

    StoredField& existing_field(MethodId method) {
        std::optional<StoredField>& field = fields_[index_of(method)];
        if (!field)
            throw Error(ErrorKind::Runtime,
                        fmt::format("CPU back end: expected tables of '{}', got none", info_of(method).name));
        return *field;
    }
    AnyFieldView learned_field(MethodId method) {
        AnyFieldView field = field_view(shape_, *volumes_, existing_field(method).arrays);
        visit_field(field, [&](auto& view) {
            view.writers = settings_.threads == 1 ? Writers::One : Writers::Many;
            if constexpr (requires { view.evaluate; }) view.evaluate = best_lane_kernels().evaluate_vertex;
        });
        return field;
    }

    /// The placement and, for heat maps, one value per volume; empty for views that need neither.
    ShownField shown_field(const FilmSlot& slot) {
        const ViewInfo& view = info_of(slot.view);
        if (!view.needs_volumes && !view.needs_tables) return {};
        if (!volumes_) throw Error(ErrorKind::Runtime, "CPU back end: expected volumes, got none");
        ShownField shown{placement_view(*volumes_, shape_.extent), {}};
        if (needs_volume_values(slot.view)) shown.volume_values = volume_values(slot);
        return shown;
    }

    Span<const float> volume_values(const FilmSlot& slot) {
        std::visit(
            [&](auto& arrays) {
                const VolumeSummary auto summary = summary_of(shape_, *volumes_, arrays);
                volume_values_.resize(volume_count(arrays));
                for_each_volume(volume_values_.size(), settings_.threads, [&](std::uint32_t volume) {
                    volume_values_[volume] = volume_value(summary, volume, slot.view);
                });
            },
            existing_field(field_owner(slot.method)).arrays);
        return view_of(std::as_const(volume_values_));
    }

    /// Refines the emission in the `paths` samples that a pass has added from its first pixel on.
    PassCounters refine_emission_of(const PassRequest& request, std::uint32_t paths) {
        if (!has_visible_emission(scene_->view())) return {};
        const IndexRange pixels{request.first_pixel, request.first_pixel + paths};
        const FilmView film = films_.view(request.slot, request.weight());
        return launch(kEmissionKernels, request.features,
                      EmissionPass{.setup = make_setup(request.path, pixels, nullptr),
                                   .tracer = *tracer_,
                                   .context = request.emission_context({film.width, film.height, request.sample}),
                                   .film = film});
    }

    PassCounters run_view(const PassSetup& setup, const PassRequest& request) {
        return launch(kViewKernels, request.features,
                      ViewPass{.setup = setup,
                               .view = request.slot.view,
                               .shown = shown_field(request.slot),
                               .camera = request.camera,
                               .sample = request.sample,
                               .film = films_.view(request.slot, request.weight())});
    }

    CpuSettings settings_;
    std::string device_ = cpu_name();  ///< cached, since info() is called after every pass
    std::shared_ptr<const HostScene> scene_;
    std::optional<BatchTracer> tracer_;
    LightTable lights_;
    std::shared_ptr<const HostVolumes> volumes_;
    FieldShape shape_;
    std::array<std::optional<StoredField>, kMethodCount> fields_;
    HostArray<float> volume_values_;  ///< of the latest heat map
    FilmStore films_;
};

}  // namespace

std::unique_ptr<RenderBackend> make_cpu_backend(const CpuSettings& settings) {
    constexpr int kMostThreads = 4096;
    constexpr std::uint32_t kMostPaths = 1u << 20;
    if (settings.threads < 0 || settings.threads > kMostThreads)
        throw Error(ErrorKind::Usage,
                    fmt::format("number of threads: expected 0 to {}, got {}", kMostThreads, settings.threads));
    if (settings.batch_paths == 0 || settings.batch_paths > kMostPaths)
        throw Error(ErrorKind::Usage,
                    fmt::format("paths per batch: expected 1 to {}, got {}", kMostPaths, settings.batch_paths));
    CpuSettings resolved = settings;
    if (resolved.threads == 0) resolved.threads = usable_threads();
    return std::make_unique<CpuBackend>(resolved);
}

}  // namespace pl
