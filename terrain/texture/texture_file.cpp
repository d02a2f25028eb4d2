#include "terrain/texture/texture_file.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "terrain/raster/crs.hpp"
#include "terrain/raster/gdal_file.hpp"
#include "terrain/raster/raster_reference.hpp"

namespace diurna {

namespace {

constexpr double most_texels = 1e8;
}  // namespace

TextureImage read_texture_image(const std::filesystem::path& file, int channel,
                                const std::optional<Confines>& confines) {
    const QuietGdal gdal;
    const GdalGate gate(confines ? *confines : confines_of(file));
    TextureImage image;
    image.source = file.string();
    const auto data = open_gdal_file(file, GdalUse::texture, gdal, gate);
    image.columns = data->GetRasterXSize();
    image.rows = data->GetRasterYSize();
    const double texels = double(image.columns) * image.rows;
    if (data->GetRasterCount() < channel) {
        throw InputError(image.source,
                         fmt::format("has {}, expected at least {}",
                                     number_of(data->GetRasterCount(), "channel"), channel));
    }
    GDALRasterBand& band = *data->GetRasterBand(channel);
    const double bytes = texels * GDALGetDataTypeSizeBytes(band.GetRasterDataType());
    constexpr double small = 1e6;  // pictures of one colour may be packed better
    if (texels > most_texels || claims_too_much(bytes - small, file)) {
        throw InputError(image.source,
                         fmt::format("declares {} x {} texels, but has only {} bytes",
                                     image.columns, image.rows, std::filesystem::file_size(file)));
    }
    image.value.resize(std::size_t(image.columns) * std::size_t(image.rows));
    if (band.RasterIO(GF_Read, 0, 0, image.columns, image.rows, image.value.data(), image.columns,
                      image.rows, GDT_Float32, 0, 0) != CE_None) {
        throw InputError(image.source, "cannot be read" + gdal.because());
    }
    int has_nodata = 0;
    const double nodata = band.GetNoDataValue(&has_nodata);
    for (float& v : image.value) {
        if (!std::isfinite(v) || (has_nodata && v == static_cast<float>(nodata))) {
            v = std::numeric_limits<float>::quiet_NaN();
        }
    }
    const auto crs = raster_reference(*data, file);
    image.georeferenced = data->GetGeoTransform(image.transform.data()) == CE_None && crs;
    if (image.georeferenced) image.crs_wkt = wkt_of(*crs);
    return image;
}

std::array<Eigen::Vector2d, 6> texels_from_site(const TextureImage& image, const Site& site,
                                                double reach, double* worst) {
    const QuietGdal gdal;
    OGRCoordinateTransformation& from_geodetic =
        *projection_of(image.crs_wkt, image.source).from_geodetic;
    GeoTransform inverse{}, forward = image.transform;
    if (!GDALInvGeoTransform(forward.data(), inverse.data())) {
        throw InputError(image.source, "its georeference cannot be used: its texels have no area");
    }
    constexpr int half = 4;  // nine points across
    Eigen::Matrix<double, Eigen::Dynamic, 6> terms((2 * half + 1) * (2 * half + 1), 6);
    Eigen::Matrix<double, Eigen::Dynamic, 2> texel(terms.rows(), 2);
    Eigen::Index k = 0;
    for (int j = -half; j <= half; ++j) {
        for (int i = -half; i <= half; ++i, ++k) {
            const double x = double(i) / half, y = double(j) / half;
            const Geodetic place = to_geodetic(site, {reach * x, reach * y, 0.0});
            double a = place.longitude_deg, b = place.latitude_deg;
            if (!from_geodetic.Transform(1, &a, &b) || !std::isfinite(a) || !std::isfinite(b)) {
                throw InputError(image.source, "its CRS does not cover the site" + gdal.because());
            }
            terms.row(k) << 1.0, x, y, x * x, x * y, y * y;
            texel.row(k) = map_place(inverse, {a, b}).transpose();
        }
    }
    const Eigen::Matrix<double, 6, 2> fit = terms.colPivHouseholderQr().solve(texel);
    if (worst != nullptr) *worst = (terms * fit - texel).rowwise().norm().maxCoeff();
    const std::array<double, 6> scale = {1.0,           reach,         reach,
                                         reach * reach, reach * reach, reach * reach};
    std::array<Eigen::Vector2d, 6> layout;
    for (std::size_t t = 0; t < 6; ++t) {
        layout[t] = fit.row(Eigen::Index(t)).transpose() / scale[t];
    }
    return layout;
}

}  // namespace diurna
