#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// The triangles of a file of temperatures, and their names.
struct TemperatureMesh {
    /// In the file's order; areas, centroids and normals are computed from the triangles. Materials
    /// and objects are 0 if the file names none.
    FacetSet facets;
    std::vector<std::string> materials;  // (MaterialId) as written, with CF's "_"
    std::vector<std::string> objects;    // (ObjectId) the same, the ground first
    Site site;                           // origin of the frame; without refraction
    double utc_offset = 0.0;             // [s] that the scene's clock is ahead of UTC
};

/// Reads the mesh of a file of save_temperature_field (thermal/temperature_field.hpp). Throws
/// InputError, one line, if the file is missing, has another format, or holds invalid corners,
/// material numbers or positions.
TemperatureMesh load_temperature_mesh(const std::filesystem::path& file);

/// The title attribute of a netCDF file, "" without one or if it is no netCDF file.
std::string netcdf_title(const std::filesystem::path& file);

/// FieldNotes::made_of of a file of temperatures, "" without it.
std::string temperatures_made_of(const std::filesystem::path& file);

}  // namespace diurna
