#pragma once

#include <functional>
#include <span>
#include <vector>

namespace diurna {

/// A filter of pictures by spatial frequency, made once for a size.
///
/// The picture goes on beyond its edges as it ends there, and is taken as one tile of many: what
/// lies within a blur's reach of the edge is not to be used.
class Convolution {
 public:
    /// - transfer: real, of (right, down) in cycles per sample, each −½ to ½
    /// - shift: of the result [samples]: what stands at j is what was at j + shift
    Convolution(int width, int height, const std::function<double(double, double)>& transfer,
                double shift = 0.0);

    int width() const { return width_; }
    int height() const { return height_; }
    /// Row by row. The same bytes whatever else goes on; may be called from many threads.
    std::vector<float> operator()(std::span<const float> picture) const;

 private:
    int width_, height_;
    int columns_, rows_;  // padded to sizes that are products of 2, 3, 5
    double shift_;
    std::vector<double> transfer_;  // (row, column to columns_/2)
};

}  // namespace diurna
