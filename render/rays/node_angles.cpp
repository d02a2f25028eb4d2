#include "render/rays/node_angles.hpp"

#include <variant>

namespace diurna {

std::vector<DirectionalOptics> optics_at_nodes(const Material& material, const Band& band,
                                               double cosine) {
    std::vector<DirectionalOptics> optics;
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    const bool once =
        !glossy || (glossy->index.value.size() <= 2 && glossy->extinction.value.size() <= 2);
    double here = 0.0, normal = 0.0;
    for (std::size_t n = 0; n < band.node_um.size(); ++n) {
        const double um = band.node_um[n];
        if (n == 0 || !once) {
            here = interface_reflectance(material.finish, um, cosine);
            normal = interface_reflectance(material.finish, um, laboratory_cosine);
        }
        optics.push_back(directional_optics(material, um, cosine, here, normal));
    }
    return optics;
}

std::vector<double> mean_diffuse_at_nodes(const Material& material, const Band& band) {
    constexpr int steps = 100;
    std::vector<double> mean(band.node_um.size(), 0.0);
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        const auto optics = optics_at_nodes(material, band, cosine);
        for (std::size_t n = 0; n < mean.size(); ++n) {
            mean[n] += optics[n].diffuse * 2.0 * cosine / steps;
        }
    }
    return mean;
}

std::vector<double> facing_at_nodes(const Material& material, const Band& band, double cosine) {
    const auto& glossy = std::get<Glossy>(material.finish);
    std::vector<double> mirrored;
    const bool once = glossy.index.value.size() <= 2 && glossy.extinction.value.size() <= 2;
    double normal = 0.0;
    for (std::size_t n = 0; n < band.node_um.size(); ++n) {
        const double um = band.node_um[n];
        if (n == 0 || !once) {
            normal = interface_reflectance(material.finish, um, laboratory_cosine);
        }
        mirrored.push_back(
            directional_optics(material, um, cosine, smooth_reflectance(glossy, um, cosine), normal)
                .mirrored);
    }
    return mirrored;
}

}  // namespace diurna
