#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// The triangles of a file of temperatures, and what it calls them.
struct TemperatureMesh {
    /// In the file's order; areas, centroids and normals are of the triangles. Materials and
    /// objects are 0 where the file names none.
    FacetSet facets;
    std::vector<std::string> materials;  // (MaterialId) as written: "_" for what CF does not allow
    std::vector<std::string> objects;    // (ObjectId) likewise, the ground first
    Site site;                           // origin of the frame; without refraction
    double utc_offset = 0.0;             // [s] that the scene's clock is ahead of UTC
};

/// Reads the mesh of what save_temperature_field (thermal/temperature_field.hpp) wrote. Throws
/// InputError, one line, if the file is missing, is no such file, or holds corners, numbers of
/// materials or places that cannot be.
TemperatureMesh load_temperature_mesh(const std::filesystem::path& file);

/// The title that a netCDF file gives itself, "" where it has none or is no netCDF file.
std::string netcdf_title(const std::filesystem::path& file);

/// FieldNotes::made_of of a file of temperatures, "" where it has none.
std::string temperatures_made_of(const std::filesystem::path& file);

}  // namespace diurna
