#pragma once

#include "thermal/solve/grouping.hpp"

namespace diurna {

/// The kinds' columns and forcing for steps of `stride` instants; modes from a finer level.
Level make_level(const SolveState& solve, const std::vector<KindOf>& kinds, std::size_t stride,
                 int most_substeps, const Level* finer = nullptr);

/// Closes a material's modes with a typical film.
void set_film(Kind& kind, double film, double step);
/// The same for a material's plates, with a film on each face.
void set_plate_films(Kind& kind, double front, double back, double step);
/// Updates the films of a level's materials from the slopes of another level.
void set_films(const SolveState& solve, Level& level, const Level& known);
/// −(mean slope) of a material over the last pass, or of its first guess.
double typical_film(const Kind& kind);
double typical_back_film(const Kind& kind);

/// A field of a coarse level's instants with a value at every instant, linear between those.
PackedField filled_between(const SolveState& solve, const PackedField& field, std::size_t stride);

}  // namespace diurna
