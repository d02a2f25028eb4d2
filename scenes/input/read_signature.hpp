#pragma once

#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "scenes/input/bands.hpp"
#include "scenes/input/read_terrain.hpp"
#include "scenes/input/read_time.hpp"

namespace diurna {

/// What studies of one target have in common.
struct StudiedObject {
    std::string object;
    std::vector<Instant> frames;
    std::string where;  // in the scene file
};

/// The object or building and the instants, the scene's by default.
StudiedObject read_studied(const Section& section, const TerrainInput& terrain,
                           const TimeInput& time, const std::optional<Site>& site);

/// The key `name`, by default `usual`, fit for a file's, each once among `names`, to which it is
/// added.
std::string study_name(const Section& section, const Or<std::string>& usual,
                       std::vector<std::string>& names);

/// [[signature]]: how strongly an object shines in every direction.
struct SignatureInput {
    std::string name;
    StudiedObject studied;
    std::vector<std::string> bands;
    int directions = 162;  // 42, 162 or 642, of which the upper half is seen
    double range = 0.0;    // [m]; 0: at the target
    int pixels = 128;      // each way, over three times the object's greatest half-width
    int samples = 16;      // of a pixel
};

std::vector<SignatureInput> read_signatures(const Section& root, const TerrainInput& terrain,
                                            const std::vector<BandInput>& bands,
                                            const TimeInput& time, const std::optional<Site>& site);

}  // namespace diurna
