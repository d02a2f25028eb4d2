#include "materials/matter/library.hpp"

#include <fmt/format.h>

#include "materials/base/error.hpp"

namespace diurna {

MaterialLibrary::MaterialLibrary(std::vector<Material> materials) {
    for (Material& material : materials) add(std::move(material));
}

const Material& MaterialLibrary::operator[](MaterialId id) const {
    return materials_.at(static_cast<std::size_t>(id));
}

std::vector<std::string> MaterialLibrary::names() const {
    std::vector<std::string> names;
    for (const Material& material : materials_) names.push_back(material.name);
    return names;
}

MaterialId MaterialLibrary::find(const std::string& name, const std::string& where) const {
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        if (materials_[i].name == name) return static_cast<MaterialId>(i);
    }
    const std::vector<std::string> known = names();
    std::string hint = did_you_mean(name, known);
    if (hint.empty()) hint = fmt::format("known materials: {}", fmt::join(known, ", "));
    throw InputError(where, fmt::format("unknown material '{}'", name.substr(0, 60)), hint);
}

MaterialId MaterialLibrary::add(Material material) {
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        if (materials_[i].name == material.name) {
            materials_[i] = std::move(material);
            return static_cast<MaterialId>(i);
        }
    }
    if (materials_.size() > 0xffff)
        throw InputError("materials", "found more than 65536 materials");
    materials_.push_back(std::move(material));
    return static_cast<MaterialId>(materials_.size() - 1);
}

}  // namespace diurna
