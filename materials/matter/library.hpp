#pragma once

#include <string>
#include <vector>

#include "materials/matter/material.hpp"

namespace diurna {

/// The materials a scene may name.
class MaterialLibrary {
 public:
    MaterialLibrary() = default;
    explicit MaterialLibrary(std::vector<Material> materials);

    const Material& operator[](MaterialId id) const;
    std::size_t size() const { return materials_.size(); }
    std::vector<std::string> names() const;
    /// Throws InputError("where", ...) with the nearest name if no material has that name.
    MaterialId find(const std::string& name, const std::string& where = "material") const;
    /// Adds a material (a scene's own) or replaces the one of that name.
    MaterialId add(Material material);

 private:
    std::vector<Material> materials_;
};

}  // namespace diurna
