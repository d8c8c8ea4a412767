// The settings of the rendering in the window; every change is sent to the render thread as an edit.
#pragma once

#include <string>

#include "ui/model/camera_motion.h"
#include "ui/model/render_link.h"
#include "ui/model/selection.h"

namespace pl::ui {

class RenderControls {
public:
    RenderControls(const ModelServices& services, CameraMotion& camera, const RenderSettings& settings);

    /// With the camera of the window.
    RenderSettings settings() const;
    const SampleLimits& limits() const { return limits_; }
    MethodId method() const { return settings_.method; }
    /// The method before the present one; the baseline before the first change.
    MethodId previous_method() const { return previous_method_; }

    /// Also ends turns of two methods.
    void set_method(MethodId method);
    void set_view(View view);
    void step_view(int steps);
    void set_next_event(bool on);
    void set_max_depth(int depth);
    void set_roulette(RouletteRule rule);
    void set_guiding(GuidingRule rule);
    void set_seed(std::uint64_t seed);
    void set_mixture(MixtureSettings mixture);
    void set_field(const FieldSettings& field);
    void set_size(int width, int height);
    /// Continues from a saved field: the rendering takes its method and settings.
    void adopt_field(const std::shared_ptr<LearnedField>& field);

    void set_limits(const SampleLimits& limits);
    bool paused() const { return link_.is_held(RenderLink::Hold::User); }
    void set_paused(bool paused) { link_.hold(RenderLink::Hold::User, paused); }
    void single_pass();
    void restart();
    void forget();
    /// Freezes, steps or continues the learning of the method; a message if it does not learn.
    void control_learning(LearningControl control);
    /// Lets one volume of the method begin anew.
    void forget_volume(std::int32_t volume);
    void cancel_precomputation();

    /// The back end requested last; the one in use is in WorkerStatus.
    std::string wanted_backend() const { return link_.worker().wanted_backend(); }
    /// Number of the newest change of back end; 0 before the first.
    std::uint64_t backend_generation() const { return backend_generation_; }
    void set_backend(const std::string& name);
    void next_backend();

private:
    void submit_estimator();
    bool is_served(const FieldSettings& field, const std::string& backend);

    Messages& messages_;
    RenderLink& link_;
    RenderWorker& worker_;
    CameraMotion& camera_;
    RenderSettings settings_;  ///< its camera is not kept: CameraMotion has it
    SampleLimits limits_;
    MethodId previous_method_;
    std::uint64_t backend_generation_ = 0;
};

}  // namespace pl::ui
