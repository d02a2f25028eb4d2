#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace diurna {

/// A plane of a picture, row by row from its top left.
struct PlaneView {
    std::span<const float> value;
    int width = 0, height = 0;
};

/// Clutter of a background, cell by cell. Cells tile the picture from its top left; cells with a
/// skipped pixel, or a value that is not finite, do not count, and neither does the remainder at
/// the right and bottom edges.
struct CellClutter {
    double level = 0.0;     // in the plane's unit, or 0 to 1; NaN if no cell counts
    std::size_t cells = 0;  // that count
};

/// Root mean square over cells of the standard deviation in each (Schmieder and Weathersby 1983,
/// IEEE Trans. Aerosp. Electron. Syst. 19, 622): cells of twice the target's size.
///
/// - left_out: (pixel) not zero: part of the target, skipped
/// - side: [pixels] of a cell, at least 1
CellClutter cell_clutter(const PlaneView& plane, std::span<const std::uint8_t> left_out, int side);

/// Root mean square, over cells as large as the target's box, of the similarity between cell and
/// target: the structural similarity of Wang and others 2004 (IEEE Trans. Image Process. 13, 600;
/// c1 = (0.01 R)², c2 = (0.03 R)², R the plane's span of values): 0 unlike, 1 the same. Clutter
/// measure of Chang and Zhang 2006 (IEEE Trans. Aerosp. Electron. Syst. 42, 361).
///
/// - left, top, width, height: [pixels] of the target's box
CellClutter similar_clutter(const PlaneView& plane, std::span<const std::uint8_t> left_out,
                            int left, int top, int width, int height);

/// Shannon's entropy [bits] of values that are not skipped, counted in bins of `step` from zero
/// on.
double entropy_bits(std::span<const float> value, std::span<const std::uint8_t> counted,
                    double step);

/// Magnitude of the gradient [unit/pixel] by Sobel's operator (its weights over 8), mean over
/// counted pixels that are not at the picture's border; NaN without any.
double mean_gradient(const PlaneView& plane, std::span<const std::uint8_t> counted);

}  // namespace diurna
