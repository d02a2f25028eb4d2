#pragma once

#include <span>

#include "materials/radiation/band.hpp"
#include "render/light/lit_facets.hpp"
#include "render/light/radiance_input.hpp"
#include "render/picture/frame.hpp"
#include "render/rays/plume.hpp"
#include "render/rays/secondary_rays.hpp"
#include "render/view/linear_facets.hpp"
#include "render/view/observer.hpp"
#include "render/view/pixel_sun.hpp"
#include "render/view/view.hpp"

namespace diurna {

struct FrameOptions {
    bool truth = true;          // temperature, range, facet, object, material, normal
    bool terms = false;         // the terms of the radiance separately
    int surfaces = 0;           // of each pixel in planes (surface_planes.hpp); needs `terms`
    double tolerance = 1e-3;    // [K] target for the tables, in apparent temperature
    int bounces = all_bounces;  // maximum of interreflections (radiosity.hpp)
    /// lit_facets(input, seen_surfaces(view.surface, secondary rays), bands), for a series of
    /// frames without motion.
    const LitFacets* lit = nullptr;
    /// follow_rays() of the view if it sees panes, nets, mirrors or plumes
    /// (secondary_light.hpp).
    const SecondaryRays* secondary_rays = nullptr;
    /// cast_pixel_sun() of the view and the instant: shadows by pixel, not by facet. Null: none.
    const PixelSun* pixel_sun = nullptr;
    /// linear_facets() of the view and the instant: temperatures within facets. Null: their means.
    const LinearFacets* ground = nullptr;
    std::span<const Plume> plumes{};
};

/// The picture of an instant in every band: radiance.BAND and apparent_temperature.BAND, truth,
/// terms (render/picture/frame.hpp). A pixel averages radiance, not temperature.
///
/// A facet's radiance is a short row of numbers (eye_row.hpp): emission and incident light
/// in a few modes (spectral_basis.hpp), sky view, sunlight. Their contributions at the eye
/// are a table over range and height per material (eye_table.hpp), computed at the band's
/// nodes where surface, air and response are multiplied. The radiance of a target is their
/// dot product, with slopes by range and height for pixels that do not see it at its
/// middle. The grid is refined until the error estimated by halving it is below
/// `tolerance`.
///
/// Against the node-by-node reference (radiance_at_eye): within 2 mK in 3-5, 8-12 and 8-14 µm and,
/// without air, 1.5-1.8 µm, 2.6 mK in 0.4-0.7 µm; with sunlight that the air scatters, within 0.1 %
/// of radiance below 2.5 µm (tests/render/tracer_test.cpp).
///
/// By day and below 5 µm the air's scattered sunlight (materials/atmosphere/sun_field.hpp)
/// illuminates surfaces and is visible in the sky, in front of the far plain beyond the scene's
/// edge and in front of every facet (scattered_path.hpp).
///
/// Notes of the frame: for each band the error estimate, the size of the grid, and an upper
/// bound on the omitted interreflections. The same bytes for any number of threads. Throws
/// InputError if spans do not match the facets or a temperature of a facet in the picture is not
/// finite.
Frame render(const View& view, const Observer& observer, std::span<const Band> bands,
             const RadianceInput& input, const FrameOptions& options = {});

}  // namespace diurna
