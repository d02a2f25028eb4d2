#include "scenes/job/input/read_contrast.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/error.hpp"
#include "scenes/job/input/read_signature.hpp"

namespace diurna {

namespace {

std::vector<RegionInput> read_targets(const Section& section, const RegionNames& known) {
    std::vector<RegionInput> targets;
    const std::vector<std::string> given = section.texts_or(
        "targets",
        "targets to compare, each as in [[crossover]], for example bare, painted and under a net",
        {std::vector<std::string>{}, "none"});
    if (given.empty()) section.mistake("targets", "missing, expected at least one");
    for (const std::string& name : given) {
        if (std::find(known.all.known.begin(), known.all.known.end(), name) ==
            known.all.known.end()) {
            section.mistake("targets", fmt::format("unknown {} \"{}\"", known.all.what, name),
                            did_you_mean(name, known.all.known));
        } else if (std::any_of(targets.begin(), targets.end(),
                               [&](const RegionInput& other) { return other.name == name; })) {
            section.mistake("targets", fmt::format("\"{}\" twice", name));
        }
        targets.push_back(region_named(name, known));
        targets.back().where = section.where("targets");
    }
    return targets;
}

void read_eyes(const Section& section, const std::vector<ObserverInput>& observers,
               ContrastInput& input) {
    const std::vector<std::string> given =
        section.texts_or("observers", "observers of the targets, at the instants of their pictures",
                         {std::vector<std::string>{}, "all"});
    std::vector<std::string> known;
    for (const ObserverInput& one : observers) known.push_back(one.name);
    for (const std::string& name : given) {
        const auto at = std::find(known.begin(), known.end(), name);
        if (at == known.end()) {
            section.mistake("observers", fmt::format("unknown observer \"{}\"", name),
                            did_you_mean(name, known));
        } else {
            input.observers.push_back(static_cast<std::size_t>(at - known.begin()));
        }
    }
    if (!given.empty()) return;
    for (std::size_t o = 0; o < observers.size(); ++o) input.observers.push_back(o);
}

void read_bands(const Section& section, const std::vector<BandInput>& bands,
                const std::vector<ObserverInput>& observers, ContrastInput& input) {
    input.bands = read_band_names(
        section, "bands above 3 µm: words or names of [[bands]]",
        {std::vector<std::string>{}, "the first observer's bands above 3 µm"}, bands);
    const bool given = !input.bands.empty();
    const auto warm = [&](const std::string& name) {
        return named_band(bands, name).from_um() >= heat_begins_um;
    };
    if (!given && !input.observers.empty()) {
        for (const std::size_t o : input.observers) {
            for (const std::string& band : observers[o].bands) {
                try {
                    if (warm(band)) input.bands.push_back(band);
                } catch (const InputError&) {
                    return;  // reported where the observer names it
                }
            }
            if (!input.bands.empty()) break;
        }
        if (input.bands.empty()) {
            section.mistake("bands", "missing: no observer has a band above 3 um");
        }
        return;
    }
    for (const std::string& band : input.bands) {
        try {
            if (warm(band)) continue;
            section.mistake(
                "bands",
                fmt::format("\"{}\" begins below 3 um, but contrast is a temperature difference",
                            band));
        } catch (const InputError& error) {
            section.mistake("bands", error.mistakes().front().problem,
                            error.mistakes().front().hint);
        }
    }
}

}  // namespace

std::vector<ContrastInput> read_contrasts(const Section& root, const TerrainInput& terrain,
                                          const std::vector<std::string>& materials,
                                          const std::vector<BandInput>& bands,
                                          const std::vector<ObserverInput>& observers) {
    std::vector<ContrastInput> found;
    std::vector<std::string> names;
    const RegionNames known = region_names(terrain, materials);
    for (const Section& section : root.sections("contrast",
                                                "contrast of targets, or of treatments of one "
                                                "target, with their background: diurna contrast")) {
        ContrastInput input;
        input.where = section.where();
        input.targets = read_targets(section, known);
        read_eyes(section, observers, input);
        read_bands(section, bands, observers, input);
        input.name = study_name(section, {"contrast", "contrast"}, names);
        input.ring = section.number_or(
            "ring", "the background box extends this many target widths (heights) beyond each side",
            input.ring, {0.1, 20.0});
        input.threshold = section.number_or(
            "threshold_K", "root-sum-square contrast above which a target counts as visible",
            input.threshold, {1e-3, 1000.0});
        input.ranges = section.numbers_or(
            "ranges_m",
            "ranges to which the highest contrast of each observer is also taken through the air; "
            "for other hours at a range, place an observer there",
            {std::vector<double>{500.0, 1000.0, 2000.0, 5000.0, 10000.0},
             "500, 1000, 2000, 5000, 10000"});
        for (const double range : input.ranges) {
            if (range >= 1.0 && range <= 2e5) continue;
            section.mistake("ranges_m", "expected lengths from 1 to 200000");
            break;
        }
        found.push_back(std::move(input));
    }
    return found;
}

}  // namespace diurna
