// The radiance volumes and the learned fields of the CUDA back end.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "core/fields/field_model.h"
#include "core/session/film_slots.h"
#include "cuda/kernels/kernels.h"
#include "cuda/runtime/device_array.h"

namespace pl::cuda {

/// Tables are updated on the device; the network of a neural field is taught by the host between passes, as the CPU back end teaches it,
/// so that both have the same bits.
class DeviceFields {
public:
    explicit DeviceFields(const Stream& stream) : stream_(stream) {}

    /// Replaces the placement and drops all fields.
    void place(std::shared_ptr<const HostVolumes> volumes, const FieldShape& shape);
    /// Throws Error(Unavailable) for a representation that has no kernels here.
    void upload(MethodId method, const HostField& field);
    /// Empty arrays if the method has no field.
    HostField download(MethodId method) const;
    bool has(MethodId method) const { return stored_[index_of(method)].has_value(); }
    FieldReport report(MethodId method) const;

    /// The following functions throw Error(Runtime) if the method has no field.
    void change_pending(MethodId method, const std::function<void(PendingSums)>& change);
    void update(MethodId method);
    /// With the records of its volumes.
    AnyFieldView view(MethodId method);
    /// The placement and, for heat maps, one value per volume; empty for views that need neither. Queued: complete before later work
    /// of the stream.
    ShownField shown(const FilmSlot& slot);

private:
    using Arrays = FieldArrays<DeviceArray>;
    using Tables = TableStorage<DeviceArray>;

    struct StoredField {
        Arrays arrays;
        DeviceArray<VolumeRecord> records;
        FieldReport report;  ///< since the last update
    };

    static std::size_t index_of(MethodId method) { return static_cast<std::size_t>(method); }
    static Tables& tables_of(Arrays& arrays);

    StoredField& existing(MethodId method);
    void teach_network(MethodId method);
    void gather_records(StoredField& stored);
    Span<const float> volume_values(const FilmSlot& slot);

    const Stream& stream_;
    std::shared_ptr<const HostVolumes> host_volumes_;
    VolumeStorage<DeviceArray> volumes_;
    FieldShape shape_;
    std::array<std::optional<StoredField>, kMethodCount> stored_;
    DeviceArray<float> volume_values_;  ///< of the latest heat map
};

}  // namespace pl::cuda
