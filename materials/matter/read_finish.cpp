#include "materials/matter/read_finish.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/library.hpp"

namespace diurna {

namespace {

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
        throw InputError(path.string(), "expected 2 or more rows of wavelength_um, n and k");
    }
    auto& um = finish.index.wavelength_um;
    for (auto* value : {&finish.index.value, &finish.extinction.value}) {
        if (um.front() > 0.2) value->insert(value->begin(), value->front());
        if (um.back() < 100.0) value->push_back(value->back());
    }
    if (um.front() > 0.2) um.insert(um.begin(), 0.2);
    if (um.back() < 100.0) um.push_back(100.0);
    finish.extinction.wavelength_um = um;
}

Finish read_kind(const Section& section, const std::filesystem::path& folder) {
    const std::vector<std::string> kinds = {"lambert", "gloss", "metal", "by_angle"};
    const std::string kind = section.word_or("kind", "lambert", kinds);
    if (kind == "gloss" || kind == "metal") {
        Glossy finish{.roughness = section.number("roughness", 0.0, 1.0),
                      .metal = kind == "metal",
                      .index = {},
                      .extinction = {}};
        if (finish.metal) return finish;
        if (section.has("index_file")) {
            try {
                read_index(folder / section.text("index_file"), finish);
                return finish;
            } catch (const InputError& error) {
                section.mistake("index_file", error.what());
            }
        }
        const double index =
            section.has("index_file") ? 1.5 : section.number("index", 1.0 + 1e-6, 5.0);
        finish.index = flat_spectrum(index);
        finish.extinction = {};
        return finish;
    }
    if (kind == "by_angle") {
        ByAngle finish;
        for (const std::vector<double>& row : section.rows("factors", 2, 2)) {
            const bool ascends = finish.angle_deg.empty() || row[0] > finish.angle_deg.back();
            if (row[0] < 0.0 || row[0] > 90.0 || row[1] < 0.0 || !ascends) {
                section.mistake("factors",
                                "expected [angle_deg, factor] with ascending angles of 0 to 90 and "
                                "factors of zero or more");
                return Lambert{};
            }
            finish.angle_deg.push_back(row[0]);
            finish.factor.push_back(row[1]);
        }
        if (finish.angle_deg.size() < 2) return Lambert{};
        return finish;
    }
    if (section.has("kind") && section.text_or("kind", kind) != kind) section.free_keys();
    return Lambert{};
}

/// The share that is not covered lets everything through.
void open_up(double cover, Material& material) {
    if (material.transmittance.empty()) {
        material.transmittance = flat_spectrum(1.0 - cover);
    } else {
        for (double& value : material.transmittance.value) value = 1.0 - cover + cover * value;
    }
    for (double& value : material.reflectance.value) value *= cover;
    ThermalSurface& thermal = material.thermal;
    thermal.albedo *= cover;
    thermal.emissivity *= cover;
    thermal.solar_transmittance = 1.0 - cover + cover * thermal.solar_transmittance;
}

}  // namespace

void read_finish(const Section& section, const std::filesystem::path& folder, Material& material) {
    if (section.has("finish")) {
        material.finish = read_kind(section.section("finish"), folder);
        if (!section.has("emissivity") && !std::holds_alternative<Lambert>(material.finish)) {
            Spectrum emissivity{.wavelength_um = material.reflectance.wavelength_um, .value = {}};
            for (const double um : emissivity.wavelength_um) {
                emissivity.value.push_back(hemispherical_optics(material, um).emissivity);
            }
            material.thermal.emissivity = planck_mean(emissivity);
        }
    }
    material.see_through = section.flag_or("see_through", material.see_through);
    if (section.has("cover")) {
        open_up(section.number("cover", 0.0, 1.0), material);
        material.see_through = true;
    }
    if (material.see_through && material.transmittance.empty()) {
        section.mistake("see_through",
                        "expected a transmittance or a cover: nothing lets light "
                        "through");
    }
}

}  // namespace diurna
