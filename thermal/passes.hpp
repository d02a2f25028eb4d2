#pragma once

#include <Eigen/QR>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "thermal/batch.hpp"
#include "thermal/solver.hpp"
#include "thermal/surroundings.hpp"

namespace diurna {

// What a solve works on: its facets in blocks of one material, stepped over the span in passes.

/// Up to `lanes` facets of one material and their state at the start of the span.
struct Block {
    std::size_t material;  // index into Job::material
    std::vector<std::size_t> facet;
    std::vector<NaturalFilm> natural;
    std::vector<double> start, change;  // [node][lane] relative; change over the last pass
    std::vector<double> move, planned;  // [node][lane] of the start after the pass before: what
                                        // was done, and what the material's matrix alone would do
    double residual = 1e9;              // [K] largest of `change`
    double heat_change = 1e9;           // [W m⁻²] of the terrain's longwave since the last run
    double largest_move = 1e9;          // [K] of `move`
    bool rests = false;                 // left out of the last pass
    StepRecord record;                  // of the last run
    std::vector<double> slope;          // (step, substep, stage) Σ over facets, of the last run

    /// Running it again would change nothing that counts: 0.05 W/m² of longwave are 3 mK.
    bool settled(double tolerance) const { return residual <= tolerance && heat_change <= 0.05; }
};

struct StageForcing {
    AirFilm air;
    double sky_longwave;
};

/// One material of the scene with the forcing its facets share.
struct Kind {
    MaterialColumn column;
    std::vector<StageForcing> forcing;  // (step, substep, stage)
    std::vector<double> slope;          // (step, substep, stage) mean surface slope, last pass
    std::size_t facets = 0;
    /// (I − M)⁻¹ of the linearised period.
    std::optional<Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>> period{};
};

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
    std::vector<float> kelvin;    // (instant, facet)
    std::vector<Block> block;

    std::size_t steps() const { return instant.size() - 1; }
    std::span<float> row(std::vector<float>& field, std::size_t i) const {
        return {field.data() + i * facets, facets};
    }
};

/// The materials' columns and forcing for steps of `stride` instants.
Level make_level(const Job& job, const std::vector<MaterialId>& materials, std::size_t stride,
                 int most_substeps);

/// First guess: every facet's steady state under its mean forcing over the span.
void settle(Job& job, const Level& level);

/// One pass over the span for all blocks that have not settled: writes their temperatures, changes
/// and surface slopes.
void pass(Job& job, const Level& level, double progress_from, double progress_to);

/// Temperatures at the instants a coarse level steps over, on the line between those it lands on.
void fill_between(Job& job, std::size_t stride);

/// Mean surface slopes of each material over the last pass, and the period's matrix from them.
void renew_matrices(const Job& job, Level& level);

/// Corrects the start of every block that ran by Newton's on the period map.
///
/// secant  whether the last correction's effect is all that has changed since the pass before
void correct(Job& job, const Level& level, bool secant);

}  // namespace diurna
