#include "materials/matter/library.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/radiation/band.hpp"
#include "materials/radiation/planck.hpp"

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
    if (hint.empty()) hint = fmt::format("known: {}", fmt::join(known, ", "));
    throw InputError(where, fmt::format("no material '{}'", name.substr(0, 60)), hint);
}

MaterialId MaterialLibrary::add(Material material) {
    for (std::size_t i = 0; i < materials_.size(); ++i) {
        if (materials_[i].name == material.name) {
            materials_[i] = std::move(material);
            return static_cast<MaterialId>(i);
        }
    }
    if (materials_.size() > 0xffff) throw InputError("materials", "more than 65536 of them");
    materials_.push_back(std::move(material));
    return static_cast<MaterialId>(materials_.size() - 1);
}

MaterialLibrary load_material_library(const std::filesystem::path& file) {
    const Document document = Document::from_file(file);
    const Section root = document.root();
    MaterialLibrary library;
    for (const std::string& name : root.free_keys()) {
        library.add(read_material(root.section(name), library, file.parent_path(), name));
    }
    document.finish();
    return library;
}

MaterialLibrary default_material_library() {
    return load_material_library(data_folder() / "library.toml");
}

double solar_mean(const Spectrum& s) {
    static const Spectrum sun =
        read_spectrum(data_folder() / "atmosphere" / "sun_at_ground.csv", 0.0);
    return weighted_mean(s, sun);
}

double planck_mean(const Spectrum& s, double temperature) {
    if (s.value.size() < 2) return 0.0;
    const Band band = flat_band("", std::max(s.wavelength_um.front(), 0.2),
                                std::min(s.wavelength_um.back(), 100.0), s.wavelength_um);
    double sum = 0.0;
    for (std::size_t i = 0; i < band.node_um.size(); ++i) {
        sum += band.weight[i] * s.at(band.node_um[i]) * planck(band.node_um[i], temperature);
    }
    return sum / band_radiance(band, temperature);
}

}  // namespace diurna
