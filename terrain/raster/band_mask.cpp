#include "terrain/raster/band_mask.hpp"

#include <algorithm>
#include <utility>

#include "materials/base/error.hpp"

namespace diurna {

BandMask::BandMask(GDALRasterBand& band, std::string where) : where_(std::move(where)) {
    if ((band.GetMaskFlags() & GMF_ALL_VALID) == 0) mask_.push_back(band.GetMaskBand());
    // GDAL gives one mask alone: a nodata value hides an alpha band, a mask hides a nodata value
    // (which those who read values compare for themselves).
    GDALDataset* const data = band.GetDataset();
    const bool has_alpha = (band.GetMaskFlags() & GMF_ALPHA) != 0;
    if (data == nullptr || has_alpha || band.GetColorInterpretation() == GCI_AlphaBand) return;
    for (GDALRasterBand* other : data->GetBands()) {
        if (other->GetColorInterpretation() == GCI_AlphaBand) mask_.push_back(other);
    }
}

void BandMask::read(int column, int row, std::span<std::uint8_t> valid) {
    std::fill(valid.begin(), valid.end(), std::uint8_t{1});
    const int count = static_cast<int>(valid.size());
    one_.resize(valid.size());
    for (GDALRasterBand* mask : mask_) {
        if (mask->RasterIO(GF_Read, column, row, count, 1, one_.data(), count, 1, GDT_Byte, 0, 0) !=
            CE_None) {
            throw InputError(where_, "its mask of pixels without a value is damaged");
        }
        for (std::size_t i = 0; i < valid.size(); ++i) valid[i] = valid[i] != 0 && one_[i] != 0;
    }
}

}  // namespace diurna
