#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "thermal/covered_facets.hpp"
#include "thermal/heat_flux_field.hpp"

namespace diurna {

/// The temperature of every facet at every kept instant, whoever made it.
struct TemperatureField {
    std::vector<Instant> instant;  // ascending
    std::size_t facets = 0;
    std::vector<float> kelvin;  // (instant, facet) [K]
    CoveredFacets water{};      // what lies on facets whose water was followed; none where all dry
    /// (facet) the one whose temperatures it has, itself where it was solved; empty: all were.
    std::vector<std::uint32_t> solved_as{};

    std::span<const float> at(std::size_t index) const {
        return {kelvin.data() + index * facets, facets};
    }
    std::span<float> at(std::size_t index) { return {kelvin.data() + index * facets, facets}; }
    /// Linear between the kept instants, constant beyond them. (facet) [K]
    std::vector<float> interpolate(Instant when) const;
    /// The same of what lies on facets: (place in water.facet).
    std::vector<SurfaceCover> cover_at(Instant when) const;
};

/// What stands in a file beside temperatures.
struct FieldNotes {
    std::vector<std::string> materials{};   // (MaterialId) names; empty: not written
    std::vector<std::string> objects{};     // (ObjectId) names, the ground first; empty likewise
    double utc_offset = 0.0;                // [s] that the scene's clock is ahead of UTC
    const HeatFluxField* fluxes = nullptr;  // at the temperatures' instants; null: not written
    std::string made_of{};                  // lines "SHA-256 NAME" of inputs; empty: not written
};

/// Writes netCDF (CF 1.8 with a UGRID 1.0 mesh of the facets in the site's east-north-up frame):
/// a whole file or none. Throws std::runtime_error with path and reason, also for a temperature
/// that is not finite.
///
/// Instants are written in UTC, on the scene's clock and in solar time; names as flag_meanings, in
/// which what CF does not allow becomes "_"; terms of the heat balance with their `balance_sign`,
/// by which they add up to nothing.
void save_temperature_field(const std::filesystem::path& file, const TemperatureField& field,
                            const FacetSet& facets, const Site& site, const FieldNotes& notes = {});

/// Reads what save_temperature_field wrote. Throws InputError if the file is missing, is no such
/// file, counts time in another way, or holds temperatures that are not from 1 to 5000 K.
TemperatureField load_temperature_field(const std::filesystem::path& file);

/// One term of the heat balance that the file of `field` holds beside it: (instant, facet)
/// [W m⁻²], empty where it holds none. Throws InputError where it is of another shape or not
/// finite.
std::vector<float> load_heat_term(const std::filesystem::path& file, HeatTerm term,
                                  const TemperatureField& field);

/// Throws InputError where the field, read from `file`, is not of these instants: where one lies
/// beyond its ends by more than its instants are apart.
void check_covers(const TemperatureField& field, std::span<const Instant> wanted,
                  const std::filesystem::path& file);

}  // namespace diurna
