#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "materials/matter/finish.hpp"
#include "materials/radiation/spectrum.hpp"

namespace diurna {

enum class MaterialId : std::uint16_t {};

/// c(T) = Σ coefficient[i] Tⁱ [J kg⁻¹ K⁻¹].
using HeatPolynomial = std::array<double, 5>;

/// Laws of a layer: constants, or one of the following.
struct Constant {};
/// Conductivity (1 + cubic T³) and a polynomial heat capacity: regolith in a vacuum.
struct Radiating {
    double cubic;  // [K⁻³]
    HeatPolynomial heat;
};
inline constexpr double heat_of_fusion = 3.337e5;  // [J kg⁻¹] of ice at 273.15 K
/// Water that freezes at 273.15 K; the layer's own constants are those of the thawed state.
struct Freezing {
    double water;                 // [kg m⁻³] that freezes
    double frozen_conductivity;   // [W m⁻¹ K⁻¹]
    double frozen_heat_capacity;  // [J kg⁻¹ K⁻¹]
};
/// Snow: stays at or below 273.15 K. Meltwater beyond `held` (kg per kg of snow) runs off; the pack
/// is not reduced.
struct Melting {
    double held = 0.05;
};
using ThermalLaw = std::variant<Constant, Radiating, Freezing, Melting>;

/// A homogeneous layer of a column, counted from the surface downward.
struct Layer {
    double thickness;      // [m]            1e-5 to 100
    double conductivity;   // [W m⁻¹ K⁻¹]    0.005 to 500
    double density;        // [kg m⁻³]
    double heat_capacity;  // [J kg⁻¹ K⁻¹]
    ThermalLaw law = Constant{};
};

/// Boundary condition below the last layer.
struct FixedTemperature {
    double temperature;
};  // [K]
struct FixedFlux {
    double flux;
};  // [W m⁻²] upward, into the column
/// A value through the day by the local clock of the span's start: (hour, value), hours ascending,
/// 0 to 24. Linear between entries, also across midnight; empty: no schedule.
using Schedule = std::vector<std::array<double, 2>>;
/// A heated room: its air and the film to it.
struct Interior {
    double air_temperature;  // [K]
    double film;             // [W m⁻² K⁻¹]
    Schedule schedule = {};  // [K], replaces air_temperature
};
using Bottom = std::variant<FixedTemperature, FixedFlux, Interior>;

/// How the surface exchanges heat with the air.
struct Louis {
    double least_film = 0.0;  // [W m⁻² K⁻¹] added: exchange in calm, stable air
    double gust = 1.0;        // [m s⁻¹] gusts beyond the mean wind: √(U² + gust²)
};                            // bulk Monin-Obukhov, Louis 1979: ground
/// Natural + forced by plate orientation (Walton 1983): walls and roofs of buildings.
struct Tarp {
    double length = 10.0;  // [m] of the square that gives the ratio of perimeter to area
    double roughness =
        1.67;  // 1 glass, 1.11 smooth plaster, 1.52 concrete, 1.67 brick, 2.17 stucco
};
/// DOE-2 / MoWiTT (Yazdanian & Klems 1994): smooth walls of buildings.
struct Mowitt {
    double roughness = 1.0;  // factor on the wind's part, as Tarp's
};
struct ConstantFilm {
    double film;
};  // [W m⁻² K⁻¹]
/// Shape of a part of a vehicle or device, for convection.
enum class BodyShape : std::uint8_t { plate, cylinder, box };
/// Free and forced convection by size, tilt, side, wind and the air's properties
/// (thermal/surface/plate_film.hpp).
struct BodyFilm {
    BodyShape shape = BodyShape::plate;
    double length = 0.0;      // [m] of a plate along the wind, of a cylinder or box across; 0: from
                              // the part's geometry
    double transition = 1e5;  // Re of a plate's transition to turbulence, in gusts
};
using Convection = std::variant<Louis, Tarp, Mowitt, ConstantFilm, BodyFilm>;

/// A surface of an aircraft: its speed through the air, and its length along the flow.
struct Flight {
    double speed = 0.0;   // [m s⁻¹]
    double length = 1.0;  // [m] along the flow, for the transition to turbulence
};

/// Evaporation by a resistance in series with the air's; wetness 0 (dry) to 1.
struct Evaporation {
    double minimum_resistance = 0.0;  // [s m⁻¹]
    double wetness = 0.0;
};

/// Water on a surface, as on leaves, stones and roofs: filled by rain and dew, emptied by
/// evaporation; the excess runs off. The wet share, content over capacity, evaporates without the
/// surface's own resistance. Snow lies on top of it (thermal/surface/standing_water.hpp).
struct WaterStore {
    double capacity_mm = 0.0;  // of level ground; 0: neither filled nor emptied
    double wet_albedo = -1.0;  // of the wet surface; negative: same as dry
    bool leaves = false;       // leaves hold the same amount on any slope
};

/// Snow's broadband albedo ages from the material's albedo (Douville et al. 1995, Clim. Dyn. 12,
/// 21): dry by 0.008 a day, melting by a factor e^−0.24 a day towards `old`, never below it; 10 kg
/// m⁻² of new snow raise it from `old` to `fresh`.
struct AgeingAlbedo {
    double fresh = 0.85, old = 0.5;
};

/// A big leaf over the ground: a skin without heat capacity, coupled to the top node.
struct BigLeaf {
    double skin_conductance;  // [W m⁻² K⁻¹]
};
/// Leaves and the ground between them as separate surfaces side by side (Norman et al. 1995): the
/// leaves cover 1 − exp(−0.5 leaf area) and evaporate, the ground exchanges the rest.
struct TwoSource {
    double leaf_area;        // [m² m⁻²]
    double leaf_resistance;  // [s m⁻¹] of the whole canopy to transpiration
};
using Canopy = std::variant<std::monostate, BigLeaf, TwoSource>;

/// The open back of a thin plate: air behind the last layer, which then has no other bottom, and
/// the surroundings of the back; in a closed mesh these have the air's temperature.
struct ExposedBack {
    double emissivity = 0.9;
    double albedo = 0.9;
};

/// What the heat balance needs of a surface: broadband optics, exchange with the air, the column.
/// albedo + solar transmittance + absorptance = 1; longwave: absorptance = emissivity.
struct ThermalSurface {
    double albedo = 0.0;                   // broadband, 0.3 to 4 µm
    double solar_transmittance = 0.0;      // passes through (glass), absorbed elsewhere
    double emissivity = 1.0;               // broadband, hemispherical
    double roughness_length = 0.01;        // momentum [m]
    double heat_roughness_length = 0.001;  // heat [m]
    Convection convection = Louis{};
    std::optional<Flight> flight{};  // if set, replaces the wind
    Evaporation evaporation;
    WaterStore store{};
    std::optional<AgeingAlbedo> snow_albedo{};
    Canopy canopy{};
    double internal_heat = 0.0;       // [W m⁻²] released at the surface
    Schedule internal_schedule = {};  // [W m⁻²], replaces internal_heat
    std::vector<Layer> layers;
    Bottom bottom = FixedFlux{0.0};
    std::optional<ExposedBack> back;  // if set, replaces `bottom`
};

/// Snow that hides a share of a surface: opaque and the same at every angle. The surface's own
/// spectra, to which its finish applies, are stored with it.
struct SnowOver {
    double share = 0.0;
    Spectrum reflectance;
    Spectrum bare_reflectance, bare_transmittance;
};

/// A material: its spectra for the picture, its thermal surface for the balance. Opaque or partly
/// transparent. Kirchhoff's law holds: ε(λ) = 1 − ρ(λ) − τ(λ), at every angle
/// (materials/matter/directional_optics.hpp).
struct Material {
    std::string name;
    Spectrum reflectance;    // directional-hemispherical ρ(λ), 0.3 to 20 µm
    Spectrum transmittance;  // τ(λ); empty means opaque
    ThermalSurface thermal;
    Finish finish{};           // law of angle
    bool see_through = false;  // rays continue behind it: panes, nets; else it has a room behind
    /// Of a net: the share covered by strips. Its spectra are those of the whole net, `thermal`
    /// that of its strips (materials/matter/net_optics.hpp).
    double cover = 1.0;
    /// Wavelengths of its spectra [µm], whose ends are continued beyond; whether this makes its
    /// albedo or emissivity a guess (materials/matter/spectrum_notes.hpp).
    double given_from_um = 0.0, given_to_um = 1e9;
    bool guessed_albedo = false, guessed_emissivity = false;
    std::string varies = {};  // of a texture's level: the name of the base material
    /// In a picture with a finish other than Lambert: `reflectance` and `transmittance` include the
    /// snow (materials/matter/covered_material.hpp).
    std::shared_ptr<const SnowOver> snow_over = nullptr;

    /// Name for users: a texture's levels have the name of the base material.
    const std::string& kind() const { return varies.empty() ? name : varies; }
    /// The picture needs its viewing angle, or what lies behind it.
    bool needs_rays() const { return see_through || finish.index() != 0; }
};

}  // namespace diurna
