#include "app/picture_metadata.h"

#include "core/base/printable.h"
#include "core/measure/picture_identity.h"
#include "core/session/shown_range.h"

namespace pl {

ImageMetadata metadata_of(const Session& session, const Snapshot& snapshot, const Json& stats,
                          const std::string& command, bool interrupted) {
    ImageMetadata metadata{{"Software", "pathlight " PL_VERSION}, {"command", command}};
    if (snapshot.slot.view == View::Beauty)
        metadata.emplace_back(kPictureHashKey, picture_hash(session.scene(), session.settings()));
    if (interrupted) metadata.emplace_back("partial", "true");
    for (const char* key : {"scene", "scene_hash", "light", "method", "view", "backend", "width", "height", "spp",
                            "seed", "max_depth", "nee", "kernel"}) {
        const Json& value = stats.at(key);
        metadata.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
    }
    if (const std::string range = legend(snapshot); !range.empty()) metadata.emplace_back("range", range);
    metadata.emplace_back("seconds", print_real(stats.at("seconds").at("total").get<double>()));
    return metadata;
}

}  // namespace pl
