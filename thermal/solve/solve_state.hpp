#pragma once

#include <Eigen/QR>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "thermal/solve/air_tiers.hpp"
#include "thermal/solve/facet_exchange.hpp"
#include "thermal/solve/packed_field.hpp"
#include "thermal/solve/solve_input.hpp"
#include "thermal/steppers/material_column.hpp"
#include "thermal/steppers/mode_batch.hpp"
#include "thermal/steppers/plate_batch.hpp"
#include "thermal/weather/sky_series.hpp"

namespace diurna {

// Working data of a solve: its facets in blocks of one material, stepped over the span in passes.

/// A block's span to first order: (I − M)⁻¹ of the derivative M of its period map, and the effect
/// on the surface of a kelvin in each of its start's states, (instant, state). Under the block's
/// mean slopes, and under slopes steeper by a quarter; a facet's own is interpolated.
struct PeriodMap {
    using Factors = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;
    Factors mean, steeper;
    Eigen::MatrixXf follow_mean, follow_steeper;
};

/// Facets of one material and their state at the start of the span: up to `lanes` of them where
/// columns are layered, up to `mode_lanes` in modes.
struct Block {
    std::size_t material;  // index into SolveState::material
    std::size_t stride;    // lanes of the block, used or not
    std::vector<std::size_t> facet;
    std::vector<std::size_t> behind{};  // [lane] the facet that is its back; empty: no backs
    bool sheltered = false;             // ground with less than the measured wind
    std::size_t tier = 0;               // AirTiers::low of all its facets
    std::vector<double> up;             // [lane] AirTiers::share; empty with one tier
    double mean_up = 0.0;  // of all lanes: layered columns and plates have one air a block
    /// Jumps of incident sunlight: those of step i are from (step + 1) of[i] to of[i + 1].
    struct Jump {
        std::uint32_t lane;
        float share, heat;  // of the step, 0 to 1; [W m⁻²] size of the jump
    };
    struct Jumps {
        std::vector<Jump> jump;
        std::vector<std::uint32_t> of;
    };
    Jumps front{}, back{};
    std::vector<double> start;         // [state][lane] relative. States are nodes' temperatures, or
                                       // the open column's modes
    std::vector<float> change;         // over the last pass
    std::vector<float> move, planned;  // [state][lane] of the start after the previous pass: made,
                                       // and by the material's matrix alone
    double residual = 1e9;             // [K] largest of `change`
    double heat_change = 1e9;          // [W m⁻²] change of terrain longwave since the last run;
    double unfollowed = 0.0;           // part of it without correction of temperatures;
    double warmed = 1e9;               // [K] correction of temperatures
    double relit = 0.0;                // [W m⁻²] change of sunlight since the last run
    double largest_move = 1e9;         // [K] of `move`
    double nudge = 0.0;                // [K] correction of the start by neighbours since
    bool rests = false;                // skipped in the last pass
    std::optional<PeriodMap> period{};  // linearised about a run
    double film = 0.0;          // [W m⁻² K⁻¹] −Σ over facets of the first guess's slope
    StepRecord record;          // of the last run
    std::vector<double> slope;  // like Kind::forcing: Σ over facets, last run
    std::vector<double> back_slope;  // of plates' backs
    std::vector<double> steepness;   // [lane] Σ over the span of its slopes, both faces

