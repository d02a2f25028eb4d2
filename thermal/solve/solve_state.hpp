#pragma once

#include <Eigen/QR>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "thermal/solve/air_tiers.hpp"
#include "thermal/solve/facet_exchange.hpp"
#include "thermal/solve/solve_input.hpp"
#include "thermal/steppers/material_column.hpp"
#include "thermal/steppers/mode_batch.hpp"
#include "thermal/steppers/plate_batch.hpp"
#include "thermal/weather/sky_series.hpp"

namespace diurna {

// What a solve works on: its facets in blocks of one material, stepped over the span in passes.

/// A block's span to first order: (I − M)⁻¹ of the derivative M of its period map, and what a
/// kelvin of each of its start's states does to the surface, (instant, state). Under the block's
/// mean slopes, and under ones steeper by a quarter: a facet's own lies on the straight line.
struct PeriodMap {
    using Factors = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;
    Factors mean, steeper;
    Eigen::MatrixXd follow_mean, follow_steeper;
};

/// Facets of one material and their state at the start of the span: up to `lanes` of them where
/// columns are layered, up to `mode_lanes` in modes.
struct Block {
    std::size_t material;  // index into SolveState::material
    std::size_t stride;    // lanes of the block, used or not
    std::vector<std::size_t> facet;
    std::vector<std::size_t> behind{};  // [lane] the facet that is its back; empty: none has one
    std::vector<NaturalFilm> natural;
    bool sheltered = false;  // ground that has less wind than is measured
    std::size_t tier = 0;    // AirTiers::low of all its facets
    std::vector<double> up;  // [lane] AirTiers::share; empty where there is one tier
    double mean_up = 0.0;    // of all lanes: layered columns and plates have one air a block
    /// Jumps of incident sunlight, those of step i from (step + 1) of[i] to of[i + 1].
    struct Jumps {
        std::vector<HeatJump> jump;
        std::vector<std::uint32_t> of;
    };
    Jumps front{}, back{};
    std::vector<double> start, change;  // [state][lane] relative; change over the last pass. States
                                        // are nodes' temperatures, or the open column's modes
    std::vector<double> move, planned;  // [state][lane] of the start after the pass before: what
                                        // was done, and what the material's matrix alone would do
    double residual = 1e9;              // [K] largest of `change`
    double heat_change = 1e9;           // [W m⁻²] of the terrain's longwave since the last run;
    double unfollowed = 0.0;            // of that, what temperatures were not moved by;
    double warmed = 1e9;                // [K] what they were moved by
    double relit = 0.0;         // [W m⁻²] that sunlight has changed by since the last run
    double largest_move = 1e9;  // [K] of `move`
    double nudge = 0.0;         // [K] what neighbours moved the start by since
    bool rests = false;         // skipped of the last pass
    std::optional<PeriodMap> period{};  // linearised about a run
    double film = 0.0;          // [W m⁻² K⁻¹] −Σ over facets of the first guess's slope
    StepRecord record;          // of the last run
    std::vector<double> slope;  // like Kind::forcing: Σ over facets, of the last run
    std::vector<double> back_slope;  // of plates' backs
    std::vector<double> steepness;   // [lane] Σ over the span of its own slopes, faces together

    /// Running it again would change nothing that counts: 0.05 W/m² of longwave are 3 mK. Of a
    /// span that does not repeat, what it was moved by to first order is exact enough where it is
    /// no more than neighbours' heat may be worth in the end (on the default scene's second and
    /// third day 0.0003 K rms from a run again, 0.013 K at the most).
    bool settled(const SolveOptions& options) const {
        if (relit > 0.05) return false;
        if (!options.periodic) return warmed <= options.settled && unfollowed <= 0.05;
        return residual <= options.tolerance && largest_move <= 0.01 && heat_change <= 0.05;
    }
    /// It has run on this level: there are slopes to go by.
    bool has_run() const { return !slope.empty(); }
};

/// States of a block where they lie, (state, lane), `stride` lanes from one state to the next.
using BlockStates =
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>, 0,
               Eigen::OuterStride<>>;

struct StageForcing {
    AirFilm air;
    double sky_longwave;
};

/// A material's column as modes.
struct ModeColumn {
    ReducedColumn reduced;
    Eigen::MatrixXd probe;  // (place, mode) temperature at some depths of the open column's states
    ClosedColumn closed{};
    ModeStep step{};
};

/// On the straight line between the forcings of two tiers.
StageForcing between(const StageForcing& low, const StageForcing& high, double up);

/// One material of the scene with the forcing its facets share at the heights of the solve's tiers.
/// Layered columns have two stages to a substep; modes, those of plates too, have one instant at
/// the end of each, and one at the start of the span.
struct Kind {
    MaterialColumn column;
    std::optional<ModeColumn> modes{};
    std::optional<PlateStep> plate{};   // its states are nodes, as those of layered columns
    std::size_t times = 0;              // of the forcing
    std::vector<StageForcing> forcing;  // (tier, time); times are (step, substep, stage) or
                                        // (instant)
    std::vector<StageForcing> in_lee;   // the same for sheltered ground; empty where there is none
    std::vector<double> slope;          // (time) mean surface slope, last pass
    std::vector<double> back_slope;     // of plates
    std::size_t facets = 0;
    double measured_share = 0.0;  // SolveInput::measured_share

