#include "scenes/studies/crossover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/job/world/stepping.hpp"
#include "scenes/studies/seen_regions.hpp"

namespace diurna {

namespace {

/// Crossovers of one observer and the same bands, by their numbers.
struct CrossoverGroup {
    std::size_t observer;
    std::vector<std::string> bands;
    std::vector<std::size_t> of;
};

std::vector<CrossoverGroup> groups(const std::vector<CrossoverInput>& inputs) {
    std::vector<CrossoverGroup> all;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const auto same = std::find_if(all.begin(), all.end(), [&](const CrossoverGroup& group) {
            return group.observer == inputs[i].observer && group.bands == inputs[i].bands;
        });
        CrossoverGroup& group =
            same != all.end()
                ? *same
                : all.emplace_back(CrossoverGroup{inputs[i].observer, inputs[i].bands, {}});
        group.of.push_back(i);
    }
    return all;
}

/// First and second of each crossover of a group, in turn.
std::vector<RegionInput> regions_of(const CrossoverGroup& group,
                                    const std::vector<CrossoverInput>& inputs) {
    std::vector<RegionInput> regions;
    for (const std::size_t i : group.of) {
        regions.push_back(inputs[i].first);
        regions.push_back(inputs[i].second);
    }
    return regions;
}

SeenRegions seen(const Stages& stages, const CrossoverGroup& group, const TemperatureField& field,
                 int more_samples) {
    const Scene& scene = stages.scene().scene;
    return {stages.at(0), group.observer, regions_of(group, scene.crossovers),
            group.bands,  field,          more_samples * scene.observers[group.observer].samples};
}

/// Of a pair in a band, over the seconds of the span.
Difference difference_of(const SeenRegions& seen, std::size_t pair, std::size_t band,
                         std::size_t bands, Instant start) {
    return [&seen, at = 2 * pair * bands + band, bands, start](double seconds) {
        const std::vector<double>& kelvin = seen.apparent(later(start, seconds));
        return kelvin[at] - kelvin[at + bands];
    };
}

CrossoverDay day_of(const SeenRegions& seen, const CrossoverInput& input, std::size_t pair,
                    std::size_t band, const std::vector<Instant>& instant) {
    const std::size_t bands = input.bands.size(), at = 2 * pair * bands + band;
    CrossoverDay day{.band = input.bands[band],
                     .instant = instant,
                     .first = {},
                     .second = {},
                     .crossing = {},
                     .nearest_at = {}};
    std::vector<double> time, value;
    for (const Instant when : instant) {
        const std::vector<double>& kelvin = seen.apparent(when);
        day.first.push_back(kelvin[at]);
        day.second.push_back(kelvin[at + bands]);
        time.push_back(seconds_between(instant.front(), when));
        value.push_back(day.first.back() - day.second.back());
    }
    // (T48) of docs/theory.md
    const Difference difference = difference_of(seen, pair, band, bands, instant.front());
    const std::vector<ZeroCrossing> found = find_crossings(
        time, value, difference, {.width = found_to, .touching = input.touching, .jumping = jump});
    const auto nearest = std::min_element(
        value.begin(), value.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    day.nearest = *nearest;
    day.nearest_at = instant[std::size_t(nearest - value.begin())];
    day.worst_least = std::abs(day.nearest);
    for (const ZeroCrossing& one : found) {
        if (std::abs(one.least) < day.worst_least) {
            day.worst_least = std::abs(one.least);
            day.nearest = one.least;
            day.nearest_at = later(instant.front(), one.at);
        }
        day.crossing.push_back({.when = later(instant.front(), one.at),
                                .kind = one.kind,
                                .first_warmer_after = one.kind == ZeroCrossing::Kind::touches
                                                          ? one.least > 0.0
                                                          : one.slope > 0.0,
                                .slope = one.slope,
                                .least = one.least,
                                .refined = {},
                                .shift = {}});
        // The hours below the threshold see it, too.
        const auto place = std::upper_bound(time.begin(), time.end(), one.at);
        value.insert(value.begin() + (place - time.begin()), one.least);
        time.insert(place, one.at);
    }
    day.lost = time_below(time, value, input.threshold);
    return day;
}

/// How far each crossing of a group moves in another scene; `reported` takes it.
template <class Messages>
void follow(const SeenRegions& seen, const CrossoverGroup& group,
            const std::vector<CrossoverInput>& inputs, std::vector<CrossoverReport>& reports,
            const Messages& reported) {
    struct Job {
        std::size_t crossover, pair, band, crossing;
    };
    std::vector<Job> jobs;
    for (std::size_t pair = 0; pair < group.of.size(); ++pair) {
        const std::size_t i = group.of[pair];
        for (std::size_t b = 0; b < inputs[i].bands.size(); ++b) {
            const auto& crossings = reports[i].band[b].crossing;
            for (std::size_t c = 0; c < crossings.size(); ++c) jobs.push_back({i, pair, b, c});
        }
    }
    std::vector<std::optional<double>> shift(jobs.size());
    const auto one = [&](std::size_t j) {
        const Job& job = jobs[j];
        const CrossoverDay& day = reports[job.crossover].band[job.band];
        const TimedCrossing& base = day.crossing[job.crossing];
        if (base.kind == ZeroCrossing::Kind::touches) return;
        const Instant start = day.instant.front();
        const double at = seconds_between(start, base.when);
        const auto found = nearest_crossing(
            {.at = at, .slope = base.slope},
            difference_of(seen, job.pair, job.band, group.bands.size(), start), farthest_shift, 0.0,
            seconds_between(start, day.instant.back()), found_to);
        if (found) shift[j] = *found - at;
    };
    for_each_index(jobs.size(), one, 1);
    for (std::size_t j = 0; j < jobs.size(); ++j) {
        reported(reports[jobs[j].crossover].band[jobs[j].band].crossing[jobs[j].crossing],
                 jobs[j].crossover, shift[j]);
    }
}

}  // namespace

void check_crossovers(const Prepared& prepared, const SceneWith& scene_with) {
    const Scene& scene = prepared.scene;
    std::vector<Mistake> mistakes;
    for (const CrossoverInput& input : scene.crossovers) {
        if (!prepared.movement.none() || prepared.sequences[input.observer].goes) {
            throw InputError(
                input.where,
                fmt::format(
                    "expected a scene without moving objects and with a fixed observer; found {}",
                    prepared.movement.none() ? "an observer that moves or turns"
                                             : "moving objects"));
        }
        for (const UncertainInput& one : input.uncertain) {
            const auto found =
                mistake_with(scene_with, {setting(one.key, one.one_sigma)}, one.where);
            if (found) mistakes.push_back(*found);
        }
    }
    if (!mistakes.empty()) throw InputError(std::move(mistakes));
    for (const CrossoverGroup& group : groups(scene.crossovers)) {
        filled_pixels(prepared, group.observer, regions_of(group, scene.crossovers),
                      scene.observers[group.observer].samples);
    }
}

namespace {

/// All crossovers of a study, first as the scene is, then with other numbers.
class Crossovers {
 public:
    Crossovers(Study& study, const SceneWith& scene_with)
        : study_(study),
          scene_with_(scene_with),
          inputs_(study.scene().crossovers),
          groups_(groups(inputs_)),
          answer_{.report = std::vector<CrossoverReport>(inputs_.size()), .notes = {}} {}

