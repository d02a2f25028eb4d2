#pragma once

#include <gdal_priv.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace diurna {

/// Pixels of a band without a value, from any declaration in the file: a nodata value, an internal
/// mask, an alpha band, a .msk file; if several apply, any of them.
class BandMask {
 public:
    /// where  the file, for messages
    BandMask(GDALRasterBand& band, std::string where);

    /// Sets 0 for pixels of a row without a value, non-zero for the others. Throws InputError if
    /// the mask cannot be read.
    ///
    /// valid  (pixel) from `column` on
    void read(int column, int row, std::span<std::uint8_t> valid);

 private:
    std::vector<GDALRasterBand*> mask_{};
    std::vector<std::uint8_t> one_{};
    std::string where_;
};

}  // namespace diurna
