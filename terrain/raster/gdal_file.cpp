#include "terrain/raster/gdal_file.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "materials/base/hdf5_file.hpp"
#include "terrain/raster/raster_names.hpp"
#include "terrain/raster/zip_archive.hpp"

namespace diurna {

namespace {

constexpr int most_bands = 4096;
constexpr double largest_block = 512e6;  // [bytes]

}  // namespace

GDALDatasetUniquePtr open_gdal_file(const std::filesystem::path& file, GdalUse use,
                                    const QuietGdal& gdal, const GdalGate& gate) {
    if (!std::filesystem::is_regular_file(file)) {
        throw InputError(file.string(), "the file does not exist");
    }
    note_file_read(file);
    check_values_are_its_own(file);
    const bool vector = use == GdalUse::shapes;
    const std::string name = vector ? gdal_vector_name(file) : gdal_raster_name(file);
    const unsigned kind = vector ? GDAL_OF_VECTOR : GDAL_OF_RASTER;
    GDALDatasetUniquePtr data(
        GDALDataset::Open(name.c_str(), kind | GDAL_OF_READONLY, gdal_drivers(use).data()));
    gate.check();
    if (!data) {
        throw InputError(file.string(), "cannot be read" + gdal.because(),
                         unread_hint(file, gdal_advice(use)));
    }
    look_beside(*data, gate);
    check_bands(*data, file.string());
    return data;
}

void check_bands(GDALDataset& data, const std::string& where) {
    const int bands = data.GetRasterCount();
    if (bands > most_bands) {
        throw InputError(where, fmt::format("has {} bands, expected at most {}", bands, most_bands),
                         "write the bands that you need to a separate file");
    }
    if (bands == 0) return;
    GDALRasterBand& first = *data.GetRasterBand(1);
    int columns = 0, rows = 0;
    first.GetBlockSize(&columns, &rows);
    const char* const order = data.GetMetadataItem("INTERLEAVE", "IMAGE_STRUCTURE");
    const bool side_by_side = order != nullptr && EQUAL(order, "PIXEL");
    const double bytes = double(columns) * rows * (side_by_side ? bands : 1) *
                         GDALGetDataTypeSizeBytes(first.GetRasterDataType());
    if (bytes <= largest_block) return;
    throw InputError(
        where,
        fmt::format(
            "has blocks of {} x {} pixels and {} bands, {:.1f} GB each, expected at most {:.1f} GB",
            columns, rows, bands, 1e-9 * bytes, 1e-9 * largest_block),
        "gdal_translate -b 1 -co TILED=YES writes one band in small blocks");
}

void look_beside(GDALDataset& data, const GdalGate& gate) {
    char** const list = data.GetFileList();
    for (char** file = list; file != nullptr && *file != nullptr; ++file) note_file_read(*file);
    CSLDestroy(list);
    gate.check();
}

bool claims_too_much(double bytes, const std::filesystem::path& file) {
    constexpr double best_compression = 1100.0;
    std::error_code problem;
    return bytes >
           best_compression * static_cast<double>(std::filesystem::file_size(file, problem));
}

}  // namespace diurna
