// The part of Session that hands out learned fields and takes them in.
#include "core/base/error.h"
#include "core/kernel/fields/direction_table.h"
#include "core/scene/scene_hash.h"
#include "core/session/session.h"

namespace pl {
namespace {

/// Do the sizes of all arrays agree?
bool fits_together(const LearnedField& field) {
    if (field.volumes == nullptr || field.shape.cells.side < 1) return false;
    const std::size_t volumes = field.volumes->normals.size();
    const HostTables expected = make_tables(field.shape, volumes);
    bool fits = field.volumes->sites.size() == volumes && field.volumes->kd_nodes.size() <= volumes &&
                field.refinement.added <= volumes;
    zip(expected, field.tables,
        [&](const auto& want, const auto& have) { fits = fits && want.size() == have.size(); });
    return fits;
}

}  // namespace

void Session::ensure_tables(MethodId method) {
    ensure_volumes();
    const MethodId owner = table_owner(method);
    if (!backend_->has_tables(owner))
        backend_->upload_tables(owner, make_tables(placement_.shape(), placement_.count()));
}

void Session::clear_tables() {
    fields_.fill(FieldProgress{});
    placement_.undo_refinement();
    if (placement_.is_placed()) backend_->upload_volumes(placement_.volumes(), placement_.shape());
}

VolumeInspection Session::inspect_volume(MethodId method, std::int32_t volume) const {
    const MethodId owner = table_owner(method);
    if (!placement_.is_placed() || !backend_->has_tables(owner))
        throw Error(ErrorKind::Usage, "nothing has been learned yet: render with a method that uses radiance volumes "
                                      "(precomputed, reinforcement) first");
    if (volume < 0 || static_cast<std::size_t>(volume) >= placement_.count())
        throw Error(ErrorKind::Usage, "radiance volume " + std::to_string(volume) +
                                          " does not exist: expected 0 to " + std::to_string(placement_.count()) +
                                          " (exclusive)");
    const HostVolumes& volumes = *placement_.volumes();
    HostTables tables = backend_->download_tables(owner);
    const TableField field = table_field(placement_.shape(), volumes, tables);
    const DirectionCells& cells = placement_.shape().cells;
    const auto index = static_cast<std::size_t>(volume);
    const auto first = static_cast<std::ptrdiff_t>(index) * cells.count();
    const auto last = first + cells.count();

    VolumeInspection result{.volume = volume,
                            .position = volumes.sites[index].position,
                            .normal = volumes.normals[index],
                            .side = cells.side,
                            .radiance = {tables.radiance.begin() + first, tables.radiance.begin() + last},
                            .probability = {},
                            .visits = {tables.visits.begin() + first, tables.visits.begin() + last},
                            .mean_radiance = tables.mean_radiance[index]};
    const DirectionTable table(field, volume);
    for (int row = 0; row < cells.side; ++row)
        for (int column = 0; column < cells.side; ++column)
            result.probability.push_back(table.cell_probability(column, row));
    return result;
}

LearnedField Session::export_field(MethodId method) const {
    if (!placement_.is_placed() || !backend_->has_tables(method))
        throw Error(ErrorKind::Usage, "method '" + std::string(info_of(method).name) + "' has learned nothing yet");
    return {.method = method,
            .scene_hash = scene_hash(scene()),
            .settings = settings_.field,
            .shape = placement_.shape(),
            .volumes = placement_.volumes(),
            .refinement = placement_.refinement(),
            .tables = backend_->download_tables(method),
            .progress = field(method).without_part()};
}

void Session::import_field(LearnedField learned) {
    require_learned_in(scene(), learned);
    if (!info_of(learned.method).uses_field || !fits_together(learned))
        throw Error(ErrorKind::Input, "the field's volumes and tables do not fit together");
    Placement adopted = placement_;
    adopted.adopt(*backend_, *scene_.packed(), *learned.volumes, learned.shape, learned.refinement);
    backend_->upload_tables(learned.method, std::move(learned.tables));
    placement_ = std::move(adopted);
    settings_.field = learned.settings;
    fields_.fill(FieldProgress{});
    field(learned.method) = learned.progress;
    clear_films();
}

}  // namespace pl
