#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>

#include "materials/radiation/spectrum.hpp"

namespace diurna {

/// The lens in front of the detector. Effects with a value of zero are skipped (left_out()).
struct Lens {
    double f_number = 2.0;
    Spectrum transmission = flat_spectrum(0.9);
    double housing_temperature = 295.0;  // [K] of lens and walls
    bool cold_stop = true;    // the detector sees only the lens; else also the walls beside it
    bool cos4 = true;         // light falls off with the fourth power of the cosine
    double vignetting = 0.0;  // share of the light that mounts block in the corner; starts
                              // half way there, with the square of the distance beyond
    double k1 = 0.0, k2 = 0.0, k3 = 0.0, p1 = 0.0, p2 = 0.0;  // Brown's, of x/f and y/f
    double veiling_glare = 0.0;     // share of the light that is spread over the whole picture
    double narcissus = 0.0;         // share of the detector's cold reflection in the middle
    double narcissus_radius = 0.4;  // of half the diagonal, at 1/e
};

/// Causes of blur besides diffraction and the pixels' size.
struct Blur {
    bool diffraction = true;
    double wavefront_error = 0.0;     // rms [waves]
    double defocus = 0.0;             // [m] of the detector from the focus
    double diffusion_length = 0.0;    // [m] of charge
    double jitter = 0.0;              // rms [rad] in each axis
    Eigen::Vector2d drift{0.0, 0.0};  // right, down [rad] during integration
    double turbulence_cn2 = 0.0;      // [m^-2/3]
    double turbulence_range = 0.0;    // [m] to the target
};

enum class DetectorKind {
    photon,    // counts electrons
    bolometer  // is heated
};

/// The detector. A photon detector's noises are in electrons, a bolometer's in mK at 300 K.
struct Detector {
    DetectorKind kind = DetectorKind::photon;
    double pitch = 15e-6;                      // [m]
    double fill = 1.0;                         // share of a pixel's area that is sensitive
    Spectrum efficiency = flat_spectrum(0.8);  // quantum efficiency; a bolometer's absorptance
    double integration_time = 0.003;           // [s] at most; photon detectors
    double well_share = 0.0;     // of the well filled by the picture's brightest per cent, by a
                                 // shorter integration time; 0: fixed time
    double well = 7e6;           // [electrons]
    double dark_current = 0.0;   // [electrons/s]
    double capacitance = 0.0;    // [F] of a node that is reset without double sampling; 0: none
    double temperature = 300.0;  // [K] of the detector
    bool shot_noise = true;
    double netd = 0.0;  // [K] at 300 K: all temporal noise of a pixel; replaces read noise
    double read_noise = 0.0;
    double row_noise = 0.0, column_noise = 0.0, frame_noise = 0.0;  // from frame to frame
    double flicker_noise = 0.0;                                     // 1/f, over 2^12 frames
    double time_constant = 0.0;                                     // [s] of a bolometer

    double gain_spread = 0.0;    // fixed, rms, relative
    double offset_spread = 0.0;  // fixed, rms
    double row_offset = 0.0, column_offset = 0.0;
    double gain_drift = 0.0;            // rms share an hour since the last correction
    double offset_drift = 0.0;          // rms an hour
    double nonlinearity = 0.0;          // relative loss at a full well; varies by a tenth, rms
    double dead = 0.0, blinking = 0.0;  // share of pixels
    double blink = 0.0;                 // size of the jumps of blinking pixels
};

enum class CorrectionKind { none, one_point, two_point };

/// Correction of the fixed pattern, by uniform light on the whole picture.
struct Correction {
    CorrectionKind kind = CorrectionKind::two_point;
    std::array<double, 2> temperature{290.0, 310.0};  // [K] of black bodies; 0: by well
    std::array<double, 2> well{0.1, 0.6};             // shares of the well, used instead
    double housing_temperature = 0.0;                 // [K] of the lens then; 0: as at present
    double interval = 3600.0;                         // [s] until it is repeated
    bool replace_dead = true;                         // by the mean of their neighbours
};

enum class Display { linear, plateau, manual };

/// From the signal to counts, and from counts to a picture of 8 bits.
struct Electronics {
    int bits = 14;
    double gain = 1.0;         // 1: a full well, or the top of `range`, is the maximum count
    double black_level = 0.0;  // counts without light
    std::array<double, 2> range{233.0, 423.0};  // [K] of a bolometer: zero and maximum count
    double frame_rate = 30.0;                   // [Hz]
    Display display = Display::plateau;
    double low = 0.01, high = 0.99;  // shares of pixels shown black and not white: linear
    double plateau = 0.02;           // maximum share of pixels for the width of a count in the
                                     // picture: plateau
    double level = 0.0, span = 0.0;  // counts: manual; middle, and from black to white
    bool black_hot = false;
};

/// A camera that replaces an observer's pinhole (render/instrument/camera.hpp).
struct Instrument {
    std::string name = "camera";
    Lens lens;
    Blur blur;
    Detector detector;
    Correction correction;
    Electronics electronics;
    int oversampling = 0;  // of the radiance, each direction; 0: by the blur (blur.hpp)
    std::uint64_t seed = 1;
};

}  // namespace diurna