    /// Running it again would change nothing significant: 0.05 W/m² of longwave are 3 mK. A quick
    /// solve counts with its corrections to first order, which leave a small share of them. For a
    /// span that is not periodic, first-order corrections are exact enough if they are within the
    /// final limit for neighbours' heat (on the default scene's second and third day 0.0003 K rms
    /// from another run, at most 0.013 K).
    ///
    /// - left: SolveState::left_by_pass
    bool settled(const SolveOptions& options, double left) const {
        if (relit > 0.05) return false;
        if (!options.periodic) return warmed <= options.settled && unfollowed <= 0.05;
        if (!options.quick) {
            return residual <= options.tolerance && largest_move <= options.still &&
                   heat_change <= options.still_heat;
        }
        constexpr double usual_left = 0.2;
        const double share = std::min(1.0, usual_left / left);
        return std::max(residual, largest_move) <= share * options.still &&
               heat_change <= share * options.still_heat;
    }
    /// It has run on this level, so slopes are available.
    bool has_run() const { return !slope.empty(); }
};

/// References to the states of a block, (state, lane), `stride` lanes from one state to the next.
template <class Scalar>
using StatesOf = Eigen::Map<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>,
                            0, Eigen::OuterStride<>>;
using BlockStates = StatesOf<double>;
using BlockChanges = StatesOf<float>;

struct StageForcing {
    AirFilm air;
    double sky_longwave;
};

/// A material's column as modes.
struct ModeColumn {
    ReducedColumn reduced;
    Eigen::MatrixXd probe;  // (place, mode) temperature at some depths of the open column's states
    bool quick = false;     // ModeStep::quick
    ClosedColumn closed{};
    ModeStep step{};
};

/// Interpolated between the forcings of two tiers.
StageForcing between(const StageForcing& low, const StageForcing& high, double up);

/// One material of the scene with the forcing of its facets at the heights of the solve's tiers.
/// Layered columns have two stages per substep; modes, also those of plates, have one instant at
/// the end of each, and one at the start of the span.
struct Kind {
    MaterialColumn column;
    std::optional<ModeColumn> modes{};
    std::optional<PlateStep> plate{};   // its states are nodes, as for layered columns
    std::size_t times = 0;              // of the forcing
    std::vector<StageForcing> forcing;  // (tier, time); times are (step, substep, stage) or
                                        // (instant)
    std::vector<StageForcing> in_lee;   // the same for sheltered ground; empty if there is none
    std::vector<double> slope;          // (time) mean surface slope, last pass
    std::vector<double> back_slope;     // of plates
    std::size_t facets = 0;
    double measured_share = 0.0;  // SolveInput::measured_share

    /// Forcing of the block's tier at a time; of the tier above it; of the middle of its facets.
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

/// A time resolution of the span: steps of `stride` instants.
struct Level {
    std::size_t stride = 1;
    std::vector<Kind> kind;
};

class HeatRecord;

/// Last correction of SolveState::changing, like ChangingAlbedo::albedo: the difference from the
/// value computed under it, and the correction made.
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
    std::size_t counted;  // number of first facets that count; others: SolveInput::beside
    AirTiers tiers;
    FacetOptics optics;
    std::vector<std::uint32_t> other_side;  // terrain/visibility/two_sides.hpp
    std::vector<SkyState> sky;              // (instant) at the weather's height
    std::vector<SkyState> tier_sky;         // (instant, tier); empty with one tier
    PackedField shares;       // SunExposure::fraction, of sunlit instants; empty: no shadows
    PackedField sunlight;     // incident
    PackedField excess;       // terrain longwave; empty without exchange
    std::vector<float> tilt;  // (facet) tilted_sky_excess; empty if the sky is uniform
    PackedField kelvin;
    ChangingAlbedo changing{};  // of facets with snow or water, as used in `sunlight`
    AlbedoMove albedo_move{};
    std::vector<float> relit{};  // (facet) [W m⁻²] as Block::relit; empty: no changes
    std::vector<Block> block;
    /// Share of the error that a pass and its corrections to first order leave, as passes with
    /// steps of an hour have shown; used by quick solves.
    double left_by_pass = 1.0;
    std::vector<bool> in_network;  // (facet) part of a target; empty without targets
    HeatRecord* record = nullptr;  // of the current pass, if it is to be recorded

    /// Sets instants, step and optics; light, temperatures and blocks later. All must outlive it.
    SolveState(const SolveInput& given, const SolveOptions& how, const SkySeries& sky_series);

