#pragma once

#include <memory>
#include <vector>

#include "thermal/network/network_step.hpp"
#include "thermal/solve/network_period.hpp"
#include "thermal/solve/network_surroundings.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// The targets of a scene (SolveInput::network): each is a network that is stepped as a whole, with
/// the sun, sky and neighbours of its facets; the blocks only provide a first guess of its start.
/// Steps of SolveOptions::step, second order: five minutes at most, or ten where temperatures
/// change evenly (second differences below 0.02 K rms), while neighbours still change, and on days
/// that only lead to the span. Sunlight that jumps within a step counts by its mean. Without rain
/// and dew.
class NetworkFacets {
 public:
    /// - near: the solve starts from temperatures of a similar day
    NetworkFacets(const SolveState& solve, bool near);

    /// After a pass of the blocks: runs all networks whose surroundings have changed, and stores
    /// their temperatures in the solve, at the level's instants.
    void pass(SolveState& solve, const Level& level);
    /// [W m⁻²] largest change of neighbours' heat since the last run.
    double moved() const;
    /// Stores their temperatures again, after updates by neighbours.
    void put(SolveState& solve) const;

    /// Starts from the end state of another solve of the same targets.
    void set_out_from(const std::vector<std::vector<double>>& left);
    std::vector<std::vector<double>> left() const;

    struct Summary {
        double residual = 0.0;  // [K] |P(T) − T|
        double error = 0.0;     // [K] effect of the neighbours' changes since the last run
        double worst_closure = 0.0;
        int limited = 0;
        std::string first_limited{};  // target with the first limited step
        std::size_t facets = 0;
    };
    Summary summary() const;
    /// Whether another pass would change no more than so much [K].
    bool at_rest(double limit) const;

 private:
    struct Target {
        const NetworkObject* object;
        std::size_t level = 1, stride = 1;           // of the last run, and of its steps
        std::vector<int> parts{};                    // (step) equal parts of it
        std::vector<float> kelvin{}, back_kelvin{};  // (instant of that, facet)
        std::vector<float> excess{};                 // (instant of that, facet, side) input
        std::vector<double> start{}, end{};          // [K] nodes, then lumps
        double residual = 0.0;                       // [K] |P(T) − T|
        double move = 0.0;                           // [K] of the start after it
        NetworkCourse course{};                      // of the last run
        std::unique_ptr<NetworkStepper> stepper{};   // with its factors, from run to run
        std::unique_ptr<NetworkPeriod> period{};
        NetworkCount count{};
        bool closed = false;  // may have been the last run
    };
    void run(const Level& level, Target& target) const;
    /// - longest: [s] of a part of a step, where temperatures bend
    void march(double longest, NetworkSurroundings& around, NetworkStepper& stepper,
               NetworkPeriod& period, Target& target) const;
    void put_down(std::size_t i, const NetworkStepper& stepper, NetworkSurroundings& around,
                  Target& target) const;
    void guess(const Target& target, NetworkSurroundings& around, NetworkStepper& stepper) const;
    double moved(const Target& target) const;
    double error(const Target& target) const;
    bool rests(const Target& target, double limit) const;

    const SolveState& solve_;
    const bool near_;
    std::vector<Target> target_;
};

}  // namespace diurna
