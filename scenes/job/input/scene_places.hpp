#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/job/input/read_elevation.hpp"
#include "scenes/job/input/read_height.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The keys of one place: metres from the site, or as in maps. ("place_m", "place")
struct PlaceKeys {
    const char* metres;
    const char* mapped;
};

/// Converts places of a scene file to east, north [m] of its site. A file may give each of them so,
/// or as `place = [latitude, longitude]` (WGS84), or in the coordinate reference system named by
/// `place_crs` in the same table, else in [site]: [latitude, longitude] of a geographic one,
/// [easting, northing] of a projected one.
///
/// An object at a latitude and longitude is on the geodetic vertical through it: its east and north
/// are those at its own height, which far from the site differ from those of the ground below (1.3
/// m for 1000 m of height 8 km away). So the elevation is read for the first such place, and only
/// then. Agrees with GeographicLib to 2 mm (tests/scenes/mapped_places_test.cpp); PROJ's
/// transformation between datums may be less accurate.
class ScenePlaces {
 public:
    /// - site, terrain: sections of the file, for their mistakes
    /// - elevation: as given in [terrain]
    ScenePlaces(const Section& site, const Section& terrain, std::optional<Site> origin,
                ElevationInput elevation);

    /// From one key or the other; a mistake if it has neither or both.
    Eigen::Vector2d one(const Section& section, const PlaceKeys& keys, const char* says,
                        const HeightInput& height = {}) const;
    /// From the first two numbers of rows under a key such as `ring`, on the ground. Invalid rows
    /// are reported and replaced by the site.
    std::vector<Eigen::Vector2d> all(const Section& section, const char* mapped,
                                     const std::vector<std::vector<double>>& rows) const;
    /// The same as latitudes and longitudes; NaN for invalid rows.
    std::vector<Geodetic> geodetic(const Section& section, const char* mapped,
                                   const std::vector<std::vector<double>>& rows) const;
    /// From a latitude and longitude, such as one in
    /// a file named under `key`; its height is
    /// ignored.
    Eigen::Vector2d at(const Section& section, const char* key, const Geodetic& place,
                       const HeightInput& height = {}) const;

    /// The elevation read for them; null if no place needed it.
    std::shared_ptr<const Dem> elevation() const;

 private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace diurna
