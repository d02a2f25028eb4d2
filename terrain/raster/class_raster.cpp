#include "terrain/raster/class_raster.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <string_view>

#include "materials/base/error.hpp"
#include "terrain/raster/ascii_grid.hpp"
#include "terrain/raster/band_mask.hpp"
#include "terrain/raster/crs.hpp"
#include "terrain/raster/gdal_file.hpp"
#include "terrain/raster/quiet_gdal.hpp"
#include "terrain/raster/raster_reference.hpp"

namespace diurna {

namespace {

constexpr double most_cells = 5e8;
/// Row by row; throws InputError for a class that is no whole number.
std::vector<std::int32_t> read_classes(GDALRasterBand& band, const ClassRaster& raster) {
    std::vector<double> row(std::size_t(raster.columns));
    int declared = 0;
    const double nodata = band.GetNoDataValue(&declared);
    std::vector<std::uint8_t> valid(row.size());
    BandMask mask(band, raster.source);
    std::vector<std::int32_t> value;
    value.reserve(std::size_t(raster.columns) * raster.rows);
    for (int r = 0; r < raster.rows; ++r) {
        if (band.RasterIO(GF_Read, 0, r, raster.columns, 1, row.data(), raster.columns, 1,
                          GDT_Float64, 0, 0) != CE_None) {
            throw InputError(raster.source, "is damaged");
        }
        mask.read(0, r, valid);
        for (std::size_t column = 0; column < row.size(); ++column) {
            const double x = row[column];
            if (std::isnan(x) || (declared && x == nodata) || valid[column] == 0) {
                value.push_back(no_class);
            } else if (x != std::round(x) || std::abs(x) > 2e9) {
                throw InputError(raster.source,
                                 fmt::format("found a class of {}, expected a whole number", x));
            } else {
                value.push_back(static_cast<std::int32_t>(x));
            }
        }
    }
    return value;
}

/// Refuses a picture: its shades of red are not classes.
void refuse_colours(GDALDataset& data, const std::string& where) {
    const int bands = data.GetRasterCount();
    if (bands < 3) return;
    for (int i = 1; i <= 3; ++i) {
        const GDALColorInterp colour = data.GetRasterBand(i)->GetColorInterpretation();
        const bool rgb = colour >= GCI_RedBand && colour <= GCI_BlueBand;
        const bool other = colour >= GCI_HueBand && colour <= GCI_YCbCr_CrBand;
        if (!rgb && !other) return;
    }
    throw InputError(
        where,
        fmt::format("is a picture with {} bands of colour, expected one band of class numbers",
                    bands),
        "use the raster of class numbers from which the picture was drawn");
}

}  // namespace

ClassRaster read_class_raster(const std::filesystem::path& file,
                              const std::optional<Confines>& confines) {
    const QuietGdal gdal;
    const GdalGate gate(confines ? *confines : confines_of(file));
    const auto data = open_gdal_file(file, GdalUse::classes, gdal, gate);
    ClassRaster raster;
    raster.source = file.string();
    raster.columns = data->GetRasterXSize();
    raster.rows = data->GetRasterYSize();
    if (data->GetRasterCount() == 0) throw InputError(raster.source, "has no raster band");
    refuse_colours(*data, raster.source);
    const double cells = double(raster.columns) * raster.rows;
    GDALRasterBand& band = *data->GetRasterBand(1);
    const double bytes = cells * GDALGetDataTypeSizeBytes(band.GetRasterDataType());
    if (cells > most_cells || claims_too_much(bytes, file)) {
        throw InputError(raster.source, fmt::format("declares {} x {} cells, but has only {} bytes",
                                                    raster.columns, raster.rows,
                                                    std::filesystem::file_size(file)));
    }
    const auto reference = raster_reference(*data, file);
    if (data->GetGeoTransform(raster.transform.data()) != CE_None ||
        !(std::abs(pixel_area(raster.transform)) > 0.0) ||  // of nan, too
        !std::isfinite(pixel_area(raster.transform)) || !reference) {
        throw InputError(raster.source, "has no georeference or no CRS");
    }
    raster.crs_wkt = wkt_of(*reference);
    if (std::string_view(data->GetDriverName()) == "AAIGrid") {
        check_ascii_grid(file, std::size_t(cells));
    }
    raster.value = read_classes(band, raster);
    return raster;
}

std::vector<std::int32_t> classes_at(const ClassRaster& raster, std::span<const Geodetic> places) {
    const QuietGdal gdal;
    std::vector<double> x, y;
    for (const Geodetic& place : places) {
        x.push_back(place.longitude_deg);
        y.push_back(place.latitude_deg);
    }
    const GeoProjection& projection = projection_of(raster.crs_wkt, raster.source);
    const std::vector<int> good = transform(*projection.from_geodetic, x, y);
    std::vector<std::int32_t> found(places.size(), no_class);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Eigen::Vector2d pixel = pixel_at(raster.transform, x[i], y[i]);
        const double column = std::floor(pixel.x()), row = std::floor(pixel.y());
        if (good[i] && column >= 0 && row >= 0 && column < raster.columns && row < raster.rows) {
            found[i] = raster.value[std::size_t(row) * raster.columns + std::size_t(column)];
        }
    }
    return found;
}

}  // namespace diurna