    /// Contrasts and crossings of the scene as it is.
    ///
    /// - field: must outlive this
    void find(const TemperatureField& field) {
        field_ = &field;
        study_.progress().stage(StageId::named, "contrast");
        for (const CrossoverGroup& group : groups_) {
            const SeenRegions regions = seen(study_.stages(), group, field, 1);
            const std::vector<Instant>& instant = field.instant;
            for_each_index(
                instant.size(), [&](std::size_t i) { regions.apparent(instant[i]); }, 1);
            for (std::size_t pair = 0; pair < group.of.size(); ++pair) {
                CrossoverReport& report = answer_.report[group.of[pair]];
                report.first_pixels = regions.pixels(2 * pair);
                report.second_pixels = regions.pixels(2 * pair + 1);
                for (std::size_t b = 0; b < group.bands.size(); ++b) {
                    report.band.push_back(
                        day_of(regions, inputs_[group.of[pair]], pair, b, instant));
                }
            }
        }
    }

    /// Shifts by half the step and more samples, of those that ask for it.
    void refine() {
        const auto refined = [&](std::size_t i) { return inputs_[i].refined; };
        bool any = false;
        for (std::size_t i = 0; i < inputs_.size(); ++i) any |= refined(i);
        if (!any) return;
        in_other({fmt::format("time.step_s={:g}", 0.5 * study_.scene().time.step)}, true, 2,
                 refined, [&](TimedCrossing& crossing, std::size_t i, std::optional<double> shift) {
                     if (refined(i)) crossing.refined = shift;
                 });
    }

