#pragma once

#include <functional>
#include <vector>

#include "thermal/network/network_system.hpp"

namespace diurna {

/// What a network gets at an instant, whatever its temperatures.
struct NetworkLoads {
    std::vector<double> outer, inner;  // (facet) [W m⁻²] into its ends: sources, sun through panes
    std::vector<double> lump;          // [W]
    std::vector<double> fixed;         // (lump) [K] of those that are given
};

/// What facets' outer ends, and inner ones in the open, exchange with the world at temperatures
/// (facet): heat into them [W m⁻²] and d/dT. Ends in no open have zeros.
struct FaceFluxes {
    std::vector<double> outer, outer_slope, inner, inner_slope;
};

/// Where in its step a stage stands, 0 to 1.
struct NetworkForcing {
    std::function<void(double share, NetworkLoads& loads)> loads;
    /// outer, inner  (facet) [K]
    std::function<void(double share, const std::vector<double>& outer,
                       const std::vector<double>& inner, FaceFluxes& fluxes)>
        faces;
    /// What comes to `fluxes` by gas as warm as lumps (lump) [K].
    std::function<void(double share, const std::vector<double>& outer,
                       const std::vector<double>& inner, const std::vector<double>& lump,
                       FaceFluxes& fluxes)>
        jets{};
};

struct NetworkCount {
    long stages = 0, newton = 0, linear = 0;
    int limited = 0;             // stages left unfinished, or hotter than 5000 K
    double worst_closure = 0.0;  // Σ |missing| over Σ |terms| of a stage
};

/// Steps a network: SDIRK2 (Alexander 1977; thermal/column/column.hpp), each stage by Newton's
/// method to `closed` of the heat that flows, so that energy closes at any step.
class NetworkStepper {
 public:
    explicit NetworkStepper(const HeatNetwork& network);

    /// The state from which a step sets out, and to which it leads.
    NetworkState state;
    NetworkCount count;
    double closed = 4e-9;

    /// All at one temperature.
    void settle(double kelvin);
    /// Forgets the way that led to the state: a new one begins.
    void begin();
    void advance(double step, const NetworkForcing& forcing);
    /// The facets' ends (facet) [K].
    void ends(std::vector<double>& outer, std::vector<double>& inner) const;
    const NetworkSystem& system() const { return system_; }
    /// Of the last stage.
    NetworkSystem::Ends slopes() const {
        return {faces_.outer_slope, faces_.inner_slope, to_star_};
    }

 private:
    void stage(double tau, double share, const NetworkForcing& forcing, const NetworkState& start);
    double facet_residual(std::size_t f, std::size_t block, double tau, const NetworkState& start);
    double residual(double tau, const NetworkState& start);
    void guess(const NetworkState& since, double onward);

    const HeatNetwork& network_;
    NetworkSystem system_;
    NetworkSystem::Residual missing_;
    NetworkSystem::Given given_;
    std::vector<double> flowing_;  // (block of facets) [W]
    NetworkState before_{};        // a step ago
    double last_step_ = 0.0;       // [s]; 0: none was taken
    NetworkLoads loads_;
    FaceFluxes faces_;
    std::vector<double> outer_, inner_, to_star_;
};

}  // namespace diurna
