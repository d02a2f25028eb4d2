#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "terrain/place/instant.hpp"
#include "thermal/column/nonlinear_column.hpp"
#include "thermal/surface/ground_and_leaves.hpp"
#include "thermal/surface/standing_water.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Inputs of a facet at one instant that do not depend on its own state.
struct PointForcing {
    AirState air;  // the air at the surface
    double wind_speed = 1.0;
    double rain_mm_h = 0.0;
    double sunlight = 0.0;         // [W m⁻²] incident
    double own_light = 0.0;        // [W m⁻²] from ground of its own kind, per unit albedo
    double albedo = not_measured;  // measured; replaces the material's
    double longwave_in = 0.0;      // [W m⁻²] irradiance from sky and other facets
    double own_view = 0.0;         // of ground at the facet's own temperature, 0 to 1
};

/// A facet and its stepping. `surface`, `louis` and `knot` must outlive the PointFacet.
struct PointSetup {
    const ThermalSurface& surface;
    const LouisForm& louis;
    double up_cosine = 1.0;     // of its normal
    FilmPart part{};            // shape for the wind
    double wind_height = 10.0;  // [m]
    double utc_offset = 0.0;    // [s] clock of schedules ahead of UTC
    double reference = 290.0;   // [K] near the expected temperatures
    GridOptions grid{};
    double longest_step = 600.0;      // [s]
    double tolerance = 0.002;         // [K] per step, from step doubling
    std::span<const Instant> knot{};  // ascending; no step crosses one
    std::function<PointForcing(Instant)> forcing;
    /// [W m⁻²] absorbed sun and longwave of a plate's back; none: that of surroundings at the air's
    /// temperature.
    std::function<double(Instant)> behind{};
    bool wet_behind = false;  // evaporates as the front does, without standing water
};

/// Of fresh snow: the material's own, or that of snowfall on it.
double new_snow_albedo(const ThermalSurface& surface);

/// A facet that needs more than a linear column and a dry or evenly wet surface, stepped through
/// the weather: the column's state, the water and snow on it, and the step control. Used by the
/// point tool, and by the facet solver for materials that need it (thermal/solve/point_facets.hpp).
class PointFacet {
 public:
    explicit PointFacet(PointSetup setup);

    /// Steps of SDIRK2, each as two halves, and once as a whole for the error estimate. Returns the
    /// heat that melted snow or frost [J m⁻²]. `steps` receives the chosen steps; `map` is
    /// multiplied by the linearised span. Throws std::runtime_error with the instant if the
    /// equations need too many steps.
    double advance(Instant from, Instant to, std::vector<double>* steps = nullptr,
                   Eigen::MatrixXd* map = nullptr);
    /// Repeats the same steps.
    void repeat(Instant from, const std::vector<double>& steps, Eigen::MatrixXd& map);
    /// The span in steps of `longest_step`, without error control: a third of the time. `restart`
    /// begins with 10 s, for use after a jump; a step that does not converge is halved.
    void march(Instant from, Instant to, bool restart, Eigen::MatrixXd* map = nullptr);
    /// [K] the largest change of any node since the state `start`.
    double change_since(const std::vector<double>& start) const;
    /// Moves the state by (I − map)⁻¹ times the change since `start`: Newton on the periodic map.
    /// Returns the largest move [K].
    double close_period(const std::vector<double>& start, const Eigen::MatrixXd& map);
    void keep_in_bounds();
    /// Resets snow to its initial age, before a span is repeated.
    void renew_snow() { snow_albedo_ = new_snow_albedo(setup_.surface); }
    double snow_albedo() const { return snow_albedo_; }
    void set_snow_albedo(double albedo) { snow_albedo_ = albedo; }
    /// Takes over state and step length of a facet with the same column.
    void go_on_from(const PointFacet& other);

    /// Conditions at the end of the last step, and the flux into its column there [W m⁻²].
    struct Ending {
        SurfaceTerms terms{};
        double taken = 0.0;
    };
    const Ending& ending() const { return ending_; }

    SurfaceConditions conditions(Instant when, const Standing& lying, double snow_albedo) const;
    SurfaceTerms terms(Instant when) const;

    struct Count {
        long long steps = 0, rejected = 0;
        int limited = 0;
        /// Steps that did not converge at any length and were skipped; and the first of them.
        int unsolved = 0;
        Instant first_unsolved{};
        /// |stored − in| over the sum of the magnitudes of all fluxes times the step and of the
        /// nodes' gains and losses; the largest of any step.
        double worst_closure = 0.0;
    };

    NonlinearColumn column;
    std::vector<double> u;  // (node), see NonlinearColumn
    Standing standing;
    WaterCount water;  // since construction
    Count count;

 private:
    /// All state that a step changes.
    struct State {
        std::vector<double> u{}, rest{};  // (node) and its part below double precision
        Standing standing;
        WaterCount water;
        StoreRates rates;  // of the last step
        double snow_albedo = 0.0;
    };
    State state() const { return {u, rest_, standing, water, rates_, snow_albedo_}; }
    void take(const State& state);
    struct Taken {
        NonlinearColumn::Step step;
        double melted = 0.0;       // [J m⁻²]
        double duration = 0.0;     // [s]
        SurfaceConditions last{};  // at its end
    };
    struct Ends {
        std::array<Boundary, 2> top, back;  // (stage); no back: the column's own bottom
    };
    Ends ends(const std::array<SurfaceConditions, 2>& conditions,
              const std::array<Instant, 2>& when) const;
    /// One step of SDIRK2 from `at` seconds after `from`.
    Taken half_step(Instant from, double at, double step, bool gentle, State& state,
                    Eigen::MatrixXd* map) const;
    StoreFlows flows_of(const std::array<SurfaceConditions, 2>& conditions, const Taken& taken,
                        const Lying& lying, bool gentle) const;
    void age_snow(const Taken& taken, double snow, State& state) const;
    /// A possible step: its two halves, their result, and its difference from the whole
    /// step.
    struct Trial {
        Taken first, second;
        State whole, middle, end;
        double error = 0.0;  // [K]
    };
    double step_within(double limit) const;
    [[noreturn]] void give_up(Instant when, double step, double error) const;
    void try_step(Instant from, double at, double step, bool gentle, const State& begin,
                  Trial& trial) const;
    void march_step(Instant from, double at, double step, int depth, Eigen::MatrixXd* map);
    void count_closure(const Taken& taken, const State& before, const State& after);
    Eigen::VectorXd until_melted(const std::vector<double>& start,
                                 const Eigen::VectorXd& drift) const;

    PointSetup setup_;
    double next_step_ = 0.05;   // [s]
    double next_march_ = 10.0;  // [s]
    long long tried_ = 0;       // steps of advance(), accepted or not
    double granted_ = 0.0;      // limit for the spans so far
    StoreRates rates_;          // of the last step
    std::vector<double> rest_;  // (node) of u
    StoreCapacity capacity_;
    double snow_albedo_;  // of ageing snow, or of snow on the store
    Ending ending_;
};

/// The grid of a point's column: fine enough for a one-minute shock, and never cut off.
GridOptions point_grid(const ThermalSurface& surface);

}  // namespace diurna
