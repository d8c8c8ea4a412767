#include "app/field_files.h"

#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/io/field_file.h"

namespace pl {

FieldFiles::FieldFiles(const Options& given) {
    if (given.load_field.empty()) return;
    const Stopwatch watch;
    loaded_ = read_field(given.load_field);
    load_seconds_ = watch.seconds();
}

std::shared_ptr<const LearnedField> FieldFiles::take(const SceneDescription& scene, const Options& options) {
    if (!loaded_) return nullptr;
    const auto field = std::make_shared<LearnedField>(std::move(*loaded_));
    loaded_.reset();
    try {
        require_learned_in(scene, *field);
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}", options.load_field, error.what()));
    }
    return field;
}

void FieldFiles::hand_over(Session& session, const Options& options, Console& console) {
    if (!loaded_) return;
    LearnedField field = std::move(*loaded_);
    loaded_.reset();
    console.log().detail(fmt::format("{}: {}", options.load_field, summary_of(field)));
    try {
        session.import_field(std::move(field));
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}", options.load_field, error.what()));
    }
}

void FieldFiles::save(const Session& session, const Options& options, Console& console) const {
    if (options.save_field.empty()) return;
    const LearnedField field = session.export_field(options.render.method);
    write_field(options.save_field, field);
    console.remark(fmt::format("{}: {}\n", options.save_field, summary_of(field)));
    console.event("field", {{"output", options.save_field},
                            {"volumes", field.volumes->normals.size()},
                            {"passes", field.progress.passes},
                            {"records", field.progress.records}});
}

}  // namespace pl
