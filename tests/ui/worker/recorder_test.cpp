#include "ui/worker/recorder.h"

#include <set>

#include "core/measure/picture_identity.h"

#include "tests/support/catch.hpp"
#include "tests/ui/worker/session_bench.h"
#include "tests/ui/worker_bench.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Recorder: the picture is known once a film of its generation was observed") {
    SessionBench bench;
    Recorder recorder;
    CHECK(recorder.runs());
    bench.render(kDefault, 1);
    recorder.observe(bench.session, kDefault);
    const std::uint64_t picture = picture_key(bench.session.scene_hash(), bench.session.settings());
    CHECK(recorder.picture(bench.session.film_origin(kDefault)) == picture);
    bench.render(kLearning, 1);
    CHECK(recorder.picture(bench.session.film_origin(kLearning)) == picture);

    CameraDescription camera = bench.session.settings().camera;
    camera.eye.x += 1.0f;
    bench.session.apply(EditCamera{camera});
    bench.render(kDefault, 1);
    CHECK(recorder.picture(bench.session.film_origin(kDefault)) == 0);
    recorder.observe(bench.session, kDefault);
    CHECK(recorder.picture(bench.session.film_origin(kDefault)) != picture);
}

TEST_CASE("Recorder: a run carries the settings that differ from the defaults, in words") {
    SessionBench bench;
    FieldSettings field = bench.session.settings().field;
    field.refine_share = 0.0f;
    bench.session.apply(EditField{field});
    Recorder recorder;
    REQUIRE(eventually([&] {
        bench.render(kLearning, 1);
        return recorder.observe(bench.session, kLearning) && !recorder.runs()->runs.empty();
    }));
    CHECK(recorder.runs()->runs.front()->label.details == "16 volumes, 16 bins, not refined");
}

TEST_CASE("Recorder: every setting of a field has words of its own") {
    const RenderSettings standard;
    std::vector<RenderSettings> all(13, standard);
    all[0].field.representation = Representation::SdTree;
    all[1].field.representation = Representation::Neural;
    all[2].field.volumes = 4000;
    all[3].field.bins = 64;
    all[4].field.refine_share = 0.5f;
    all[5].field.rate = LearningRate::SampleMean;
    all[6].field.learning.target = LearningTarget::MonteCarlo;
    all[7].field.learning.light = LearnedLight::All;
    all[8].field.budget_megabytes = 4.0;
    all[9].field.uniform_floor = 0.5f;
    all[10].mixture.learned = 0;
    all[11].mixture.bsdf_fraction = 0.9f;
    all[12].mixture.learned_lights = 0;
    std::set<std::string> texts{details_of(standard, learning_method())};
    CHECK(*texts.begin() == "");
    for (const RenderSettings& settings : all) {
        CHECK(texts.insert(details_of(settings, learning_method())).second);
        CHECK(details_of(settings, baseline_method()) == "");
    }
    CHECK(method_text(all[0], learning_method()) == "Reinforcement (SD-tree)");
    RenderSettings probes;
    probes.field.precompute_samples = 4;
    CHECK(details_of(probes, MethodId::Precomputed) == "4 probes");
}

TEST_CASE("Recorder: a bad reference is refused once, and kept as the one that was asked for") {
    Recorder recorder;
    const auto bad =
        std::make_shared<const LiveReference>(LiveReference{.width = 3, .height = 3, .first = {}, .second = {}});
    CHECK_THROWS(recorder.set_reference(bad));
    CHECK(recorder.reference() == bad);
}
