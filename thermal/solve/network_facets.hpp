#pragma once

#include <vector>

#include "thermal/network/network_step.hpp"
#include "thermal/solve/network_surroundings.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// The targets of a scene (SolveInput::network): each a network that is stepped as a whole, with
/// the sun, sky and neighbours of its facets. The blocks solve these facets too, as if nothing led
/// from one to the next: their first guess. Steps of SolveOptions::step, five minutes at most,
/// second order; sunlight that jumps within a step counts by its mean. Rain and dew are not
/// followed on them.
class NetworkFacets {
 public:
    explicit NetworkFacets(const SolveState& solve);

    /// After a pass of the blocks: runs all whose surroundings have changed, and puts their
    /// temperatures in the solve's.
    void pass(SolveState& solve, const Level& level);
    /// Their temperatures once more, where neighbours have moved the solve's since.
    void put(SolveState& solve) const;

    /// Begins with what another solve has left of the same targets.
    void set_out_from(const std::vector<std::vector<double>>& left);
    std::vector<std::vector<double>> left() const;

    struct Summary {
        double residual = 0.0;  // [K] |P(T) − T|
        double worst_closure = 0.0;
        int limited = 0;
        std::size_t facets = 0;
    };
    Summary summary() const;
    /// Whether another pass would change nothing that counts.
    bool at_rest() const;

 private:
    struct Target {
        const NetworkObject* object;
        std::vector<float> kelvin{}, back_kelvin{};  // (instant, facet) of the last run
        std::vector<float> excess{};                 // (instant, facet, side) under which it ran
        std::vector<double> start{}, end{};          // [K] nodes, then lumps
        double residual = 0.0;
        NetworkCount count{};
    };
    void run(const Level& level, Target& target) const;
    void march(NetworkSurroundings& around, NetworkStepper& stepper, Target& target) const;
    void guess(const Target& target, NetworkStepper& stepper) const;
    std::vector<float> excess_on(const NetworkObject& object) const;
    bool rests(const Target& target) const;

    const SolveState& solve_;
    std::vector<Target> target_;
};

}  // namespace diurna
