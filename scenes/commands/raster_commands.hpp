#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "materials/atmosphere/band_model.hpp"

/// The verbs of the command line that need no scene. Each prints its result to stdout and throws
/// InputError for values it cannot use.
namespace diurna {

struct PathArguments {
    std::string profile = "US76";  // or a radiosonde's CSV file
    std::string aerosol = "none";
    double visibility_km = 23.0;
    double co2_ppm = todays_co2_ppm;
    double ground_km = 0.0;  // where the haze begins
    double rain_mm_h = 0.0;
    double height_km = 0.0;   // start of the path, above the sea
    double zenith_deg = 0.0;  // there
    std::optional<double> range_km, to_height_km;
    bool to_ground = false, to_space = false;
    std::optional<double> sun_zenith_deg;  // named: scattered sunlight too
    double azimuth_from_sun_deg = 0.0;     // of the path
    double ground_albedo = 0.2;
    std::vector<std::string> bands;
    std::filesystem::path csv;  // whole spectrum, if named
    std::string modtran;        // absolute path of MODTRAN 5, which then stands in for the model
};
void path_command(const PathArguments& arguments);

struct SunArguments {
    double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
    std::string time;
    std::optional<double> pressure_hPa;
    double temperature_C = 15.0;
};
void sun_command(const SunArguments& arguments);

struct MeshArguments {
    std::filesystem::path dem;
    double tolerance_m = 1.0;
    std::string frame = "enu";  // or grid: (column, row, height) in the raster's own posts
    std::filesystem::path out;  // PLY, if named
};
void mesh_command(const MeshArguments& arguments);

struct VisibilityArguments {
    std::vector<std::filesystem::path> dem;  // tiles of one lattice
    int azimuths = 32;
    std::optional<double> sun_azimuth_deg, sun_elevation_deg;
    std::filesystem::path out;  // GeoTIFF, if named: sky view, then sun fraction
};
/// Sky view (and, for a sun, the lit share) of every post by the march over the raster.
void visibility_command(const VisibilityArguments& arguments);

void column_command(const std::filesystem::path& file, const std::filesystem::path& out);

/// Versions, instruction sets, threads, where data are found.
void doctor_command();

}  // namespace diurna
