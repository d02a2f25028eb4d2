#pragma once

#include <cstddef>

#include "render/picture/frame.hpp"
#include "scenes/products/labels/object_masks.hpp"

namespace diurna {

/// Contrast of an object with its background, in the unit of a plane.
///
/// Its background is every pixel outside its mask in the box that extends its box by half its
/// width (height) on each side, rounded up to whole pixels, at least 2, within the picture:
/// everything visible there, sky and other objects too. Pixels whose value is not finite are
/// skipped.
struct Contrast {
    double target = 0.0;      // mean over the mask
    double spread = 0.0;      // standard deviation over the mask
    double background = 0.0;  // mean
    std::size_t background_pixels = 0;
    bool known = false;  // both have pixels

    double difference() const { return target - background; }
    /// √((target − background)² + spread²): the root sum square used for detection ranges (Ratches
    /// 1976; NVThermIP).
    double rss() const;
};

Contrast contrast(const Plane& plane, int width, int height, const ObjectMask& mask);

}  // namespace diurna