    /// Of the block's tier at a time; of the tier above it; of the middle of its facets.
    const StageForcing& low(const Block& block, std::size_t time) const {
        return at(block, block.tier, time);
    }
    const StageForcing& high(const Block& block, std::size_t time) const {
        return at(block, block.tier + (block.up.empty() ? 0 : 1), time);
    }
    const StageForcing& at(const Block& block, std::size_t tier, std::size_t time) const {
        return (block.sheltered ? in_lee : forcing)[tier * times + time];
    }
    StageForcing middle(const Block& block, std::size_t time) const {
        return block.up.empty() ? low(block, time)
                                : between(low(block, time), high(block, time), block.mean_up);
    }
    /// The air over a block's lanes.
    AirOver over(const Block& block, std::size_t time) const {
        if (block.up.empty()) return low(block, time).air;
        return {low(block, time).air, high(block, time).air, block.up.data()};
    }
};

/// Whether a material's facets are stepped in modes.
inline bool in_modes(const SolveOptions& options, const ThermalSurface& surface) {
    return options.method == Method::modes && !surface.back;
}

/// A way to step the span: every `stride` instants at once.
struct Level {
    std::size_t stride = 1;
    std::vector<Kind> kind;
};

class HeatRecord;

/// How SolveState::changing last moved, like ChangingAlbedo::albedo: how far it was from what was
/// found under it, and what it was moved by.
struct AlbedoMove {
    std::vector<float> residual{}, move{};
};

struct SolveState {
    const SolveInput& input;
    const SolveOptions& options;
    const SkySeries& series;
    std::vector<Instant> instant;  // = step_instants(options)
    double step;                   // [s]
    std::size_t facets;
    std::size_t counted;  // of these, the first, by which it is judged; others: SolveInput::beside
    AirTiers tiers;
    FacetOptics optics;
    std::vector<std::uint32_t> other_side;  // terrain/visibility/two_sides.hpp
    std::vector<SkyState> sky;              // (instant) at the weather's height
    std::vector<SkyState> tier_sky;         // (instant, tier); empty where there is one tier
    std::vector<float> sunlight;            // (instant, facet) incident
    std::vector<float> excess;  // (instant, facet) terrain longwave; empty without exchange
    std::vector<float> tilt;    // (facet) tilted_sky_excess; empty where the sky is even
    std::vector<float> kelvin;  // (instant, facet)
    ChangingAlbedo changing{};  // of facets under snow or wet, as `sunlight` goes by it
    AlbedoMove albedo_move{};
    std::vector<float> relit{};  // (facet) [W m⁻²] likewise Block::relit; empty: none has been
    std::vector<Block> block;
    std::vector<bool> in_network;  // (facet) a target's; empty where there is none
    HeatRecord* record = nullptr;  // of the pass on its way, if it is to be taken down

    /// Instants, step and optics; light, temperatures and blocks follow. All must outlive it.
    SolveState(const SolveInput& given, const SolveOptions& how, const SkySeries& sky_series);

    std::size_t steps() const { return instant.size() - 1; }
    /// A flux of the sky at an instant, at a facet's height.
    double at_facet(double SkyState::*flux, std::size_t i, std::size_t f) const {
        if (tiers.flat()) return sky[i].*flux;
        const SkyState* const low = &tier_sky[i * tiers.size() + tiers.low[f]];
        return std::lerp(low[0].*flux, low[1].*flux, double(tiers.share[f]));
    }
    /// What a facet's part is to the wind.
    FilmPart part_of(std::size_t f) const {
        return input.part.empty() ? FilmPart{} : input.part[f];
    }
    /// Whether its facets are a target's, which NetworkFacets solves.
    bool of_target(const Block& of) const {
        return !in_network.empty() && in_network[of.facet.front()];
    }
    /// Whether its facets are beside those that count.
    bool is_beside(const Block& of) const { return of.facet.front() >= counted; }
    /// Whether a facet is the back of another, whose column is its too.
    bool is_back(std::size_t f) const {
        return !other_side.empty() && other_side[f] != index(no_facet) &&
               input.materials[input.facets.material[f]].thermal.layers.empty();
    }
    /// Whether it is this facet, and no copy of it that a texture made, that its back is like.
    bool has_back(std::size_t f) const {
        return !other_side.empty() && other_side[f] != index(no_facet) && is_back(other_side[f]);
    }
    std::span<float> row(std::vector<float>& field, std::size_t i) const {
        return {field.data() + i * facets, facets};
    }
};

/// [s] of a level's step
inline double level_step(const SolveState& solve, const Level& level) {
    return solve.step * double(level.stride);
}

/// Share of sunlight that a material takes in at an instant.
double absorptance_at(const SolveState& solve, const Kind& kind, std::size_t i);
/// The fronts of a block's facets at an instant, or their backs.
struct BlockFace {
    std::span<const std::size_t> facet;
    double absorptance, emissivity, internal;
    bool wet = false;  // of backs: they evaporate as the fronts do
};
BlockFace front_of(const SolveState& solve, const Block& block, const Kind& kind, std::size_t i);
BlockFace back_of(const SolveState& solve, const Block& block);
/// Heat [lane], all of the block's, at an instant that differs from facet to facet: sun, terrain
/// longwave, internal.
void facet_heat(const SolveState& solve, const Block& block, const BlockFace& face, std::size_t i,
                double* heat);

/// Puts down a block's surface temperatures [lane] at an instant, and those of its backs.
void put_kelvin(SolveState& solve, const Block& block, std::size_t i, const double* temperature,
                const double* behind = nullptr);

/// The jumps of a face's sunlight in the step that ends at instant i; none on coarse levels.
std::span<const HeatJump> edges_of(const Level& level, const Block::Jumps& jumps, std::size_t i);

/// Adds to a block's temperatures [K], (instant of the level, facet of the block); to those of its
/// backs as much, or what is given.
void warm(SolveState& solve, const Level& level, const Block& block, const Eigen::MatrixXd& warmer,
          const Eigen::MatrixXd* behind = nullptr);

}  // namespace diurna
