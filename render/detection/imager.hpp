#pragma once

#include <functional>

#include "materials/radiation/band.hpp"
#include "render/instrument/instrument.hpp"

namespace diurna {

/// An instrument as used for ranges: in angles, kelvins and seconds.
struct Imager {
    /// Modulation transfer for a sine wave to the right, or down; cycles per milliradian.
    std::function<double(double)> mtf_right, mtf_down;
    double pixel = 0.1;        // [mrad] from one to the next
    double netd = 0.03;        // [K] of a pixel in a frame, before 300 K
    double frame_rate = 30.0;  // [Hz]

    /// Half the rate of pixels [cycles/mrad]: higher frequencies are not counted (FLIR92).
    double finest() const { return 0.5 / pixel; }
};

/// - focal_length: [m]
Imager imager_of(const Instrument& instrument, const Band& band, double focal_length);

/// Viewing conditions of its picture.
struct Viewing {
    double luminance = 34.3;      // [cd/m²] of the display on average: 10 foot-lamberts
    double display_deg = 15.0;    // square root of the display's angular area, at the eye
    double magnification = 1.0;   // angle at the eye over angle of the scene
    double scene_contrast = 5.0;  // [K] shown as the display's mean luminance
};

}  // namespace diurna
