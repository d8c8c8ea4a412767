// A recorded path is the path of the picture, to the bit, and its parts explain its radiance.
#include "core/diagnose/record_path.h"
#include "core/kernel/integrator/steps.h"
#include "core/scene/pack_scene.h"
#include "core/session/path_settings.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/cornell_variants.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::diagnose;
using namespace pl::test;

namespace {

constexpr std::uint32_t kPixels = 61 * 47;

void come_to_path(Session& session, std::uint32_t pixel) {
    while (session.advance_to_path(slot_of(session), pixel) == Progress::Precomputed) {
    }
}

/// The paths of the pass under way, each with the field that its part samples from.
std::vector<PathRecord> record_pass(Session& session) {
    std::vector<PathRecord> paths;
    const FilmSlot slot = slot_of(session);
    while (paths.size() < kPixels) {
        const auto first = static_cast<std::uint32_t>(paths.size());
        come_to_path(session, first);
        PassReplay passes = session.pass_replay(slot);
        const AnyFieldView field = field_of(passes);
        const bool in_parts = info_of(slot.method).learns && passes.schedule.trained + passes.samples == 0;
        // Parts end at powers of two from 1024 on.
        const std::uint32_t end = in_parts ? std::min(first == 0 ? 1024u : 2 * first, kPixels) : kPixels;
        for (std::uint32_t pixel = first; pixel < end; ++pixel)
            paths.push_back(record_path(passes, field, pixel, passes.samples));
    }
    return paths;
}

std::vector<Vec3f> radiances(const std::vector<PathRecord>& paths) {
    std::vector<Vec3f> radiance;
    for (const PathRecord& path : paths) radiance.push_back(path.radiance);
    return radiance;
}

/// The samples of the session's next pass alone, without the samples of further camera rays.
std::vector<Vec3f> render_alone(Session& session) {
    const FilmSlot slot = slot_of(session);
    const RenderSettings& settings = session.settings();
    const std::uint32_t pass = session.passes(slot);
    PathSettings path = path_settings(settings, slot.method);
    path.sequences = session.pass_replay(slot).run_of(pass).sequences;
    RenderBackend& backend = session.backend_access();
    backend.reset_film(slot, settings.width, settings.height);
    backend.run_pass({.slot = slot,
                      .features = session.needed_features(slot),
                      .path = path,
                      .camera = make_camera(settings.camera, settings.width, settings.height),
                      .mixture = mixture_of(settings, slot.method),
                      .learning = settings.field.learning,
                      .sample = session.pass_replay(slot).schedule.sample_of(pass)});
    return backend.read_film(slot).mean;
}

/// `absorbs`: glass may absorb light along segments.
void check_explains(const PathRecord& path, bool absorbs = false) {
    REQUIRE(path.segments == path.vertices.size());
    Vec3f sum{0.0f};
    for (std::size_t i = 0; i < path.vertices.size(); ++i) {
        const VertexRecord& vertex = path.vertices[i];
        sum += vertex.contribution();
        const bool is_last = i + 1 == path.vertices.size();
        REQUIRE(vertex.scattered.has_value() == !is_last);
        if (!is_last) {
            const ScatterRecord& direction = *vertex.scattered;
            const VertexRecord& next = path.vertices[i + 1];
            const Vec3f share = next.throughput / glm::max(direction.throughput, Vec3f{1e-30f});
            CHECK((absorbs ? max_component(share) <= 1.0f : next.throughput == direction.throughput));
            CHECK((direction.technique == Technique::Delta) == (direction.pdf_sa == 0.0f));
            const float a = vertex.bsdf_fraction;
            const float mixture = a * direction.bsdf_pdf_sa + (1.0f - a) * direction.field_pdf_sa;
            if (direction.technique != Technique::Delta)
                CHECK(direction.pdf_sa == Approx((1.0f - vertex.delta_probability) * mixture).epsilon(1e-5));
        }
    }
    // The same terms, in the same order but for the two parts of an environment.
    CHECK(glm::length(sum - path.radiance) <= 1e-6f * glm::length(path.radiance));
}

}  // namespace

