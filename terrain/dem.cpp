#include "terrain/dem.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "materials/error.hpp"
#include "terrain/ascii_grid.hpp"
#include "terrain/dem_voids.hpp"

namespace diurna {

namespace {

constexpr double lowest = -12e3, highest = 10e3;  // heights on Earth [m], with some room
constexpr double most_posts = 5e8;
constexpr double best_compression = 1100.0;  // DEFLATE cannot do better than 1032 : 1

const char* const allowed_drivers[] = {"GTiff",   "DTED", "SRTMHGT", "USGSDEM",
                                       "AAIGrid", "ENVI", "netCDF",  nullptr};

/// Keeps GDAL's messages off the terminal and remembers the first, for our own.
class QuietGdal {
 public:
    QuietGdal() {
        static std::once_flag once;
        std::call_once(once, [] { GDALAllRegister(); });
        CPLPushErrorHandlerEx(remember, &first_);
    }
    ~QuietGdal() { CPLPopErrorHandler(); }
    QuietGdal(const QuietGdal&) = delete;
    QuietGdal& operator=(const QuietGdal&) = delete;

    std::string because() const { return first_.empty() ? "" : ": " + first_; }

 private:
    static void CPL_STDCALL remember(CPLErr level, CPLErrorNum, const char* message) {
        auto* first = static_cast<std::string*>(CPLGetErrorHandlerUserData());
        if (level < CE_Failure || !first->empty()) return;
        *first = message;
        std::replace(first->begin(), first->end(), '\n', ' ');
    }
    std::string first_;
};

/// An absolute path, so that no name is ever taken for one of GDAL's connection strings.
std::string gdal_name(const std::filesystem::path& file) {
    const std::string path = std::filesystem::absolute(file).lexically_normal().string();
    const bool zipped_hgt = path.ends_with(".hgt.zip") || path.ends_with(".HGT.zip");
    return zipped_hgt ? "/vsizip/" + path + "/" + file.stem().string() : path;
}

GDALDatasetUniquePtr open(const std::string& name) {
    return GDALDatasetUniquePtr(
        GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, allowed_drivers));
}

/// A netCDF file with several variables has no bands of its own: take the one that is named like
/// an elevation.
GDALDatasetUniquePtr open_elevation_variable(GDALDataset& file, const std::string& where) {
    const std::vector<std::string> wanted{
        "dem",  "elevation", "height",           "altitude",  "z",  "topo",
        "elev", "Band1",     "surface_altitude", "orography", "HGT"};
    CSLConstList list = file.GetMetadata("SUBDATASETS");
    std::string offered;
    for (int i = 1;
         const char* name = CSLFetchNameValue(list, fmt::format("SUBDATASET_{}_NAME", i).c_str());
         ++i) {
        const std::string full = name;
        const std::string variable = full.substr(full.find_last_of(":/") + 1);
        if (std::find(wanted.begin(), wanted.end(), variable) != wanted.end()) return open(full);
        offered += (offered.empty() ? "" : ", ") + variable;
    }
    throw InputError(where, "holds no elevation that can be told by its name",
                     offered.empty() ? "" : "variables: " + offered);
}

GDALDatasetUniquePtr open_raster(const std::filesystem::path& file, const QuietGdal& gdal) {
    const std::string where = file.string();
    std::error_code problem;
    const auto status = std::filesystem::status(file, problem);
    if (!std::filesystem::exists(status)) throw InputError(where, "there is no such file");
    if (!std::filesystem::is_regular_file(status)) {
        throw InputError(where, "is not a file; expected an elevation raster");
    }
    if (std::filesystem::file_size(file, problem) == 0) throw InputError(where, "is empty");
    auto raster = open(gdal_name(file));
    if (!raster) {
        throw InputError(where, "cannot be read as elevation" + gdal.because(),
                         "known formats: GeoTIFF, DTED, SRTM HGT, USGS DEM, ESRI ASCII, ENVI, "
                         "netCDF");
    }
    if (raster->GetRasterCount() == 0) raster = open_elevation_variable(*raster, where);
    if (!raster || raster->GetRasterCount() == 0) {
        throw InputError(where, "holds no raster band" + gdal.because());
    }
    return raster;
}

void check_size(GDALDataset& raster, const std::filesystem::path& file) {
    const int columns = raster.GetRasterXSize(), rows = raster.GetRasterYSize();
    const std::string where = file.string();
    if (columns < 2 || rows < 2) {
        throw InputError(
            where, fmt::format("has {} x {} posts; a surface needs at least 2 x 2", columns, rows));
    }
    const double posts = double(columns) * rows;
    if (posts > most_posts) {
        throw InputError(where, fmt::format("has {} x {} posts; at most {:.0f} million are read",
                                            columns, rows, most_posts / 1e6));
    }
    const int post_bytes = GDALGetDataTypeSizeBytes(raster.GetRasterBand(1)->GetRasterDataType());
    std::error_code problem;
    const double bytes = static_cast<double>(std::filesystem::file_size(file, problem));
    if (posts * post_bytes > bytes * best_compression) {
        throw InputError(where, fmt::format("claims {} x {} posts but has only {:.0f} bytes",
                                            columns, rows, bytes));
    }
}

/// Our CRS objects take longitude before latitude, easting before northing, whatever EPSG says.
OGRSpatialReference reference_of(const std::string& wkt) {
    OGRSpatialReference reference;
    // A WKT or a name such as EPSG:32611; never a file or an address.
    reference.SetFromUserInput(wkt.c_str(),
                               OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

bool same_reference(const Dem& a, const Dem& b) {
    const OGRSpatialReference first = reference_of(a.crs_wkt), second = reference_of(b.crs_wkt);
    return a.crs_wkt == b.crs_wkt || first.IsSame(&second);
}

/// CRS of a raster to WGS84 longitude, latitude and back; made once per CRS and thread.
struct Projection {
    std::string wkt;
    bool geographic = false;
    std::unique_ptr<OGRCoordinateTransformation> to_geodetic, from_geodetic;
};

const Projection& projection_of(const Dem& dem) {
    thread_local Projection last;
    if (last.wkt == dem.crs_wkt && last.to_geodetic) return last;
    OGRSpatialReference reference = reference_of(dem.crs_wkt);
    OGRSpatialReference wgs84;
    wgs84.SetWellKnownGeogCS("WGS84");
    wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    last.to_geodetic.reset(OGRCreateCoordinateTransformation(&reference, &wgs84));
    last.from_geodetic.reset(OGRCreateCoordinateTransformation(&wgs84, &reference));
    last.geographic = reference.IsGeographic();
    if (!last.to_geodetic || !last.from_geodetic) {
        throw InputError(dem.source,
                         "its coordinate reference system cannot be brought to latitude and "
                         "longitude");
    }
    last.wkt = dem.crs_wkt;
    return last;
}

void read_georeference(GDALDataset& raster, Dem& dem) {
    if (raster.GetGeoTransform(dem.transform.data()) != CE_None) {
        throw InputError(dem.source, "has no georeference: the place of its posts is not known");
    }
    const auto& t = dem.transform;
    const bool finite = std::all_of(t.begin(), t.end(), [](double x) { return std::isfinite(x); });
    const double cell = t[1] * t[5] - t[2] * t[4];
    const double shape = std::max({std::abs(t[1]), std::abs(t[2]), std::abs(t[4]), std::abs(t[5])});
    if (!finite || std::abs(cell) <= 1e-12 * shape * shape) {
        throw InputError(dem.source,
                         fmt::format("its georeference is singular (cell {} x {})", t[1], t[5]));
    }
    const bool ascii = std::string_view(raster.GetDriverName()) == "AAIGrid";
    if (ascii && t[1] < 0.0) {
        throw InputError(dem.source,
                         fmt::format("found a cell size of {}; expected more than 0", t[1]));
    }
    const OGRSpatialReference* reference = raster.GetSpatialRef();
    if (!reference || reference->IsEmpty() || reference->IsLocal()) {
        throw InputError(dem.source, "names no coordinate reference system",
                         "gdal_translate -a_srs EPSG:... writes one");
    }
    char* wkt = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    reference->exportToWkt(&wkt, options);
    dem.crs_wkt = wkt ? wkt : "";
    CPLFree(wkt);
}

/// The corners must be places on Earth: HGT and hand-made headers can say 91° north.
void check_corners(const Dem& dem) {
    const double right = dem.columns - 1, bottom = dem.rows - 1;
    const Eigen::Vector2d corners[] = {{0, 0}, {right, 0}, {0, bottom}, {right, bottom}};
    const float heights[4] = {};
    for (const Geodetic& place : geodetic_places(dem, corners, heights)) {
        if (!std::isfinite(place.longitude_deg) || !(std::abs(place.latitude_deg) <= 90.0) ||
            std::abs(place.longitude_deg) > 540.0) {
            throw InputError(dem.source, "its georeference puts it outside the Earth");
        }
    }
}

/// Says how far the raster's datum lies from WGS84, if PROJ does not know the way: it then takes
/// latitude and longitude as they are.
void note_datum(Dem& dem) {
    const OGRSpatialReference reference = reference_of(dem.crs_wkt);
    std::unique_ptr<OGRSpatialReference> own(reference.CloneGeogCS());
    if (!own) return;
    own->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const char* name = own->GetAttrValue("DATUM");
    const std::string datum = name ? name : "unknown datum";
    for (const char* near : {"WGS", "World Geodetic", "North_American_Datum_1983",
                             "North American "
                             "Datum 1983",
                             "ETRS", "European Terrestrial", "NZGD2000", "GDA", "SWEREF",
                             "Greek Geodetic Reference System 1987"}) {
        if (datum.find(near) != std::string::npos) return;
    }
    OGRSpatialReference wgs84;
    wgs84.SetWellKnownGeogCS("WGS84");
    wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const QuietGdal gdal;
    const std::unique_ptr<OGRCoordinateTransformation> shift(
        OGRCreateCoordinateTransformation(own.get(), &wgs84));
    const Geodetic centre =
        geodetic_places(dem, std::vector<Eigen::Vector2d>{{0.0, 0.0}}, std::vector<float>{0.0f})
            .front();
    double x = centre.longitude_deg, y = centre.latitude_deg;
    if (!shift || !shift->Transform(1, &x, &y)) return;
    const Site here{centre.latitude_deg, centre.longitude_deg, 0.0};
    const double metres = to_local(here, Geodetic{y, x, 0.0}).head<2>().norm();
    dem.notes.push_back(
        metres < 0.01
            ? fmt::format("{}: no shift from {} to WGS84 is known, its latitudes and longitudes "
                          "are taken as they are: places may be off by 200 m",
                          dem.source, datum)
            : fmt::format("{}: {} is brought to WGS84 by a shift of {:.0f} m, good to a few metres",
                          dem.source, datum, metres));
}

struct Window {
    int column, row, columns, rows;
};

/// Posts from one before to one after the circle of the options.
Window window_of(const Dem& dem, const DemOptions& options) {
    if (!options.centre) return {0, 0, dem.columns, dem.rows};
    const Site site{options.centre->latitude_deg, options.centre->longitude_deg, 0.0};
    std::vector<Geodetic> circle;
    for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 15) {
        circle.push_back(to_geodetic(site, options.radius * direction(azimuth_deg, 0.0)));
    }
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Vector2d high = -low;
    for (const Eigen::Vector2d& place : raster_places(dem, circle)) {
        low = low.cwiseMin(place);
        high = high.cwiseMax(place);
    }
    const auto clip = [](double x, int count) {
        return static_cast<int>(std::clamp(x, 0.0, count - 1.0));
    };
    const int first_column = clip(std::floor(low.x()) - 1.0, dem.columns);
    const int first_row = clip(std::floor(low.y()) - 1.0, dem.rows);
    const int last_column = clip(std::ceil(high.x()) + 1.0, dem.columns);
    const int last_row = clip(std::ceil(high.y()) + 1.0, dem.rows);
    if (!low.allFinite() || !high.allFinite() || last_column - first_column < 1 ||
        last_row - first_row < 1) {
        throw InputError(dem.source, fmt::format("does not reach the place {:.5f}, {:.5f}",
                                                 site.latitude_deg, site.longitude_deg));
    }
    return {first_column, first_row, last_column - first_column + 1, last_row - first_row + 1};
}

double metres_per_unit(GDALRasterBand& band, const DemOptions& options) {
    if (options.unit) return *options.unit;
    const std::string unit = band.GetUnitType();
    if (unit == "ft" || unit == "foot" || unit == "feet") return 0.3048;
    if (unit == "US survey foot" || unit == "ftUS") return 1200.0 / 3937.0;
    if (unit == "cm" || unit == "centimetre") return 0.01;
    if (unit == "dm") return 0.1;
    return 1.0;
}

void read_heights(GDALDataset& raster, const Window& window, const DemOptions& options, Dem& dem,
                  const QuietGdal& gdal) {
    GDALRasterBand& band = *raster.GetRasterBand(1);
    dem.height.resize(std::size_t(window.columns) * window.rows);
    if (band.RasterIO(GF_Read, window.column, window.row, window.columns, window.rows,
                      dem.height.data(), window.columns, window.rows, GDT_Float32, 0,
                      0) != CE_None) {
        throw InputError(dem.source, "is damaged" + gdal.because());
    }
    int declared = 0;
    const auto nodata = static_cast<float>(band.GetNoDataValue(&declared));
    const double unit = metres_per_unit(band, options);
    const double scale = band.GetScale() * unit, offset = band.GetOffset() * unit;
    for (float& height : dem.height) {
        const bool is_void = !std::isfinite(height) || (declared && height == nodata) ||
                             height == -32768.0f || height == -32767.0f || height == 32767.0f ||
                             height == -9999.0f || scale * height + offset < lowest;
        if (is_void) {
            height = std::numeric_limits<float>::quiet_NaN();
        } else {
            height = static_cast<float>(scale * height + offset);
            if (height > highest) {
                throw InputError(dem.source,
                                 fmt::format("found a height of {:.0f} m; nothing on Earth is so "
                                             "high",
                                             height),
                                 "say which unit its heights have");
            }
        }
    }
}

/// Turns a raster over that is stored south first.
void put_north_first(Dem& dem) {
    auto& t = dem.transform;
    if (t[1] * t[5] - t[2] * t[4] < 0.0) return;
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

void apply_void_policy(Dem& dem, VoidPolicy policy) {
    dem.voids = static_cast<std::size_t>(
        std::count_if(dem.height.begin(), dem.height.end(), [](float h) { return std::isnan(h); }));
    if (dem.voids == dem.height.size()) {
        throw InputError(dem.source, "has no elevation at all: every post is void");
    }
    if (dem.voids > 0) {
        dem.is_void.resize(dem.height.size());
        std::transform(dem.height.begin(), dem.height.end(), dem.is_void.begin(),
                       [](float h) { return std::uint8_t{std::isnan(h)}; });
    }
    if (dem.voids == 0 || policy == VoidPolicy::leave) return;
    if (policy == VoidPolicy::refuse) {
        const double percent = 100.0 * double(dem.voids) / double(dem.height.size());
        throw InputError(dem.source,
                         fmt::format("{} posts ({:.2g} %) have no elevation", dem.voids, percent),
                         "let voids be filled");
    }
    fill_voids(dem.columns, dem.rows, dem.height);
}

/// The heights of a file, its window alone, voids as NaN.
Dem read_tile(const std::filesystem::path& file, const DemOptions& options, bool whole) {
    const QuietGdal gdal;
    const auto raster = open_raster(file, gdal);
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

    const Window window = whole ? Window{0, 0, dem.columns, dem.rows} : window_of(dem, options);
    auto& t = dem.transform;
    t[0] += t[1] * window.column + t[2] * window.row;
    t[3] += t[4] * window.column + t[5] * window.row;
    dem.columns = window.columns;
    dem.rows = window.rows;
    read_heights(*raster, window, options, dem, gdal);
    put_north_first(dem);
    note_datum(dem);
    return dem;
}

void crop(Dem& dem, const Window& window) {
    std::vector<float> kept;
    kept.reserve(std::size_t(window.columns) * window.rows);
    for (int row = 0; row < window.rows; ++row) {
        const auto from =
            dem.height.begin() + window.column + std::ptrdiff_t(row + window.row) * dem.columns;
        kept.insert(kept.end(), from, from + window.columns);
    }
    auto& t = dem.transform;
    t[0] += t[1] * window.column + t[2] * window.row;
    t[3] += t[4] * window.column + t[5] * window.row;
    dem.columns = window.columns;
    dem.rows = window.rows;
    dem.height = std::move(kept);
}

/// Where a tile's first post lies on the lattice of another.
std::array<int, 2> lattice_place(const Dem& tile, const Dem& first) {
    const auto &a = first.transform, &b = tile.transform;
    const double cell = std::sqrt(std::abs(a[1] * a[5] - a[2] * a[4]));
    bool same = same_reference(tile, first);
    for (const int k : {1, 2, 4, 5}) same = same && std::abs(a[k] - b[k]) < 1e-5 * cell;
    if (!same) {
        throw InputError(tile.source, fmt::format("has another grid than {}", first.source),
                         "bring tiles to one CRS and spacing, for example by gdalwarp");
    }
    double dx = b[0] - a[0];
    const double dy = b[3] - a[3], whole = a[1] * a[5] - a[2] * a[4];
    if (projection_of(first).geographic) dx -= 360.0 * std::round(dx / 360.0);
    const double column = (a[5] * dx - a[2] * dy) / whole, row = (a[1] * dy - a[4] * dx) / whole;
    if (!(std::abs(column) < 1e6 && std::abs(row) < 1e6) ||
        std::abs(column - std::round(column)) > 0.01 || std::abs(row - std::round(row)) > 0.01) {
        throw InputError(tile.source,
                         fmt::format("its posts lie between those of {}", first.source));
    }
    return {static_cast<int>(std::round(column)), static_cast<int>(std::round(row))};
}

Dem joined(std::vector<Dem> tiles) {
    std::vector<std::array<int, 2>> place;
    std::array<int, 2> low{0, 0}, high{0, 0};
    for (const Dem& tile : tiles) {
        place.push_back(lattice_place(tile, tiles.front()));
        const int last[] = {place.back()[0] + tile.columns, place.back()[1] + tile.rows};
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], place.back()[k]);
            high[k] = std::max(high[k], last[k]);
        }
    }
    Dem dem;
    dem.source = tiles.front().source;
    dem.crs_wkt = tiles.front().crs_wkt;
    dem.transform = tiles.front().transform;
    auto& t = dem.transform;
    t[0] += t[1] * low[0] + t[2] * low[1];
    t[3] += t[4] * low[0] + t[5] * low[1];
    dem.columns = high[0] - low[0];
    dem.rows = high[1] - low[1];
    if (double(dem.columns) * dem.rows > most_posts) {
        throw InputError(dem.source, fmt::format("its tiles span {} x {} posts; at most {:.0f} "
                                                 "million are held",
                                                 dem.columns, dem.rows, most_posts / 1e6));
    }
    dem.height.assign(std::size_t(dem.columns) * dem.rows, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        Dem& tile = tiles[i];
        std::size_t differing = 0;
        float worst = 0.0f;
        for (int row = 0; row < tile.rows; ++row) {
            float* to = dem.height.data() + std::size_t(row + place[i][1] - low[1]) * dem.columns +
                        std::size_t(place[i][0] - low[0]);
            for (int column = 0; column < tile.columns; ++column) {
                const float h = tile.at(row, column);
                if (std::isnan(to[column])) {
                    to[column] = h;
                } else if (std::abs(h - to[column]) > 1.0f) {
                    ++differing;
                    worst = std::max(worst, std::abs(h - to[column]));
                }
            }
        }
        dem.notes.insert(dem.notes.end(), tile.notes.begin(), tile.notes.end());
        if (differing > 0) {
            dem.notes.push_back(
                fmt::format("{}: {} posts shared with other tiles differ, by up to "
                            "{:.1f} m; the first tile's are taken",
                            tile.source, differing, worst));
        }
        tile.height = {};
    }
    return dem;
}

