#pragma once

#include <span>
#include <string>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/instrument/convolution.hpp"
#include "render/instrument/instrument.hpp"

namespace diurna {

/// The product of all modulation transfer functions of an instrument (mtf.hpp), over frequency in
/// the picture's plane [1/m]: lens (over the wavelengths of its band, each by its share of a black
/// body of 300 K, below 3 µm of 5772 K), turbulence, motion, diffusion, the pixel's sensitive area.
class SystemMtf {
 public:
    SystemMtf(const Instrument& instrument, const Band& band, double focal_length);
    double operator()(double right, double down) const;
    /// Cut-off frequency of the lens [1/m]; infinite without diffraction.
    double cut_off() const { return cut_off_; }

 private:
    double lens_at(double frequency) const;

    std::vector<double> lens_;  // of rotationally symmetric parts, in even steps
    double step_ = 1.0, cut_off_ = 0.0;
    double jitter_ = 0.0, diffusion_ = 0.0, width_ = 0.0;  // [m]
    double drift_right_ = 0.0, drift_down_ = 0.0;          // [m]
};

/// Samples per pixel in each direction, and their reason.
///
/// Samples alias frequencies above half their rate. The blur must reduce these to a twentieth at
/// half the rate of the oversampled picture; 2 to 6.
struct Oversampling {
    int times = 2;
    std::string why;
};
Oversampling oversampling_of(const Instrument& instrument, const SystemMtf& mtf);

/// The single convolution of a radiance with `times` samples a pixel in each direction, each the
/// mean of a square: the system's MTF over the sinc of these squares. If `times` is even, result j
/// is at the middle between samples j and j + 1, so that pixels' centres are samples.
Convolution system_blur(const SystemMtf& mtf, double pitch, int times, int width, int height);

}  // namespace diurna
