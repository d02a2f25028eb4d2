#include "terrain/raster/land_cover.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

constexpr double most_cells = 5e8;
constexpr std::size_t most_corners = 1'000'000;

const char* const raster_drivers[] = {"GTiff", "AAIGrid", "ENVI", "netCDF", nullptr};
const char* const vector_drivers[] = {"GeoJSON", "ESRI Shapefile", "GPKG", nullptr};

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;

/// Keeps GDAL's messages off the terminal.
class QuietGdal {
 public:
    QuietGdal() {
        static std::once_flag once;
        std::call_once(once, [] { GDALAllRegister(); });
        CPLPushErrorHandler(CPLQuietErrorHandler);
    }
    ~QuietGdal() { CPLPopErrorHandler(); }
    QuietGdal(const QuietGdal&) = delete;
    QuietGdal& operator=(const QuietGdal&) = delete;
};

GDALDatasetUniquePtr open(const std::filesystem::path& file, unsigned kind,
                          const char* const* drivers, const char* formats) {
    if (!std::filesystem::is_regular_file(file)) {
        throw InputError(file.string(), "there is no such file");
    }
    const std::string name = std::filesystem::absolute(file).lexically_normal().string();
    GDALDatasetUniquePtr data(GDALDataset::Open(name.c_str(), kind | GDAL_OF_READONLY, drivers));
    if (!data) throw InputError(file.string(), "cannot be read", formats);
    return data;
}

OGRSpatialReference wgs84() {
    OGRSpatialReference reference;
    reference.SetWellKnownGeogCS("WGS84");
    reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return reference;
}

std::vector<Geodetic> corners_of(const OGRLineString& line, OGRCoordinateTransformation* shift) {
    std::vector<double> x, y;
    for (int i = 0; i < line.getNumPoints(); ++i) {
        x.push_back(line.getX(i));
        y.push_back(line.getY(i));
    }
    std::vector<int> good(x.size(), 1);
    if (shift && !x.empty()) {
        shift->Transform(static_cast<int>(x.size()), x.data(), y.data(), nullptr, good.data());
    }
    std::vector<Geodetic> corners;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (good[i] && std::isfinite(x[i]) && std::abs(y[i]) <= 90.0) {
            corners.push_back({y[i], x[i], 0.0});
        }
    }
    return corners;
}

std::vector<Geodetic> ring_of(const OGRLineString& line, OGRCoordinateTransformation* shift) {
    auto ring = corners_of(line, shift);
    if (ring.size() > 1 && ring.front().latitude_deg == ring.back().latitude_deg &&
        ring.front().longitude_deg == ring.back().longitude_deg) {
        ring.pop_back();
    }
    return ring;
}

/// Appends the polygons and lines of a geometry, however nested.
void append(std::vector<LandShape>& shapes, const OGRGeometry& geometry, const LandShape& like,
            OGRCoordinateTransformation* shift) {
    switch (wkbFlatten(geometry.getGeometryType())) {
        case wkbPolygon: {
            const OGRPolygon& polygon = *geometry.toPolygon();
            LandShape shape = like;
            if (polygon.getExteriorRing() == nullptr) return;
            shape.ring = ring_of(*polygon.getExteriorRing(), shift);
            for (int i = 0; i < polygon.getNumInteriorRings(); ++i) {
                shape.hole.push_back(ring_of(*polygon.getInteriorRing(i), shift));
            }
            if (shape.ring.size() >= 3) shapes.push_back(std::move(shape));
            return;
        }
        case wkbLineString: {
            LandShape shape = like;
            shape.line = true;
            shape.ring = corners_of(*geometry.toLineString(), shift);
            if (shape.ring.size() >= 2) shapes.push_back(std::move(shape));
            return;
        }
        case wkbMultiPolygon:
        case wkbMultiLineString:
        case wkbGeometryCollection:
            for (const OGRGeometry* part : *geometry.toGeometryCollection()) {
                append(shapes, *part, like, shift);
            }
            return;
        default:
            return;  // points and curves lay down no ground
    }
}

