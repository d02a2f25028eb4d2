#include "scenes/app/sweep/sweep_plan.hpp"

#include <fmt/format.h>

namespace diurna {

std::string count_reported(const Sweep& sweep) {
    const SweepInput& input = sweep.base.sweep;
    const std::size_t solves = sweep.solves();
    return fmt::format("{} variants{}, {} {} of the heat balance", sweep.variants.size(),
                       input.draw ? fmt::format(" drawn of {:g} combinations", input.grid()) : "",
                       solves, solves == 1 ? "solve" : "solves");
}

std::string describe(const Sweep& sweep, const Plan& base) {
    double heat = 0.0, pictures = 0.0, built = 0.0;
    for (const PlannedStage& stage : base.stages) {
        const bool of_pictures = stage.stage == StageId::views || stage.stage == StageId::frames ||
                                 stage.stage == StageId::instruments ||
                                 stage.stage == StageId::report;
        (of_pictures ? pictures : heat) += stage.seconds;
        if (stage.stage == StageId::terrain) built += stage.seconds;
    }
    std::string text = fmt::format("sweep       {}\n", count_reported(sweep));
    for (const SweepAxis& axis : sweep.base.sweep.axes) {
        const bool shared = !touches_heat(sweep, axis);
        text += fmt::format("  {:<32} {:>4} values{}\n", axis.name, axis.values.size(),
                            shared ? ", temperatures shared" : "");
    }
    const double solves = double(sweep.solves()), variants = double(sweep.variants.size());
    text += fmt::format(
        "  total time  {:>12.1f} s   heat balances {:.1f} s, pictures {:.1f} s per variant; "
        "estimated from the base scene below\n",
        // A variant that shares its heat is built for its pictures.
        solves * heat + (variants - solves) * built + variants * pictures, heat, pictures);
    return text;
}

}  // namespace diurna
