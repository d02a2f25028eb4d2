#include "scenes/job/input/read_sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "materials/base/error.hpp"
#include "scenes/job/input/read_signature.hpp"
#include "scenes/job/input/read_uncertain.hpp"

namespace diurna {

namespace {

using Figure = SensitivityOutput::Figure;

/// What outputs may name.
struct Known {
    RegionNames regions;
    const std::vector<BandInput>& bands;
    const std::vector<ObserverInput>& observers;
    double hours;  // of the span
};

std::vector<RangedInput> read_ranges(const Section& section) {
    std::vector<RangedInput> found;
    std::set<std::string> keys;
    for (const Section& one : section.sections("uncertain", "an uncertain value of the scene")) {
        found.push_back({.key = read_uncertain_key(one),
                         .low = one.number("low", "lowest value"),
                         .high = one.number("high", "highest value"),
                         .where = one.where()});
        const RangedInput& input = found.back();
        if (!one.has_mistakes() && !(input.low < input.high)) {
            one.mistake("high", fmt::format("found {:g}, expected above low = {:g}", input.high,
                                            input.low));
        }
        if (!keys.insert(input.key).second) {
            one.mistake("key", fmt::format("\"{}\" twice", input.key));
        }
    }
    if (found.empty()) section.mistake("uncertain", "missing, expected at least one");
    return found;
}

RegionInput read_sensitivity_region(const Section& section, const char* key, const char* says,
                                    const Known& known) {
    RegionInput region = region_named(section.name(key, says, known.regions.all), known.regions);
    region.where = section.where(key);
    return region;
}

/// What is beyond 3 µm and which the observer has, or any that it could have.
void read_sensitivity_band(const Section& section, const Known& known, SensitivityOutput& output) {
    const auto warm = [&](const std::string& name) {
        return named_band(known.bands, name).from_um() >= heat_begins_um;
    };
    const bool given = section.has("band");
    output.band = section.text_or("band", "band above 3 µm: a word or a name of [[bands]]",
                                  {std::string(), "the observer's first band above 3 µm"});
    try {
        if (given) {
            if (!warm(output.band)) {
                section.mistake(
                    "band",
                    fmt::format("\"{}\" begins below 3 um, where nothing is visible at night",
                                output.band));
            }
            return;
        }
        for (const std::string& band : known.observers[output.observer].bands) {
            if (!output.band.empty() || !warm(band)) continue;
            output.band = band;
        }
    } catch (const InputError& error) {
        if (!given) return;  // reported where the observer names it
        section.mistake("band", error.mistakes().front().problem, error.mistakes().front().hint);
        return;
    }
    if (output.band.empty()) {
        section.mistake("band", "missing: the observer has no band above 3 um");
    }
}

void read_eye(const Section& section, const Known& known, SensitivityOutput& output) {
    Names names{.what = "observer", .known = {}, .where = " in [[observer]]"};
    for (const ObserverInput& one : known.observers) names.known.push_back(one.name);
    const bool only = names.known.size() == 1;
    const std::string name = section.name_or(
        "observer", "observer that sees the regions (required if there are several)",
        {only ? names.known.front() : std::string(), "the only one"}, names);
    if (!only && !section.has("observer")) {
        section.mistake("observer", "missing, expected the name of an [[observer]]");
    }
    const auto at = std::find(names.known.begin(), names.known.end(), name);
    if (at == names.known.end()) return;
    output.observer = std::size_t(at - names.known.begin());
    read_sensitivity_band(section, known, output);
}

SensitivityOutput read_one_output(const Section& section, const Known& known, Instant start) {
    SensitivityOutput output;
    output.where = section.where();
    output.figure = section.choice_or(
        "figure",
        "temperature: mean of first over its area; contrast: apparent temperature of first minus "
        "that of second; crossover: hour at which these are equal",
        Figure::temperature,
        {{"temperature", Figure::temperature},
         {"contrast", Figure::contrast},
         {"crossover", Figure::crossover}});
    output.first = read_sensitivity_region(section, "first", region_says, known);
    std::string usual = output.first.name;
    if (output.figure != Figure::temperature) {
        output.second =
            read_sensitivity_region(section, "second", "region of comparison, as first", known);
        if (output.first.name == output.second.name && !output.first.name.empty()) {
            section.mistake("second", "must differ from first");
        }
        usual += " - " + output.second.name;
        read_eye(section, known, output);
    }
    if (output.figure == Figure::crossover) {
        output.number = section.integer_or("number", "number of the crossover in the span",
                                           output.number, {1, 1000});
        usual += fmt::format(" crossover {}", output.number);
    } else {
        const double hour = section.number("at_h", "hours after the span's start", {0.0, 8784.0});
        if (hour > known.hours) {
            section.mistake("at_h", fmt::format("found {:g}, expected within the span of {:g} h",
                                                hour, known.hours));
        }
        output.at = later(start, 3600.0 * hour);
        usual += fmt::format(" at {:g} h", hour);
    }
    output.name = section.text_or("name", "name in the results",
                                  {usual,
                                   "FIRST - SECOND at N h; with observer and band "
                                   "where that is the name of several"});
    return output;
}

/// Adds observer and band to names that were not given and are used twice. The same name again is a
/// mistake.
void name_outputs(const std::vector<Section>& sections, const std::vector<ObserverInput>& observers,
                  std::vector<SensitivityOutput>& outputs) {
    std::map<std::string, int> uses;
    for (const SensitivityOutput& one : outputs) ++uses[one.name];
    std::set<std::string> names;
    for (std::size_t o = 0; o < outputs.size(); ++o) {
        SensitivityOutput& one = outputs[o];
        const bool seen = one.figure != Figure::temperature && one.observer < observers.size();
        if (uses[one.name] > 1 && seen && !sections[o].has("name")) {
            one.name += fmt::format(" from {} in {}", observers[one.observer].name, one.band);
        }
        if (names.insert(one.name).second) continue;
        sections[o].mistake("name", fmt::format("two of the name \"{}\"", one.name),
                            "give each output a name of its own");
    }
}

}  // namespace

std::vector<SensitivityInput> read_sensitivities(const Section& root, const TerrainInput& terrain,
                                                 const std::vector<std::string>& materials,
                                                 const std::vector<BandInput>& bands,
                                                 const std::vector<ObserverInput>& observers,
                                                 const TimeInput& time) {
    std::vector<SensitivityInput> found;
    std::vector<std::string> names;
    const Known known{region_names(terrain, materials), bands, observers, time.duration / 3600.0};
    for (const Section& section :
         root.sections("sensitivity",
                       "effect of uncertain values on results of the scene: diurna sensitivity")) {
        SensitivityInput input;
        input.where = section.where();
        input.name = study_name(section, {"sensitivity", "sensitivity"}, names);
        input.uncertain = read_ranges(section);
        const std::vector<Section> outputs = section.sections("output", "a result to be studied");
        for (const Section& one : outputs) {
            input.outputs.push_back(read_one_output(one, known, time.start));
        }
        name_outputs(outputs, observers, input.outputs);
        if (input.outputs.empty()) section.mistake("output", "missing, expected at least one");
        input.trajectories =
            std::size_t(section.integer_or("trajectories",
                                           "number of trajectories of Morris's screening; each "
                                           "evaluates one scene more than there "
                                           "are uncertain values; 0: one value at a time only",
                                           static_cast<int>(input.trajectories), {0, 1000}));
        input.levels = section.integer_or("levels", "number of levels of every value, even",
                                          input.levels, {2, 100});
        if (input.levels % 2 != 0) section.mistake("levels", "expected an even number");
        input.exact = section.flag_or(
            "exact",
            "solve every scene of the screening; false: only the one farthest from the scene, and "
            "combine the temperatures of the others from the scenes with one value changed",
            input.exact);
        input.tolerance = section.number_or(
            "tolerance_K",
            "allowed rms error of combined temperatures, measured on the scene that is farthest "
            "from the unchanged one; if it is exceeded, every scene is solved",
            input.tolerance, {0.0, 10.0});
        found.push_back(std::move(input));
    }
    return found;
}

}  // namespace diurna
