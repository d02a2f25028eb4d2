#pragma once

#include <Eigen/Core>

namespace diurna {

/// Gas that leaves a round outlet and blows over surfaces: a turbulent free jet among still air, a
/// stagnation point with a wall jet round it where it meets a surface.
struct HotJet {
    double diameter;     // [m]
    double speed;        // [m s⁻¹] mean over the outlet
    double temperature;  // [K] of the gas there, which is air as to its properties
    double air_temperature = 288.15, pressure = 101325.0;  // [K], [Pa] of the air around
};

/// [kg s⁻¹] ρ u π D² / 4, and [W K⁻¹] what it carries away for each kelvin of its excess.
double mass_flow(const HotJet& jet);
double heat_flow(const HotJet& jet);
/// [m s⁻¹] of the outlet that passes such a mass [kg s⁻¹].
double speed_of(double mass_flow, const HotJet& jet);

/// Speed and excess temperature as shares of the outlet's.
struct FreeJet {
    double speed, warmth;
};
/// At a place of the free jet: on its axis
///
///     u / u₀ = 6.2 D* / x,   (T − T_air) / (T₀ − T_air) = 5 D* / x,   D* = D √(ρ₀ / ρ_air),
///
/// one where these are more (Chen & Rodi 1980, Vertical Turbulent Buoyant Jets, 2.2; D* Thring &
/// Newby 1953); across, Gauss's curves of 1/e half-widths 0.107 x and 0.127 x (Fischer et al. 1979,
/// Mixing in Inland and Coastal Waters, 9.2), half a diameter at least. Where the outlet is a
/// pipe's end, as an exhaust's is, the decay begins at the outlet itself.
///
/// along, off  [m] its axis from the outlet, and from the axis; nothing before the outlet
FreeJet free_jet(const HotJet& jet, double along, double off);

/// The film of a blown surface: heat to it is film · (T_air + warmth · (T₀ − T_air) − T).
struct JetFilm {
    double film = 0.0;    // [W m⁻² K⁻¹]
    double warmth = 0.0;  // of the adiabatic wall
};

/// At a place of a plane surface.
///
/// Met head on, at a distance H along the axis and r from where the axis meets the plane: Martin's
/// mean Nusselt number (1977, Advances in Heat Transfer 13; Incropera et al., 7.7), by which
///
///     Nu / Pr^0.42 = (D/r) (1 − 1.1 D/r) / (1 + 0.1 (H/D − 6) D/r) · 2 √Re √(1 + 0.005 Re^0.55)
///
/// is the mean over the circle of radius r: 2000 < Re < 400 000, 2 < H/D < 12, 2.5 < r/D < 7.5,
/// properties of the mean of gas and air. Here it is taken apart into rings; within 2.5 D a
/// paraboloid that has its mean there. Beyond 12 D the jet is that of an outlet 12 of its own
/// diameters away, of the same momentum; nearer than 2 D as at 2. Beyond 7.5 D it is carried on,
/// and fades from 15 to 20. Wall's warmth: 5 D* / (H + 3 r), of which the constant 3 keeps the heat
/// of the jet in a radial wall jet (half-width 0.09 r, u 1.05 u₀ D / r: Poreh, Tsuei & Cermak
/// 1967). Met at an angle β, what goes in a direction φ from the downstream one is sin³β / (1 −
/// cosβ cosφ)² of that of a level ring (Taylor 1960, from momentum), as a diameter's square, 4 at
/// most.
///
/// Along the jet a turbulent plate's, 0.0296 Re_x^0.8 Pr^⅓ k / x from the outlet on, at the free
/// jet's own speed there; the larger of both counts. Nothing on what is turned away from it, and
/// nothing where the warmth is less than a twentieth (fading from a tenth on): wind and its own
/// lift bend a jet there, which is not followed.
///
/// place      [m] from the outlet's middle
/// direction  of the jet, and `normal` of the surface, unit
/// met        the axis meets this surface: there is a wall jet. Else what is off the axis gets the
///            share of the free jet's curve.
JetFilm jet_film(const HotJet& jet, const Eigen::Vector3d& direction, const Eigen::Vector3d& place,
                 const Eigen::Vector3d& normal, bool met);

/// [m] from the outlet, beyond which jet_film() is nothing.
double jet_reach(const HotJet& jet);

}  // namespace diurna
