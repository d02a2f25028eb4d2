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

/// The temperature of every facet at every stored instant, from any source.
struct TemperatureField {
    std::vector<Instant> instant;  // ascending
    std::size_t facets = 0;
    std::vector<float> kelvin;  // (instant, facet) [K]
    CoveredFacets water{};      // on facets with a water balance; empty if all are dry
    /// (facet) its representative, itself if solved; empty: all were solved.
    std::vector<std::uint32_t> solved_as{};
    /// [K] rms difference between a facet's own temperature and its representative's, measured on a
    /// sample of facets; 0: not measured, or all were solved.
    double representative_rms = 0.0;

    std::span<const float> at(std::size_t index) const {
        return {kelvin.data() + index * facets, facets};
    }
    std::span<float> at(std::size_t index) { return {kelvin.data() + index * facets, facets}; }
    /// Linear between the stored instants, constant outside. (facet) [K]
    std::vector<float> interpolate(Instant when) const;
    /// The same for water and snow on facets: (place in water.facet).
    std::vector<SurfaceCover> cover_at(Instant when) const;
};

/// Further contents of a file of temperatures.
struct FieldNotes {
    std::vector<std::string> materials{};   // (MaterialId) names; empty: not written
    std::vector<std::string> objects{};     // (ObjectId) the same, the ground first
    double utc_offset = 0.0;                // [s] that the scene's clock is ahead of UTC
    const HeatFluxField* fluxes = nullptr;  // at the temperatures' instants; null: not written
    std::string made_of{};                  // lines "SHA-256 NAME" of inputs; empty: not written
};

/// Writes netCDF (CF 1.8 with a UGRID 1.0 mesh of the facets in the site's east-north-up frame): a
/// whole file or none. Throws std::runtime_error with path and reason, also for a temperature that
/// is not finite.
///
/// Instants are written in UTC, on the scene's clock and in solar time; names as flag_meanings,
/// with "_" for characters that CF does not allow; terms of the heat balance with their
/// `balance_sign`, with which their sum is zero.
void save_temperature_field(const std::filesystem::path& file, const TemperatureField& field,
                            const FacetSet& facets, const Site& site, const FieldNotes& notes = {});

/// Reads a file of save_temperature_field. Throws InputError if the file is missing, has another
/// format, uses other units of time, or holds temperatures outside 1 to 5000 K.
TemperatureField load_temperature_field(const std::filesystem::path& file);

/// One term of the heat balance in the file of `field`: (instant, facet) [W m⁻²],
/// empty if the file has none. Throws InputError if it has another shape or is not
/// finite.
std::vector<float> load_heat_term(const std::filesystem::path& file, HeatTerm term,
                                  const TemperatureField& field);

/// Throws InputError if the field, read from `file`, does not cover the instants: if one is outside
/// it by more than the interval of its instants.
void check_covers(const TemperatureField& field, std::span<const Instant> wanted,
                  const std::filesystem::path& file);

}  // namespace diurna
