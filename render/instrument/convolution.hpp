#pragma once

#include <functional>
#include <span>
#include <vector>

namespace diurna {

/// A filter of pictures by spatial frequency, prepared once for a size.
///
/// The picture is extended beyond its edges with the edge values and treated as periodic: results
/// within a blur's reach of the edge are not valid.
class Convolution {
 public:
    /// - transfer: real, of (right, down) in cycles per sample, each −½ to ½
    /// - shift: of the result [samples]: result j is the filtered value at j + shift
    Convolution(int width, int height, const std::function<double(double, double)>& transfer,
                double shift = 0.0);

    int width() const { return width_; }
    int height() const { return height_; }
    /// Row by row. Deterministic bytes; may be called from many threads.
    std::vector<float> operator()(std::span<const float> picture) const;

 private:
    int width_, height_;
    int columns_, rows_;  // padded to sizes that are products of 2, 3, 5
    double shift_;
    std::vector<double> transfer_;  // (row, column to columns_/2)
};

}  // namespace diurna
