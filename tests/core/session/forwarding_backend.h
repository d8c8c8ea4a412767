// The CPU back end behind another one: tests change some of its functions.
#pragma once

#include "cpu/cpu_backend.h"

namespace pl::test {

class ForwardingBackend : public RenderBackend {
public:
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
    PassCounters run_pass(const PassRequest& request) override { return inner_->run_pass(request); }
    PassCounters precompute(const PrecomputeRequest& request) override { return inner_->precompute(request); }
    void update_field(MethodId method) override { inner_->update_field(method); }

private:
    std::shared_ptr<RenderBackend> inner_ = make_cpu_backend({.threads = 1});
};

}  // namespace pl::test
