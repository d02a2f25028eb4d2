#pragma once

namespace diurna {

/// What cloud leaves of a clear sky's sunlight: factors on its global light (on the horizontal) and
/// on its beam. The diffuse light is what is left of the global.
struct CloudEffect {
    double global = 1.0, beam = 1.0;
};

/// Under a cover of 0 to 1, Kasten & Czeplak 1980 (Solar Energy 24, 177; ten years of Hamburg):
///
///     G / G_clear = 1 − 0.75 c^3.4,    D / G = d + (1 − d) c²
///
/// with d the clear sky's own share of diffuse light (theirs is 0.3), so that the beam keeps
/// (1 − 0.75 c^3.4) (1 − c²) of its clear strength whatever the haze. The diffuse light is greatest
/// at six eighths. Means over many hours: the cover says nothing of how thick a cloud is, and
/// overcast hours of the same record pass 0.16 (nimbostratus) to 0.61 (cirrus) of the clear sky's
/// light where the formula has 0.25; single hours are off by a third and more. Measure sunlight
/// where that counts.
CloudEffect kasten_czeplak(double cover);

/// The level cloud that does so: over which part of the sky, and how thick.
struct SunlitCloud {
    double fraction = 0.0;
    double optical_depth = 20.0;
};

/// The cloud, of independent columns with and without it, that leaves these parts of beam and
/// global light under a sun: beam (1 − f) + f e^(−τ/μ), global (1 − f) + f T(τ), T Eddington's
/// closed form for drops that absorb nothing (g = 0.85) over ground of albedo 0.2. What two streams
/// make of it differs by some per cent, which LightScale takes up. Global light beyond what
/// the thinnest such cloud passes: that cloud. No cloud for a beam that has lost nothing. A beam
/// below 3e-3 of the clear one is none: the depth then follows from the global light alone, so that
/// what the cloud sends back, passes and absorbs is all that came in.
///
/// sun_cosine  of the sun's zenith angle, 0 to 1
SunlitCloud cloud_of_effect(const CloudEffect& effect, double sun_cosine);

/// Transmittance T above: all light under a layer of an optical depth, over all at its top.
double cloud_transmittance(double optical_depth, double sun_cosine);

}  // namespace diurna
