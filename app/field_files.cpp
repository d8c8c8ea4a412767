#include "app/field_files.h"

#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "core/io/field_file.h"

namespace pl {
namespace {

std::string summary(const LearnedField& field) {
    return fmt::format("{}, {} volumes, {} directions, {} passes, {} records", info_of(field.method).name,
                       field.volumes->normals.size(), field.shape.cells.count(), field.progress.passes,
                       field.progress.records);
}

}  // namespace

FieldFiles::FieldFiles(const Options& given) {
    if (given.load_field.empty()) return;
    const Stopwatch watch;
    loaded_ = read_field(given.load_field);
    load_seconds_ = watch.seconds();
}

void FieldFiles::hand_over(Session& session, const Options& options, Console& console) {
    if (!loaded_) return;
    LearnedField field = std::move(*loaded_);
    loaded_.reset();
    console.log().detail(fmt::format("{}: {}", options.load_field, summary(field)));
    earlier_precompute_seconds_ = std::exchange(field.progress.precompute_seconds, 0.0);
    field.settings.lookup = options.render.field.lookup;
    field.shape.lookup = options.render.field.lookup;
    try {
        session.import_field(std::move(field));
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}", options.load_field, error.what()));
    }
}

void FieldFiles::save(const Session& session, const Options& options, Console& console) const {
    if (options.save_field.empty()) return;
    LearnedField field = session.export_field();
    field.progress.precompute_seconds += earlier_precompute_seconds_;
    write_field(options.save_field, field);
    console.remark(fmt::format("{}: {}\n", options.save_field, summary(field)));
    console.event("field", {{"output", options.save_field},
                            {"volumes", field.volumes->normals.size()},
                            {"passes", field.progress.passes},
                            {"records", field.progress.records}});
}

}  // namespace pl
