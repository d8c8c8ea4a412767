#include "core/io/checkpoint_file.h"

#include <concepts>
#include <optional>
#include <type_traits>

#include "core/io/field_file.h"
#include "core/io/files.h"
#include "core/io/sealed_file.h"

namespace pl {
namespace {

constexpr SealedKind kCheckpointKind{
    .magic = "PLCHECK\n", .version = 13, .title = "checkpoint", .word = "checkpoint"};

/// transfer(), also for the kinds of values that only checkpoints hold. Each works for writing, with constant values, and for
/// reading.
template <class Stream>
class CheckpointLayout {
public:
    explicit CheckpointLayout(Stream& stream) : stream_(stream) {}

    template <class... Values>
    void all(Values&... values) {
        (one(values), ...);
    }

    template <class Value>
    void one(Value& value) {
        transfer(stream_, value);
    }
    template <class Value>
    requires std::same_as < std::remove_const_t<Value>,
    bool > void one(Value& value) {
        auto byte = static_cast<std::uint8_t>(value ? 1 : 0);
        transfer(stream_, byte);
        if constexpr (!std::is_const_v<Value>) value = byte != 0;
    }
    void one(const std::string& value) { stream_.text(value); }
    void one(std::string& value) { stream_.text(value); }
    template <class T>
    void one(const std::optional<T>& value) {
        one_optional<const T>(value);
    }
    template <class T>
    void one(std::optional<T>& value) {
        one_optional<T>(value);
    }

    /// By name, since numbers of methods and views follow from their lists.
    template <class Method>
    requires std::same_as<std::remove_const_t<Method>, MethodId>
    void one(Method& method) {
        auto name = std::is_const_v<Method> ? std::string(info_of(method).name) : std::string();
        one(name);
        if constexpr (!std::is_const_v<Method>) method = known(method_by_name(name), "method", name);
    }
    template <class Shown>
    requires std::same_as<std::remove_const_t<Shown>, View>
    void one(Shown& view) {
        auto name = std::is_const_v<Shown> ? std::string(info_of(view).name) : std::string();
        one(name);
        if constexpr (!std::is_const_v<Shown>) view = known(view_by_name(name), "view", name);
    }

    template <class Counters>
    void counters(Counters& counters) {
        PassCounters copy = counters;
        add_counters(copy, counters, [this](auto& value, const auto&) { one(value); });
        VarianceSums::each(copy.variance, counters.variance, [this](auto& value, const auto&) { one(value); });
        if constexpr (!std::is_const_v<Counters>) counters = copy;
    }

    template <class Film>
    void progress(Film& film) {
        auto& origin = film.origin;
        all(origin.number, origin.generation, origin.warm, origin.place_seconds, origin.precompute_seconds);
        all(film.is_allocated, film.passes, film.next_pixel, film.render_seconds, film.guided_seconds,
            film.learn_seconds);
        counters(film.counters);
        GuidingChoice::each_value(film.guiding, [this](auto& value) { one(value); });
        all(film.is_guided, film.trains, film.unguided_passes);
        counters(film.measured);
        each(film.runs, [this](auto& run) {
            all(run.first_pass, run.first_sample, run.sequences.name, run.sequences.first_sample, run.is_guided,
                run.trains, run.decides);
        });
        one(film.updates_seen);
    }

    template <class Progress>
    void learning(Progress& progress) {
        all(progress.passes, progress.untrained_passes, progress.updates, progress.records, progress.clamped_records,
            progress.lookup_misses, progress.precomputed_slices, progress.next_probe, progress.precompute_seconds,
            progress.is_well_trained, progress.has_part, progress.was_edited);
        transfer_array(stream_, progress.forgotten);
    }

    template <class Pixels>
    void pixels(Pixels& pixels) {
        static_assert(sizeof(FilmPixel) == 6 * sizeof(double) + 4 * sizeof(std::uint32_t));
        stream_.count(pixels);
        for (auto& pixel : pixels) {
            for (int i = 0; i < 3; ++i) all(pixel.sum[i], pixel.second_sum[i]);
            all(pixel.weight, pixel.second_weight, pixel.invalid);
            all(pixel.emission.value, pixel.emission.varies, pixel.emission.at_border);
        }
    }

    /// Calls fn(element) for each element of an array, after it has got its length.
    template <class Array, class Fn>
    void each(Array& array, Fn&& fn) {
        auto count = static_cast<std::uint32_t>(array.size());
        one(count);
        if constexpr (!std::is_const_v<Array>)
            for (std::uint32_t i = 0; i < count; ++i) fn(array.emplace_back());
        else
            for (const auto& element : array) fn(element);
    }

private:
    template <class T>
    T known(std::optional<T> value, const char* what, const std::string& name) {
        if (!value) stream_.fail(fmt::format("{}: expected one of this program's, got '{}'", what, name));
        return *value;
    }

