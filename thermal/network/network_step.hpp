#pragma once

#include <functional>
#include <vector>

#include "thermal/network/network_course.hpp"
#include "thermal/network/network_system.hpp"

namespace diurna {

/// Heat input of a network at an instant that does not depend on its temperatures.
struct NetworkLoads {
    std::vector<double> outer, inner;  // (facet) [W m⁻²] into its ends: sources, sun through panes
    std::vector<double> lump;          // [W]
    std::vector<double> fixed;         // (lump) [K] of lumps with a given temperature
};

/// Exchange of facets' outer ends, and of inner ends in the open, with the surroundings at
/// temperatures (facet): heat into them [W m⁻²] and d/dT. Zero for ends without exchange.
struct FaceFluxes {
    std::vector<double> outer, outer_slope, inner, inner_slope;
};

/// Time of a stage in its step, 0 to 1.
struct NetworkForcing {
    std::function<void(double share, NetworkLoads& loads)> loads;
    /// outer, inner  (facet) [K]
    std::function<void(double share, const std::vector<double>& outer,
                       const std::vector<double>& inner, FaceFluxes& fluxes)>
        faces;
    /// Adds to `fluxes` the heat from gas at the temperatures of lumps (lump) [K].
    std::function<void(double share, const std::vector<double>& outer,
                       const std::vector<double>& inner, const std::vector<double>& lump,
                       FaceFluxes& fluxes)>
        jets{};
};

struct NetworkCount {
    long stages = 0, newton = 0, linear = 0;
    int limited = 0;             // stages that did not converge, or exceeded 5000 K
    double worst_closure = 0.0;  // Σ |residual| over Σ |terms| of a stage
};

/// Steps a network: SDIRK2 (Alexander 1977; thermal/column/column.hpp), each stage by Newton's
/// method to a residual of `closed` of the heat flow, so that energy is conserved at any step.
class NetworkStepper {
 public:
    explicit NetworkStepper(const HeatNetwork& network);

    /// The state at the start of a step, replaced by that at its end.
    NetworkState state;
    NetworkCount count;
    double closed = 4e-9;
    /// Whether a stage ends with a look at what its residual is; else it may end where Newton's
    /// next step is sure to be within `closed`, and counts as that.
    bool confirmed = true;
    /// Of an earlier march, for the guesses of this one; null: none. Its step must have begun.
    NetworkCourse* course = nullptr;

    /// Sets all to one temperature.
    void settle(double kelvin);
    /// Discards the history of the state: a new integration begins.
    void begin();
    void advance(double step, const NetworkForcing& forcing);
    /// The facets' ends (facet) [K].
    void ends(std::vector<double>& outer, std::vector<double>& inner) const;
    const NetworkSystem& system() const { return system_; }
    /// Those of the last stage.
    NetworkSystem::Ends slopes() const {
        return {faces_.outer_slope, faces_.inner_slope, to_star_};
    }

 private:
    void stage(double tau, double share, const NetworkForcing& forcing, const NetworkState& start);
    double facet_residual(std::size_t f, std::size_t block, double tau, const NetworkState& start);
    double residual(double tau, const NetworkState& start);
    void guess(const NetworkState& since, double onward);
    void guessed_stage(double tau, double share, const NetworkForcing& forcing,
                       const NetworkState& start);

    const HeatNetwork& network_;
    NetworkSystem system_;
    NetworkSystem::Residual missing_;
    NetworkSystem::Given given_;
    std::vector<double> flowing_;  // (block of facets) [W]
    NetworkState before_{};        // previous step
    NetworkState guess_{};         // of a stage, without its course
    double last_step_ = 0.0;       // [s]; 0: no step yet
    NetworkLoads loads_;
    FaceFluxes faces_;
    std::vector<double> outer_, inner_, to_star_;
};

}  // namespace diurna
