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

/// What reaches a facet at one instant, whatever its own state answers.
struct PointForcing {
    AirState air;  // as the surface meets it
    double wind_speed = 1.0;
    double rain_mm_h = 0.0;
    double sunlight = 0.0;         // [W m⁻²] incident
    double own_light = 0.0;        // [W m⁻²] the same from ground like itself, per unit albedo
    double albedo = not_measured;  // measured, in place of the material's
    double longwave_in = 0.0;      // [W m⁻²] irradiance from sky and other facets
    double own_view = 0.0;         // of ground as warm as the facet itself, 0 to 1
};

/// A facet and how it is stepped. `surface`, `louis` and `knot` must outlive the PointFacet.
struct PointSetup {
    const ThermalSurface& surface;
    const LouisForm& louis;
    double up_cosine = 1.0;     // of its normal
    FilmPart part{};            // to the wind
    double wind_height = 10.0;  // [m]
    double utc_offset = 0.0;    // [s] that the clock of schedules is ahead of UTC
    double reference = 290.0;   // [K] a temperature near those to come
    GridOptions grid{};
    double longest_step = 600.0;      // [s]
    double tolerance = 0.002;         // [K] per step, from step doubling
    std::span<const Instant> knot{};  // ascending; no step passes over one
    std::function<PointForcing(Instant)> forcing;
    /// [W m⁻²] absorbed sun and longwave of a plate's back; none: that of surroundings as warm as
    /// the air.
    std::function<double(Instant)> behind{};
    bool wet_behind = false;  // it evaporates as the front does, but for water that stands there
};

/// Of snow before it has aged: the material's own, or that of what falls on it.
double new_snow_albedo(const ThermalSurface& surface);

/// A facet that needs more than a linear column and a dry or evenly wet surface, on its way through
/// the weather: the column's state, what stands on it, and how it steps. The point tool's engine,
/// and the facet solver's where a material asks for it (thermal/solve/point_facets.hpp).
class PointFacet {
 public:
    explicit PointFacet(PointSetup setup);

    /// Steps of SDIRK2 twice over its halves; once over its whole, for the error it is chosen by.
    /// Returns the heat that melted snow or frost [J m⁻²]. `steps` takes down the steps chosen;
    /// `map` carries the linearised span along. Throws std::runtime_error, which says when, where
    /// the equations ask for so many steps that no end is in sight.
    double advance(Instant from, Instant to, std::vector<double>* steps = nullptr,
                   Eigen::MatrixXd* map = nullptr);
    /// The same steps again.
    void repeat(Instant from, const std::vector<double>& steps, Eigen::MatrixXd& map);
    /// The span in steps of `longest_step`, their error unchecked: a third of the work. `restart`
    /// begins with 10 s, for after a jump; a step whose equations are not solved is halved.
    void march(Instant from, Instant to, bool restart, Eigen::MatrixXd* map = nullptr);
    /// [K] the largest of any node since the column's state was `start`.
    double change_since(const std::vector<double>& start) const;
    /// Moves the state by (I − map)⁻¹ times the change since `start`: Newton on the periodic map.
    /// Returns the largest move [K].
    double close_period(const std::vector<double>& start, const Eigen::MatrixXd& map);
    void keep_in_bounds();
    /// Snow as old as at the beginning: before a span is gone through again.
    void renew_snow() { snow_albedo_ = new_snow_albedo(setup_.surface); }
    double snow_albedo() const { return snow_albedo_; }
    void set_snow_albedo(double albedo) { snow_albedo_ = albedo; }
    /// Takes over the state of a facet of the same column, and how long its steps were.
    void go_on_from(const PointFacet& other);

    /// What the last step met at its end, and what its column took there [W m⁻²].
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
        /// Steps that no halving solved: nothing moved in them; and when the first began.
        int unsolved = 0;
        Instant first_unsolved{};
        /// |stored − in| over the magnitudes of all fluxes times the step and of what the nodes
        /// gained or lost; of any step.
        double worst_closure = 0.0;
    };

    NonlinearColumn column;
    std::vector<double> u;  // (node), see NonlinearColumn
    Standing standing;
    WaterCount water;  // since it was made
    Count count;

 private:
    /// All that a step changes.
    struct State {
        std::vector<double> u{}, rest{};  // (node) and what its doubles do not hold
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
    /// A step that may be taken: its halves, where they lead, and how far the whole leads
    /// elsewhere.
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
    long long tried_ = 0;       // steps of advance(), good or not
    double granted_ = 0.0;      // for the spans it has gone through
    StoreRates rates_;          // of the last step
    std::vector<double> rest_;  // (node) of u
    StoreCapacity capacity_;
    double snow_albedo_;  // of snow that ages, or lies on the store
    Ending ending_;
};

/// The grid of a point's column: fine enough for a minute's shock, and never cut off.
GridOptions point_grid(const ThermalSurface& surface);

}  // namespace diurna