    /// A scene for each uncertain number, whichever crossovers it concerns.
    void vary() {
        std::map<std::pair<std::string, double>, std::vector<std::size_t>> numbers;
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            const std::vector<UncertainInput>& uncertain = inputs_[i].uncertain;
            for (const UncertainInput& one : uncertain)
                numbers[{one.key, one.one_sigma}].push_back(i);
            for (CrossoverDay& day : answer_.report[i].band) {
                for (TimedCrossing& one : day.crossing) one.shift.resize(uncertain.size());
            }
        }
        for (const auto& [number, of] : numbers) vary_number(number.first, number.second, of);
    }

    /// Times rounded to a second.
    CrossoverAnswer finish() {
        for (CrossoverReport& report : answer_.report) {
            for (CrossoverDay& day : report.band) {
                for (TimedCrossing& one : day.crossing) {
                    const Instant start = day.instant.front();
                    one.when = later(start, std::round(seconds_between(start, one.when) +
                                                       one.refined.value_or(0.0)));
                }
            }
        }
        return std::move(answer_);
    }

 private:
    void vary_number(const std::string& key, double one_sigma, const std::vector<std::size_t>& of) {
        const auto concerns = [&](std::size_t i) {
            return std::find(of.begin(), of.end(), i) != of.end();
        };
        in_other({setting(key, one_sigma)}, false, 1, concerns,
                 [&](TimedCrossing& crossing, std::size_t i, std::optional<double> shift) {
                     for (std::size_t u = 0; u < inputs_[i].uncertain.size(); ++u) {
                         const UncertainInput& one = inputs_[i].uncertain[u];
                         if (one.key != key || one.one_sigma != one_sigma) continue;
                         crossing.shift[u] = shift;
                         // (T49) of docs/theory.md
                         crossing.sigma = std::hypot(crossing.sigma, shift.value_or(0.0));
                     }
                 });
    }

    /// Crossings in the scene with other settings.
    ///
    /// - concerns(i): whether the i-th crossover is affected
    /// - reported(crossing, i, shift): takes each crossing's shift
    template <class Concerns, class Reported>
    void in_other(const std::vector<std::string>& settings, bool finer_steps, int more_samples,
                  const Concerns& concerns, const Reported& reported) {
        const std::optional<Instant> last = last_followed(concerns);
        if (!last) {  // no crossing whose shift could be found
            study_.skip_solve();
            return;
        }
        const OtherScene other(scene_with_(settings), study_, *field_, finer_steps,
                               later(*last, farthest_shift));
        if (!other.not_converged.empty()) {
            answer_.notes.push_back(
                fmt::format("with {}: {}", fmt::join(settings, ", "), other.not_converged));
        }
        study_.progress().stage(StageId::named, "crossings");
        for (const CrossoverGroup& group : groups_) {
            if (std::none_of(group.of.begin(), group.of.end(), concerns)) continue;
            follow(seen(other.stages, group, other.field(), more_samples), group, inputs_,
                   answer_.report, reported);
        }
    }

    /// The last crossing that other scenes shift; none: there is no crossing.
    template <class Concerns>
    std::optional<Instant> last_followed(const Concerns& concerns) const {
        std::optional<Instant> last;
        for (const CrossoverGroup& group : groups_) {
            if (std::none_of(group.of.begin(), group.of.end(), concerns)) continue;
            for (const std::size_t i : group.of) {
                for (const CrossoverDay& day : answer_.report[i].band) {
                    for (const TimedCrossing& one : day.crossing) {
                        if (one.kind == ZeroCrossing::Kind::touches) continue;
                        last = last ? std::max(*last, one.when) : one.when;
                    }
                }
            }
        }
        return last;
    }

    Study& study_;
    const SceneWith& scene_with_;
    const TemperatureField* field_ = nullptr;
    const std::vector<CrossoverInput>& inputs_;
    const std::vector<CrossoverGroup> groups_;
    CrossoverAnswer answer_;
};

}  // namespace

CrossoverAnswer crossovers_of(Study& study, const TemperatureField& field,
                              const SceneWith& scene_with) {
    Crossovers crossovers(study, scene_with);
    crossovers.find(field);
    crossovers.refine();
    crossovers.vary();
    return crossovers.finish();
}

}  // namespace diurna
