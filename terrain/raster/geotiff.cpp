#include "terrain/raster/geotiff.hpp"

#include <cpl_vsi.h>
#include <gdal_priv.h>

#include <cassert>
#include <limits>
#include <memory>
#include <stdexcept>

#include "materials/base/files.hpp"

namespace diurna {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file) {
    throw std::runtime_error(file.string() +
                             ": GeoTIFF cannot be created: " + CPLGetLastErrorMsg());
}

}  // namespace

void write_geotiff(const std::filesystem::path& file, const Dem& dem,
                   const std::vector<RasterBand>& bands, TiffLayout layout) {
    GDALAllRegister();
    GDALDriver* cloud =
        layout == TiffLayout::cloud ? GetGDALDriverManager()->GetDriverByName("COG") : nullptr;
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(cloud ? "MEM" : "GTiff");
    if (driver == nullptr) fail(file);
    // In memory first: a disk that fills up then leaves no half file.
    const std::string memory = "/vsimem/diurna-" + file.filename().string();
    const char* options[] = {"COMPRESS=DEFLATE", "PREDICTOR=3", nullptr};
    {
        const std::unique_ptr<GDALDataset> set(
            driver->Create(memory.c_str(), dem.columns, dem.rows, static_cast<int>(bands.size()),
                           GDT_Float32, cloud ? nullptr : const_cast<char**>(options)));
        if (!set) fail(file);
        std::array<double, 6> transform = dem.transform;
        set->SetGeoTransform(transform.data());
        set->SetProjection(dem.crs_wkt.c_str());
        for (std::size_t b = 0; b < bands.size(); ++b) {
            assert(bands[b].value.size() == dem.height.size());
            GDALRasterBand* band = set->GetRasterBand(static_cast<int>(b) + 1);
            band->SetDescription(bands[b].name.c_str());
            if (!bands[b].unit.empty()) band->SetUnitType(bands[b].unit.c_str());
            band->SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
            if (band->RasterIO(GF_Write, 0, 0, dem.columns, dem.rows,
                               const_cast<float*>(bands[b].value.data()), dem.columns, dem.rows,
                               GDT_Float32, 0, 0) != CE_None) {
                fail(file);
            }
        }
        if (cloud) {
            const char* how[] = {"COMPRESS=DEFLATE", "PREDICTOR=YES", "OVERVIEW_RESAMPLING=AVERAGE",
                                 nullptr};
            const std::unique_ptr<GDALDataset> copy(cloud->CreateCopy(
                memory.c_str(), set.get(), FALSE, const_cast<char**>(how), nullptr, nullptr));
            if (!copy) fail(file);
        }
    }
    vsi_l_offset size = 0;
    const std::unique_ptr<GByte, decltype(&VSIFree)> bytes(
        VSIGetMemFileBuffer(memory.c_str(), &size, TRUE), &VSIFree);
    if (!bytes) fail(file);
    write_whole_file(file, std::as_bytes(std::span(bytes.get(), static_cast<std::size_t>(size))));
}

}  // namespace diurna
