#include "scenes/job/world/sheets.hpp"

#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>

#include "materials/matter/read_optics.hpp"
#include "terrain/objects/open_pieces.hpp"
#include "terrain/visibility/two_sides.hpp"

namespace diurna {

namespace {

/// Whether air is behind the last layer, by what a material says or leaves unsaid.
bool air_behind(const ThermalSurface& surface) {
    const auto* flux = std::get_if<FixedFlux>(&surface.bottom);
    return surface.back || (flux && flux->flux == 0.0);
}

Material front_of(const Material& base) {
    Material front = base;
    front.name = base.name + " (sheet)";
    front.varies = base.kind();
    const ThermalSurface& as_front = base.thermal;
    if (!air_behind(as_front)) return front;
    front.see_through = !base.transmittance.empty();
    const bool pane = front.see_through && as_front.solar_transmittance > 0.0;
    if (pane || !as_front.back) {
        front.thermal.back =
            ExposedBack{.emissivity = as_front.emissivity, .albedo = as_front.albedo};
    }
    return front;
}

/// What is seen of a sheet from behind.
///
/// base  its front
Material back_of(const Material& base) {
    const ExposedBack back = base.thermal.back.value_or(
        ExposedBack{.emissivity = base.thermal.emissivity, .albedo = base.thermal.albedo});
    Material seen = base;
    seen.name = base.kind() + " (back)";
    const double solar_transmittance = base.see_through ? base.thermal.solar_transmittance : 0.0;
    const bool alike = std::abs(back.emissivity - base.thermal.emissivity) < 1e-6 &&
                       std::abs(back.albedo - base.thermal.albedo) < 1e-6;
    if (!alike) {
        seen.finish = Lambert{};
        seen.reflectance = two_step_reflectance(back.albedo, back.emissivity);
        for (std::size_t i = 0; base.see_through && i < seen.reflectance.value.size(); ++i) {
            // Of a net, of its strips.
            seen.reflectance.value[i] *=
                1.0 - base.transmittance.at(seen.reflectance.wavelength_um[i]);
        }
    }
    if (!base.see_through) seen.transmittance = {};
    seen.thermal = {};
    seen.thermal.albedo = back.albedo;
    seen.thermal.emissivity = back.emissivity;
    seen.thermal.solar_transmittance = solar_transmittance;
    seen.thermal.roughness_length = base.thermal.roughness_length;
    seen.thermal.heat_roughness_length = base.thermal.heat_roughness_length;
    seen.thermal.convection = base.thermal.convection;
    return seen;
}

}  // namespace

const SheetMaterials& Sheets::of(MaterialId material) {
    if (const auto known = known_.find(material); known != known_.end()) return known->second;
    const Material base = materials_[material];
    const auto* flux = std::get_if<FixedFlux>(&base.thermal.bottom);
    SheetMaterials sheet{material, material, air_behind(base.thermal) || !flux};
    if (sheet.two_sided) {
        Material front = front_of(base);
        Material back = back_of(front);
        if (!base.thermal.back) back.thermal.evaporation = base.thermal.evaporation;
        sheet.back = materials_.add(std::move(back));
        sheet.front = materials_.add(std::move(front));
    }
    return known_.emplace(material, sheet).first->second;
}

void Sheets::append(FacetSet& facets, const ObjectMesh& mesh, ObjectId object) {
    const std::vector<std::uint8_t> open = open_pieces(mesh);
    ObjectMesh closed{mesh.vertex, {}, {}}, sheet{mesh.vertex, {}, {}};
    std::map<MaterialId, MaterialId> back;
    for (std::size_t t = 0; t < open.size(); ++t) {
        MaterialId material = mesh.material[t];
        // A net or a pane encloses nothing: what passes one side meets the inside of the other.
        const bool lets_through = materials_[material].see_through;
        const bool two_sided = (open[t] || lets_through) && of(material).two_sided;
        if (two_sided) {
            back[of(material).front] = of(material).back;
            material = of(material).front;
        }
        ObjectMesh& part = two_sided ? sheet : closed;
        part.triangle.push_back(mesh.triangle[t]);
        part.material.push_back(material);
    }
    append_facets(facets, closed, object);
    std::vector<std::uint32_t> front;
    std::vector<MaterialId> behind;
    const std::size_t first = facets.size();
    append_facets(facets, sheet, object);
    for (std::size_t f = first; f < facets.size(); ++f) {
        front.push_back(static_cast<std::uint32_t>(f));
        behind.push_back(back.at(facets.material[f]));
    }
    append_backs(facets, front, behind);
}

}  // namespace diurna
