#include "core/diagnose/pixel_paths.h"

#include <algorithm>
#include <numeric>

#include "core/diagnose/record_path.h"

namespace pl::diagnose {
namespace {

PassReplay without_field(const PassReplay& passes) {
    return {.width = passes.width,
            .height = passes.height,
            .schedule = passes.schedule,
            .samples = passes.samples,
            .next_pixel = passes.next_pixel,
            .scene = passes.scene,
            .path = passes.volumes ? passes.unguided_path : passes.path,
            .camera = passes.camera,
            .is_closed = passes.is_closed};
}

struct Candidate {
    float light = 0.0f;
    std::uint32_t pass = 0;
};

/// Whether `a` is to be kept before `b`.
bool is_before(const Candidate& a, const Candidate& b) {
    return a.light != b.light ? a.light > b.light : a.pass < b.pass;
}

}  // namespace

PassPair pass_pair(const Session& session, FilmSlot slot) {
    PassReplay own = session.pass_replay(slot);
    const MethodId owner = field_owner(slot.method);
    PassPair pair{.plain = without_field(own), .guided_method = owner, .shows_guided = own.volumes != nullptr};
    PassReplay guided = owner == slot.method ? std::move(own) : session.pass_replay({owner, slot.view});
    if (!guided.volumes) return pair;
    guided.schedule = pair.plain.schedule;
    guided.samples = pair.plain.samples;
    guided.next_pixel = pair.plain.next_pixel;
    pair.guided = std::move(guided);
    return pair;
}

PixelPaths trace_pixel(PassPair& passes, const PixelPathsRequest& request, const StopFlag* stop) {
    const auto is_stopped = [&] { return stop != nullptr && *stop; };
    const AnyFieldView no_field;
    const AnyFieldView field = passes.guided ? field_of(*passes.guided) : no_field;
    const auto plain_path = [&](std::uint32_t pass) {
        return record_path(passes.plain, no_field, request.pixel, pass);
    };
    const auto guided_path = [&](std::uint32_t pass) {
        return record_path(*passes.guided, field, request.pixel, pass);
    };

    PixelPaths result{.pixel = request.pixel,
                      .samples = passes.plain.samples + (request.pixel < passes.plain.next_pixel ? 1u : 0u)};
    const std::uint32_t wanted =
        request.choice == PassChoice::Newest ? request.count : std::max(request.count, kMostSearchedPasses);
    const std::uint32_t end = std::max(result.samples, request.count);
    std::vector<Candidate> kept;
    for (std::uint32_t pass = end - std::min(wanted, end); pass < end && !is_stopped(); ++pass) {
        kept.push_back({path_light(passes.shows_guided ? guided_path(pass) : plain_path(pass)), pass});
        std::ranges::push_heap(kept, is_before);
        ++result.searched;
        if (kept.size() <= request.count) continue;
        std::ranges::pop_heap(kept, is_before);  // the darkest
        kept.pop_back();
    }
    std::ranges::sort(kept, is_before);
    for (const Candidate& candidate : kept) {
        result.passes.push_back(candidate.pass);
        result.plain.push_back(plain_path(candidate.pass));
        if (passes.guided) result.guided.push_back(guided_path(candidate.pass));
    }
    return result;
}

float path_light(const PathRecord& path) { return luminance(path.radiance); }

std::vector<std::size_t> by_light(const std::vector<PathRecord>& paths) {
    std::vector<std::size_t> order(paths.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t i) { return path_light(paths[i]); });
    return order;
}

}  // namespace pl::diagnose