/// EGM96 added at a lattice of posts about 1 km apart, bilinear between.
void add_geoid(Dem& dem) {
    const Eigen::Vector2d spacing = post_spacing(dem);
    const int step = std::clamp(static_cast<int>(1000.0 / spacing.minCoeff()), 1, 64);
    const int columns = (dem.columns - 1) / step + 2, rows = (dem.rows - 1) / step + 2;
    std::vector<Eigen::Vector2d> node;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) node.emplace_back(x * step, y * step);
    }
    const std::vector<float> level(node.size(), 0.0f);
    const std::vector<double> geoid = geoid_heights(geodetic_places(dem, node, level));
    for (int row = 0; row < dem.rows; ++row) {
        for (int column = 0; column < dem.columns; ++column) {
            const double u = double(column % step) / step, v = double(row % step) / step;
            const double* a = geoid.data() + std::size_t(row / step) * columns + column / step;
            const double* b = a + columns;
            dem.height[std::size_t(row) * dem.columns + column] += static_cast<float>(
                (1 - v) * ((1 - u) * a[0] + u * a[1]) + v * ((1 - u) * b[0] + u * b[1]));
        }
    }
}

Dem finished(Dem dem, const DemOptions& options) {
    apply_void_policy(dem, options.voids);
    if (options.geoid) add_geoid(dem);
    return dem;
}

}  // namespace

