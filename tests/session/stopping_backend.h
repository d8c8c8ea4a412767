// A back end that a test stops within a pass, at a path of the test's choice.
#pragma once

#include <optional>

#include "cpu/cpu_backend.h"

namespace pl::test {

/// The CPU back end, whose next pass of a film stops behind a number of paths, as by a stop flag that is raised there.
class StoppingBackend final : public RenderBackend {
public:
    /// Paths of the next pass, fewer than it has; empty: it is complete.
    std::optional<std::uint32_t> stops_behind;

    BackendInfo info() const override { return inner_->info(); }
    void upload_scene(std::shared_ptr<const HostScene> scene) override { inner_->upload_scene(std::move(scene)); }
    void upload_volumes(std::shared_ptr<const HostVolumes> volumes, const FieldShape& shape) override {
        inner_->upload_volumes(std::move(volumes), shape);
    }
    void upload_field(MethodId method, HostField field) override { inner_->upload_field(method, std::move(field)); }
    HostField download_field(MethodId method) const override { return inner_->download_field(method); }
    bool has_field(MethodId method) const override { return inner_->has_field(method); }
    void reset_film(FilmSlot slot, int width, int height) override { inner_->reset_film(slot, width, height); }
    FilmReading read_film(FilmSlot slot) const override { return inner_->read_film(slot); }
    FilmReading read_halves(FilmSlot slot) const override { return inner_->read_halves(slot); }
    std::vector<std::uint32_t> invalid_samples(FilmSlot slot) const override { return inner_->invalid_samples(slot); }
    DisplayFrame show_film(FilmSlot slot, const FrameStyle& style) override { return inner_->show_film(slot, style); }
    float largest_value(FilmSlot slot) override { return inner_->largest_value(slot); }
    PassCounters run_pass(const PassRequest& request) override {
        PassRequest part = request;
        if (stops_behind && request.use != SampleUse::Trial) {
            part.end_pixel = request.first_pixel + *stops_behind;
            part.most_passes = 1;
            stops_behind.reset();
        }
        return inner_->run_pass(part);
    }
    PassCounters precompute(const PrecomputeRequest& request) override { return inner_->precompute(request); }
    void update_field(MethodId method) override { inner_->update_field(method); }

private:
    std::shared_ptr<RenderBackend> inner_ = make_cpu_backend({.threads = 1});
};

}  // namespace pl::test
