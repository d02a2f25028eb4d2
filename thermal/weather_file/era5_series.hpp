#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// Values by ERA5's short names, (row), NaN where missing, in ERA5's units: t2m and d2m [K], u10
/// and v10 or si10 [m s⁻¹], sp [Pa], tcc, and sums over the hour that ends at the stamp: ssrd, fdir
/// and strd [J m⁻²], tp [m].
using Era5Values = std::map<std::string, std::vector<double>>;

/// Content of one file of ERA5, or of several joined.
struct Era5Series {
    std::filesystem::path file;
    std::string format;                // "ERA5 netCDF"
    std::vector<Instant> stamp{};      // (row) ascending
    std::vector<std::string> where{};  // (row)
    Era5Values values{};
    std::optional<Geodetic> place{};
    std::vector<std::string> notes{};
    std::vector<std::string> unused{};  // variables that were skipped
    /// Radiation and rain are those of an hour in the mean since the row before; else of the hour
    /// before the stamp.
    bool between_rows = false;
};

}  // namespace diurna
