#pragma once

namespace diurna {

/// A film between surface and air [W m⁻² K⁻¹]; (T_s − T_a) dh/dT_s, which stays finite at equal
/// temperatures; and dh/dT_s for the latent heat, zero for plates, where one more Newton step takes
/// less time.
struct Film {
    double h, rise, slope;
};

/// The law of a surface's film: ground (Louis, or a constant), open or sheltered; a building's wall
/// or roof (TARP, MoWiTT); a body of known shape and size.
enum class FilmKind : unsigned char { ground, sheltered_ground, wall, body };
template <FilmKind Kind>
inline constexpr bool on_ground = Kind == FilmKind::ground || Kind == FilmKind::sheltered_ground;

}  // namespace diurna
