#include "terrain/raster/dem_file.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "materials/base/hdf5_file.hpp"
#include "terrain/raster/ascii_grid.hpp"
#include "terrain/raster/crs.hpp"
#include "terrain/raster/dem_heights.hpp"
#include "terrain/raster/dem_notes.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/dem_window.hpp"
#include "terrain/raster/gdal_file.hpp"
#include "terrain/raster/geotransform.hpp"
#include "terrain/raster/quiet_gdal.hpp"
#include "terrain/raster/raster_names.hpp"
#include "terrain/raster/raster_reference.hpp"
#include "terrain/raster/zip_archive.hpp"

namespace diurna {

namespace {

GDALDatasetUniquePtr open(const std::string& name) {
    return GDALDatasetUniquePtr(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY,
                                                  gdal_drivers(GdalUse::elevation).data()));
}

/// A netCDF file with several variables has no bands of its own: take the one that is named like
/// an elevation.
GDALDatasetUniquePtr open_elevation_variable(GDALDataset& file, const std::string& where) {
    const std::vector<std::string> wanted{
        "dem",        "elevation", "height", "altitude",         "z",           "topo",
        "topography", "elev",      "band1",  "surface_altitude", "hgt",         "orography",
        "orog",       "terrain",   "hsurf",  "surface_height",   "geopotential"};
    CSLConstList list = file.GetMetadata("SUBDATASETS");
    std::string offered;
    for (int i = 1;
         const char* name = CSLFetchNameValue(list, fmt::format("SUBDATASET_{}_NAME", i).c_str());
         ++i) {
        const std::string full = name;
        const std::string variable = full.substr(full.find_last_of(":/") + 1);
        const std::string small = small_letters(variable);
        if (std::find(wanted.begin(), wanted.end(), small) != wanted.end()) return open(full);
        offered += (offered.empty() ? "" : ", ") + variable;
    }
    throw InputError(where,
                     "has several variables, none with a usual name of elevation" +
                         (offered.empty() ? "" : ": " + offered),
                     "gdal_translate NETCDF:" + where + ":NAME elevation.tif extracts one");
}

GDALDatasetUniquePtr open_raster(const std::filesystem::path& file, const QuietGdal& gdal,
                                 const GdalGate& gate) {
    const std::string where = file.string();
    std::error_code problem;
    const auto status = std::filesystem::status(file, problem);
    if (!std::filesystem::exists(status)) throw InputError(where, "the file does not exist");
    if (!std::filesystem::is_regular_file(status)) {
        throw InputError(where, "is not a file, expected an elevation raster");
    }
    if (std::filesystem::file_size(file, problem) == 0) throw InputError(where, "is empty");
    note_file_read(file);
    check_values_are_its_own(file);
    auto raster = open(gdal_raster_name(file));
    gate.check();
    if (!raster) {
        throw InputError(where, "cannot be read as elevation" + gdal.because(),
                         unread_hint(file, gdal_advice(GdalUse::elevation)));
    }
    if (raster->GetRasterCount() == 0) raster = open_elevation_variable(*raster, where);
    if (!raster || raster->GetRasterCount() == 0) {
        throw InputError(where, "has no raster band" + gdal.because());
    }
    look_beside(*raster, gate);
    check_bands(*raster, where);
    return raster;
}

void check_size(GDALDataset& raster, const std::filesystem::path& file) {
    const int columns = raster.GetRasterXSize(), rows = raster.GetRasterYSize();
    const std::string where = file.string();
    if (columns < 2 || rows < 2) {
        throw InputError(where,
                         fmt::format("has {} x {} posts, expected at least 2 x 2", columns, rows));
    }
    const double posts = double(columns) * rows;
    if (posts > most_posts) {
        throw InputError(where, fmt::format("has {} x {} posts, expected at most {:.0f} million",
                                            columns, rows, most_posts / 1e6));
    }
    const int post_bytes = GDALGetDataTypeSizeBytes(raster.GetRasterBand(1)->GetRasterDataType());
    std::error_code problem;
    const auto bytes = std::filesystem::file_size(file, problem);
    // GDAL reads zeros where such a file, which is as it is in memory, ends too soon.
    const auto reported = [&](const char* key) {
        const char* text = raster.GetMetadataItem(key, "ENVI");
        return text != nullptr ? std::atof(text) : 0.0;
    };
    const double whole = posts * post_bytes * raster.GetRasterCount() + reported("header_offset");
    const bool raw =
        std::string_view(raster.GetDriverName()) == "ENVI" && reported("file_compression") == 0.0;
    if (raw && whole > double(bytes)) {
        throw InputError(where,
                         fmt::format("has {} bytes, but its header declares {:.0f}", bytes, whole),
                         "copy the file again");
    }
    if (claims_too_much(posts * post_bytes, file)) {
        throw InputError(where,
                         fmt::format("declares {} x {} posts, but has only {} bytes", columns, rows,
                                     std::filesystem::file_size(file, problem)));
    }
}

void read_georeference(GDALDataset& raster, Dem& dem) {
    if (raster.GetGeoTransform(dem.transform.data()) != CE_None) {
        throw InputError(dem.source, "has no georeference, so the place of its posts is unknown");
    }
    const auto& t = dem.transform;
    const bool finite = std::all_of(t.begin(), t.end(), [](double x) { return std::isfinite(x); });
    const double cell = pixel_area(t);
    const double shape = std::max({std::abs(t[1]), std::abs(t[2]), std::abs(t[4]), std::abs(t[5])});
    if (!finite || std::abs(cell) <= 1e-12 * shape * shape) {
        throw InputError(dem.source,
                         fmt::format("its georeference is singular (cell {} x {})", t[1], t[5]));
    }
    const bool ascii = std::string_view(raster.GetDriverName()) == "AAIGrid";
    if (ascii && t[1] < 0.0) {
        throw InputError(dem.source,
                         fmt::format("found a cell size of {}, expected more than 0", t[1]));
    }
    const auto reference = raster_reference(raster, dem.source);
    if (!reference) {
        throw InputError(
            dem.source, "has no coordinate reference system",
            "gdal_translate -a_srs EPSG:... adds one; ESRI ASCII needs a .prj file beside it");
    }
    dem.crs_wkt = wkt_of(*reference);
}

/// The corners must be places on Earth: HGT and hand-made headers can say 91° north.
void check_corners(const Dem& dem) {
    const double right = dem.columns - 1, bottom = dem.rows - 1;
    const Eigen::Vector2d corners[] = {{0, 0}, {right, 0}, {0, bottom}, {right, bottom}};
    const float heights[4] = {};
    for (const Geodetic& place : geodetic_places(dem, corners, heights)) {
        if (!std::isfinite(place.longitude_deg) || !(std::abs(place.latitude_deg) <= 90.0) ||
            std::abs(place.longitude_deg) > 540.0) {
            throw InputError(dem.source, "its georeference is outside the Earth");
        }
    }
}

/// Turns a raster over that is stored south first.
void put_north_first(Dem& dem) {
    auto& t = dem.transform;
    if (pixel_area(t) < 0.0) return;
    for (int row = 0; row < dem.rows / 2; ++row) {
        const auto upper = dem.height.begin() + std::ptrdiff_t(row) * dem.columns;
        const auto lower = dem.height.begin() + std::ptrdiff_t(dem.rows - 1 - row) * dem.columns;
        std::swap_ranges(upper, upper + dem.columns, lower);
    }
    t[0] += t[2] * dem.rows;
    t[3] += t[5] * dem.rows;
    t[2] = -t[2];
    t[5] = -t[5];
}

}  // namespace

Dem read_tile(const std::filesystem::path& file, const DemOptions& options, bool whole) {
    const QuietGdal gdal;
    const GdalGate gate(options.confines ? *options.confines : confines_of(file));
    const auto raster = open_raster(file, gdal, gate);
    check_size(*raster, file);

    Dem dem;
    dem.source = file.string();
    dem.columns = raster->GetRasterXSize();
    dem.rows = raster->GetRasterYSize();
    read_georeference(*raster, dem);
    check_corners(dem);
    if (std::string_view(raster->GetDriverName()) == "AAIGrid") {
        check_ascii_grid(file, std::size_t(dem.columns) * dem.rows);
    }

    const PostWindow window =
        whole ? PostWindow{0, 0, dem.columns, dem.rows} : window_of(dem, options);
    move_to_window(dem, window);
    read_heights(*raster, window, options, dem, gdal);
    put_north_first(dem);
    note_datum(dem);
    note_zone(dem);
    return dem;
}

}  // namespace diurna
