#pragma once

#include <vector>

#include "thermal/solve/time_level.hpp"
#include "thermal/steppers/material_column.hpp"

// What others do with the same column under the same forcing (bench/column_bench.cpp).

namespace diurna {

/// One facet's day: heat linear between instants `step` apart, jumps within, air by the minute.
struct FacetDay {
    const MaterialColumn* column;
    const std::vector<StageForcing>* air;  // (minute)
    NaturalFilm natural;
    double step;               // [s]
    std::vector<double> heat;  // (instant) absorbed sun and internal heat [W m⁻²]
    struct Jump {
        std::size_t step;  // from instant `step` on
        double share, heat;
    };
    std::vector<Jump> jump;  // in order of time

    double heat_at(double t, std::size_t jumps_passed_in_step) const;
    StageForcing air_at(double t) const;
};

/// Nodes' temperatures [K] at the start of the day that repeats itself, by Newton on the period
/// (differences of the layered method in steps of 20 s).
std::vector<double> periodic_start(const FacetDay& day);

/// Surface temperature at every instant of a day from a state that it leaves at the day's end [K]:
/// SUNDIALS CVODE, variable-order
/// BDF with Newton and a banded matrix by differences, begun again at every jump.
std::vector<double> cvode_day(const FacetDay& day, std::vector<double>& state, double tolerance);

/// The same by backward Euler, one step to an instant, light taken at the step's end, after
/// `spin_up` days from the air's mean temperature throughout.
std::vector<double> euler_days(const FacetDay& day, int spin_up);

}  // namespace diurna
