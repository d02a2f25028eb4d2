#pragma once

#include <cstddef>
#include <type_traits>

#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// A number for each lane.
template <std::size_t Count>
struct Lanes {
    alignas(64) double of[Count];
    [[gnu::always_inline]] double& operator[](std::size_t l) { return of[l]; }
    [[gnu::always_inline]] const double& operator[](std::size_t l) const { return of[l]; }
};

/// The air over every lane, for one kind of surface. `Own`: double, the same for all of them, or
/// Lanes<Count>.
template <std::size_t Count, class Own>
struct FilmLanes : AirFilmOf<Lanes<Count>, Own> {
    using Film = AirFilmOf<Lanes<Count>, Own>;

    bool on_ground() const {
        return Film::kind == FilmKind::ground || Film::kind == FilmKind::sheltered_ground;
    }
    /// Sets a lane; values of plates only for these.
    void put(std::size_t l, const AirFilm& air) {
        const auto set = [l](auto& to, auto from) {
            if constexpr (std::is_same_v<decltype(to), Lanes<Count>&>) {
                to[l] = from;
            } else {
                to = from;
            }
        };
        Film& own = *this;
        each_air_field(set, set, own, air);
        if (!on_ground()) each_plate_field(set, set, own, air);
    }
    [[gnu::always_inline]] AirFilm operator()(std::size_t l) const {
        const auto get = [l](auto& to, const auto& from) __attribute__((always_inline)) {
            if constexpr (std::is_same_v<decltype(from), const Lanes<Count>&>) {
                to = from[l];
            } else {
                to = from;
            }
        };
        AirFilm air;
        const Film& own = *this;
        each_air_field(get, get, air, own);
        each_plate_field(get, get, air, own);
        return air;
    }
};

}  // namespace diurna
