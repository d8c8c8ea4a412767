#include "core/session/guided_passes.h"

#include "core/session/path_settings.h"

namespace pl {

bool GuidedPasses::chooses(FilmSlot slot) const {
    return inputs_.settings.guiding == GuidingRule::Paying && inputs_.settings.next_event &&
           slot.view == View::Beauty && info_of(slot.method).uses_field;
}

bool GuidedPasses::coarse_map_suffices(FilmSlot slot, const FilmProgress& film) const {
    if (!chooses(slot)) return false;
    return film.guiding.is_warm_up(film.passes) || !film.guiding.is_guided(film.passes);
}

void GuidedPasses::begin_film(FilmSlot slot, FilmProgress& film) const {
    if (!chooses(slot)) return;
    const bool is_known =
        info_of(slot.method).learns && (fields_.progress(slot.method).passes > 0 || fields_.is_frozen(slot.method));
    film.guiding.begin_film(inputs_.pixel_count(), is_known);
}

void GuidedPasses::begin_pass(FilmSlot slot, FilmProgress& film) const {
    film.measured = {};
    film.is_guided = true;
    bool may_train = true;
    if (chooses(slot)) {
        film.is_guided = film.guiding.is_guided(film.passes);
        may_train = film.is_guided || film.guiding.role_of(film.passes) == PassRole::Training;
    }
    film.trains = may_train && slot.view == View::Beauty && info_of(slot.method).learns &&
                  fields_.is_trained_by_pass(slot.method, film.passes);
}

/// Paths of the baseline that train are traced by the kernel of the method that learns, which doubles their time: they find light that the
/// field has not learned as often as light that it has.
void GuidedPasses::shape(FilmSlot slot, const FilmProgress& film, PassRequest& request) const {
    if (!film.is_guided) {
        request.is_guided = film.trains;
        request.mixture = MixtureSettings::unguided();
        request.path.roulette = RouletteRule::Albedo;
    }
    if (!chooses(slot)) return;
    request.measure = film.guiding.measure_of(film.passes);
}

void GuidedPasses::finish_pass(FilmSlot slot, FilmProgress& film) const {
    if (!chooses(slot)) return;
    if (!film.is_guided) ++film.unguided_passes;
    const Representation representation = representation_of(inputs_.settings.field, slot.method);
    film.guiding.finish_pass(film.passes, film.measured, guidance_of(representation));
}

std::optional<GuidingStatus> GuidedPasses::status(FilmSlot slot, const FilmProgress& film) const {
    if (!chooses(slot)) return std::nullopt;
    return GuidingStatus{.pays = film.guiding.pays(),
                         .variance_ratio = film.guiding.variance_ratio(),
                         .ratio_factor = film.guiding.ratio_factor(),
                         .unguided_passes = film.unguided_passes,
                         .guided_share = film.guided_seconds / film.render_seconds};
}

}  // namespace pl
