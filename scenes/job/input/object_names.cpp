#include "scenes/job/input/object_names.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace diurna {

void add_objects(Names& names, const TerrainInput& terrain) {
    for (const ObjectInput& object : terrain.objects) {
        names.known.push_back(object.name);
        if (object.copy_of.empty()) continue;
        std::erase(names.known, object.copy_of);
        names.instead.try_emplace(
            object.copy_of, fmt::format("its copies are named \"{}\" and so on", object.name));
    }
}

}  // namespace diurna
