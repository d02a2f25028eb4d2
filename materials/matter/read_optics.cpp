#include "materials/matter/read_optics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "materials/base/error.hpp"
#include "materials/matter/broadband.hpp"

namespace diurna {

namespace {

constexpr double shortest_um = 0.2, longest_um = 100.0;
constexpr double split_um = 4.0;  // sunlight below, own emission above

/// Keeps its end values out to 0.2 and 100 µm, so that no band looks past a spectrum's end.
Spectrum extended(Spectrum s) {
    if (s.wavelength_um.front() > shortest_um) {
        s.wavelength_um.insert(s.wavelength_um.begin(), shortest_um);
        s.value.insert(s.value.begin(), s.value.front());
    }
    if (s.wavelength_um.back() < longest_um) {
        s.wavelength_um.push_back(longest_um);
        s.value.push_back(s.value.back());
    }
    return s;
}

/// The spectrum with separate factors below and above 4 µm, cut into two there.
Spectrum scaled(const Spectrum& s, double below, double above) {
    Spectrum result;
    const auto append = [&](double wavelength, double value) {
        result.wavelength_um.push_back(wavelength);
        result.value.push_back(std::clamp(value, 0.0, 1.0));
    };
    for (std::size_t i = 0; i < s.value.size(); ++i) {
        const double wavelength = s.wavelength_um[i];
        const bool crosses = i > 0 && s.wavelength_um[i - 1] <= split_um && wavelength > split_um;
        if (crosses) {
            if (s.wavelength_um[i - 1] < split_um) append(split_um, below * s.at(split_um));
            append(split_um + 1e-4, above * s.at(split_um + 1e-4));
        }
        if (crosses && wavelength <= split_um + 1e-4) continue;
        append(wavelength, (wavelength <= split_um ? below : above) * s.value[i]);
    }
    return result;
}

/// 1 − ρ − τ on the union of both grids.
Spectrum absorptance(const Spectrum& reflectance, const Spectrum& transmittance) {
    std::vector<double> grid = reflectance.wavelength_um;
    grid.insert(grid.end(), transmittance.wavelength_um.begin(), transmittance.wavelength_um.end());
    std::sort(grid.begin(), grid.end());
    grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
    Spectrum result{.wavelength_um = grid, .value = {}};
    for (const double um : grid) {
        result.value.push_back(1.0 - reflectance.at(um) - transmittance.at(um));
    }
    return result;
}

/// Makes the values of a column those of `key`, by its name: 1 − emissivity for reflectance. Throws
/// InputError for another quantity.
///
/// - column: its name in small letters
void take_quantity(const std::filesystem::path& file, const std::string& column,
                   std::string_view key, bool opaque, Spectrum& s) {
    const auto has = [&](const char* part) { return column.find(part) != std::string::npos; };
    const bool left = has("emiss") || has("absorpt");  // 1 − ρ − τ
    const bool reflectance = key == "reflectance";
    if (reflectance && left && opaque) {
        for (double& value : s.value) value = 1.0 - value;
        return;
    }
    if (!left && !has(reflectance ? "transm" : "reflec")) return;
    throw InputError(file.string() + ": " + column,
                     fmt::format("found a column of another quantity, expected {}", key),
                     left ? "emissivity is 1 - reflectance - transmittance"
                          : fmt::format("name the column {} if it is", key));
}

/// A spectrum of a file, as far as it goes.
Spectrum read_file(const Section& section, const char* key, const char* says) {
    const std::filesystem::path file = section.file(key, says);
    try {
        if (!file.empty()) {
            const std::string column = small_letters(column_of_spectrum(file));
            const bool percent = column.find("percent") != std::string::npos ||
                                 column.find('%') != std::string::npos;
            Spectrum s = read_spectrum(file, 0.0, percent ? 100.0 : 1.0);
            if (percent) {
                for (double& value : s.value) value *= 0.01;
            }
            take_quantity(file, column, key, !section.has("transmittance"), s);
            check_micrometres(s, file);
            return s;
        }
    } catch (const InputError& error) {
        section.mistake(key, error.what());
    }
    return two_step_reflectance(0.0, 1.0);
}

/// The means that a table gives of its own.
struct Means {
    std::optional<double> albedo, emissivity;
};

Means read_means(const Section& section, bool needed) {
    constexpr const char *albedo =
                             "broadband albedo, 0.3 to 4 µm, weighted by the sun at the ground; "
                             "required without reflectance and `like`",
                         *emissivity =
                             "broadband hemispherical emissivity, weighted by Planck's law at 300 "
                             "K; required without reflectance and `like`";
    Means means;
    if (needed || section.has("albedo"))
        means.albedo = section.number("albedo", albedo, {0.0, 1.0});
    if (needed || section.has("emissivity")) {
        means.emissivity = section.number("emissivity", emissivity, {0.0, 1.0});
    }
    return means;
}

/// No wavelength may send back and let through more than there is.
void check_absorbed(const Section& section, const Spectrum& absorbed) {
    const auto least = std::min_element(absorbed.value.begin(), absorbed.value.end());
    if (*least >= -1e-9) return;
    const double um =
        absorbed.wavelength_um[static_cast<std::size_t>(least - absorbed.value.begin())];
    section.mistake(
        "reflectance",
        fmt::format("reflectance and transmittance add up to {:.4g} at {:g} µm, expected at most 1",
                    1.0 - *least, um));
}

/// Takes a spectrum of a file into what the material's were given over, and whether its means then
/// are guesses.
void note_range(const Spectrum& given, Material& material) {
    constexpr double least_sun = 0.9, heat_um = 12.0;
    material.given_from_um = std::max(material.given_from_um, given.wavelength_um.front());
    material.given_to_um = std::min(material.given_to_um, given.wavelength_um.back());
    material.guessed_albedo = solar_share(material.given_from_um, material.given_to_um) < least_sun;
    material.guessed_emissivity = material.given_to_um < heat_um;
}

/// Scales the material's spectrum to the given means.
void fit_means(const Section& section, const Means& means, Material& material) {
    ThermalSurface& thermal = material.thermal;
    const double albedo = means.albedo.value_or(thermal.albedo);
    const double emissivity = means.emissivity.value_or(thermal.emissivity);
    if (albedo + thermal.solar_transmittance > 1.0) {
        section.mistake(
            "albedo",
            fmt::format(
                "found {:g}, expected at most {:.4g}: the remaining sunlight is transmitted",
                albedo, 1.0 - thermal.solar_transmittance));
    }
    const double reflected = planck_mean(material.reflectance);
    const double wanted = std::max(0.0, reflected + thermal.emissivity - emissivity);
    const double below = thermal.albedo > 0.0 ? albedo / thermal.albedo : 1.0;
    const double above = reflected > 0.0 ? wanted / reflected : 1.0;
    Spectrum fitted = scaled(material.reflectance, below, above);
    // A spectrum that cannot be scaled to these means (dark, or cut off at 1) is made flat.
    if (std::abs(solar_mean(fitted) - albedo) > 0.01 ||
        std::abs(planck_mean(fitted) - wanted) > 0.01) {
        fitted = two_step_reflectance(albedo, 1.0 - wanted);
    }
    material.reflectance = std::move(fitted);
    thermal.albedo = albedo;
    thermal.emissivity = emissivity;
}

}  // namespace

Spectrum two_step_reflectance(double albedo, double emissivity) {
    return {.wavelength_um = {shortest_um, split_um, split_um + 1e-4, longest_um},
            .value = {albedo, albedo, 1.0 - emissivity, 1.0 - emissivity}};
}

void check_micrometres(const Spectrum& s, const std::filesystem::path& file) {
    constexpr double longest = 20.0;  // of the wavelengths that pictures may be of
    if (s.wavelength_um.front() < longest) return;
    throw InputError(
        file.string(),
        fmt::format(
            "found wavelengths of {:g} to {:g} µm, expected some below {:g}: they seem to be in nm",
            s.wavelength_um.front(), s.wavelength_um.back(), longest),
        "divide them by 1000");
}

void read_optics(const Section& section, bool fresh, Material& material) {
    ThermalSurface& thermal = material.thermal;
    const double albedo_before = thermal.albedo, emissivity_before = thermal.emissivity;
    // Without a file a material of its own needs both numbers; otherwise each may change a mean.
    const bool needed = fresh && !section.has("reflectance");
    const bool anew = fresh || section.has("reflectance") || section.has("transmittance") ||
                      section.has("finish");
    const Means means = read_means(section, needed);
    if (section.has("reflectance")) {
        const Spectrum given =
            read_file(section, "reflectance",
                      "hemispherical reflectance: CSV file of wavelength_um and value, 0 to 1");
        material.given_from_um = Material{}.given_from_um;
        material.given_to_um = Material{}.given_to_um;
        note_range(given, material);
        material.reflectance = extended(given);
    } else if (fresh) {
        material.reflectance = two_step_reflectance(*means.albedo, *means.emissivity);
    }
    if (section.has("transmittance")) {
        const Spectrum given = read_file(
            section, "transmittance",
            "transmittance: CSV file of wavelength_um and value, 0 to 1; default: opaque");
        note_range(given, material);
        material.transmittance = extended(given);
    }
    if (means.albedo) material.guessed_albedo = false;
    if (means.emissivity) material.guessed_emissivity = false;
    const Spectrum absorbed = absorptance(material.reflectance, material.transmittance);
    check_absorbed(section, absorbed);
    thermal.solar_transmittance = solar_mean(material.transmittance);
    thermal.albedo = solar_mean(material.reflectance);
    thermal.emissivity = planck_mean(absorbed);
    if (needed) {  // the means of a flat spectrum differ from these by the tail beyond 4 µm
        thermal.albedo = *means.albedo;
        thermal.emissivity = *means.emissivity;
    } else if (means.albedo || means.emissivity) {
        fit_means(section, means, material);
    }
    if (anew) return;
    // Of the same spectra and law of angle: only what was given is another.
    if (!means.albedo) thermal.albedo = albedo_before;
    if (!means.emissivity) thermal.emissivity = emissivity_before;
}

}  // namespace diurna
