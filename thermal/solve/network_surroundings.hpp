#pragma once

#include <cstdint>
#include <vector>

#include "thermal/network/network_step.hpp"
#include "thermal/solve/blown_faces.hpp"
#include "thermal/solve/network_object.hpp"
#include "thermal/solve/own_longwave.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Inputs of a target's facets over a span: air, sun, sky, neighbours, its own sources.
class NetworkSurroundings {
 public:
    /// All arguments must outlive it.
    ///
    /// stride  instants of the solve per step: the level's, or a multiple
    NetworkSurroundings(const SolveState& solve, const Level& level, const NetworkObject& object,
                        std::size_t stride);

    /// Number of steps; the end of step i is SolveState's instant i × stride.
    std::size_t steps() const { return solve_.steps() / stride_; }
    std::size_t instant(std::size_t i) const { return i * stride_; }

    /// Inputs of part s of `parts` of step i. Steps must be requested in order; the result is valid
    /// until the next call.
    NetworkForcing of_part(std::size_t i, int s, int parts);
    /// Mean inputs over the span: light and air at the instants, sources by their hours.
    NetworkForcing of_mean();
    /// [K] mean air temperature of the span.
    double mean_air() const { return outdoors_.back(); }

    /// begin(): an integration starts. at(): it has reached step i with these
    /// temperatures of its facets' ends [K], which determine its faces' exchange until
    /// the next call.
    void begin() { own_.begin(); }
    void follow(std::size_t i, const std::vector<double>& outer, const std::vector<double>& inner) {
        own_.at(instant(i), outer, inner);
    }
    /// Neighbours' longwave at an instant [W m⁻²]: of all outer faces, then of the other
    /// sides.
    void excess(std::size_t i, std::vector<float>& all) const;

    /// Records the balances of all faces at the level's instant i, if requested.
    ///
    /// outer, inner  (network's facet) [K] temperatures of the ends
    /// lump          (lump) [K]
    void record(std::size_t i, const std::vector<double>& outer, const std::vector<double>& inner,
                const std::vector<double>& lump);

 private:
    /// Faces of one material under one air.
    struct Group {
        std::size_t kind;  // Level::kind
        bool inner, wet;
        bool in_air = false;  // surroundings at the air's temperature
        double emissivity, absorptance;
        double internal = 0.0;               // [W m⁻²] of the material's own, at outer ends
        std::vector<std::uint32_t> face{};   // the network's facets
        std::vector<std::uint32_t> facet{};  // of the scene
        std::vector<NaturalFilm> natural{};  // [lane], filled up
        std::vector<AirFilm> air{};          // (instant), and their mean
    };
    struct Jump {
        std::size_t step;
        std::uint32_t face;
        bool inner;
        double heat;  // [W m⁻²] mean of the step minus the mean of its ends
    };
    void add(std::size_t face, std::size_t kind, bool inner, std::vector<Group>& groups);
    void sort_faces();
    void set_airs();
    void find_jumps();
    void find_panes();
    void find_blown();
    void jets(double share, const std::vector<double>& outer, const std::vector<double>& inner,
              const std::vector<double>& lump, FaceFluxes& out) const;
    double sun_on(const Group& group, std::size_t l, std::size_t i) const;
    double longwave_on(const Group& group, std::size_t l, std::size_t i) const;
    void light_at(std::size_t i, std::vector<double> absorbed[2]) const;
    void begin_step(std::size_t i);
    NetworkForcing forcing();
    void loads(double share, NetworkLoads& to) const;
    void own_loads(NetworkLoads& to) const;
    void faces(double share, const std::vector<double>& outer, const std::vector<double>& inner,
               FaceFluxes& out) const;

    const SolveState& solve_;
    const Level& level_;
    const NetworkObject& object_;
    std::size_t stride_;
    OwnLongwave own_;
    BlownFaces blown_;
    std::vector<Group> group_;
    std::vector<Jump> jump_;
    std::vector<double> outdoors_;            // (instant, and their mean) [K]
    std::vector<std::vector<double>> panes_;  // (NetworkObject::sunlit)(instant, mean) [W] through
    static constexpr std::size_t no_step = ~std::size_t{0};
    std::size_t step_ = no_step, next_jump_ = 0;
    std::size_t first_ = 0, last_ = 0;          // instants around the step
    double from_ = 0.0, to_ = 1.0;              // the current part of the step
    Instant begin_{}, end_{};                   // of that part
    std::vector<double> before_[2], after_[2];  // (end)(facet) [W m⁻²] absorbed at the step's ends
};

}  // namespace diurna