TEST_CASE("Record path: every pixel's first path has the bits of the picture, by every method") {
    for (const char* name : {"cornell", "spheres", "sky"}) {
        const SceneDescription scene = shipped_scene(name);
        for (const Estimator& estimator : kEstimators) {
            INFO(name << ", " << estimator);
            const RenderSettings settings = small_settings(scene, estimator);
            Session recorded = make_session(scene, settings);
            Session rendered = make_session(scene, settings);
            const std::vector<PathRecord> paths = record_pass(recorded);
            render_passes(rendered, 1);
            CHECK(same_bits(radiances(paths), rendered.snapshot(slot_of(rendered)).pixels));
            // Coming to a path changes nothing of the picture.
            render_passes(recorded, 1);
            CHECK(same_state(state_of(recorded), state_of(rendered)));
        }
    }
}

TEST_CASE("Record path: later paths have the bits of their pass") {
    constexpr std::uint32_t kPasses = 6;
    const SceneDescription scene = shipped_scene("cornell");
    for (const Estimator& estimator : kEstimators) {
        INFO(estimator);
        Session session = make_session(scene, small_settings(scene, estimator));
        render_passes(session, kPasses);
        const std::vector<PathRecord> paths = record_pass(session);
        CHECK(same_bits(radiances(paths), render_alone(session)));
        bool has_field_sample = false;
        for (const PathRecord& path : paths) {
            check_explains(path);
            for (const VertexRecord& vertex : path.vertices)
                has_field_sample |= vertex.scattered && vertex.scattered->technique == Technique::Field;
        }
        CHECK(has_field_sample == info_of(estimator.method).uses_field);
    }
}

TEST_CASE("Record path: the parts of a path explain it at all kinds of surfaces and lights") {
    for (const char* name : {"spheres", "coats", "plates", "sky", "gallery"}) {
        const SceneDescription scene = shipped_scene(name);
        for (const Estimator& estimator : kEstimators) {
            INFO(name << ", " << estimator);
            Session session = make_session(scene, small_settings(scene, estimator));
            for (const PathRecord& path : record_pass(session)) check_explains(path);
        }
    }
}

TEST_CASE(
    "Record path: the parts of a path explain it in glass that absorbs, behind panes, and by lights without extent") {
    for (const SceneDescription& scene :
         {cornell_with_delta_lights(), cornell_with_stained_glass(), cornell_with_panes(), cornell_with_blends()}) {
        for (const Estimator& estimator : kEstimators) {
            INFO(scene.name << ", " << estimator);
            Session recorded = make_session(scene, small_settings(scene, estimator));
            Session rendered = make_session(scene, small_settings(scene, estimator));
            const std::vector<PathRecord> paths = record_pass(recorded);
            for (const PathRecord& path : paths) check_explains(path, true);
            render_passes(rendered, 1);
            CHECK(same_bits(radiances(paths), rendered.snapshot(slot_of(rendered)).pixels));
        }
    }
}

TEST_CASE("Record path: vertices show all training samples of their pass, and no others") {
    for (const char* name : {"cornell", "spheres", "sky"}) {
        const SceneDescription scene = shipped_scene(name);
        for (const Estimator& estimator : kEstimators) {
            INFO(name << ", " << estimator);
            Session session = make_session(scene, small_settings(scene, estimator));
            const FilmSlot slot = slot_of(session);
            const auto records = [&] { return session.snapshot(slot).counters.path.method.records; };
            render_passes(session, 2);
            std::uint64_t shown = 0;
            for (const PathRecord& path : record_pass(session)) {
                CHECK_FALSE(path.vertices.front().target);
                for (const VertexRecord& vertex : path.vertices) shown += vertex.target ? 1 : 0;
            }
            const std::uint64_t before = records();
            render_passes(session, 1);
            CHECK(shown == records() - before);
            CHECK((shown > 0) == info_of(estimator.method).learns);
        }
    }
}

TEST_CASE("Record path: whether a pass is guided is known before it, and asking changes no later choice") {
    const SceneDescription scene = shipped_scene("cornell");
    const RenderSettings settings = settings_without_gain(scene, MethodId::Reinforcement);
    Session asked = make_session(scene, settings);
    Session rendered = make_session(scene, settings);
    std::uint32_t unguided = 0;
    for (std::uint32_t pass = 0; pass < 24; ++pass) {
        come_to_path(asked, 5);
        PassReplay passes = asked.pass_replay(slot_of(asked));
        const PathRecord path = record_path(passes, field_of(passes), 5, pass);
        render_passes(asked, 1);
        render_passes(rendered, 1);
        CHECK(path.is_guided == rendered.pass_replay(slot_of(rendered)).is_guided(pass));
        unguided += path.is_guided ? 0 : 1;
    }
    CHECK(unguided > 0);
    CHECK(unguided < 24);
    CHECK(same_state(state_of(asked), state_of(rendered)));
}
