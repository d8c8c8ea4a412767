// Single paths through the CPU back end: a film after one pass holds one sample per pixel.
#pragma once

#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "cpu/cpu_backend.h"

namespace pl::test {

struct FilmSize {
    int width;
    int height;
};

struct FilmSamples {
    std::vector<Vec3f> values;
    PassCounters counters;
};

/// One path of default path tracing for every pixel, with path settings that a session would not choose.
inline FilmSamples sample_film(const SceneDescription& scene, FilmSize size, const PathSettings& path) {
    const auto packed = std::make_shared<const HostScene>(pack_scene(scene));
    const std::unique_ptr<RenderBackend> backend = make_cpu_backend({.threads = 1});
    const FilmSlot slot{MethodId::Default, View::Beauty};
    backend->upload_scene(packed);
    backend->reset_film(slot, size.width, size.height);
    FilmSamples samples;
    samples.counters = backend->run_pass({.slot = slot,
                                          .features = needed_effects(*packed),
                                          .path = path,
                                          .camera = make_camera(scene.camera, size.width, size.height)});
    samples.values = backend->read_film(slot).mean;
    return samples;
}

}  // namespace pl::test
