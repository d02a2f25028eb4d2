#include "scenes/job/input/target_input.hpp"

#include <algorithm>

namespace diurna {

bool TargetInput::has_enclosure(const std::string& name) const {
    return std::any_of(enclosure.begin(), enclosure.end(),
                       [&](const EnclosureInput& room) { return room.name == name; });
}
bool TargetInput::has_lump(const std::string& name) const {
    return std::any_of(lump.begin(), lump.end(),
                       [&](const LumpInput& one) { return one.name == name; });
}
int TargetInput::find_part(const std::string& name) const {
    const auto found = std::find_if(part.begin(), part.end(),
                                    [&](const PartInput& one) { return one.name == name; });
    return found == part.end() ? -1 : int(found - part.begin());
}

}  // namespace diurna
