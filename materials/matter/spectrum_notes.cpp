#include "materials/matter/spectrum_notes.hpp"

#include <fmt/format.h>

namespace diurna {

std::vector<std::string> spectrum_notes(const Material& material, const std::vector<Band>& bands) {
    std::vector<std::string> notes;
    const std::string ends =
        fmt::format("material {}: its spectra were given over {:g} to {:g} µm and are held beyond",
                    material.kind(), material.given_from_um, material.given_to_um);
    if (material.guessed_albedo) {
        notes.push_back(fmt::format("{}: its albedo {:.3g} is a guess; `albedo` tells it", ends,
                                    material.thermal.albedo));
    }
    if (material.guessed_emissivity) {
        notes.push_back(
            fmt::format("{}: its emissivity {:.3g} is a guess; `emissivity` tells it, "
                        "or a spectrum to 14 µm",
                        ends, material.thermal.emissivity));
    }
    constexpr double rounding = 1e-6;
    for (const Band& band : bands) {
        if (band.from_um() >= material.given_from_um - rounding &&
            band.to_um() <= material.given_to_um + rounding) {
            continue;
        }
        notes.push_back(fmt::format("{}: so in band {}", ends, band.name));
    }
    return notes;
}

}  // namespace diurna
