#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenes/job/run/stages.hpp"
#include "scenes/job/run/sun_exposure.hpp"
#include "scenes/job/world/measured_albedo.hpp"
#include "thermal/solve/solve_input.hpp"
#include "thermal/solve/solver.hpp"

namespace diurna {

/// Inputs of the heat balance for one stage, computed once.
class StageHeat {
 public:
    /// - stage: must outlive it
    /// - end: of the span
    StageHeat(const SceneStage& stage, Instant end);
    StageHeat(const StageHeat&) = delete;  // the input refers to its members
    StageHeat& operator=(const StageHeat&) = delete;

    const SolveInput& input() const { return input_; }
    SunExposure exposure(const std::vector<Instant>& instants);
    /// `exposure` has only these surfaces, ascending.
    void ask_for(const std::vector<std::uint32_t>& surfaces) { daily_.ask_for(surfaces); }
    double shadow_seconds() const { return shadow_seconds_; }
    /// Notes for the report, one line each.
    std::vector<std::string> reported(const SolveReport& report) const;

 private:
    const Prepared& prepared_;
    const std::optional<FacetViews> sunlight_views_;
    const SunExposure none_{};
    DailySunExposure daily_;
    const MeasuredAlbedo albedo_;
    const AirByHeight by_height_;
    const std::vector<FilmPart> parts_;
    const std::vector<float> open_;
    const SolveInput input_;
    double shadow_seconds_ = 0.0;
};

}  // namespace diurna
