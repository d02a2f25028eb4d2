#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/job/plan/prepared.hpp"

namespace diurna {

/// Meaning of the numbers in truth planes.
struct Legend {
    struct Object {
        std::size_t id;  // of the plane `object`
        std::string name, kind;
    };
    struct Material {
        std::size_t id;  // of the plane `material`
        std::string name;
    };
    struct Part {
        std::size_t object, part;            // its ObjectId; index in the mesh
        std::string name;                    // of its group or node
        std::string material;                // as in the scene file
        std::vector<std::size_t> materials;  // ids of its materials in the planes: a sheet's two
                                             // sides, or the part's own copy
    };
    std::vector<Object> object;
    std::vector<Material> material;  // those of any surface
    std::vector<Part> part;          // of meshes
};

Legend legend_of(const Prepared& prepared);

}  // namespace diurna
