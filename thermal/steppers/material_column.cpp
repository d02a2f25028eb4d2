#include "thermal/steppers/material_column.hpp"

namespace diurna {

MaterialColumn material_column(const ThermalSurface& surface, const StepSetup& setup,
                               const LouisForm* louis) {
    // Behind a plate a typical film stands in the grid, for first guesses and the period's matrix;
    // its steps take the true one.
    constexpr double film_behind = 15.0;
    const Bottom bottom =
        surface.back ? Bottom{Interior{setup.reference, film_behind}} : surface.bottom;
    MaterialColumn material{
        .surface = surface,
        .louis = louis ? *louis
                       : louis_form(surface.roughness_length, surface.heat_roughness_length,
                                    setup.wind_height, setup.air_height),
        .grid = column_grid(surface.layers, bottom, setup.grid),
        .stage = {},
        .reference = setup.reference,
        .substeps = 0};
    constexpr double typical_film = 25.0;  // [W m⁻² K⁻¹] radiation and air together
    double share;
    do {
        ++material.substeps;
        const double step = setup.step / material.substeps;
        share = typical_film / make_stage(material.grid, step, setup.reference).b;
    } while (share > setup.largest_share && material.substeps < setup.most_substeps);
    material.substeps *= setup.refinement;
    material.stage =
        make_stage(material.grid, sdirk_gamma * setup.step / material.substeps, setup.reference);
    return material;
}

}  // namespace diurna
