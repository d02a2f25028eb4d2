#pragma once

#include <Eigen/Core>

namespace diurna {

/// Gas from a round outlet that blows over surfaces: a turbulent free jet in still air, with a
/// stagnation point and a wall jet around it where it meets a surface.
struct HotJet {
    double diameter;     // [m]
    double speed;        // [m s⁻¹] mean over the outlet
    double temperature;  // [K] of the gas there; its properties are those of air
    double air_temperature = 288.15, pressure = 101325.0;  // [K], [Pa] of the air around
};

/// [kg s⁻¹] ρ u π D² / 4, and [W K⁻¹] heat transported per kelvin of its excess.
double mass_flow(const HotJet& jet);
double heat_flow(const HotJet& jet);
/// [m s⁻¹] at the outlet for a mass flow [kg s⁻¹].
double speed_of(double mass_flow, const HotJet& jet);

/// Speed and excess temperature relative to the outlet's.
struct FreeJet {
    double speed, warmth;
};
/// At a place of the free jet: on its axis
///
///     u / u₀ = 6.2 D* / x,   (T − T_air) / (T₀ − T_air) = 5 D* / x,   D* = D √(ρ₀ / ρ_air),
///
/// but at most one (Chen & Rodi 1980, Vertical Turbulent Buoyant Jets, 2.2; D* Thring & Newby
/// 1953); across, Gaussian profiles of 1/e half-widths 0.107 x and 0.127 x (Fischer et al. 1979,
/// Mixing in Inland and Coastal Waters, 9.2), at least half a diameter. For an outlet that is a
/// pipe's end, such as an exhaust, the decay begins at the outlet itself.
///
/// along, off  [m] along its axis from the outlet, and off the axis; zero upstream of the outlet
FreeJet free_jet(const HotJet& jet, double along, double off);

/// The film of a blown surface: heat flux into it = film · (T_air + warmth · (T₀ − T_air) − T).
struct JetFilm {
    double film = 0.0;    // [W m⁻² K⁻¹]
    double warmth = 0.0;  // relative excess of the adiabatic wall temperature
};

/// At a point of a plane surface.
///
/// At normal incidence, at a distance H along the axis and r from the stagnation point: Martin's
/// mean Nusselt number (1977, Advances in Heat Transfer 13; Incropera et al., 7.7),
///
///     Nu / Pr^0.42 = (D/r) (1 − 1.1 D/r) / (1 + 0.1 (H/D − 6) D/r) · 2 √Re √(1 + 0.005 Re^0.55)
///
/// averaged over the circle of radius r: 2000 < Re < 400 000, 2 < H/D < 12, 2.5 < r/D < 7.5,
/// properties at the mean of gas and air. Here it is converted to local values by rings; within 2.5
/// D a paraboloid with the same mean. Beyond 12 D the jet is replaced by that of an outlet 12
/// diameters away with the same momentum; nearer than 2 D the value at 2 is used. Beyond 7.5 D it
/// is extrapolated, and fades from 15 to 20. Warmth of the wall: 5 D* / (H + 3 r), where the
/// constant 3 conserves the jet's heat in a radial wall jet (half-width 0.09 r, u 1.05 u₀ D / r:
/// Poreh, Tsuei & Cermak 1967). At an incidence angle β, the flow in a direction φ from downstream
/// is sin³β / (1 − cosβ cosφ)² of that at normal incidence (Taylor 1960, from momentum), as the
/// square of a diameter, at most 4.
/// most.
///
/// Along the jet that of a turbulent plate, 0.0296 Re_x^0.8 Pr^⅓ k / x from the outlet on, at the
/// free jet's local speed; the larger of both is used. Zero on surfaces that face away, and where
/// the warmth is less than a twentieth (fading from a tenth on): there wind and buoyancy bend a
/// jet, which is not modelled.
///
/// place      [m] from the outlet's centre
/// direction  of the jet, and `normal` of the surface, unit
/// met        the axis meets this surface, so there is a wall jet; otherwise a point off the axis
///            has the share of the free jet's profile
JetFilm jet_film(const HotJet& jet, const Eigen::Vector3d& direction, const Eigen::Vector3d& place,
                 const Eigen::Vector3d& normal, bool met);

/// [m] from the outlet: beyond it jet_film() is zero.
double jet_reach(const HotJet& jet);

}  // namespace diurna
