#include "scenes/job/input/read_detection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "render/detection/tasks.hpp"

namespace diurna {

namespace {

/// Its number among the scene's, or none.
std::optional<std::size_t> find_instrument(const Section& section,
                                           const std::vector<InstrumentInput>& instruments) {
    Names known{.what = "instrument", .known = {}, .where = " in [[instrument]]"};
    for (const InstrumentInput& one : instruments) known.known.push_back(one.instrument.name);
    const bool only = instruments.size() == 1;
    const std::string name = section.name_or(
        "instrument",
        "instrument whose display the observer watches (required if there are several)",
        {only ? known.known.front() : std::string(), "the only one"}, known);
    if (!only && !section.has("instrument")) {
        section.mistake("instrument", "missing, expected the name of an [[instrument]]");
    }
    const auto at = std::find(known.known.begin(), known.known.end(), name);
    if (name.empty() || at == known.known.end()) return std::nullopt;
    return static_cast<std::size_t>(at - known.known.begin());
}

void check_sees_heat(const Section& section, const InstrumentInput& instrument,
                     const std::vector<BandInput>& bands) {
    try {
        const Band band = named_band(bands, instrument.band);
        if (0.5 * (band.from_um() + band.to_um()) >= 3.0) return;
        section.mistake("instrument", fmt::format("has the band {}, expected one above 3 um: noise "
                                                  "and contrast are temperature differences",
                                                  instrument.band));
    } catch (const InputError&) {
        // Reported where the observer names its band.
    }
}

/// Three numbers above 0, one for each task.
std::array<double, 3> by_task(const Section& section, const std::string& key, const char* says,
                              const std::array<double, 3>& usual) {
    const std::vector<double> given =
        section.numbers_or(key, says,
                           {std::vector<double>(usual.begin(), usual.end()),
                            fmt::format("{}", fmt::join(usual, ", "))},
                           3);
    std::array<double, 3> found = usual;
    if (given.size() != 3) return found;  // reported
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(given[i] > 0.0 && given[i] < 1e6)) {
            section.mistake(key, fmt::format("found {:g}, expected numbers above 0", given[i]));
            return usual;
        }
        found[i] = given[i];
    }
    return found;
}

/// The display, and who sits before it.
Viewing read_viewing(const Section& section, const ObserverInput& observer) {
    Viewing viewing;
    viewing.luminance = section.number_or("luminance_cd_m2", "mean luminance of the display",
                                          viewing.luminance, {0.01, 10000.0});
    viewing.display_deg =
        section.number_or("width_deg", "angular width of the whole picture on the display",
                          viewing.display_deg, {0.5, 120.0});
    viewing.magnification = viewing.display_deg / observer.horizontal_fov_deg;
    viewing.display_deg *= std::sqrt(double(observer.height) / observer.width);
    viewing.scene_contrast = section.number_or("scene_contrast_K",
                                               "temperature difference shown with the display's "
                                               "mean luminance (the level divided by the gain)",
                                               viewing.scene_contrast, {0.01, 1000.0});
    return viewing;
}

}  // namespace

std::vector<DetectionInput> read_detections(const Section& root, const TerrainInput& terrain,
                                            const std::vector<InstrumentInput>& instruments,
                                            const std::vector<BandInput>& bands,
                                            const std::vector<ObserverInput>& observers,
                                            const TimeInput& time,
                                            const std::optional<Site>& site) {
    std::vector<DetectionInput> found;
    std::vector<std::string> names;
    for (const Section& section : root.sections(
             "detection",
             "ranges at which an observer of an instrument's display detects an object, by "
             "Johnson's criteria and the Targeting Task Performance metric: diurna detection")) {
        DetectionInput input;
        input.studied = read_studied(section, terrain, time, site);
        input.name = study_name(section, {input.studied.object, "name of the object"}, names);
        const std::vector<double> range =
            section.numbers_or("range_m", "[shortest, longest] range",
                               {std::vector<double>{input.range[0], input.range[1]}}, 2);
        if (range.size() == 2) {
            input.range = {range[0], range[1]};
            if (!(range[0] >= 1.0 && range[0] < range[1] && range[1] <= 2e5)) {
                section.mistake("range_m", "expected two lengths from 1 to 200000, ascending");
            }
        }
        input.probabilities = section.numbers_or(
            "probabilities", "probabilities of detection whose ranges are reported",
            {input.probabilities, "0.5, 0.9"});
        for (const double p : input.probabilities) {
            if (!(p > 0.0 && p < 1.0)) {
                section.mistake("probabilities", "expected numbers between 0 and 1");
            }
        }
        input.across = section.choice_or("criterion",
                                         "Johnson's cycles are counted over the root of the "
                                         "target's area, or across its smallest apparent width",
                                         false, {{"area", false}, {"across", true}});
        std::array<double, 3> n50{}, v50{};
        for (std::size_t i = 0; i < 3; ++i) {
            n50[i] = input.across ? tasks[i].cycles_across : tasks[i].cycles_square;
            v50[i] = tasks[i].v50;
        }
        const std::array<double, 3> square = n50;
        input.n50 = by_task(section, "n50",
                            "Johnson's N50: cycles for detection, recognition and identification "
                            "with a probability of 50 %; defaults of across: 1, 4, 8",
                            square);
        input.v50 =
            by_task(section, "v50",
                    "V50 of the Targeting Task Performance metric, for the same tasks", v50);
        const Section display = section.section("display", "the display that the observer watches");
        if (const auto at = find_instrument(section, instruments)) {
            input.instrument = *at;
            check_sees_heat(section, instruments[*at], bands);
            for (const ObserverInput& observer : observers) {
                if (observer.name != instruments[*at].observer) continue;
                input.viewing = read_viewing(display, observer);
                if (!section.has("frames") && !section.has("frame_every_s") &&
                    !section.has("frames_at_sun")) {
                    input.studied.frames = observer.frames;
                }
            }
        } else {
            read_viewing(display, ObserverInput{});
        }
        found.push_back(std::move(input));
    }
    return found;
}

}  // namespace diurna
