#include "cuda/device_fields.h"

#include <fmt/format.h>

#include "core/base/parallel.h"
#include "core/fields/field_choices.h"
#include "core/fields/field_kernels.h"
#include "cpu/learning/neural_update.h"

namespace pl::cuda {

void DeviceFields::place(std::shared_ptr<const HostVolumes> volumes, const FieldShape& shape) {
    stored_ = {};
    volumes_ = {};
    zip(*volumes, volumes_, [&](const auto& from, auto& to) { to.upload(from, stream_); });
    stream_.wait("uploading radiance volumes");
    host_volumes_ = std::move(volumes);
    shape_ = shape;
}

void DeviceFields::upload(MethodId method, const HostField& field) {
    if (volumes_.normals.size() == 0)
        throw Error(ErrorKind::Runtime, "CUDA back end: expected volumes before tables, got none");
    const Representation representation = representation_of(field);
    if (!is_for_devices(representation))
        throw Error(
            ErrorKind::Unavailable,
            fmt::format("CUDA back end: expected a field of tables, got --field {}, which the CPU serves: take "
                        "--backend cpu or --field table",
                        name_of(representation)));
    StoredField uploaded;
    zip_fields(field, uploaded.arrays, [&](const auto& from, auto& to) { to.upload(from, stream_); });
    gather_records(uploaded);
    uploaded.report = report_of(field);
    stream_.wait("uploading a field");
    stored_[index_of(method)] = std::move(uploaded);
}

HostField DeviceFields::download(MethodId method) const {
    HostField field;
    if (!has(method)) return field;
    zip_fields(stored_[index_of(method)]->arrays, field,
               [&](const auto& from, auto& to) { from.download(to, stream_); });
    stream_.wait("downloading a field");
    return field;
}

FieldReport DeviceFields::report(MethodId method) const {
    return has(method) ? stored_[index_of(method)]->report : FieldReport{};
}

void DeviceFields::change_pending(MethodId method, const std::function<void(PendingSums)>& change) {
    for_each_pending_array(tables_of(existing(method).arrays), [&](auto& array) {
        std::vector<std::remove_cvref_t<decltype(*array.data())>> values;
        array.download(values, stream_);
        stream_.wait("reading pending sums");
        change(std::span(values));
        array.upload(values, stream_);
        stream_.wait("writing pending sums");
    });
}

void DeviceFields::update(MethodId method) {
    StoredField& stored = existing(method);
    const TableUpdateView field = update_view(shape_, tables_of(stored.arrays));
    const std::uint32_t volumes = field.mean_radiance.count;
    for (const UpdateStep& step : kUpdateSteps) {
        std::uint32_t count = volumes;
        if (step.item == UpdateItem::Cell) count *= static_cast<std::uint32_t>(field.cells.count());
        if (step.item == UpdateItem::Row) count *= static_cast<std::uint32_t>(field.cells.side);
        launch(step.kernel, one_thread_each(count), stream_, step.name, field, count);
    }
    if (stored.report.network) return teach_network(method);
    gather_records(stored);
    stream_.wait("updating a field");
}

/// Teaches the network by the tables as they are on the device. Its arrays go back.
void DeviceFields::teach_network(MethodId method) {
    StoredField& stored = existing(method);
    HostField field = download(method);
    auto& neural = std::get<HostNeural>(field);
    update_network(shape_, *host_volumes_, neural, usable_threads());
    auto& arrays = std::get<NeuralStorage<DeviceArray>>(stored.arrays);
    for_each_network_array([&](const auto& spec) { spec.get(arrays).upload(spec.get(neural), stream_); });
    stored.report = report_of(field);
    gather_records(stored);
    stream_.wait("updating a network");
}

AnyFieldView DeviceFields::view(MethodId method) {
    StoredField& stored = existing(method);
    AnyFieldView view = field_view(shape_, volumes_, stored.arrays);
    visit_field(view, [&](auto& field) {
        if constexpr (requires { field.records; }) field.records = view_of(std::as_const(stored.records));
    });
    return view;
}

ShownField DeviceFields::shown(const FilmSlot& slot) {
    const ViewInfo& view = info_of(slot.view);
    if (!view.needs_volumes && !view.needs_tables) return {};
    if (volumes_.normals.size() == 0) throw Error(ErrorKind::Runtime, "CUDA back end: expected volumes, got none");
    ShownField shown{placement_view(volumes_, shape_.extent), {}};
    if (needs_volume_values(slot.view)) shown.volume_values = volume_values(slot);
    return shown;
}

/// The tables of a field that has them.
DeviceFields::Tables& DeviceFields::tables_of(Arrays& arrays) {
    Tables* tables = nullptr;
    std::visit(
        [&](auto& stored) {
            if constexpr (std::derived_from<std::remove_cvref_t<decltype(stored)>, Tables>) tables = &stored;
        },
        arrays);
    return *tables;  // others are refused when they are uploaded
}

DeviceFields::StoredField& DeviceFields::existing(MethodId method) {
    std::optional<StoredField>& stored = stored_[index_of(method)];
    if (!stored)
        throw Error(ErrorKind::Runtime,
                    fmt::format("CUDA back end: expected tables of '{}', got none", info_of(method).name));
    return *stored;
}

/// Queued: to be called after every change of a field.
void DeviceFields::gather_records(StoredField& stored) {
    const TableField field = field_view(shape_, volumes_, tables_of(stored.arrays));
    const std::uint32_t volumes = field.normals.count;
    if (stored.records.size() != volumes) stored.records = DeviceArray<VolumeRecord>(volumes);
    launch(kGatherRecords, one_thread_each(volumes), stream_, "gather_records", field, view_of(stored.records));
}

Span<const float> DeviceFields::volume_values(const FilmSlot& slot) {
    const MethodId method = field_owner(slot.method);
    Arrays& arrays = existing(method).arrays;
    const TableUpdateView field = update_view(shape_, tables_of(arrays));
    const std::uint32_t volumes = field.mean_radiance.count;
    if (volume_values_.size() != volumes) volume_values_ = DeviceArray<float>(volumes);
    if (representation_of(arrays) != Representation::Table) {
        HostField on_host = download(method);
        std::vector<float> values(volumes);
        std::visit(
            [&](auto& host_arrays) {
                const VolumeSummary auto summary = summary_of(shape_, *host_volumes_, host_arrays);
                for (std::uint32_t i = 0; i < volumes; ++i) values[i] = volume_value(summary, i, slot.view);
            },
            on_host);
        volume_values_.upload(values, stream_);
        stream_.wait("uploading a heat map");
    } else {
        launch(kVolumeValues, one_thread_each(volumes), stream_, "volume_values", field, slot.view,
               Span<float>{volume_values_.data(), volumes});
    }
    return Span<const float>{volume_values_.data(), volumes};
}

}  // namespace pl::cuda