int field_index(OGRLayer& layer, const std::string& field, const std::string& where) {
    if (field.empty()) return -1;
    const int found = layer.GetLayerDefn()->GetFieldIndex(field.c_str());
    if (found >= 0) return found;
    std::vector<std::string> names;
    for (int i = 0; i < layer.GetLayerDefn()->GetFieldCount(); ++i) {
        names.emplace_back(layer.GetLayerDefn()->GetFieldDefn(i)->GetNameRef());
    }
    const std::string hint = did_you_mean(field, names);
    throw InputError(where, fmt::format("has no field \"{}\"", field),
                     hint.empty() ? fmt::format("fields: {}", fmt::join(names, ", ")) : hint);
}

}  // namespace

ClassRaster read_class_raster(const std::filesystem::path& file) {
    const QuietGdal quiet;
    const auto data = open(file, GDAL_OF_RASTER, raster_drivers,
                           "known formats: GeoTIFF, ESRI ASCII, ENVI, netCDF");
    ClassRaster raster;
    raster.source = file.string();
    raster.columns = data->GetRasterXSize();
    raster.rows = data->GetRasterYSize();
    if (data->GetRasterCount() == 0) throw InputError(raster.source, "holds no raster band");
    const double cells = double(raster.columns) * raster.rows;
    GDALRasterBand& band = *data->GetRasterBand(1);
    const double bytes = cells * GDALGetDataTypeSizeBytes(band.GetRasterDataType());
    if (cells > most_cells || bytes > 1100.0 * double(std::filesystem::file_size(file))) {
        throw InputError(raster.source,
                         fmt::format("claims {} x {} cells but has only {} bytes", raster.columns,
                                     raster.rows, std::filesystem::file_size(file)));
    }
    const auto& t = raster.transform;
    const OGRSpatialReference* reference = data->GetSpatialRef();
    if (data->GetGeoTransform(raster.transform.data()) != CE_None ||
        std::abs(t[1] * t[5] - t[2] * t[4]) <= 0.0 || !reference || reference->IsEmpty()) {
        throw InputError(raster.source, "has no georeference or names no CRS");
    }
    char* wkt = nullptr;
    reference->exportToWkt(&wkt);
    raster.crs_wkt = wkt ? wkt : "";
    CPLFree(wkt);
    std::vector<double> row(std::size_t(raster.columns));
    int declared = 0;
    const double nodata = band.GetNoDataValue(&declared);
    raster.value.reserve(std::size_t(raster.columns) * raster.rows);
    for (int r = 0; r < raster.rows; ++r) {
        if (band.RasterIO(GF_Read, 0, r, raster.columns, 1, row.data(), raster.columns, 1,
                          GDT_Float64, 0, 0) != CE_None) {
            throw InputError(raster.source, "is damaged");
        }
        for (const double x : row) {
            if (std::isnan(x) || (declared && x == nodata)) {
                raster.value.push_back(no_class);
            } else if (x != std::round(x) || std::abs(x) > 2e9) {
                throw InputError(raster.source,
                                 fmt::format("found a class of {}; classes are whole numbers", x));
            } else {
                raster.value.push_back(static_cast<std::int32_t>(x));
            }
        }
    }
    return raster;
}

