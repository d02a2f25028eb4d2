#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/instrument/blur.hpp"
#include "render/instrument/noise.hpp"
#include "render/instrument/optics.hpp"
#include "render/instrument/pattern.hpp"
#include "render/instrument/response.hpp"

namespace diurna {

/// An instrument prepared for pictures of one size in one band. Its stages in order:
///
///     see()    radiance, oversampled -> flux of each pixel    blur, lens, distortion, glare
///     lag()    (optics.hpp)                                   a bolometer's time constant
///     take()   flux -> signal -> counts                       detector, correction, electronics
///     displayed() (display.hpp)                               8 bits
struct Camera {
    Instrument instrument;
    int width, height;    // [pixels]
    double focal_length;  // [m]
    Response response;    // at present, and at the correction of the fixed pattern:
    Response corrected_response;
    SystemMtf mtf;
    Oversampling oversampling;
    int margin;  // pixels beyond each edge needed for blur and distortion
    Convolution blur;
    LensField field, corrected_field;
    Pattern pattern;
    Noise noise;

    int seen_width() const { return (width + 2 * margin) * oversampling.times; }
    int seen_height() const { return (height + 2 * margin) * oversampling.times; }
};

/// Throws InputError for settings that contradict each other or the band: a NETD below the photon
/// noise, a lens with distortion that folds over, correction black bodies with almost no signal.
void check_camera(const Instrument& instrument, const Band& band, int width, int height,
                  double focal_length);

/// - band: the observer's; the radiance to be rendered is that of Camera::response.scene
/// - focal_length: [m]; of a pinhole with the detector's pitch
Camera camera_of(const Instrument& instrument, const Band& band, int width, int height,
                 double focal_length);

/// Flux [signal's unit, of a photon detector per second] from the scene for each pixel, scaled to
/// the optical axis.
///
/// - radiance: of the scene's band, seen_width() × seen_height(), row by row
std::vector<float> see(const Camera& camera, std::span<const float> radiance);

/// A picture as taken.
struct Shot {
    double integration_time = 0.0;      // [s]; 1 for a bolometer
    std::vector<float> signal;          // from the scene only, without noise; signal's unit
    std::vector<float> measured;        // with background, noise and pattern, after its correction
    std::vector<std::uint16_t> counts;  // limited to the electronics' bits
    std::size_t saturated = 0, dead = 0;  // pixels: full wells; not replaced
};

/// - frame: number of the picture, seconds since 1970 times the frame rate: selects the noise
/// - hours: since the last correction
Shot take(const Camera& camera, std::span<const float> flux, std::int64_t frame, double hours);

/// Frame number and hours since the last correction, `seconds` after 1970. Corrections occur every
/// Correction::interval, with a phase from the seed.
std::int64_t frame_number(const Instrument& instrument, double seconds);
double hours_since_correction(const Instrument& instrument, double seconds);

/// Counts of a measured signal before rounding, and back. A photon detector's are
/// proportional to it; a bolometer's range from zero at the range's lower black body to the
/// maximum.
struct CountScale {
    double zero = 0.0, per_signal = 1.0;
    double counts(double signal) const { return zero + per_signal * signal; }
    double signal(double counts) const { return (counts - zero) / per_signal; }
};
CountScale count_scale(const Camera& camera);

/// Stages omitted by the settings, a line each: "jitter: none".
std::vector<std::string> left_out(const Instrument& instrument);

}  // namespace diurna
