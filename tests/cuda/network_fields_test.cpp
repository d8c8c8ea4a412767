// Neural fields on the CUDA back end, run on the host: the bits of the CPU back end.
#include <limits>

#include "tests/cuda/cuda_session.h"
#include "tests/cuda/shim/control.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/shipped_scenes.h"
#include "tests/support/session/same_bits.h"
#include "tests/support/session/small_settings.h"

using namespace pl;
using namespace pl::test;

TEST_CASE("Neural fields have the bits, the size and the views of the CPU back end") {
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, true});
    settings.field.representation = Representation::Neural;
    shim::reset();
    shim::set_threads(3);
    {
        Session cpu = make_session(scene, settings);
        Session cuda = make_cuda_session(scene, settings, kShortLaunches);
        render_passes(cpu, 6);
        render_passes(cuda, 6);
        CHECK(same_state(state_of(cuda), state_of(cpu)));
        const std::optional<FieldStatus> expected = cpu.snapshot(slot_of(cpu)).field;
        const std::optional<FieldStatus> got = cuda.snapshot(slot_of(cuda)).field;
        REQUIRE((expected && got && expected->network && got->network));
        CHECK(got->bytes == expected->bytes);
        CHECK(got->network->steps == expected->network->steps);
        CHECK(got->network->steps > 0);
        for (const ViewInfo& view : all_views()) {
            INFO(view.name);
            const FilmSlot slot{MethodId::Reinforcement, view.id};
            render_passes(cpu, slot, 1);
            render_passes(cuda, slot, 1);
            CHECK(same_film(state_of(cuda, slot), state_of(cpu, slot)));
        }
    }
    CHECK(shim::live_objects() == 0);
}

TEST_CASE("A network that is lost guides by the cosine on both back ends") {
    shim::reset();
    const SceneDescription scene = shipped_scene("door");
    RenderSettings settings = small_settings(scene, {MethodId::Reinforcement, false});
    settings.field.representation = Representation::Neural;
    const auto render_lost = [&](Session session) {
        render_passes(session, 2);
        RenderBackend& backend = session.backend_access();
        HostField field = backend.download_field(MethodId::Reinforcement);
        std::get<HostNeural>(field).weights[kLastLayer] = std::numeric_limits<float>::quiet_NaN();
        backend.upload_field(MethodId::Reinforcement, std::move(field));
        render_passes(session, 2);
        CHECK(backend.field_report(MethodId::Reinforcement).network->is_lost);
        return state_of(session);
    };
    CHECK(same_state(render_lost(make_cuda_session(scene, settings)), render_lost(make_session(scene, settings))));
}
