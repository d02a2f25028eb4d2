#include "scenes/studies/sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "materials/base/error.hpp"
#include "scenes/studies/combined_heat.hpp"
#include "scenes/studies/crossings.hpp"
#include "scenes/studies/seen_regions.hpp"

namespace diurna {

namespace {

using SensitivityFigure = SensitivityOutput::Figure;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Which of the span's crossings an output is about, as the scene has it; none where there is none.
using Likes = std::vector<std::optional<ZeroCrossing>>;

double mean_temperature(const Prepared& prepared, const RegionInput& region,
                        const TemperatureField& field, Instant when) {
    const FacetSet& surfaces = prepared.world.surfaces();
    const std::vector<float> kelvin = field.interpolate(when);
    double sum = 0.0, area = 0.0;
    for (const SurfaceId surface : surfaces_of(prepared, region)) {
        sum += double{surfaces.area[index(surface)]} * double{kelvin[index(surface)]};
        area += double{surfaces.area[index(surface)]};
    }
    return sum / area;
}

/// The figure of one scene. Without `like` the crossing is searched for among all, and `like` takes
/// it; with it the one nearest to it.
double figure_of(const SensitivityOutput& output, const Stages& stages,
                 const TemperatureField& field, bool base, std::optional<ZeroCrossing>& like) {
    const Prepared& prepared = stages.scene();
    if (output.figure == SensitivityFigure::temperature) {
        return mean_temperature(prepared, output.first, field, output.at);
    }
    if (output.figure == SensitivityFigure::crossover && !base && !like) return nan;
    const SeenRegions seen(stages.at(0), output.observer, {output.first, output.second},
                           {output.band}, field, prepared.scene.observers[output.observer].samples);
    const auto contrast = [&](Instant when) {
        const std::vector<double>& kelvin = seen.apparent(when);
        return kelvin[0] - kelvin[1];
    };
    if (output.figure == SensitivityFigure::contrast) return contrast(output.at);
    const Instant start = field.instant.front();
    const Difference difference = [&](double seconds) { return contrast(later(start, seconds)); };
    if (!base) {
        const auto found = nearest_crossing(*like, difference, farthest_shift, 0.0,
                                            seconds_between(start, field.instant.back()), found_to);
        return found ? *found / 3600.0 : nan;
    }
    std::vector<double> time, value;
    for (const Instant when : field.instant) {
        time.push_back(seconds_between(start, when));
        value.push_back(contrast(when));
    }
    int number = 0;
    for (const ZeroCrossing& one :
         find_crossings(time, value, difference, {.width = found_to, .jumping = jump})) {
        if (one.kind == ZeroCrossing::Kind::touches || ++number != output.number) continue;
        like = one;
        return one.at / 3600.0;
    }
    return nan;
}

/// (output)
std::vector<double> sensitivity_figures(const SensitivityInput& input, const Stages& stages,
                                        const TemperatureField& field, bool base, Likes& likes) {
    std::vector<double> found;
    for (std::size_t o = 0; o < input.outputs.size(); ++o) {
        found.push_back(figure_of(input.outputs[o], stages, field, base, likes[o]));
    }
    return found;
}

MorrisDesign design_of(const SensitivityInput& input, const Scene& scene) {
    return morris_design(input.uncertain.size(), input.trajectories, input.levels, scene.seed);
}

/// - point: (uncertain) 0 at the low end, 1 at the high one
std::vector<std::string> settings_at(const SensitivityInput& input,
                                     const std::vector<double>& point) {
    std::vector<std::string> settings;
    for (std::size_t u = 0; u < point.size(); ++u) {
        const RangedInput& one = input.uncertain[u];
        settings.push_back(setting(one.key, one.low + point[u] * (one.high - one.low)));
    }
    return settings;
}

void check_output(const Prepared& prepared, const SensitivityOutput& output) {
    if (!prepared.movement.none()) {
        throw InputError(output.where,
                         "expected a scene without moving objects, found moving objects");
    }
    if (output.figure == SensitivityFigure::temperature) {
        if (!surfaces_of(prepared, output.first).empty()) return;
        throw InputError(output.first.where,
                         fmt::format("\"{}\" has no surface", output.first.name));
    }
    if (prepared.sequences[output.observer].goes) {
        throw InputError(output.where, "expected a fixed observer, found a moving one");
    }
    filled_pixels(prepared, output.observer, {output.first, output.second},
                  prepared.scene.observers[output.observer].samples);
}

/// What is to be reported of the numbers' effects.
void add_notes(const SensitivityInput& input, SensitivityReport& report) {
    for (std::size_t o = 0; o < input.outputs.size(); ++o) {
        const OutputSensitivity& one = report.output[o];
        const std::string& name = input.outputs[o].name;
        if (std::isnan(one.base)) {
            report.notes.push_back(
                fmt::format("{}: the unchanged scene has no such crossover", name));
            continue;
        }
        for (std::size_t u = 0; u < input.uncertain.size(); ++u) {
            for (const auto& [word, value] :
                 {std::pair{"low", one.alone[u].low}, std::pair{"high", one.alone[u].high}}) {
                if (!std::isnan(value)) continue;
                report.notes.push_back(
                    fmt::format("{}: no crossover with {} {}", name, word, input.uncertain[u].key));
            }
            if (one.effect.empty() || one.effect[u].count == input.trajectories) continue;
            report.notes.push_back(fmt::format(
                "{}: {} of {} elementary effects of {} are known; the others have no crossover",
                name, one.effect[u].count, input.trajectories, input.uncertain[u].key));
        }
    }
    for (std::size_t u = 0; u < input.uncertain.size(); ++u) {
        const bool idle = std::all_of(
            report.output.begin(), report.output.end(), [&](const OutputSensitivity& one) {
                const bool none = std::isnan(one.base) ||
                                  (one.alone[u].low == one.base && one.alone[u].high == one.base);
                return none && (one.effect.empty() || one.effect[u].count == 0 ||
                                one.effect[u].mean_size == 0.0);
            });
        if (idle) {
            report.notes.push_back(fmt::format("{} has no effect", input.uncertain[u].key));
        }
    }
}

/// Whether the temperatures of every number at three places can be kept in memory.
bool may_combine(const SensitivityInput& input, const TemperatureField& field) {
    constexpr double most_bytes = 4e9;
    const double fields = 3.0 * double(input.uncertain.size()) + 4.0;
    return !input.exact && fields * sizeof(float) * double(field.kelvin.size()) < most_bytes;
}

std::size_t farthest(const std::vector<std::vector<double>>& point, const CombinedHeat& combined) {
    std::size_t farthest = 0;
    double most = -1.0;
    for (std::size_t p = 0; p < point.size(); ++p) {
        const double away = combined.departure(point[p]);
        if (away > most) {
            most = away;
            farthest = p;
        }
    }
    return farthest;
}

/// What is to be reported of combined temperatures.
void add_combined(const SensitivityInput& input, SensitivityReport& report) {
    const CombinedScenes& combined = report.combined;
    if (combined.settings.empty()) return;
    const std::string error = fmt::format(
        "with {} combined temperatures differ from a whole solution by {:.2g} K rms, "
        "{:.2g} K at most (tolerance_K = {:g})",
        fmt::join(combined.settings, ", "), combined.rms, combined.worst, input.tolerance);
    if (combined.scenes == 0) {
        report.notes.push_back("screening: every scene is solved: " + error);
        return;
    }
    std::vector<std::string> outputs;
    for (std::size_t o = 0; o < input.outputs.size(); ++o) {
        if (std::isnan(combined.output[o])) continue;
        const bool hours = input.outputs[o].figure == SensitivityFigure::crossover;
        outputs.push_back(fmt::format("{} by {:.2g} {}", input.outputs[o].name, combined.output[o],
                                      hours ? "h" : "K"));
    }
    report.notes.push_back(fmt::format(
        "screening: the temperatures of {} scenes are combined from those with one value changed; "
        "{}{}{}; sigma and the standard error of mu* do not include effects of two values on the "
        "temperatures together (exact = true does)",
        combined.scenes, error, outputs.empty() ? "" : "; outputs: ", fmt::join(outputs, ", ")));
}

}  // namespace

void check_sensitivity(const Prepared& prepared, const SensitivityInput& input,
                       const SceneWith& scene_with) {
    for (const SensitivityOutput& output : input.outputs) check_output(prepared, output);
    std::vector<Mistake> mistakes;
    for (const RangedInput& one : input.uncertain) {
        for (const double value : {one.low, one.high}) {
            const auto found = mistake_with(scene_with, {setting(one.key, value)}, one.where);
            if (!found) continue;
            mistakes.push_back(*found);
            break;
        }
    }
    if (!mistakes.empty()) throw InputError(std::move(mistakes));
    for (const std::vector<double>& point : design_of(input, prepared.scene).point) {
        const auto found = mistake_with(scene_with, settings_at(input, point), input.where);
        if (found) throw InputError({*found});
    }
}

SensitivityReport sensitivity_of(Study& study, const SensitivityInput& input,
                                 const TemperatureField& field, const SceneWith& scene_with) {
    const std::size_t outputs = input.outputs.size();
    SensitivityReport report{.output = std::vector<OutputSensitivity>(outputs)};
    Likes likes(outputs);
    study.progress().stage(StageId::named, "sensitivity");
    const std::vector<double> base = sensitivity_figures(input, study.stages(), field, true, likes);
    const auto not_converged_note = [&](const OtherScene& other,
                                        const std::vector<std::string>& settings) {
        if (other.not_converged.empty()) return;
        report.converged = false;
        report.notes.push_back(
            fmt::format("with {}: {}", fmt::join(settings, ", "), other.not_converged));
    };
    const auto evaluated = [&](OtherScene& other) {
        return sensitivity_figures(input, other.stages, other.field(), false, likes);
    };
    const auto solve_with = [&](const std::vector<std::string>& settings,
                                std::optional<TemperatureField>* own = nullptr) {
        OtherScene other(scene_with(settings), study, field);
        ++report.scenes;
        ++(other.solved ? report.solved : report.shared);
        not_converged_note(other, settings);
        std::vector<double> found = evaluated(other);
        if (own) *own = other.take_field();
        return found;
    };
    for (std::size_t o = 0; o < outputs; ++o) report.output[o].base = base[o];
    CombinedHeat combined(field);
    bool combine = input.trajectories > 1 && may_combine(input, field);
    for (const RangedInput& one : input.uncertain) {
        CombinedHeat::Changed changed;
        const std::vector<double> low =
            solve_with({setting(one.key, one.low)}, combine ? &changed.low : nullptr);
        const std::vector<double> high =
            solve_with({setting(one.key, one.high)}, combine ? &changed.high : nullptr);
        for (std::size_t o = 0; o < outputs; ++o) {
            const double change = high[o] - low[o];
            report.output[o].alone.push_back(
                {.low = low[o], .high = high[o], .slope = change / (one.high - one.low)});
            report.output[o].deviation =
                std::hypot(report.output[o].deviation, change / std::sqrt(12.0));
        }
        changed.has_middle = combine && input.levels > 2;
        if (changed.has_middle) {
            const std::vector<std::string> middle{setting(one.key, 0.5 * (one.low + one.high))};
            OtherScene other(scene_with(middle), study, field);
            report.solved += other.solved ? 1 : 0;
            not_converged_note(other, middle);
            changed.middle = other.take_field();
        }
        combine = combine && combined.add(std::move(changed));
    }
    if (input.trajectories > 0) {
        const MorrisDesign design = design_of(input, study.scene());
        std::vector<std::vector<double>> figures(design.point.size());
        if (combine) {
            const std::size_t far = farthest(design.point, combined);
            const std::vector<std::string> settings = settings_at(input, design.point[far]);
            std::optional<TemperatureField> whole;
            figures[far] = solve_with(settings, &whole);
            const TemperatureField guess = combined.at(design.point[far]);
            const FieldDifference apart = difference_of(guess, whole ? *whole : field);
            OtherScene other(scene_with(settings), study, GivenTemperatures{guess});
            report.combined = {.scenes = 0,
                               .settings = settings,
                               .rms = apart.rms,
                               .worst = apart.worst,
                               .output = evaluated(other)};
            for (std::size_t o = 0; o < outputs; ++o) report.combined.output[o] -= figures[far][o];
            combine = apart.rms <= input.tolerance;
        }
        for (std::size_t p = 0; p < design.point.size(); ++p) {
            if (!figures[p].empty()) continue;
            const std::vector<std::string> settings = settings_at(input, design.point[p]);
            if (!combine) {
                figures[p] = solve_with(settings);
                continue;
            }
            OtherScene other(scene_with(settings), study,
                             GivenTemperatures{combined.at(design.point[p])});
            ++report.scenes;
            ++report.combined.scenes;
            figures[p] = evaluated(other);
        }
        for (std::size_t o = 0; o < outputs; ++o) {
            std::vector<double> result;
            for (const std::vector<double>& of_point : figures) result.push_back(of_point[o]);
            report.output[o].effect = elementary_effects(design, result);
        }
    }
    add_notes(input, report);
    add_combined(input, report);
    if (report.shared > 0) {
        report.notes.push_back(
            fmt::format("{} of {} changed scenes have the temperatures of the unchanged scene and "
                        "were not solved",
                        report.shared, report.scenes));
    }
    return report;
}

}  // namespace diurna
