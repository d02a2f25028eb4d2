#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/input/read_elevation.hpp"
#include "scenes/input/read_height.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// The keys of one place: metres of the site, or as a map has it. ("place_m", "place")
struct PlaceKeys {
    const char* metres;
    const char* mapped;
};

/// Places of a scene file as east, north [m] of its site. A file may give each of them so, or as
/// `place = [latitude, longitude]` (WGS84), or in the coordinate reference system that `place_crs`
/// names in the same table, else in [site]: [latitude, longitude] of a geographic one, [easting,
/// northing] of a projected one.
///
/// What stands at a latitude and longitude stands on the geodetic vertical through it: its east and
/// north are those of its own height, which far from the site differ from those of the ground below
/// (1.3 m for 1000 m of height 8 km away). So the elevation is read for the first such place, and
/// only then. GeographicLib has them within 2 mm (tests/scenes/mapped_places_test.cpp); PROJ's way
/// between datums may leave more.
class ScenePlaces {
 public:
    /// - site, terrain: sections of the file, for the mistakes that are theirs
    /// - elevation: what [terrain] says of it
    ScenePlaces(const Section& site, const Section& terrain, std::optional<Site> origin,
                ElevationInput elevation);

    /// Of one key or the other; a mistake where it has neither or both.
    Eigen::Vector2d one(const Section& section, const PlaceKeys& keys, const char* says,
                        const HeightInput& height = {}) const;
    /// Of the first two numbers of rows under a key such as `ring`, on the ground. Rows that are no
    /// places are reported and become the site's.
    std::vector<Eigen::Vector2d> all(const Section& section, const char* mapped,
                                     const std::vector<std::vector<double>>& rows) const;
    /// The same as latitudes and longitudes; NaN where rows are no places.
    std::vector<Geodetic> geodetic(const Section& section, const char* mapped,
                                   const std::vector<std::vector<double>>& rows) const;
    /// Of a latitude and longitude, such as one of a file named under `key`, whose own height does
    /// not count.
    Eigen::Vector2d at(const Section& section, const char* key, const Geodetic& place,
                       const HeightInput& height = {}) const;

    /// That was read for them; null where no place asked for it.
    std::shared_ptr<const Dem> elevation() const;

 private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace diurna