    template <class T, class Optional>
    void one_optional(Optional& value) {
        bool has_value = value.has_value();
        one(has_value);
        if (!has_value) return;
        if constexpr (!std::is_const_v<Optional>) value.emplace();
        one(*value);
    }

    Stream& stream_;
};

template <class Stream, class Placement, class Volumes>
void transfer_placement(Stream& stream, Placement& placement, Volumes& volumes) {
    transfer_settings(stream, placement.settings);
    transfer_shape(stream, placement.shape);
    transfer_refinement(stream, placement.refinement);
    transfer(stream, placement.seconds);
    transfer_volumes(stream, volumes);
}

template <class Stream, class Content>
void transfer_content(Stream& stream, Content& checkpoint) {
    CheckpointLayout layout(stream);
    auto& state = checkpoint.state;
    layout.one(checkpoint.seconds);
    layout.each(state.identity, [&](auto& entry) { layout.all(entry.first, entry.second); });
    layout.one(state.is_closed);
    layout.each(state.fields, [&](auto& field) {
        layout.one(field.method);
        layout.learning(field.progress);
        transfer_tables(stream, field.arrays);
    });
    layout.each(state.films, [&](auto& film) {
        layout.all(film.slot.method, film.slot.view);
        layout.progress(film.progress);
        layout.pixels(film.pixels);
    });
}

/// Volumes and tables before kernels use their values as indices and probabilities.
void require_usable_fields(SessionState& state, const std::filesystem::path& path) {
    if (!state.placement) return;
    const SavedPlacement& placement = *state.placement;
    LearnedField checked;
    checked.settings = placement.settings;
    checked.shape = placement.shape;
    checked.volumes = placement.volumes;
    checked.refinement = placement.refinement;
    bool has_tables = false;
    for (SavedField& field : state.fields) {
        if (field_bytes(field.arrays) == 0) continue;
        has_tables = true;
        checked.method = field.method;
        checked.progress = field.progress;
        checked.field = std::move(field.arrays);
        require_usable(checked, path);
        field.arrays = std::move(checked.field);
    }
    if (has_tables) return;
    checked.method = MethodId::Reinforcement;
    checked.field = make_field(placement.shape, placement.volumes->normals.size(), placement.settings.representation);
    require_usable(checked, path);
}

/// Volumes whose tables the next pass is to clear.
void require_known_volumes(const std::vector<std::int32_t>& forgotten, std::size_t volumes,
                           const std::filesystem::path& path) {
    for (const std::int32_t volume : forgotten)
        if (volume < 0 || static_cast<std::size_t>(volume) >= volumes)
            fail_damaged(path, kCheckpointKind.word,
                         fmt::format("forgotten volume: expected one of {}, got {}", volumes, volume));
}

void require_usable(SessionState& state, const std::filesystem::path& path) {
    for (const SavedField& field : state.fields) {
        const bool has_tables = field_bytes(field.arrays) > 0;
        if (has_tables && !(state.placement && info_of(field.method).uses_field))
            fail_damaged(path, kCheckpointKind.word, "tables: expected a method that learns, and volumes");
        require_known_volumes(field.progress.forgotten, has_tables ? state.placement->volumes->normals.size() : 0,
                              path);
    }
    require_usable_fields(state, path);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
    BinaryWriter writer = begin_sealed(kCheckpointKind);
    const std::optional<SavedPlacement>& placement = checkpoint.state.placement;
    writer.number(std::uint32_t{placement ? 1u : 0u});
    if (placement) transfer_placement(writer, *placement, *placement->volumes);
    transfer_content(writer, checkpoint);
    write_sealed(path, std::move(writer));
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
    const std::string bytes = read_file(path);
    BinaryReader reader(sealed_content(bytes, path, kCheckpointKind), path, kCheckpointKind.word);
    Checkpoint checkpoint;
    std::uint32_t is_placed = 0;
    reader.number(is_placed);
    if (is_placed != 0) {
        HostVolumes volumes;
        transfer_placement(reader, checkpoint.state.placement.emplace(), volumes);
        checkpoint.state.placement->volumes = std::make_shared<const HostVolumes>(std::move(volumes));
    }
    transfer_content(reader, checkpoint);
    reader.require_end();
    require_usable(checkpoint.state, path);
    return checkpoint;
}

}  // namespace pl
