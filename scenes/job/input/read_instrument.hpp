#pragma once

#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "render/instrument/instrument.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/input/read_observer.hpp"

namespace diurna {

/// A camera that replaces an observer's pinhole, in one of its bands.
struct InstrumentInput {
    Instrument instrument;
    std::string observer, band;
    std::string where;      // in the scene file
    std::string seen_band;  // of Scene::bands: its weight for the radiance
};

/// The tables [[instrument]], or the one table [instrument]. Adds their weights for the radiance to
/// `bands`, and to each observer the bands in which it has one.
std::vector<InstrumentInput> read_instruments(const Section& root, std::uint64_t seed,
                                              std::vector<ObserverInput>& observers,
                                              std::vector<BandInput>& bands);

/// [m] focal length of an observer's pinhole for a detector of that pitch.
double focal_length_of(const ObserverInput& observer, double pitch);

}  // namespace diurna
