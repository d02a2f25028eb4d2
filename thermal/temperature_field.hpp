#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// The temperature of every facet at every kept instant, whoever made it.
struct TemperatureField {
    std::vector<Instant> instant;  // ascending
    std::size_t facets = 0;
    std::vector<float> kelvin;  // (instant, facet) [K]

    std::span<const float> at(std::size_t index) const {
        return {kelvin.data() + index * facets, facets};
    }
    std::span<float> at(std::size_t index) { return {kelvin.data() + index * facets, facets}; }
    /// Linear between the kept instants, constant beyond them. (facet) [K]
    std::vector<float> interpolate(Instant when) const;
};

/// Writes netCDF (CF 1.8 with a UGRID 1.0 mesh of the facets in the site's east-north-up frame):
/// a whole file or none. Throws std::runtime_error with path and reason, also for a temperature
/// that is not finite.
void save_temperature_field(const std::filesystem::path& file, const TemperatureField& field,
                            const FacetSet& facets, const Site& site);

/// Reads what save_temperature_field wrote. Throws InputError if the file is missing, is no such
/// file, or holds temperatures that are not finite and positive.
TemperatureField load_temperature_field(const std::filesystem::path& file);

}  // namespace diurna
