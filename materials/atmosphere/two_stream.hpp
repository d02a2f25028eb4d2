#pragma once

#include <span>
#include <vector>

namespace diurna {

/// A homogeneous layer of scattering and absorbing air, from the top of the air downward.
struct ScatteringLayer {
    double depth;              // optical, vertical
    double single_albedo;      // 0 to 1
    double asymmetry;          // mean cosine of scattering
    double beam_in, beam_out;  // irradiance of a plane facing the sun, at its top and bottom
};

/// Diffuse fluxes through horizontal planes at every level (layers + 1, from the top), in the same
/// unit as the beam.
struct DiffuseFlux {
    std::vector<double> up, down;
};

/// Multiple scattering in plane layers over ground of an albedo, by Eddington's two streams; the
/// beam may decrease at any rate within a layer (so its path may be bent and the air spherical).
///
/// sun_cosine     of the beam's zenith angle where it is scattered and reflected, 0 to 1
/// down_at_top    diffuse flux entering from above (0 at the top of the air)
///
/// With delta-scaled layers fluxes err by some per cent, 10 % for a low sun
/// (tests/materials/two_stream_test: conservation, symmetry, closed forms). Source: Toon et al.
/// 1989, doi:10.1029/JD094iD13p16287; adding of layers as Liou 2002, chapter 6.
DiffuseFlux two_stream(std::span<const ScatteringLayer> layers, double sun_cosine, double albedo,
                       double down_at_top = 0.0);

}  // namespace diurna
