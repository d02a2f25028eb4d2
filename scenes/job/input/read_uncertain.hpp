#pragma once

#include <string>
#include <vector>

#include "materials/base/section.hpp"

namespace diurna {

/// The path of an uncertain number, in a table of its own. One that affects neither light nor heat
/// is a mistake, which is noted.
std::string read_uncertain_key(const Section& section);

/// A number of limited accuracy.
struct UncertainInput {
    std::string key;         // its path in the scene file
    double one_sigma = 0.0;  // its value one standard deviation from that in the scene
    std::string where;       // in the scene file
};

/// The tables `uncertain` of a section.
///
/// - says: what one is, for the list of keys
std::vector<UncertainInput> read_uncertain_values(const Section& section, const char* says);

/// Converts a name to a valid file name.
std::string plain_name(std::string name);

}  // namespace diurna
