#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace diurna {

/// Diagnostics of a step.
struct StepRecord {
    double worst_closure = 0.0;  // |stored − in| / Σ|terms| dt, so far
    long long stages = 0, iterations = 0;
    int worst_iterations = 0;
    std::size_t bisections = 0;
    std::array<double, 2> slope{};  // Σ over lanes of d(flux)/dT at the last step's two stages

    /// Newton iterations of one stage, and the lanes × iterations outside the bracket.
    void count(int newton, std::size_t bisected) {
        ++stages;
        iterations += newton;
        worst_iterations = std::max(worst_iterations, newton);
        bisections += bisected;
    }
    void merge(const StepRecord& other) {
        worst_closure = std::max(worst_closure, other.worst_closure);
        stages += other.stages;
        iterations += other.iterations;
        worst_iterations = std::max(worst_iterations, other.worst_iterations);
        bisections += other.bisections;
    }
};

}  // namespace diurna