Dem read_dem(const std::filesystem::path& file, const DemOptions& options) {
    return finished(read_tile(file, options, false), options);
}

Dem read_dem(std::span<const std::filesystem::path> files, const DemOptions& options) {
    if (files.empty()) throw InputError("elevation", "names no file");
    if (files.size() == 1) return read_dem(files.front(), options);
    std::vector<Dem> tiles;
    for (const auto& file : files) tiles.push_back(read_tile(file, options, true));
    Dem dem = joined(std::move(tiles));
    crop(dem, window_of(dem, options));
    return finished(std::move(dem), options);
}

std::vector<double> geoid_heights(std::span<const Geodetic> places) {
    const QuietGdal gdal;
    OGRSpatialReference above_sea = reference_of("EPSG:4326+5773");
    OGRSpatialReference above_ellipsoid = reference_of("EPSG:4979");
    const std::unique_ptr<OGRCoordinateTransformation> shift(
        OGRCreateCoordinateTransformation(&above_sea, &above_ellipsoid));
    if (!shift) throw InputError("EGM96", "PROJ knows no way from it to the ellipsoid");
    std::vector<double> x, y, z(places.size(), 0.0);
    for (const Geodetic& place : places) {
        x.push_back(place.longitude_deg);
        y.push_back(place.latitude_deg);
    }
    std::vector<int> good(places.size(), 1);
    shift->Transform(static_cast<int>(places.size()), x.data(), y.data(), z.data(), good.data());
    // Without the grid PROJ would leave every height as it is.
    if (!places.empty() && (std::find(good.begin(), good.end(), 0) != good.end() ||
                            std::all_of(z.begin(), z.end(), [](double h) { return h == 0.0; }))) {
        throw InputError("EGM96", "PROJ has not got the grid egm96_15 for these places",
                         "apt install proj-data");
    }
    return z;
}

