#pragma once

#include <gdal_priv.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace diurna {

/// What a file says of the pixels of a band that hold no value, in whichever way: a declared nodata
/// value, an internal mask, an alpha band, a .msk file; of several that apply, any.
class BandMask {
 public:
    /// where  the file, for messages
    BandMask(GDALRasterBand& band, std::string where);

    /// Sets 0 for pixels of a row without a value, others where they have one. Throws InputError
    /// where the mask cannot be read.
    ///
    /// valid  (pixel) from `column` on
    void read(int column, int row, std::span<std::uint8_t> valid);

 private:
    std::vector<GDALRasterBand*> mask_{};
    std::vector<std::uint8_t> one_{};
    std::string where_;
};

}  // namespace diurna