std::vector<std::int32_t> classes_at(const ClassRaster& raster, std::span<const Geodetic> places) {
    const QuietGdal quiet;
    OGRSpatialReference own;
    own.SetFromUserInput(raster.crs_wkt.c_str(),
                         OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
    own.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    OGRSpatialReference geodetic = wgs84();
    const Transformation shift(OGRCreateCoordinateTransformation(&geodetic, &own));
    if (!shift) throw InputError(raster.source, "its CRS cannot be reached from WGS84");
    std::vector<double> x, y;
    for (const Geodetic& place : places) {
        x.push_back(place.longitude_deg);
        y.push_back(place.latitude_deg);
    }
    std::vector<int> good(places.size(), 1);
    shift->Transform(static_cast<int>(places.size()), x.data(), y.data(), nullptr, good.data());
    const auto& t = raster.transform;
    const double cell = t[1] * t[5] - t[2] * t[4];
    std::vector<std::int32_t> found(places.size(), no_class);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double dx = x[i] - t[0], dy = y[i] - t[3];
        const double column = std::floor((t[5] * dx - t[2] * dy) / cell);
        const double row = std::floor((t[1] * dy - t[4] * dx) / cell);
        if (good[i] && column >= 0 && row >= 0 && column < raster.columns && row < raster.rows) {
            found[i] = raster.value[std::size_t(row) * raster.columns + std::size_t(column)];
        }
    }
    return found;
}

std::vector<LandShape> read_shapes(const std::filesystem::path& file, const std::string& kind_field,
                                   const std::string& height_field) {
    const QuietGdal quiet;
    const auto data = open(file, GDAL_OF_VECTOR, vector_drivers,
                           "known formats: GeoJSON, ESRI Shapefile, GeoPackage");
    OGRSpatialReference geodetic = wgs84();
    std::vector<LandShape> shapes;
    std::size_t corners = 0;
    for (OGRLayer* layer : data->GetLayers()) {
        const int kind = field_index(*layer, kind_field, file.string());
        const int height = field_index(*layer, height_field, file.string());
        const OGRSpatialReference* named = layer->GetSpatialRef();
        if (!named || named->IsEmpty()) {
            throw InputError(file.string(), "names no coordinate reference system");
        }
        OGRSpatialReference own = *named;
        own.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        const Transformation shift(OGRCreateCoordinateTransformation(&own, &geodetic));
        if (!shift) throw InputError(file.string(), "its CRS cannot be brought to WGS84");
        for (const auto& feature : *layer) {
            if (feature->GetGeometryRef() == nullptr) continue;
            LandShape like;
            if (kind >= 0) like.kind = feature->GetFieldAsString(kind);
            if (height >= 0 && feature->IsFieldSetAndNotNull(height)) {
                like.height = feature->GetFieldAsDouble(height);
            }
            const std::size_t before = shapes.size();
            append(shapes, *feature->GetGeometryRef(), like, shift.get());
            for (std::size_t i = before; i < shapes.size(); ++i) corners += shapes[i].ring.size();
            if (corners > most_corners) {
                throw InputError(file.string(), "has more than a million corners");
            }
        }
    }
    return shapes;
}

std::vector<Eigen::Vector2d> ribbon(std::span<const Eigen::Vector2d> line, double width) {
    std::vector<Eigen::Vector2d> way;
    for (const auto& p : line) {
        if (way.empty() || (p - way.back()).norm() > 1e-6) way.push_back(p);
    }
    if (way.size() < 2) return {};
    std::vector<Eigen::Vector2d> left, right;
    const auto side = [&](std::size_t i) -> Eigen::Vector2d {
        const Eigen::Vector2d along = (way[i + 1] - way[i]).normalized();
        return {-along.y(), along.x()};
    };
    for (std::size_t i = 0; i < way.size(); ++i) {
        const Eigen::Vector2d before = side(i > 0 ? i - 1 : 0);
        const Eigen::Vector2d after = side(std::min(i, way.size() - 2));
        const Eigen::Vector2d middle = before + after;
        // The mitre reaches 1/cos of half the bend.
        const double reach = middle.norm() > 1.0 ? 2.0 / middle.squaredNorm() : 1.0;
        const Eigen::Vector2d off =
            0.5 * width * (middle.norm() > 1.0 ? Eigen::Vector2d(reach * middle) : after);
        left.push_back(way[i] + off);
        right.push_back(way[i] - off);
    }
    left.insert(left.end(), right.rbegin(), right.rend());
    return left;
}

}  // namespace diurna
