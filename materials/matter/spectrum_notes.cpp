#include "materials/matter/spectrum_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <variant>

namespace diurna {

namespace {

struct Reach {
    double from_um, to_um;
    bool holds(const Band& band) const {
        constexpr double rounding = 1e-6;
        return band.from_um() >= from_um - rounding && band.to_um() <= to_um + rounding;
    }
};

/// From where to where a finish has n and k of a table; beyond its ends their values go on, so that
/// they are the same twice (read_finish). None: no table, or k of nothing but a law.
std::optional<Reach> index_given(const Finish& finish) {
    const auto* glossy = std::get_if<Glossy>(&finish);
    if (glossy == nullptr) return {};
    const Spectrum &n = glossy->index, &k = glossy->extinction;
    const auto none = [](double x) { return x == 0.0; };
    const bool by_law = n.value == k.value || std::all_of(k.value.begin(), k.value.end(), none);
    const std::size_t rows = n.value.size();
    if (by_law || rows < 3 || k.value.size() != rows) return {};
    const auto same = [&](std::size_t a, std::size_t b) {
        return n.value[a] == n.value[b] && k.value[a] == k.value[b];
    };
    return Reach{n.wavelength_um[same(0, 1) ? 1 : 0],
                 n.wavelength_um[same(rows - 2, rows - 1) ? rows - 2 : rows - 1]};
}

}  // namespace

std::vector<std::string> spectrum_notes(const Material& material, const std::vector<Band>& bands) {
    std::vector<std::string> notes;
    const std::string ends = fmt::format(
        "material {}: its spectra cover {:g} to {:g} µm and are extended by their end values",
        material.kind(), material.given_from_um, material.given_to_um);
    if (material.guessed_albedo) {
        notes.push_back(
            fmt::format("{}: the albedo {:.3g} is estimated from them; set it by `albedo`", ends,
                        material.thermal.albedo));
    }
    if (material.guessed_emissivity) {
        notes.push_back(
            fmt::format("{}: the emissivity {:.3g} is estimated from them; set it by `emissivity`, "
                        "or give a spectrum up to 14 µm",
                        ends, material.thermal.emissivity));
    }
    const Reach given{material.given_from_um, material.given_to_um};
    const std::optional<Reach> index = index_given(material.finish);
    for (const Band& band : bands) {
        if (!given.holds(band))
            notes.push_back(fmt::format("{}, which affects band {}", ends, band.name));
        if (!index || index->holds(band)) continue;
        notes.push_back(
            fmt::format("material {}: n and k cover {:g} to {:g} µm and are extended by their end "
                        "values, which affects band {}",
                        material.kind(), index->from_um, index->to_um, band.name));
    }
    return notes;
}

}  // namespace diurna
