// Renders passes of a plain scene on request and prints the time of each: a program for check_effect_time.py.
// Usage: timed_passes METHOD [forced]: for each line of input one pass with one thread, answered by a line with its seconds
// of processor time, at the end of input by a checksum of all pictures. A line "anew" begins another picture first, in
// other memory. 'forced': the kernel that can do every effect.
#include <malloc.h>

#include <bit>
#include <ctime>
#include <iostream>
#include <memory>
#include <string>

#include "core/base/error.h"
#include "core/io/load_scene.h"
#include "core/session/methods.h"
#include "core/session/session.h"
#include "cpu/cpu_backend.h"

namespace pl::test {
namespace {

RenderSettings settings_of(const SceneDescription& scene, const std::string& method, bool forced) {
    RenderSettings settings{.next_event = false};
    for (const MethodInfo& info : all_methods())
        if (info.name == method) settings.method = info.id;
    if (info_of(settings.method).name != method) throw Error(ErrorKind::Usage, "no such method: " + method);
    settings.width = settings.height = 128;
    settings.camera = scene.camera;
    settings.field.volumes = 200;
    settings.field.precompute_samples = 1;
    if (forced) settings.forced_effects = kEveryFeature;
    return settings;
}

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::uint32_t add_picture(std::uint32_t sum, const Session& session) {
    for (const Vec3f& pixel : session.snapshot(slot_of(session.settings())).pixels)
        for (int i = 0; i < 3; ++i) sum = 31u * sum + std::bit_cast<std::uint32_t>(pixel[i]);
    return sum;
}

void serve(const std::string& method, bool forced) {
    const auto scene = std::make_shared<const SceneDescription>(load_scene("cornell", PL_SOURCE_DIR "/assets"));
    std::unique_ptr<Session> session;
    std::uint32_t sum = 0;
    std::string line;
    while (std::getline(std::cin, line)) {
        if (!session || line == "anew") {
            if (session) sum = add_picture(sum, *session);
            session.reset();
            session = std::make_unique<Session>(make_cpu_backend({.threads = 1}), scene,
                                                settings_of(*scene, method, forced));
        }
        double start = processor_seconds();
        const FilmSlot slot = slot_of(session->settings());
        while (session->advance(slot) != Progress::Rendered) start = processor_seconds();  // placing, precomputing
        std::cout << processor_seconds() - start << std::endl;
    }
    std::cout << (session ? add_picture(sum, *session) : sum) << std::endl;
}

}  // namespace
}  // namespace pl::test

int main(int count, char** arguments) try {
    // All blocks lie in one heap, of huge pages if GLIBC_TUNABLES asks for them: in small ones each picture has other conflicts in
    // the caches, and its time varies by a tenth.
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    pl::test::serve(count > 1 ? arguments[1] : "default", count > 2);
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
