#include "scenes/products/labels/label_contrast.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace diurna {

double Contrast::rss() const { return std::hypot(difference(), spread); }

Contrast contrast(const Plane& plane, int width, int height, const ObjectMask& mask) {
    const std::vector<std::uint8_t> own = pixels_of(mask, width, height);
    const int more_x = std::max(2, (mask.width + 1) / 2);
    const int more_y = std::max(2, (mask.height + 1) / 2);
    double sum = 0.0, squares = 0.0, around = 0.0;
    std::size_t pixels = 0;
    Contrast found;
    const int bottom = std::min(height, mask.top + mask.height + more_y);
    const int right = std::min(width, mask.left + mask.width + more_x);
    // Sums of differences from one of its values: squares of temperatures would lose their spread.
    double origin = std::nan("");
    for (int row = std::max(0, mask.top - more_y); row < bottom; ++row) {
        for (int column = std::max(0, mask.left - more_x); column < right; ++column) {
            const std::size_t p = std::size_t(row) * std::size_t(width) + std::size_t(column);
            if (!std::isfinite(plane.pixel[p])) continue;
            if (std::isnan(origin)) origin = double{plane.pixel[p]};
            const double value = double{plane.pixel[p]} - origin;
            if (own[p] != 0) {
                ++pixels;
                sum += value;
                squares += value * value;
            } else {
                ++found.background_pixels;
                around += value;
            }
        }
    }
    found.known = pixels > 0 && found.background_pixels > 0;
    if (!found.known) return found;
    const double mean = sum / double(pixels);
    found.target = origin + mean;
    found.spread = std::sqrt(std::max(0.0, squares / double(pixels) - mean * mean));
    found.background = origin + around / double(found.background_pixels);
    return found;
}

}  // namespace diurna
