#include "app/picture_target.h"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/base/printable.h"
#include "core/io/picture_file.h"
#include "core/measure/picture_identity.h"
#include "core/session/shown_range.h"

namespace pl {

bool is_standard_output(const std::string& output) { return output == "-" || output.ends_with(":-"); }

ImageKind picture_kind(const std::string& output) {
    if (!is_standard_output(output)) return image_kind(output);
    if (output == "-") return ImageKind::Png;
    for (const ChoiceInfo<ImageKind>& info : kChoices<ImageKind>)
        if (output == fmt::format("{}:-", info.name)) return info.value;
    throw Error(ErrorKind::Usage, fmt::format("-o: expected -, png:-, exr:- or pfm:-, got '{}'", output));
}

void require_target(const std::string& output, Console& console) {
    picture_kind(output);
    if (!is_standard_output(output)) {
        require_writable(output);
        return;
    }
    if (console.json())
        throw Error(ErrorKind::Usage,
                    fmt::format("-o {}: expected a file with --json, whose lines go to standard output", output));
    if (isatty(STDOUT_FILENO) != 0)
        throw Error(ErrorKind::Usage,
                    fmt::format("-o {}: expected standard output to be a pipe or a file, got a terminal", output));
    console.keep_output_for_data();
}

void write_picture(const std::string& output, const Snapshot& snapshot, const DisplaySettings& display,
                   const ImageMetadata& metadata, Console& console) {
    if (is_standard_output(output))
        console.data(encode_picture(picture_kind(output), snapshot, display, metadata));
    else
        save_picture(output, snapshot, display, metadata);
}

ImageMetadata metadata_of(const Session& session, const Snapshot& snapshot, const Json& stats,
                          const std::string& command, bool interrupted) {
    ImageMetadata metadata{{"Software", "pathlight " PL_VERSION}, {"command", command}};
    if (snapshot.slot.view == View::Beauty)
        metadata.emplace_back(kPictureHashKey, picture_hash(session.scene_hash(), session.settings()));
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
