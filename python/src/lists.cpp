#include <pybind11/stl.h>

#include <string>

#include "materials/air/profile.hpp"
#include "materials/atmosphere/band_model.hpp"
#include "materials/base/data_folder.hpp"
#include "materials/matter/library_notes.hpp"
#include "materials/matter/read_library.hpp"
#include "python/src/bind.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/products/report/material_figures.hpp"
#include "terrain/objects/models/models.hpp"

// Lists of what a scene may name: materials, models, bands, air.

namespace diurna::python {

namespace {

py::list materials() {
    const MaterialLibrary library = default_material_library();
    const LibraryNotes notes = library_notes(data_folder() / "library.toml");
    py::list out;
    for (const std::string& name : library.names()) {
        const Material& material = library[library.find(name)];
        const MaterialFigures figures = material_figures(material);
        const MaterialNote* note = notes.find(name);
        py::dict one;
        one["name"] = name;
        one["description"] = note != nullptr ? note->what : "";
        one["albedo"] = figures.albedo;
        one["solar_transmittance"] = figures.transmittance;
        one["emissivity"] = figures.emissivity;
        one["emissivity_3_5_um"] = figures.mwir;
        one["emissivity_8_12_um"] = figures.lwir;
        one["inertia"] = figures.inertia;
        one["roughness_length_m"] = material.thermal.roughness_length;
        out.append(one);
    }
    return out;
}

py::list models() {
    py::list out;
    for (const std::string& name : model_names()) {
        py::dict one;
        one["name"] = name;
        one["description"] = model_line(name);
        one["upright"] = stands_upright(name);
        out.append(one);
    }
    return out;
}

py::list bands() {
    py::list out;
    for (const char* word : {"visible", "nir", "swir", "mwir", "lwir"}) {
        const Band band = named_band({}, word);
        py::dict one;
        one["name"] = word;
        one["from_um"] = band.from_um();
        one["to_um"] = band.to_um();
        out.append(one);
    }
    return out;
}

}  // namespace

void bind_lists(py::module_& module) {
    module.def("materials", &materials, "Materials of the library, one dictionary each.");
    module.def("models", &models, "Objects built by the program, one dictionary each.");
    module.def("bands", &bands, "Bands that have a word for a name, one dictionary each.");
    module.def("profiles", &afgl_profile_names, "Names of the profiles of the air.");
    module.def("aerosols", &aerosol_names, "Names of the aerosols of the haze.");
}

}  // namespace diurna::python
