#pragma once

namespace diurna {

/// Effect of cloud on a clear sky's sunlight: factors on its global light (on the horizontal) and
/// on its beam. The diffuse light is the remainder of the global light.
struct CloudEffect {
    double global = 1.0, beam = 1.0;
};

/// Under a cover of 0 to 1, Kasten & Czeplak 1980 (Solar Energy 24, 177; ten years of Hamburg):
///
///     G / G_clear = 1 − 0.75 c^3.4,    D / G = d + (1 − d) c²
///
/// where d is the clear sky's diffuse share (theirs is 0.3), so that the beam has (1 − 0.75 c^3.4)
/// (1 − c²) of its clear value in any haze. The diffuse light is greatest at six eighths. These are
/// means over many hours: the cover does not describe a cloud's thickness, and overcast hours of
/// the same record pass 0.16 (nimbostratus) to 0.61 (cirrus) of the clear sky's light where the
/// formula gives 0.25; single hours are off by a third and more. Use measured sunlight where this
/// matters.
CloudEffect kasten_czeplak(double cover);

/// The equivalent level cloud: its part of the sky and its optical depth.
struct SunlitCloud {
    double fraction = 0.0;
    double optical_depth = 20.0;
};

/// The cloud, of independent columns with and without it, that gives these factors on beam and
/// global light under a sun: beam (1 − f) + f e^(−τ/μ), global (1 − f) + f T(τ), T Eddington's
/// closed form for drops that absorb nothing (g = 0.85) over ground of albedo 0.2. What two streams
/// make of it differs by some per cent, which LightScale takes up. Global light beyond what
/// the thinnest such cloud passes: that cloud. No cloud for a beam that has lost nothing. A beam
/// below 3e-3 of the clear one is none: the depth then follows from the global light alone, so that
/// what the cloud sends back, passes and absorbs is all that came in.
///
/// sun_cosine  of the sun's zenith angle, 0 to 1
SunlitCloud cloud_of_effect(const CloudEffect& effect, double sun_cosine);

/// Transmittance T above: global light below a layer of an optical depth over that at its top.
double cloud_transmittance(double optical_depth, double sun_cosine);

}  // namespace diurna
