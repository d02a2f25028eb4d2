#include "scenes/products/report/material_pages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "scenes/products/report/material_figures.hpp"

namespace diurna {

namespace {

std::string what_of(const LibraryNotes& notes, const std::string& name) {
    const MaterialNote* note = notes.find(name);
    return note ? note->what : "";
}

std::string layers_of(const Material& material) {
    std::string out = "layers, from the surface downward\n";
    for (const Layer& layer : material.thermal.layers) {
        out += fmt::format("  {:.4g} m, {:.4g} W/mK, {:.4g} kg/m3, {:.4g} J/kgK\n", layer.thickness,
                           layer.conductivity, layer.density, layer.heat_capacity);
    }
    return out;
}

std::string figures_of(const Material& material) {
    const MaterialFigures f = material_figures(material);
    std::string out;
    const auto add = [&](const char* what, const std::string& value, const char* how) {
        out += fmt::format("{:<22}{:<11}{}\n", what, value, how);
    };
    const auto share = [](double x) { return fmt::format("{:.3f}", x); };
    if (material.cover < 1.0) {
        add("cover", share(material.cover),
            "of the strips of this net; the rest is open; the values below apply to the strips");
    }
    add("albedo", share(f.albedo), "weighted by the sun at the ground, ASTM G173");
    if (f.transmittance > 0.0) {
        add("solar transmittance", share(f.transmittance),
            "weighted by the sun at the ground, ASTM G173");
    }
    add("emissivity", share(f.emissivity), "hemispherical, weighted by Planck at 300 K");
    add("  3-5 um", share(f.mwir), "10 deg from the normal");
    add("  8-12 um", share(f.lwir), "");
    add("  8-14 um", share(f.wide), "");
    add("diffusivity", fmt::format("{:.3g}", f.diffusivity), "m2/s, top layer");
    add("inertia", fmt::format("{:.0f}", f.inertia), "J/m2K s^1/2, top layer: sqrt(k rho c)");
    add("diurnal depth", fmt::format("{:.3g}", f.day_depth),
        "m, where the diurnal temperature wave falls to 1/e");
    add("roughness length", fmt::format("{:g}", material.thermal.roughness_length),
        "m, for momentum");
    add("", fmt::format("{:g}", material.thermal.heat_roughness_length), "m, for heat");
    return out;
}

/// The lines of a material and of those it starts from, itself first.
std::vector<const MaterialNote*> ancestry(const LibraryNotes& notes, const std::string& name) {
    std::vector<const MaterialNote*> chain;
    for (const MaterialNote* note = notes.find(name); note && chain.size() < 16;
         note = note->like.empty() ? nullptr : notes.find(note->like)) {
        chain.push_back(note);
    }
    return chain;
}

std::string sources_in(const std::string& text, const LibraryNotes& notes) {
    std::string out;
    for (const SourceNote& source : notes.sources) {
        if (names_source(text, source.tag)) {
            out += fmt::format("  {:<10}{}\n", source.tag, source.text);
        }
    }
    return out.empty() ? out : "\nsources\n" + out;
}

}  // namespace

std::string materials_list(const MaterialLibrary& library, const LibraryNotes& notes) {
    std::string out = fmt::format("{:<26}{:>7}{:>7}{:>8}{:>8}{:>9}  description\n", "name",
                                  "albedo", "emis.", "3-5 um", "8-12 um", "inertia");
    for (const std::string& name : library.names()) {
        const MaterialFigures f = material_figures(library[library.find(name)]);
        out += fmt::format("{:<26}{:>7.2f}{:>7.2f}{:>8.2f}{:>8.2f}{:>9.0f}  {}\n", name, f.albedo,
                           f.emissivity, f.mwir, f.lwir, f.inertia, what_of(notes, name));
    }
    return out;
}

std::string material_sheet(const Material& material, const LibraryNotes& notes,
                           const std::filesystem::path& folder) {
    std::string out = fmt::format("{}: {}\n\n{}{}\n", material.name, what_of(notes, material.name),
                                  figures_of(material), layers_of(material));
    std::vector<std::string> files;
    std::string lines;
    for (const MaterialNote* note : ancestry(notes, material.name)) {
        lines += fmt::format("[{}]\n", note->name);
        for (const std::string& line : note->lines) lines += line + "\n";
        lines += "\n";
        for (const std::string& file : spectra_of(*note)) {
            if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
        }
    }
    out += "sources of all numbers: library.toml\n" + lines;
    for (const std::string& file : files) {
        out += file + "\n";
        for (const std::string& line : head_comment(folder / file)) out += "  " + line + "\n";
    }
    return out + sources_in(lines, notes);
}

std::string materials_page(const MaterialLibrary& library, const LibraryNotes& notes) {
    std::string out =
        "# The library of materials\n\nPrinted by `diurna materials --page`; the chart by `diurna "
        "materials --chart`. Edit neither of them: edit\n`library.toml` and `spectra/`. `diurna "
        "materials NAME` prints one material with the source of every number.\n\n![Spectra, "
        "colours and properties of all materials](library.svg)\n\nAlbedo: under the sun at the "
        "ground (ASTM G173). ε: hemispherical emissivity, weighted by Planck's law at 300 K, and "
        "10°\nfrom the normal in 3 to 5, 8 to 12 and 8 to 14 µm. Diffusivity k / ρ c, thermal "
        "inertia √(k ρ c) and diurnal depth (where\nthe temperature wave of a day falls to 1/e) "
        "are those of the top layer. Soil: thawed. Nets: values of the strips, without\nthe "
        "holes.\n\n| material | description | albedo | ε | ε 3-5 | ε 8-12 | ε 8-14 | diffusivity "
        "mm²/s | inertia J/m²K√s | diurnal depth m |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const std::string& name : library.names()) {
        const MaterialFigures f = material_figures(library[library.find(name)]);
        out += fmt::format(
            "| `{}` | {} | {:.2f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3g} | {:.0f} | {:.2g} "
            "|\n",
            name, what_of(notes, name), f.albedo, f.emissivity, f.mwir, f.lwir, f.wide,
            1e6 * f.diffusivity, f.inertia, f.day_depth);
    }
    return out;
}

}  // namespace diurna
