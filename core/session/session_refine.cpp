// The part of Session that refines the placement of volumes while a method learns.
#include <algorithm>
#include <limits>
#include <utility>

#include "core/session/session.h"

namespace pl {
namespace {

/// Rounds that add the share, each its part. Where nobody asked for it, more of them follow, as records come: fewer than
/// would overflow passes_before_round().
constexpr std::uint32_t kRounds = 2;
constexpr std::uint32_t kMostRounds = 32;

std::uint32_t most_rounds(const FieldSettings& settings) {
    if (settings.refine_share == 0.0f) return 0;
    return settings.refine_share == kRefineByRecords ? kMostRounds : kRounds;
}

/// After how many passes that were learned from the placement is refined: 8, 16, 48, 96, 192 and so on. Tables have to know
/// something first, and the new ones have to have something left to learn from. The later rounds keep away from powers of
/// two, where many pictures end: no pass would be left that uses what they cost. docs/learning.md has what was tried.
constexpr std::uint64_t passes_before_round(std::uint32_t round) {
    return round < kRounds ? std::uint64_t{8} << round : std::uint64_t{12} << round;
}

/// Records that a cell has on the mean when volumes are added without being asked for: fewer cells that know more, and
/// pictures that are ready before splitting has paid, are better off as they are. A cell that splits late has to know more.
constexpr std::uint64_t kRecordsPerCell = 32;
constexpr std::uint64_t kRecordsPerCellLate = 96;

/// Volumes that `records` are enough for in a round.
std::size_t worth_having(const FieldSettings& settings, std::uint32_t round, std::uint64_t records) {
    if (settings.refine_share != kRefineByRecords) return std::numeric_limits<std::size_t>::max();
    const std::uint64_t wanted = round < kRounds ? kRecordsPerCell : kRecordsPerCellLate;
    return records / (wanted * static_cast<std::uint64_t>(settings.bins));
}

/// Volumes that may be added in the round after `so_far.rounds` others.
std::size_t most_added(const FieldSettings& settings, std::size_t volumes, const Refinement& so_far,
                       std::uint64_t records) {
    const std::size_t placed = volumes - so_far.added;
    const std::size_t most = most_refined_volumes(settings, placed) - placed;
    const std::size_t parts = std::min(so_far.rounds + 1, kRounds);
    const std::size_t due = std::min(placed + most * parts / kRounds, worth_having(settings, so_far.rounds, records));
    return due > volumes ? due - volumes : 0;
}

}  // namespace

/// Right after a publication, when no record waits. Counts passes that were learned from, as fields keep them, so that one
/// that was saved in between is refined at the same moment; at most one round per publication.
void Session::refine_if_due() {
    if (refinement_.rounds >= most_rounds(settings_.field)) return;
    if (field().passes < passes_before_round(refinement_.rounds)) return;
    const std::size_t most = most_added(settings_.field, volumes_->normals.size(), refinement_, field().records);
    if (most > 0) split_volumes(most);
    ++refinement_.rounds;
}

void Session::split_volumes(std::size_t most) {
    HostField learned = backend_->download_field(settings_.method);
    const std::vector<std::uint32_t> split =
        volumes_to_split(field_view(shape_, *volumes_, learned), most, backend_->info().threads);
    RefinedPlacement refined = refine_placement(
        *packed_, settings_.field, placement_view(*volumes_, shape_.lookup, shape_.extent), split);
    if (!refined.parents.empty()) replace_volumes(std::move(refined), std::move(learned));
}

/// The pictures stay: tables only decide which directions are tried. A radiance map that is complete goes on with the tables
/// of the parents, as measured; one that is not begins anew, since its slices are counted for all volumes at once.
void Session::replace_volumes(RefinedPlacement refined, HostField learned) {
    std::vector<std::pair<MethodId, HostField>> tables;
    tables.emplace_back(settings_.method, split_field(shape_, std::move(learned), refined.parents));
    for (const MethodInfo& other : all_methods()) {
        if (other.id == settings_.method || !backend_->has_field(other.id)) continue;
        FieldProgress& progress = fields_[static_cast<std::size_t>(other.id)];
        if (progress.passes > 0)
            tables.emplace_back(other.id, split_field(shape_, backend_->download_field(other.id), refined.parents));
        else
            progress = {.precompute_seconds = progress.precompute_seconds};
    }
    volumes_ = with_lookup(std::move(refined.volumes), shape_.lookup);
    refinement_.added += static_cast<std::uint32_t>(refined.parents.size());
    try {
        backend_->upload_volumes(volumes_, shape_);
        for (auto& [method, table] : tables) backend_->upload_field(method, std::move(table));
    } catch (...) {  // nobody knows what the back end holds now
        volumes_.reset();
        clear_tables();
        clear_films();
        throw;
    }
    clear_cell_films();
}

/// Pictures of the cells would be mixtures of those before and after.
void Session::clear_cell_films() {
    const auto clear = [](FilmStates& films) {
        for (const MethodInfo& method : all_methods())
            films[static_cast<std::size_t>(FilmSlot{method.id, View::Voronoi}.index())] = FilmState{};
    };
    clear(films_);
    for (ParkedBackend& parked : parked_) clear(parked.films);
}

}  // namespace pl