    std::size_t steps() const { return instant.size() - 1; }
    /// A flux of the sky at an instant, at a facet's height.
    double at_facet(double SkyState::*flux, std::size_t i, std::size_t f) const {
        if (tiers.flat()) return sky[i].*flux;
        const SkyState* const low = &tier_sky[i * tiers.size() + tiers.low[f]];
        return std::lerp(low[0].*flux, low[1].*flux, double(tiers.share[f]));
    }
    /// Shape and size of a facet's part for the wind.
    FilmPart part_of(std::size_t f) const {
        return input.part.empty() ? FilmPart{} : input.part[f];
    }
    /// Whether its facets are a target's, solved by NetworkFacets.
    bool of_target(const Block& of) const {
        return !in_network.empty() && in_network[of.facet.front()];
    }
    /// Whether its facets are SolveInput::beside.
    bool is_beside(const Block& of) const { return of.facet.front() >= counted; }
    /// Whether a facet is the back of another, with the same column.
    bool is_back(std::size_t f) const {
        return !other_side.empty() && other_side[f] != index(no_facet) &&
               input.materials[input.facets.material[f]].thermal.layers.empty();
    }
    /// Whether this facet, not a copy of it for a texture, has the back.
    bool has_back(std::size_t f) const {
        return !other_side.empty() && other_side[f] != index(no_facet) && is_back(other_side[f]);
    }
};

/// The film of a facet, and of a block's, [lane].
NaturalFilm natural_film_of(const SolveState& solve, std::size_t facet);
std::vector<NaturalFilm> natural_films(const SolveState& solve, const Block& block);

/// [s] of a level's step
inline double level_step(const SolveState& solve, const Level& level) {
    return solve.step * double(level.stride);
}

/// Share of sunlight that a material absorbs at an instant.
double absorptance_at(const SolveState& solve, const Kind& kind, std::size_t i);
/// The fronts of a block's facets at an instant, or their backs.
struct BlockFace {
    std::span<const std::size_t> facet;
    double absorptance, emissivity, internal;
    bool wet = false;  // of backs: they evaporate as the fronts do
};
BlockFace front_of(const SolveState& solve, const Block& block, const Kind& kind, std::size_t i);
BlockFace back_of(const SolveState& solve, const Block& block);
/// Heat input of a block's fronts or backs, as far as it differs between facets: sun, terrain
/// longwave, internal.
class FaceHeat {
 public:
    FaceHeat(const SolveState& solve, const Block& block, std::span<const std::size_t> facets);
    /// At an instant [lane]; lanes beyond the facets have the first one's.
    ///
    /// - face: of those facets
    void at(const BlockFace& face, std::size_t i, double* heat);

 private:
    const SolveState& solve_;
    const Block& block_;
    PackedReader sunlight_;
    std::optional<PackedReader> excess_{};
};

/// Stores a block's surface temperatures, and those of its backs, from instant to instant of a
/// level.
class KelvinRecord {
 public:
    KelvinRecord(SolveState& solve, const Block& block);
    /// At the next instant, [lane].
    ///
    /// - behind: null: as the fronts
    void put(const double* temperature, const double* behind = nullptr);

 private:
    PackedWriter front_;
    std::vector<std::size_t> back_, lane_;  // backs that are those of no other, and their lanes
    std::optional<PackedWriter> behind_{};
};

/// The jumps of a face's sunlight in the step that ends at instant i; none on coarse levels.
std::span<const Block::Jump> edges_of(const Level& level, const Block::Jumps& jumps, std::size_t i);

/// Adds to a block's temperatures [K], (instant of the level, facet of the block); the same to
/// those of its backs, or the given values.
void warm(SolveState& solve, const Block& block, const Eigen::MatrixXd& warmer,
          const Eigen::MatrixXd* behind = nullptr);

}  // namespace diurna
