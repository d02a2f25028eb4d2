#pragma once

#include "thermal/solve/grouping.hpp"

namespace diurna {

/// The kinds' columns and forcing for steps of `stride` instants; modes from a finer level.
Level make_level(const SolveState& solve, const std::vector<KindOf>& kinds, std::size_t stride,
                 int most_substeps, const Level* finer = nullptr);

/// Puts a typical film on a material's modes.
void set_film(Kind& kind, double film, double step);
/// Typical films on the faces of a material's plates.
void set_plate_films(Kind& kind, double front, double back, double step);
/// Renews whatever films a level's materials are closed with, from the slopes another has found.
void set_films(const SolveState& solve, Level& level, const Level& known);
/// −(mean slope) of a material over the last pass, or what its first guess had.
double typical_film(const Kind& kind);
double typical_back_film(const Kind& kind);

/// A field's rows at the instants a coarse level steps over, on the line between those it lands on.
void fill_between(const SolveState& solve, std::vector<float>& field, std::size_t stride);

}  // namespace diurna
