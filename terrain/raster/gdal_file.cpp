#include "terrain/raster/gdal_file.hpp"

#include <system_error>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "materials/base/hdf5_file.hpp"
#include "terrain/raster/raster_names.hpp"
#include "terrain/raster/zip_archive.hpp"

namespace diurna {

GDALDatasetUniquePtr open_gdal_file(const std::filesystem::path& file, unsigned kind,
                                    const char* const* drivers, const char* formats,
                                    const QuietGdal& gdal, const GdalGate& gate) {
    if (!std::filesystem::is_regular_file(file)) {
        throw InputError(file.string(), "there is no such file");
    }
    note_file_read(file);
    check_values_are_its_own(file);
    const std::string name =
        (kind & GDAL_OF_RASTER) != 0 ? gdal_raster_name(file) : gdal_vector_name(file);
    GDALDatasetUniquePtr data(GDALDataset::Open(name.c_str(), kind | GDAL_OF_READONLY, drivers));
    gate.check();
    if (!data) {
        throw InputError(file.string(), "cannot be read" + gdal.because(),
                         unread_hint(file, formats));
    }
    look_beside(*data, gate);
    return data;
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
