#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/lit_facets.hpp"
#include "render/picture/frame.hpp"
#include "render/rays/secondary_rays.hpp"
#include "render/view/corner_fits.hpp"
#include "render/view/view.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// A cube's channels and the facets lit for them.
struct CubeSeries {
    std::string name;
    std::vector<Band> channels;
    LitFacets lit;
};

/// The constant part of an observer's pictures over its frames, while nothing moves.
struct Series {
    const ObserverInput& input;
    const Observer& observer;
    std::vector<Band> bands;
    ViewOptions sampling;
    View view;
    SecondaryRays secondary_rays;
    LitFacets lit;
    CornerFits fits;                       // of the visible facets
    std::vector<SurfaceId> beside_seen{};  // lit surfaces on or beside a visible facet
    std::vector<CubeSeries> cubes;
    std::vector<Plane> behind;  // for bands in which objects are visible behind nets or panes
};

/// Casts the view of an observer and computes the light that is the same at every
/// instant.
///
/// - pose: of the observer
/// - frames: of the pictures of the series
/// - asked: (pixel) pixels to be cast (non-zero); empty: all (render/view/view.hpp)
/// - known: the view of all pixels with `samples` each, if it was cast before
Series cast_series(const Prepared& prepared, const ObserverInput& input, const Observer& pose,
                   std::span<const Instant> frames, const FacetViews& views,
                   const TemperatureField& field, std::span<const std::uint8_t> asked = {},
                   std::optional<View> known = {});

/// Wind over water at an instant [m s-1].
double wind_at(const Prepared& prepared, Instant instant);

}  // namespace diurna