std::vector<Geodetic> geodetic_places(const Dem& dem, std::span<const Eigen::Vector2d> place,
                                      std::span<const float> height) {
    const QuietGdal gdal;
    const auto& t = dem.transform;
    std::vector<double> x(place.size()), y(place.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        const Eigen::Vector2d corner = place[i].array() + 0.5;  // posts are pixel centres
        x[i] = t[0] + t[1] * corner.x() + t[2] * corner.y();
        y[i] = t[3] + t[4] * corner.x() + t[5] * corner.y();
    }
    std::vector<int> good(place.size(), 1);
    projection_of(dem).to_geodetic->Transform(static_cast<int>(place.size()), x.data(), y.data(),
                                              nullptr, good.data());
    std::vector<Geodetic> geodetic(place.size());
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < place.size(); ++i) {
        geodetic[i] = {good[i] ? y[i] : unknown, good[i] ? x[i] : unknown, height[i]};
    }
    return geodetic;
}

std::vector<Eigen::Vector2d> raster_places(const Dem& dem, std::span<const Geodetic> places) {
    const QuietGdal gdal;
    const Projection& projection = projection_of(dem);
    std::vector<double> x(places.size()), y(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        x[i] = places[i].longitude_deg;
        y[i] = places[i].latitude_deg;
    }
    std::vector<int> good(places.size(), 1);
    projection.from_geodetic->Transform(static_cast<int>(places.size()), x.data(), y.data(),
                                        nullptr, good.data());
    const auto& t = dem.transform;
    const double cell = t[1] * t[5] - t[2] * t[4];
    const double middle = t[0] + 0.5 * (t[1] * dem.columns + t[2] * dem.rows);
    std::vector<Eigen::Vector2d> raster(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!good[i]) {
            raster[i].setConstant(std::numeric_limits<double>::quiet_NaN());
            continue;
        }
        // Across the date line the same meridian has two numbers: take the one near the raster.
        if (projection.geographic) x[i] += 360.0 * std::round((middle - x[i]) / 360.0);
        const double dx = x[i] - t[0], dy = y[i] - t[3];
        raster[i] = {(t[5] * dx - t[2] * dy) / cell - 0.5, (t[1] * dy - t[4] * dx) / cell - 0.5};
    }
    return raster;
}

}  // namespace diurna
