#include "core/io/field_file.h"

#include <optional>

#include "core/io/field_checks.h"
#include "core/io/field_layout.h"
#include "core/io/files.h"
#include "core/io/sealed_file.h"

namespace pl {
namespace {

constexpr SealedKind kFieldKind{.magic = "PLFIELD\n", .version = 10, .title = "learned field", .word = "field"};

template <class Stream, class Field>
void transfer_header(Stream& stream, Field& field) {
    stream.text(field.scene_hash);
    transfer_settings(stream, field.settings);
    transfer_shape(stream, field.shape);
    transfer_refinement(stream, field.refinement);
    auto& progress = field.progress;
    const auto all = [&](auto&... values) { (transfer(stream, values), ...); };
    all(progress.passes, progress.records, progress.clamped_records, progress.lookup_misses,
        progress.precomputed_slices, progress.next_probe);
}

LearnedField read_content(std::string_view content, const std::filesystem::path& path) {
    BinaryReader reader(content, path, kFieldKind.word);
    LearnedField field;
    std::string method;
    reader.text(method);
    const std::optional<MethodId> known = method_by_name(method);
    if (!known || !info_of(*known).uses_field)
        fail_damaged(path, kFieldKind.word, fmt::format("expected a method that learns, got '{}'", method));
    field.method = *known;
    transfer_header(reader, field);
    HostVolumes volumes;
    transfer_volumes(reader, volumes);
    transfer_tables(reader, field.field);
    reader.require_end();
    field.volumes = std::make_shared<const HostVolumes>(std::move(volumes));
    return field;
}

}  // namespace

void write_field(const std::filesystem::path& path, const LearnedField& field) {
    BinaryWriter writer = begin_sealed(kFieldKind);
    writer.text(std::string(info_of(field.method).name));
    transfer_header(writer, field);
    transfer_volumes(writer, *field.volumes);
    transfer_tables(writer, field.field);
    write_sealed(path, std::move(writer));
}

LearnedField read_field(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    LearnedField field = read_content(sealed_content(bytes, path, kFieldKind), path);
    require_usable(field, path);
    return field;
}

}  // namespace pl
