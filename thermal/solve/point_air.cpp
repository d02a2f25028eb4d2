#include "thermal/solve/point_air.hpp"

#include <cmath>

namespace diurna {

const std::vector<AirFilm>& PointAir::over(std::size_t facet) {
    constexpr double slice_height = 8.0;  // [m]
    const bool flat = solve_.tiers.flat();
    const long slice =
        flat ? 0 : std::lround(std::floor(double(solve_.input.height[facet]) / slice_height));
    const auto [place, is_new] = slice_.try_emplace(slice);
    std::vector<AirFilm>& film = place->second;
    if (!is_new) return film;
    const double height = slice_height * (double(slice) + 0.5);
    for (const Forcing& now : weather_) {
        const AirState air =
            flat ? now.air : air_at_height(*solve_.input.by_height, now.air, height);
        film.push_back(air_film(kind_.column.surface, kind_.column.louis, air, now.wind_speed));
        if (sheltered_) film.back().kind = FilmKind::sheltered_ground;
    }
    return film;
}

}  // namespace diurna
