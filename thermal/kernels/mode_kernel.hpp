#pragma once

#include <cstddef>

#include "thermal/column/column.hpp"
#include "thermal/surface/turbulence.hpp"

namespace diurna {

// A step of `lanes` facets in modes as plain arrays: arguments of the loops compiled for each
// vector width (thermal/kernels/mode_loops.hpp). Nothing here allocates or throws.

/// Facets in modes that are stepped through the span together, a multiple of `lanes`: enough that
/// the facets passed by a shadow's edge in the same step fill a vector.
inline constexpr std::size_t mode_lanes = 8 * lanes;

/// Shared by all facets of a material over a step.
struct ModeCoefficients {
    std::size_t modes;
    const double *rate, *surface;  // (mode)
    const double *decay, *carry;   // (mode) carry = decay · to + from
    double response, film, reference, flux_below, emissivity;
    double step;         // [s]
    bool quick = false;  // Newton ends within a millikelvin of the root
};

/// The air at the upper height; lanes at heights between have interpolated values, at the fraction
/// `up` from the arguments' air.
struct AirAbove {
    const AirFilm *before = nullptr, *air = nullptr;  // null: all lanes have the arguments'
    double dew_point_before = 0.0, dew_point = 0.0;   // [K]
    const double* up = nullptr;                       // (lane) 0 to 1
};

/// The facets [lane]. `state` [mode][lane] lacks `to · drive` of the previous step: it is added
/// with the next step's part, which saves a pass over the states.
struct ModeLanes {
    double dew_point;                  // [K] of the air: a kink of the balance
    const NaturalFilm* natural;        // of plates; unused for ground
    const double *heat_before, *heat;  // [W m⁻²] at the step's ends
    double *state, *temperature, *drive, *slope;
    AirAbove above{};
};

struct ModeOutcome {
    int iterations = 0;    // of Newton's, the same for all lanes
    bool halved = false;   // Newton oscillated, and the bracket was halved to its end
    double closure = 0.0;  // surface balance minus the modes' flux, over the sum of its terms
};

/// A jump of the heat input within the step [lane]: its instant and size.
struct SplitLanes {
    std::size_t groups;  // of `split_lanes` lanes
    double dew_point_before, dew_point;
    const NaturalFilm* natural;
    const double *share, *jump;                   // of the step, 0 < share < 1; [W m⁻²]
    const double *heat_before, *heat;             // the jump included in the latter
    double *state, *temperature, *drive, *slope;  // state [mode][split_capacity], whole
    double* to;                                   // scratch, like state
    AirAbove above{};
};
/// Lengths of the parts of a step after a jump of heat input, as shares of the
/// remainder: the true film minus the modes' follows the surface, which changes
/// fast.
inline constexpr int parts_after_jump = 4;
inline constexpr double part_after_jump[parts_after_jump + 1]{0.0, 0.04, 0.15, 0.45, 1.0};
inline constexpr std::size_t split_lanes = 8, split_capacity = mode_lanes;
inline constexpr std::size_t most_modes = 64;

struct ModeKernel {
    ModeOutcome (*advance)(const AirFilm& before, const AirFilm& air, const ModeCoefficients&,
                           const ModeLanes&);
    bool (*split)(const AirFilm& before, const AirFilm& air, const ModeCoefficients&,
                  const SplitLanes&);
    /// Used by both: emission, film and latent heat of `lanes` facets at their temperatures, flux
    /// [W m⁻²] towards the surface and d(flux)/dT. radiation: ε σ [W m⁻² K⁻⁴].
    void (*balance)(const AirFilm& air, const NaturalFilm* natural, double radiation,
                    const double* temperature, double* flux, double* slope);
};
extern const ModeKernel modes_avx2, modes_avx512;

}  // namespace diurna
