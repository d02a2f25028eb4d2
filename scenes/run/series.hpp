#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/lit_facets.hpp"
#include "render/picture/frame.hpp"
#include "render/rays/secondary_rays.hpp"
#include "render/view/view.hpp"
#include "scenes/plan/prepared.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// A cube's channels and the facets lit for them.
struct CubeSeries {
    std::string name;
    std::vector<Band> channels;
    LitFacets lit;
};

/// What stays of an observer's pictures from frame to frame, while neither it nor anything moves.
struct Series {
    const ObserverInput& input;
    const Observer& observer;
    std::vector<Band> bands;
    ViewOptions sampling;
    View view;
    SecondaryRays secondary_rays;
    LitFacets lit;
    std::vector<CubeSeries> cubes;
    std::vector<Plane> behind;  // of bands in which something is seen through something
};

/// Casts the view of an observer and lights what is the same at every instant.
///
/// - pose: the observer, where it is
/// - frames: of the pictures that the series is for
/// - asked: (pixel) those that are not zero are seen; empty: all (render/view/view.hpp)
Series cast_series(const Prepared& prepared, const ObserverInput& input, const Observer& pose,
                   std::span<const Instant> frames, const FacetViews& views,
                   const TemperatureField& field, std::span<const std::uint8_t> asked = {});

/// Wind over water at an instant [m s-1].
double wind_at(const Prepared& prepared, Instant instant);

}  // namespace diurna
