#pragma once

#include <cstdint>
#include <functional>
#include <optional>
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

/// How the columns are stepped. `modes`: a few exponential modes per material, exact in time except
/// for the surface's nonlinearity, with steps split at a shadow's edge
/// (thermal/steppers/mode_batch.hpp); thin plates similarly with two faces
/// (thermal/steppers/plate_batch.hpp). `layered`: node by node (thermal/steppers/layered_step.hpp),
/// the reference; also with edges.
enum class Method { modes, layered };

struct SolveOptions {
    Instant start{};
    double duration = 86400.0;   // [s]
    double step = 600.0;         // [s]; all steps are equally long and end with the span
    double keep_every = 3600.0;  // [s] between stored instants, rounded to whole steps
    /// Stored instants instead, ascending (their numbers).
    std::optional<std::vector<std::size_t>> keep_at{};
    bool periodic = true;     // the span repeats; else it starts from SolveInput::from,
                              // or from its mean balance
    bool goes_on = false;     // other spans follow: slower modes are retained
    bool leads_in = false;    // only its end is needed: targets are solved to 1e-5 of their heat
                              // flow, as against 4e-9
    int max_passes = 12;      // over the span; twice as many while they converge
    double tolerance = 1e-4;  // [K] |P(T) − T| of every node after a period
    double settled = 0.01;    // [K] final effect of neighbours' changes; 0.05 with water
    Method method = Method::modes;
    double mode_error = 0.004;  // largest of the impedance (thermal/column/reduced_column.hpp)
    GridOptions grid{};         // of layered columns
    int refinement = 1;         // divides every step, with the same inputs: for error estimates
    bool exchange = true;       // light and heat from one facet to another
    double least_dew = 0.3;     // [K] dew that changes a dry surface by less is not modelled
    /// Steps whose instants' heat balance is requested, ascending. It is recorded in an additional
    /// pass, which also gives the temperatures.
    std::vector<std::size_t> heat_at{};
    std::function<void(double)> progress{};  // called with 0 to 1 from the calling thread
    /// Called similarly after each pass that has not converged: pass, residual and where.
    std::function<void(const std::string&)> tell{};
    /// Fewer passes and less work in each, for pictures: see quick().
    bool quick = false;
    double still = 0.01;       // [K] a block rests whose start moves by less, and
    double still_heat = 0.05;  // [W m⁻²] whose neighbours' heat does
};

/// Options with which temperatures differ from those of the finest steps by less than half of
/// `kelvin` (rms over facets and instants; measured: bench/solver_bench.cpp): fewer modes; Newton's
/// method in a step, in the period and between neighbours ends earlier, as its last corrections
/// show how far it is from the end; neighbours' longwave is linear between hours. Unchanged for
/// 0; at most as for 0.1.
SolveOptions quick(SolveOptions options, double kelvin);

/// The instants between steps, at which sun exposure is needed: first `start`, last its end.
std::vector<Instant> step_instants(const SolveOptions& options);

/// Where a shadow's edge crosses a facet between two instants.
struct ShadowEdge {
    std::uint32_t step, facet;  // step i lies between the instants i and i + 1
    float share;                // of the step, 0 to 1
};

/// Share of each facet in the sun at each step's instant (terrain/visibility/view_factors.hpp).
/// Linear between the instants, or with a jump at the edge if there is one (from
/// thermal/solve/shadow_edges.hpp).
struct SunExposure {
    std::vector<Instant> instant;    // = step_instants(options)
    std::vector<float> fraction;     // (instant, facet) 0 to 1; empty: no shadows
    std::vector<ShadowEdge> edge{};  // at most one per step and facet
};

struct SolveInput {
    const FacetSet& facets;
    const FacetViews& views;
    const SunExposure& sun;
    const MaterialLibrary& materials;
    const Weather& weather;
    Site site;
    double utc_offset = 0.0;  // [s] clock of materials' schedules ahead of UTC
    double elevation = 0.0;   // [m] above the sea, of the weather
    /// Air from the weather's height (its `station` is `elevation`) to the facets'; null:
    /// uniform.
    const AirByHeight* by_height = nullptr;
    std::vector<float> height{};   // (facet) [m] above the sea; empty: all at the weather's
    std::vector<FilmPart> part{};  // (facet) for wind; empty: of unknown size, in the open
    /// Number of last facets that do not affect others: the results of the others are bitwise
    /// independent of them. Not part of a target.
    std::size_t beside = 0;
    std::vector<NetworkObject> network{};  // targets with conduction between facets
    /// (facet) share of the vertical precipitation that is not kept off from above; empty: all 1.
    std::vector<float> open_above{};
    ClearSky clear_sky{};
    /// (material) factor from the measured ratio of upward to downward light to its albedo: 1 for
    /// the material below the instrument; 0: the material's own albedo. Empty: all 0.
    std::vector<double> measured_share{};
    const FacetViews* sunlight_views = nullptr;  // if panes transmit light unlike heat
    const HeatState* from = nullptr;  // at the start; null: periodic, or the span's mean balance
};

/// SolveInput::measured_share of a material.
double measured_share(const SolveInput& input, MaterialId material);
/// The albedo of such a material measured at a sky, 0 to 1; NaN if not measured.
double measured_albedo(const SkyState& sky, double share);

/// Throws InputError if arrays do not match each other or the options.
void check(const SolveInput& input, const SolveOptions& options);

}  // namespace diurna
