#pragma once

#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "render/instrument/instrument.hpp"
#include "scenes/input/bands.hpp"
#include "scenes/input/read_observer.hpp"

namespace diurna {

/// A camera behind an observer's aperture, in one of its bands.
struct InstrumentInput {
    Instrument instrument;
    std::string observer, band;
    std::string where;      // in the scene file
    std::string seen_band;  // of Scene::bands: by what it weighs the radiance
};

/// The tables [[instrument]], or the one table [instrument]. Adds to `bands` what they weigh
/// radiance by, and to each observer the bands in which it has one.
std::vector<InstrumentInput> read_instruments(const Section& root, std::uint64_t seed,
                                              std::vector<ObserverInput>& observers,
                                              std::vector<BandInput>& bands);

/// [m] of an observer's pinhole before a detector of that pitch.
double focal_length_of(const ObserverInput& observer, double pitch);

}  // namespace diurna
