#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "thermal/solve/packed_field.hpp"
#include "thermal/solve/solve_state.hpp"

/// The longwave that facets send one another at given temperatures. What it warms is found by
/// thermal/solve/longwave_exchange.hpp.
namespace diurna {

/// Memory that the exchanges of a solve reuse.
struct ExchangeRoom {
    PackedField moved{};  // what arrives at facets, or leaves them
    // of a few runs of instants, (facet, instant): the exchange computes them together
    std::vector<float> leaving{};
};

/// What arrives at facets and what they send on, at the instants of a level or, where the excess is
/// linear between some of them, at these. Between the steps of
/// the exchange a facet has one or the other, in `moved`: what has arrived in the last step, until
/// follow() makes of it what leaves.
struct MovedLongwave {
    ExchangeRoom& room;
    std::size_t used;                  // instants
    std::size_t apart;                 // steps of the level from one of these to the next
    std::vector<float> most;           // (facet) largest of what has arrived
    std::vector<std::uint8_t> sends;   // (facet) 1 where what leaves may be large enough to send
    std::vector<float> itself;         // (facet) share of its own like that it sees
    std::vector<std::uint8_t> leaves;  // (facet) 1 where `moved` is what leaves
    std::vector<std::uint32_t> back;   // (facet) place in `of_back` of backs; empty: no backs
    PackedField of_back{};             // what more leaves backs, which two blocks may read
    bool unsent = true;                // what has arrived is still to be reflected
    float open = 1.0f;  // 1 − the greatest share of longwave that comes back from a facet
    /// What arrives for each W m⁻² of others', to and fro between a facet and its own like.
    float to_and_fro(std::size_t f, float reflectance) const {
        return 1.0f / std::max(0.01f, 1.0f - itself[f] * reflectance);
    }
    PackedField& moved() { return room.moved; }
    const PackedField& moved() const { return room.moved; }
    /// Temperatures of a facet at as many of these instants as `chosen` holds, from the slot'th on,
    /// the first of a run.
    ///
    /// - all: for all of the level's instants
    const float* kelvin_of(const SolveState& solve, std::size_t f, std::size_t slot,
                           std::vector<float>& all, std::vector<float>& chosen) const;
    bool is_back(std::size_t f) const { return !back.empty() && back[f] != no_back; }
    static constexpr std::uint32_t no_back = 0xFFFFFFFFu;
};

/// Largest absolute value.
float largest(std::span<const float> x);
/// What leaves a facet in a run of instants.
void leaving_of(const SolveState& solve, const MovedLongwave& field, std::size_t run, std::size_t f,
                float* out);
/// Adds to a facet's values in a run of instants.
void add_to(PackedField& values, std::size_t run, std::size_t f, const float* more);

/// Recomputes all of the longwave, a few runs of instants at a time. `moved` becomes what arrives
/// now less what did before; nothing where that is within a step of how it is stored. The sky of a
/// facet's own height stands above it: what leaves is reported beyond the sky at the weather's
/// height, what arrives beyond that at its own.
void recompute_longwave(SolveState& solve, const Level& level, MovedLongwave& field);

/// Which facets send on what is reflected of the change; what of that comes back from a facet's own
/// like is taken in at once.
void reflect_longwave(SolveState& solve, float least, MovedLongwave& field);

/// Carries what leaves the facets to those that see it, and on from there as they reflect it, in so
/// many sweeps or until less than `least` [W m⁻²] would be added: `moved` becomes what arrives, and
/// the excess grows by it. Reports whether any is left to be reflected that counts.
bool send_longwave(SolveState& solve, float least, int sweeps, MovedLongwave& field);

}  // namespace diurna
