#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "materials/spectrum.hpp"

namespace diurna {

enum class MaterialId : std::uint16_t {};

/// A homogeneous layer of a column, counted from the surface downward.
struct Layer {
    double thickness;      // [m]            1e-5 to 100
    double conductivity;   // [W m⁻¹ K⁻¹]    0.005 to 500
    double density;        // [kg m⁻³]
    double heat_capacity;  // [J kg⁻¹ K⁻¹]
};

/// What lies under the last layer.
struct FixedTemperature {
    double temperature;
};  // [K]
struct FixedFlux {
    double flux;
};  // [W m⁻²] upward, into the column
struct Interior {
    double air_temperature;
    double film;
};  // [K], [W m⁻² K⁻¹]: a heated room
using Bottom = std::variant<FixedTemperature, FixedFlux, Interior>;

/// How the surface exchanges heat with the air.
struct Louis {};   // bulk Monin-Obukhov, Louis 1979: ground
struct Tarp {};    // natural + forced by plate orientation: walls, roofs
struct Mowitt {};  // DOE-2 / MoWiTT: smooth surfaces, glass, metal
struct ConstantFilm {
    double film;
};  // [W m⁻² K⁻¹]
using Convection = std::variant<Louis, Tarp, Mowitt, ConstantFilm>;

/// Evaporation by a resistance in series with the air's; wetness 0 (dry) to 1.
struct Evaporation {
    double minimum_resistance = 0.0;  // [s m⁻¹]
    double wetness = 0.0;
};

/// The open back of a thin plate: air, and surroundings at the air's temperature, behind the last
/// layer, which then has no other bottom.
struct ExposedBack {
    double emissivity = 0.9;
    double albedo = 0.9;
};

/// What the heat balance needs of a surface: broadband optics, exchange with the air, the column.
/// albedo + solar transmittance + absorptance = 1; longwave: absorptance = emissivity.
struct ThermalSurface {
    double albedo = 0.0;                   // broadband, 0.3 to 4 µm
    double solar_transmittance = 0.0;      // passes through (glass) and is absorbed elsewhere
    double emissivity = 1.0;               // broadband, hemispherical
    double roughness_length = 0.01;        // momentum [m]
    double heat_roughness_length = 0.001;  // heat [m]
    Convection convection = Louis{};
    Evaporation evaporation;
    double internal_heat = 0.0;  // [W m⁻²] released at the surface
    std::vector<Layer> layers;
    Bottom bottom = FixedFlux{0.0};
    std::optional<ExposedBack> back;  // if set, in place of `bottom`
};

/// A kind of matter: its spectra for the picture, its thermal surface for the balance. Opaque or
/// partly transparent, Lambertian. Kirchhoff holds by construction: ε(λ) = 1 − ρ(λ) − τ(λ).
struct Material {
    std::string name;
    Spectrum reflectance;    // directional-hemispherical ρ(λ), 0.3 to 20 µm
    Spectrum transmittance;  // τ(λ); empty means opaque
    ThermalSurface thermal;

    double emissivity(double wavelength_um) const;  // 1 − ρ − τ
};

}  // namespace diurna
