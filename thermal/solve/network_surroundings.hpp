#pragma once

#include <cstdint>
#include <vector>

#include "thermal/network/network_step.hpp"
#include "thermal/solve/blown_faces.hpp"
#include "thermal/solve/network_object.hpp"
#include "thermal/solve/own_longwave.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// What a target's facets meet over a span: air, sun, sky, neighbours, its own sources.
class NetworkSurroundings {
 public:
    /// All must outlive it.
    ///
    /// stride  instants of the solve from step to step: the level's, or a multiple
    NetworkSurroundings(const SolveState& solve, const Level& level, const NetworkObject& object,
                        std::size_t stride);

    /// Instants of steps, i of which is SolveState's i × stride.
    std::size_t steps() const { return solve_.steps() / stride_; }
    std::size_t instant(std::size_t i) const { return i * stride_; }

    /// What step i brings in its part s of `parts`. Steps are asked for one after the other; it
    /// holds until the next is.
    NetworkForcing of_part(std::size_t i, int s, int parts);
    /// What the span brings in its mean: instants' light and air, sources by their hours.
    NetworkForcing of_mean();
    /// [K] of the air in the span's mean.
    double mean_air() const { return outdoors_.back(); }

    /// A march sets out; it has come to the start of step i at such temperatures of its facets'
    /// ends [K]: what its faces send one another goes by them until the next.
    void begin() { own_.begin(); }
    void follow(std::size_t i, const std::vector<double>& outer, const std::vector<double>& inner) {
        own_.at(instant(i), outer, inner);
    }
    /// Longwave of neighbours that it goes by at such an instant [W m⁻²]: of all outer faces, then
    /// of the other sides.
    void excess(std::size_t i, std::vector<float>& all) const;

    /// Takes down the balances of all faces at the level's instant i, if that is wanted.
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
        bool in_air = false;  // surroundings as warm as the air
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
        double heat;  // [W m⁻²] that the step's mean has more than its ends tell
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
    std::size_t first_ = 0, last_ = 0;          // instants between which the step lies
    double from_ = 0.0, to_ = 1.0;              // of the step, the part on its way
    Instant begin_{}, end_{};                   // of that part
    std::vector<double> before_[2], after_[2];  // (end)(facet) [W m⁻²] absorbed at the step's ends
};

}  // namespace diurna
