// The picture of every single pass of a film, for trials of rules that choose between kinds of passes or weigh them
// (docs/notebook/2026-11-29-shares-of-passes.md).
// Usage: pass_records SCENE METHOD SIDE PASSES SEED FILE. METHOD: default, or reinforcement, each of whose passes is guided. FILE gets
// for each pass two doubles, its seconds and segments, and SIDE x SIDE pixels of three floats.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/io/load_scene.h"
#include "core/session/path_settings.h"
#include "core/session/session.h"
#include "cpu/cpu_backend.h"

namespace pl::benchmarks {
namespace {

struct Recording {
    FilmSlot slot;
    int passes;
    std::string file;
};

/// Takes single passes out of the mean of all of them.
class PassPictures {
public:
    explicit PassPictures(std::size_t values) : sums_(values, 0.0) {}

    /// The picture of the next pass, which has this weight, from the mean after it.
    std::vector<float> next(const std::vector<Vec3f>& mean, double own) {
        weight_ += own;
        std::vector<float> picture(sums_.size());
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            const double sum = weight_ * static_cast<double>(mean[i / 3][static_cast<int>(i % 3)]);
            picture[i] = static_cast<float>((sum - sums_[i]) / own);
            sums_[i] = sum;
        }
        return picture;
    }

private:
    std::vector<double> sums_;
    double weight_ = 0.0;
};

void record(Session& session, const Recording& recording) {
    const RenderSettings& settings = session.settings();
    PassPictures pictures(3 * film_pixels(settings.width, settings.height));
    std::ofstream file(recording.file, std::ios::binary);
    const PassSchedule weights{.ramp = weight_ramp(settings, recording.slot.method)};
    double seconds = 0.0;
    std::uint64_t segments = 0;
    for (int pass = 0; pass < recording.passes; ++pass) {
        while (session.advance(recording.slot) != Progress::Rendered) continue;
        const Snapshot now = session.snapshot(recording.slot);
        const double spent = now.clocks.render + now.clocks.learn;
        const std::array counts{spent - seconds, static_cast<double>(now.counters.path.segments - segments)};
        seconds = spent;
        segments = now.counters.path.segments;
        const std::vector<float> picture =
            pictures.next(now.pixels, weights.weight_of(static_cast<std::uint32_t>(pass)));
        file.write(reinterpret_cast<const char*>(counts.data()), sizeof counts);
        file.write(reinterpret_cast<const char*>(picture.data()),
                   static_cast<std::streamsize>(sizeof(float) * picture.size()));
    }
    if (!file.flush()) throw Error(ErrorKind::Input, recording.file + ": cannot be written");
}

}  // namespace
}  // namespace pl::benchmarks

int main(int argc, char** argv) {
    using namespace pl;
    if (argc != 7) {
        std::fprintf(stderr, "usage: pass_records SCENE METHOD SIDE PASSES SEED FILE\n");
        return 2;
    }
    const auto scene = std::make_shared<const SceneDescription>(load_scene(argv[1], find_assets_dir()));
    const int side = std::atoi(argv[3]);
    const RenderSettings settings{.width = side,
                                  .height = side,
                                  .camera = scene->camera,
                                  .seed = static_cast<std::uint64_t>(std::atoll(argv[5])),
                                  .guiding = GuidingRule::Always};
    Session session(make_cpu_backend({.threads = 1}), scene, settings);
    const MethodId method = std::string(argv[2]) == "default" ? MethodId::Default : MethodId::Reinforcement;
    benchmarks::record(session, {{method, View::Beauty}, std::atoi(argv[4]), argv[6]});
}
