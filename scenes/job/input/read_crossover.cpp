#include "scenes/job/input/read_crossover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "scenes/job/input/read_signature.hpp"

namespace diurna {

namespace {

/// - which: "first" or "second"
RegionInput read_crossover_region(const Section& section, const std::string& which,
                                  const RegionNames& known, const ObserverInput* observer) {
    const std::string key = which + "_pixels";
    if (!section.has(key)) {
        RegionInput region = region_named(section.name(which, region_says, known.all), known);
        region.where = section.where(which);
        return region;
    }
    const std::vector<double> given = section.numbers_or(
        key,
        "region given as [left, top, width, height] in the observer's picture, instead of by name",
        {std::vector<double>{}, ""}, 4);
    RegionInput region{.kind = RegionInput::Kind::pixels,
                       .name = fmt::format("pixels {}", fmt::join(given, " ")),
                       .where = section.where(key)};
    if (section.has(which)) section.mistake(which, "cannot be combined with " + key);
    if (given.size() != 4 || observer == nullptr) return region;
    for (std::size_t i = 0; i < 4; ++i) {
        const int most = i % 2 == 0 ? observer->width : observer->height;
        if (!(given[i] >= (i < 2 ? 0.0 : 1.0) && given[i] <= most) ||
            given[i] != std::floor(given[i]) || (i > 1 && given[i] + given[i - 2] > most)) {
            section.mistake(
                key, fmt::format(
                         "expected whole numbers: a rectangle within the {} x {} pixels of \"{}\"",
                         observer->width, observer->height, observer->name));
            return region;
        }
        region.pixels[i] = static_cast<int>(given[i]);
    }
    return region;
}

const ObserverInput* read_observer_name(const Section& section,
                                        const std::vector<ObserverInput>& observers,
                                        CrossoverInput& input) {
    Names known{.what = "observer", .known = {}, .where = " in [[observer]]"};
    for (const ObserverInput& one : observers) known.known.push_back(one.name);
    const bool only = observers.size() == 1;
    const std::string name = section.name_or(
        "observer", "observer that sees the regions (required if there are several)",
        {only ? known.known.front() : std::string(), "the only one"}, known);
    if (!only && !section.has("observer")) {
        section.mistake("observer", "missing, expected the name of an [[observer]]");
    }
    const auto at = std::find(known.known.begin(), known.known.end(), name);
    if (name.empty() || at == known.known.end()) return nullptr;
    input.observer = static_cast<std::size_t>(at - known.known.begin());
    return &observers[input.observer];
}

/// Those the heat shines in: at night nothing is equal to nothing.
void read_crossover_bands(const Section& section, const std::vector<BandInput>& bands,
                          const ObserverInput* observer, CrossoverInput& input) {
    const auto warm = [&](const std::string& name) {
        return named_band(bands, name).from_um() >= heat_begins_um;
    };
    if (section.has("bands")) {
        input.bands =
            read_band_names(section, "bands above 3 µm: words or names of [[bands]]",
                            {std::vector<std::string>{}, "the observer's bands above 3 µm"}, bands);
        for (const std::string& band : input.bands) {
            try {
                if (warm(band)) continue;
                section.mistake(
                    "bands",
                    fmt::format("\"{}\" begins below 3 um, where nothing is visible at night",
                                band));
            } catch (const InputError& error) {
                section.mistake("bands", error.mistakes().front().problem,
                                error.mistakes().front().hint);
            }
        }
        return;
    }
    section.texts_or("bands", "bands above 3 µm: words or names of [[bands]]",
                     {std::vector<std::string>{}, "the observer's bands above 3 µm"});
    if (observer == nullptr) return;
    for (const std::string& band : observer->bands) {
        try {
            if (warm(band)) input.bands.push_back(band);
        } catch (const InputError&) {
            return;  // reported where the observer names it
        }
    }
    if (input.bands.empty()) {
        section.mistake("bands", fmt::format("missing: \"{}\" has no band above 3 um",  //
                                             observer->name));
    }
}

}  // namespace

std::vector<CrossoverInput> read_crossovers(const Section& root, const TerrainInput& terrain,
                                            const std::vector<std::string>& materials,
                                            const std::vector<BandInput>& bands,
                                            const std::vector<ObserverInput>& observers) {
    std::vector<CrossoverInput> found;
    std::vector<std::string> names;
    const RegionNames known = region_names(terrain, materials);
    for (const Section& section : root.sections(
             "crossover",
             "times at which two regions have equal apparent temperature: diurna crossover")) {
        CrossoverInput input;
        input.where = section.where();
        const ObserverInput* observer = read_observer_name(section, observers, input);
        input.first = read_crossover_region(section, "first", known, observer);
        input.second = read_crossover_region(section, "second", known, observer);
        if (input.first.name == input.second.name && !input.first.name.empty()) {
            section.mistake("second", "must differ from first");
        }
        input.name = study_name(
            section, {plain_name(input.first.name + "-" + input.second.name), "FIRST-SECOND"},
            names);
        read_crossover_bands(section, bands, observer, input);
        input.threshold = section.number_or(
            "threshold_K", "difference of apparent temperature below which contrast is lost",
            input.threshold, {1e-3, 100.0});
        input.touching = section.number_or("touching_K",
                                           "a minimum of the difference below this, without a "
                                           "crossing, is reported as a touching crossover",
                                           input.touching, {0.0, 10.0});
        input.refined = section.flag_or("refined",
                                        "solve again with half the step and twice the samples, to "
                                        "measure how far crossovers move",
                                        input.refined);
        input.uncertain = read_uncertain_values(
            section, "an uncertain value of the scene that shifts the crossover times");
        found.push_back(std::move(input));
    }
    return found;
}

}  // namespace diurna
