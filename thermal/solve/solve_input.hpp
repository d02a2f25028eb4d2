#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "materials/air/air_by_height.hpp"
#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/column/column.hpp"
#include "thermal/solve/heat_state.hpp"
#include "thermal/solve/network_object.hpp"
#include "thermal/surface/plate_film.hpp"
#include "thermal/temperature_field.hpp"
#include "thermal/weather/sky_state.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// How the columns are stepped. `modes`: a few exponential modes per material, exact in time but
/// for the surface's curvature, split where a shadow's edge passes
/// (thermal/steppers/mode_batch.hpp); thin plates likewise with two faces
/// (thermal/steppers/plate_batch.hpp). `layered`: node by node
/// (thermal/steppers/layered_step.hpp), the reference; it follows edges too.
enum class Method { modes, layered };

struct SolveOptions {
    Instant start{};
    double duration = 86400.0;   // [s]
    double step = 600.0;         // [s]; the last step ends with the span, all are equally long
    double keep_every = 3600.0;  // [s] between kept instants, rounded to whole steps
    bool periodic = true;        // the span repeats for ever; else it starts from SolveInput::from,
                                 // or from its mean balance
    bool goes_on = false;        // other spans follow: what is slower than this one is kept
    int max_passes = 12;         // over the span; twice as many while they bring it nearer
    double tolerance = 1e-4;     // [K] |P(T) − T| of every node after a period
    double settled =
        0.01;  // [K] that neighbours' heat may still be worth at the end; 0.05 where water lies
    Method method = Method::modes;
    double mode_error = 0.004;  // largest of the impedance (thermal/column/reduced_column.hpp)
    GridOptions grid{};         // of layered columns
    int refinement = 1;         // divides every step, forcing as it was: reports a result's error
    bool exchange = true;       // light and heat from one facet to another
    /// Steps whose instants' heat balance is wanted, ascending. One more pass takes it down, and
    /// the temperatures are that pass's.
    std::vector<std::size_t> heat_at{};
    std::function<void(double)> progress{};  // called with 0 to 1 from the calling thread
    /// Called likewise after each pass that leaves something: which it was, what is left and where.
    std::function<void(const std::string&)> tell{};
};

/// The instants between steps, where the sun's exposure is wanted: first `start`, last its end.
std::vector<Instant> step_instants(const SolveOptions& options);

/// Where a shadow's edge crosses a facet between two instants.
struct ShadowEdge {
    std::uint32_t step, facet;  // step i lies between the instants i and i + 1
    float share;                // of the step, 0 to 1
};

/// Share of each facet that the sun reaches at each step's instant
/// (terrain/visibility/view_factors.hpp). Between the instants it runs straight, or jumps at the
/// edge if there is one (thermal/solve/shadow_edges.hpp finds them).
struct SunExposure {
    std::vector<Instant> instant;    // = step_instants(options)
    std::vector<float> fraction;     // (instant, facet) 0 to 1; empty: nothing casts a shadow
    std::vector<ShadowEdge> edge{};  // one at most for each step and facet
};

struct SolveInput {
    const FacetSet& facets;
    const FacetViews& views;
    const SunExposure& sun;
    const MaterialLibrary& materials;
    const Weather& weather;
    Site site;
    double utc_offset = 0.0;  // [s] that the clock of materials' schedules is ahead of UTC
    double elevation = 0.0;   // [m] above the sea, of the weather
    /// From there (its `station` is `elevation`) to the facets; null: all have the weather's air.
    const AirByHeight* by_height = nullptr;
    std::vector<float> height{};   // (facet) [m] above the sea; empty: all at the weather's
    std::vector<FilmPart> part{};  // (facet) to the wind; empty: of unknown size, in the open
    /// Of the facets the last so many, which others do not see: what they are has no say in what
    /// others are, to the last bit. Of no target.
    std::size_t beside = 0;
    std::vector<NetworkObject> network{};  // targets whose facets conduct from one to the next
    /// (facet) share of what falls straight down that nothing above keeps off it; empty: all.
    std::vector<float> open_above{};
    ClearSky clear_sky{};
    /// (material) what measured light up over light down is to be multiplied by to be its albedo: 1
    /// for the material it was measured over; 0 leaves a material its own. Empty: all 0.
    std::vector<double> measured_share{};
    const FacetViews* sunlight_views = nullptr;  // where panes let other light pass than heat
    const HeatState* from = nullptr;  // at the start; null: periodic, or the span's mean balance
    /// With `from`: temperatures at as many instants to guess those of the span by, such as the day
    /// before's; null: those of the start throughout.
    const TemperatureField* guess = nullptr;
};

/// SolveInput::measured_share of a material.
double measured_share(const SolveInput& input, MaterialId material);
/// The albedo that a sky measured of such a material, 0 to 1; NaN where it did not.
double measured_albedo(const SkyState& sky, double share);

/// Throws InputError where arrays do not match each other or the options.
void check(const SolveInput& input, const SolveOptions& options);

}  // namespace diurna
