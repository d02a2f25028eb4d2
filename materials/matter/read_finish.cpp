#include "materials/matter/read_finish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/matter/broadband.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/library.hpp"
#include "materials/matter/measured_brdf.hpp"
#include "materials/matter/read_brdf.hpp"
#include "materials/matter/read_optics.hpp"
#include "materials/matter/waves.hpp"

namespace diurna {

namespace {

constexpr double index_heat_begins_um = 4.0;  // of effective indices
constexpr const char* index_file_says =
    "complex refractive index of the coat or metal: CSV file of wavelength_um, n and k over the "
    "whole of every band";

/// n and k of a file into a finish; the ends go on.
void read_index(const std::filesystem::path& path, Glossy& finish) {
    const CsvTable table = read_csv(path);
    const std::size_t wavelength = table.column("wavelength_um"), n = table.column("n"),
                      k = table.column("k");
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double um = table.number(row, wavelength);
        if (row > 0 && !(um > finish.index.wavelength_um.back())) {
            throw InputError(table.where(row, wavelength), "expected ascending wavelengths");
        }
        if (!(um > 0.0 && table.number(row, n) > 0.0 && table.number(row, k) >= 0.0)) {
            throw InputError(table.where(row, n), "expected wavelength > 0, n > 0 and k >= 0");
        }
        finish.index.wavelength_um.push_back(um);
        finish.index.value.push_back(table.number(row, n));
        finish.extinction.value.push_back(table.number(row, k));
    }
    if (finish.index.value.size() < 2) {
        throw InputError(path.string(), "expected at least 2 rows of wavelength_um, n and k");
    }
    check_micrometres(finish.index, path);
    auto& um = finish.index.wavelength_um;
    for (auto* value : {&finish.index.value, &finish.extinction.value}) {
        if (um.front() > 0.2) value->insert(value->begin(), value->front());
        if (um.back() < 100.0) value->push_back(value->back());
    }
    if (um.front() > 0.2) um.insert(um.begin(), 0.2);
    if (um.back() < 100.0) um.push_back(100.0);
    finish.extinction.wavelength_um = um;
}

/// n and k of a gloss: of a file, or one number.
void read_refraction(const Section& section, Glossy& finish) {
    double index = 1.5;
    if (section.has("index_file")) {
        const std::filesystem::path file = section.file("index_file", index_file_says);
        try {
            if (!file.empty()) {
                read_index(file, finish);
                return;
            }
        } catch (const InputError& error) {
            section.mistake("index_file", error.what());
        }
    } else {
        index = section.number(
            "index",
            "refractive index n of the coat at all wavelengths, unless index_file is given",
            {1.0 + 1e-6, 5.0});
    }
    finish.index = flat_spectrum(index);
    finish.extinction = {};
}

/// Factors on the reflectance over the angle.
Finish read_by_angle(const Section& section) {
    ByAngle finish;
    const auto rows = section.rows(
        "factors", "[[angle_deg, factor], ...] on the reflectance, interpolated linearly", 2, 2);
    for (const std::vector<double>& row : rows) {
        const bool ascends = finish.angle_deg.empty() || row[0] > finish.angle_deg.back();
        if (row[0] < 0.0 || row[0] > 90.0 || row[1] < 0.0 || !ascends) {
            section.mistake("factors",
                            "expected [angle_deg, factor] with ascending angles of 0 to 90 and "
                            "factors of at least 0");
            return Lambert{};
        }
        finish.angle_deg.push_back(row[0]);
        finish.factor.push_back(row[1]);
    }
    if (finish.angle_deg.size() < 2) return Lambert{};
    return finish;
}

/// A measured BRDF of a file.
Finish read_measured(const Section& section) {
    const std::filesystem::path file =
        section.file("file",
                     "a measured BRDF: .binary of the MERL database, or .csv of light_deg, "
                     "eye_deg, azimuth_deg and brdf_sr");
    try {
        if (!file.empty()) return finish_of(read_brdf(file));
    } catch (const InputError& error) {
        section.mistake("file", error.what());
    }
    return Lambert{};
}

/// Smooth matter of which only the reflectance is known, beyond 4 µm: the n that sends it back
/// upright, n = (1 + √ρ) / (1 − √ρ); of a metal n = k (Hagen and Rubens) from
/// ρ = ((n − 1)² + n²) / ((n + 1)² + n²). Below, a dielectric keeps its index.
void take_effective_index(const Spectrum& reflectance, Glossy& finish) {
    constexpr double most = 0.9999;
    const Spectrum given = finish.index;
    finish.index = finish.extinction = {};
    for (std::size_t i = 0; i < reflectance.value.size(); ++i) {
        const double um = reflectance.wavelength_um[i];
        const double rho = std::clamp(reflectance.value[i], 0.0, most);
        finish.index.wavelength_um.push_back(um);
        finish.extinction.wavelength_um.push_back(um);
        if (finish.metal) {
            // 2 n² (1 − ρ) − 2 n (1 + ρ) + (1 − ρ) = 0, the greater root; dark metals n = k = 0.7
            const double half = 0.5 * (1.0 + rho) / (1.0 - rho);
            const double n = half + std::sqrt(std::max(0.0, half * half - 0.5));
            finish.index.value.push_back(n);
            finish.extinction.value.push_back(n);
            continue;
        }
        const double root = std::sqrt(rho);
        finish.index.value.push_back(um <= index_heat_begins_um ? given.at(um)
                                                                : (1.0 + root) / (1.0 - root));
        finish.extinction.value.push_back(0.0);
    }
}

bool wants_effective_index(const Section& section) {
    return section.has("effective_index") &&
           section.flag_or("effective_index",
                           "use the index above 4 µm (metal: everywhere) that gives the "
                           "reflectance at normal incidence",
                           false);
}

/// n and k of a gloss or of a metal that has them.
void read_indices(const Section& section, const Spectrum& reflectance, Glossy& finish) {
    if (!finish.metal || section.has("index_file")) read_refraction(section, finish);
    if (!finish.waves && !finish.pane && wants_effective_index(section)) {
        take_effective_index(reflectance, finish);
    }
}

Finish read_law(const Section& section, const Spectrum& reflectance) {
    const std::string kind = section.kind_or(
        "angular reflectance; lambert: constant; gloss: a clear coat over it, such as paint or "
        "varnish; metal: bare metal; waves: water, roughened by the wind; pane: a sheet with two "
        "smooth faces and the given transmittance at normal incidence; by_angle: a table; "
        "measured: a BRDF",
        "lambert", {"lambert", "gloss", "metal", "waves", "pane", "by_angle", "measured"});
    if (kind == "by_angle") return read_by_angle(section);
    if (kind == "measured") return read_measured(section);
    if (kind == "lambert") return Lambert{};
    Glossy finish;
    finish.metal = kind == "metal";
    finish.waves = kind == "waves";
    finish.pane = kind == "pane";
    if (finish.pane) {
        finish.roughness = 0.0;
    } else if (finish.waves) {
        finish.roughness = roughness_under(finish, mean_wind_over_water);
    } else {
        finish.roughness =
            section.number("roughness", "roughness of its microfacets; 0: a mirror", {0.0, 1.0});
    }
    read_indices(section, reflectance, finish);
    return finish;
}

/// The heat balance takes what a law of angle comes to over the hemisphere: the emissivity, and of
/// water, which is bright at grazing angles only, the albedo.
void average_over_hemisphere(const Section& section, Material& material) {
    if (std::holds_alternative<Lambert>(material.finish)) return;
    const std::vector<double>& um = material.reflectance.wavelength_um;
    Spectrum emissivity{.wavelength_um = um, .value = {}}, reflectance = emissivity;
    for (const DirectionalOptics& optics : hemispherical_optics_at(material, um)) {
        emissivity.value.push_back(optics.emissivity);
        reflectance.value.push_back(optics.mirrored + optics.diffuse);
    }
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    if (!section.has("emissivity")) material.thermal.emissivity = planck_mean(emissivity);
    if (glossy && glossy->waves && !section.has("albedo")) {
        material.thermal.albedo = solar_mean(reflectance);
    }
}

}  // namespace

void read_finish(const Section& section, bool renewed, Material& material) {
    if (section.has("finish")) {
        material.finish = read_law(section.section("finish", finish_says), material.reflectance);
    }
    if (renewed) average_over_hemisphere(section, material);
}

std::optional<IndexReach> index_reach(const Section& section, const Glossy& finish) {
    if (!section.has("finish")) return {};
    const Section law = section.section("finish", finish_says);
    if (!law.has("index_file")) return {};
    const bool plain = !finish.waves && !finish.pane;
    const bool effective = plain && wants_effective_index(law);
    if (finish.metal && effective) return {};
    const std::filesystem::path file = law.file("index_file", index_file_says);
    if (file.empty()) return {};
    try {
        const CsvTable table = read_csv(file);
        const std::size_t column = table.column("wavelength_um");
        if (table.rows.empty()) return {};
        return IndexReach{.from_um = table.number(0, column),
                          .to_um = table.number(table.rows.size() - 1, column),
                          .needed_to_um = effective ? index_heat_begins_um : 1e3,
                          .effective_helps = plain && !finish.metal && !effective};
    } catch (const InputError&) {
        return {};  // reported when it was read
    }
}

}  // namespace diurna
