#include "scenes/job/input/read_instrument.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "render/instrument/presets.hpp"
#include "render/instrument/response.hpp"
#include "scenes/job/input/read_instrument_parts.hpp"

namespace diurna {

namespace {

/// The observer it stands behind; null where that is not known.
ObserverInput* find_observer(const Section& section, std::vector<ObserverInput>& observers) {
    Names known{.what = "observer", .known = {}, .where = " in [[observer]]"};
    for (const ObserverInput& observer : observers) known.known.push_back(observer.name);
    const std::string name = section.name_or(
        "observer", "observer whose aperture the instrument uses (required if there are several)",
        {observers.size() == 1 ? observers.front().name : std::string(), "the only one"}, known);
    for (ObserverInput& observer : observers) {
        if (observer.name == name) return &observer;
    }
    if (!section.has("observer") && observers.size() > 1) {
        section.mistake("observer", "missing, expected the name of one of several [[observer]]");
    }
    return nullptr;
}

std::string read_band(const Section& section, const ObserverInput& observer) {
    Names known{.what = "band", .known = observer.bands, .where = " of its observer"};
    const bool one = observer.bands.size() == 1;
    const std::string band = section.name_or(
        "band",
        "band of the instrument, one of the observer's bands (required if there are several)",
        {one ? observer.bands.front() : std::string(), "the only one"}, known);
    if (!one && !section.has("band")) {
        section.mistake("band", "missing, expected one of its observer's bands",
                        fmt::format("{}", fmt::join(observer.bands, ", ")));
    }
    return std::find(observer.bands.begin(), observer.bands.end(), band) == observer.bands.end()
               ? std::string()
               : band;
}

void check_observer_fits(const Section& section, const ObserverInput& observer) {
    if (observer.projection != Projection::pinhole) {
        section.mistake("observer",
                        "the observer's projection must be \"pinhole\": an instrument's lens has "
                        "its own distortion");
    }
    if (observer.row_time > 0.0) {
        section.mistake("observer", "has a row_time_s, but an instrument exposes all rows at once");
    }
}

/// The name of the band that weighs radiance as the instrument does.
std::string add_seen_band(const Section& section, const InstrumentInput& input,
                          std::vector<BandInput>& bands) {
    const std::string name = input.band + "@" + input.instrument.name;
    BandInput seen{.name = name, .file = {}, .response = flat_spectrum(1.0, 8.0, 12.0)};
    try {
        const Spectrum weight =
            scene_weight(input.instrument, named_band(bands, input.band).response);
        if (*std::max_element(weight.value.begin(), weight.value.end()) > 0.0) {
            seen.response = weight;
        } else {
            section.mistake(
                "band",
                fmt::format("no light of the band {} passes its lens and reaches its detector",
                            input.band));
        }
    } catch (const InputError&) {
        // Reported where the observer names its band.
    }
    bands.push_back(std::move(seen));
    return name;
}

}  // namespace

double focal_length_of(const ObserverInput& observer, double pitch) {
    return 0.5 * observer.width * pitch / std::tan(0.5 * radians(observer.horizontal_fov_deg));
}

std::vector<InstrumentInput> read_instruments(const Section& root, std::uint64_t seed,
                                              std::vector<ObserverInput>& observers,
                                              std::vector<BandInput>& bands) {
    std::vector<InstrumentInput> found;
    for (const Section& section : root.one_or_more_sections(
             "instrument",
             "a camera behind an observer's aperture, [instrument] if there is only one: converts "
             "radiance to counts, with lens, detector and electronics")) {
        InstrumentInput input;
        input.where = section.where();
        input.instrument = read_instrument(section);
        input.instrument.seed = seed * 1000003u + found.size() + 1;
        ObserverInput* observer = find_observer(section, observers);
        if (observer == nullptr) continue;
        input.observer = observer->name;
        check_observer_fits(section, *observer);
        if (observer->pixel_pitch_um > 0.0 &&
            std::abs(observer->pixel_pitch_um * 1e-6 / input.instrument.detector.pitch - 1.0) >
                1e-6) {
            section.mistake(
                "observer",
                fmt::format("has a pixel_pitch_um of {:g}, its detector one of {:g}",
                            observer->pixel_pitch_um, 1e6 * input.instrument.detector.pitch));
        }
        input.band = read_band(section, *observer);
        if (input.band.empty()) continue;
        const auto& taken = observer->instruments;
        if (std::find(taken.begin(), taken.end(), input.band) != taken.end()) {
            section.mistake("band", fmt::format("a second instrument of \"{}\" in {}",
                                                observer->name, input.band));
            continue;
        }
        const bool twice = std::any_of(found.begin(), found.end(), [&](const auto& other) {
            return other.instrument.name == input.instrument.name;
        });
        if (twice) {
            section.mistake("name",
                            fmt::format("a second instrument named \"{}\"", input.instrument.name));
            continue;
        }
        observer->instruments.push_back(input.band);
        input.seen_band = add_seen_band(section, input, bands);
        found.push_back(std::move(input));
    }
    return found;
}

}  // namespace diurna
