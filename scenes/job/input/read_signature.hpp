#pragma once

#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/input/read_terrain.hpp"
#include "scenes/job/input/read_time.hpp"

namespace diurna {

/// Common to studies of one target.
struct StudiedObject {
    std::string object;
    std::vector<Instant> frames;
    std::string where;  // in the scene file
};

/// The object or building and the instants, by default the scene's.
StudiedObject read_studied(const Section& section, const TerrainInput& terrain,
                           const TimeInput& time, const std::optional<Site>& site);

/// The key `name`, by default `usual`, valid as a file name, unique among `names`, to which it is
/// added.
std::string study_name(const Section& section, const Or<std::string>& usual,
                       std::vector<std::string>& names);

/// [[signature]]: radiant intensity of an object in every direction.
struct SignatureInput {
    std::string name;
    StudiedObject studied;
    std::vector<std::string> bands;
    int directions = 162;  // 42, 162 or 642, of which the upper half is used
    double range = 0.0;    // [m]; 0: at the target
    int pixels = 128;      // each way, over three times the object's largest half-width
    int samples = 16;      // of a pixel
};

std::vector<SignatureInput> read_signatures(const Section& root, const TerrainInput& terrain,
                                            const std::vector<BandInput>& bands,
                                            const TimeInput& time, const std::optional<Site>& site);

}  // namespace diurna
