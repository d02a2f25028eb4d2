#pragma once

#include <Eigen/QR>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "thermal/column/reduced_column.hpp"
#include "thermal/solve/facet_exchange.hpp"
#include "thermal/solve/solver.hpp"
#include "thermal/steppers/layered_batch.hpp"
#include "thermal/steppers/mode_batch.hpp"
#include "thermal/steppers/plate_batch.hpp"

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
    std::size_t material;  // index into Job::material
    std::size_t stride;    // lanes of the block, used or not
    std::vector<std::size_t> facet;
    std::vector<NaturalFilm> natural;
    std::vector<HeatJump> jump;         // of incident sunlight, those of step i from
    std::vector<std::uint32_t> jumps;   // (step + 1) jumps[i] to jumps[i + 1]
    std::vector<double> start, change;  // [state][lane] relative; change over the last pass. States
                                        // are nodes' temperatures, or the open column's modes
    std::vector<double> move, planned;  // [state][lane] of the start after the pass before: what
                                        // was done, and what the material's matrix alone would do
    double residual = 1e9;              // [K] largest of `change`
    double heat_change = 1e9;           // [W m⁻²] of the terrain's longwave since the last run
    double largest_move = 1e9;          // [K] of `move`
    double nudge = 0.0;                 // [K] what neighbours moved the start by since
    bool rests = false;                 // left out of the last pass
    std::optional<PeriodMap> period{};  // linearised about a run
    double film = 0.0;          // [W m⁻² K⁻¹] −Σ over facets of the first guess's slope
    StepRecord record;          // of the last run
    std::vector<double> slope;  // like Kind::forcing: Σ over facets, of the last run
    std::vector<double> back_slope;  // of plates' backs
    std::vector<double> steepness;   // [lane] Σ over the span of its own slopes, faces together

    /// Running it again would change nothing that counts: 0.05 W/m² of longwave are 3 mK.
    bool settled(double tolerance) const {
        return residual <= tolerance && largest_move <= 0.01 && heat_change <= 0.05;
    }
};

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

/// One material of the scene with the forcing its facets share. Layered columns have two stages to
/// a substep; modes, those of plates too, have one instant at the end of each, and one at the start
/// of the span.
struct Kind {
    MaterialColumn column;
    std::optional<ModeColumn> modes{};
    std::optional<PlateStep> plate{};   // its states are nodes, as those of layered columns
    std::vector<StageForcing> forcing;  // (step, substep, stage) or (instant)
    std::vector<double> slope;          // like `forcing`: mean surface slope, last pass
    std::vector<double> back_slope;     // of plates
    std::size_t facets = 0;
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

struct Job {
    const SolveInput& input;
    const SolveOptions& options;
    std::vector<Instant> instant;
    double step;  // [s]
    std::size_t facets;
    FacetOptics optics;
    std::vector<SkyState> sky;    // (instant)
    std::vector<float> sunlight;  // (instant, facet) incident
    std::vector<float> excess;    // (instant, facet) terrain longwave; empty without exchange
    std::vector<float> tilt{};    // (facet) tilted_sky_excess; empty where the sky is even
    std::vector<float> kelvin;    // (instant, facet)
    std::vector<Block> block;

    std::size_t steps() const { return instant.size() - 1; }
    std::span<float> row(std::vector<float>& field, std::size_t i) const {
        return {field.data() + i * facets, facets};
    }
};

/// [s] of a level's step
inline double level_step(const Job& job, const Level& level) {
    return job.step * double(level.stride);
}

/// Fills the job's sunlight at every instant: sun, sky and what facets reflect.
void shine(Job& job);
/// Sunlight that jumps at the shadows' edges: what falls on the facet with the sun's whole disc
/// less what falls on it with none, times the change of the share.
void find_jumps(Job& job);
/// What each facet sees of a sky brighter towards the horizon, where any instant's is.
std::vector<float> tilts(const Job& job);

/// The materials' columns and forcing for steps of `stride` instants; modes from a finer level.
Level make_level(const Job& job, const std::vector<MaterialId>& materials, std::size_t stride,
                 int most_substeps, const Level* finer = nullptr);

/// A material's states in balance with a surface one kelvin above their reference.
Eigen::VectorXd steady_states(const Kind& kind);

/// First guess: every facet's steady state under its mean forcing over the span.
void settle(Job& job, Level& level);

/// Runs one block of a layered material, of one in modes, or of plates over the span.
void run_layered(Job& job, const Level& level, Block& block);
void run_modes(Job& job, const Level& level, Block& block);
void run_plates(Job& job, const Level& level, Block& block);

/// Share of sunlight that a material takes in at an instant.
double absorptance_at(const Job& job, const Kind& kind, std::size_t i);
/// Heat [lane], all of the block's, at an instant that differs from facet to facet: sun, terrain
/// longwave, internal.
void facet_heat(const Job& job, const Block& block, const Kind& kind, std::size_t i, double* heat);

/// The jumps of a block's sunlight in the step that ends at instant i; none on coarse levels.
std::span<const HeatJump> edges_of(const Level& level, const Block& block, std::size_t i);

/// Puts a typical film on a material's modes.
void set_film(Kind& kind, double film, double step);
/// Typical films on the faces of a material's plates.
void set_plate_films(Kind& kind, double front, double back, double step);
/// Renews whatever films a level's materials are closed with, from the slopes another has found.
void set_films(const Job& job, Level& level, const Level& known);
/// −(mean slope) of a material over the last pass, or what its first guess had.
double typical_film(const Kind& kind);
double typical_back_film(const Kind& kind);

/// One pass over the span for all blocks that have not settled: writes their temperatures, changes
/// and surface slopes.
void pass(Job& job, const Level& level, double progress_from, double progress_to);

/// A field's rows at the instants a coarse level steps over, on the line between those it lands on.
void fill_between(const Job& job, std::vector<float>& field, std::size_t stride);

/// Mean surface slopes of each material over the last pass, and each block's period from its own.
void renew_matrices(const Job& job, Level& level, std::vector<Block>& blocks);

/// Corrects the start of every block that ran by Newton's on the period map, and the temperatures
/// of that run by what this does to first order.
void correct(Job& job, const Level& level);

/// (I − M)⁻¹ change of every facet of a block, (state, facet).
Eigen::MatrixXd close_period(const Block& block, const Eigen::MatrixXd& change);
/// [K] that moves of its facets' starts do to their surfaces, (instant, facet).
Eigen::MatrixXd follow_start(const Block& block, const Eigen::MatrixXd& move);

/// Adds to a block's temperatures [K], (instant of the level, facet of the block).
void warm(Job& job, const Level& level, const Block& block, const Eigen::MatrixXd& warmer);

}  // namespace diurna
