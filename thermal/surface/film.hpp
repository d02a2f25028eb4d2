#pragma once

namespace diurna {

/// A film between surface and air [W m⁻² K⁻¹]; (T_s − T_a) dh/dT_s, which stays finite where the
/// two are equally warm; and dh/dT_s for the latent heat, zero for plates: there a step of Newton's
/// more costs less.
struct Film {
    double h, rise, slope;
};

/// What the film of a surface follows: ground (Louis, or a constant), open or in the lee of
/// something; a building's wall or roof (TARP, MoWiTT); a body of known shape and size.
enum class FilmKind : unsigned char { ground, sheltered_ground, wall, body };
template <FilmKind Kind>
inline constexpr bool on_ground = Kind == FilmKind::ground || Kind == FilmKind::sheltered_ground;

}  // namespace diurna
