#include "thermal/solve/blown_faces.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

BlownFaces::BlownFaces(const NetworkObject& object)
    : object_(object), running_(object.jet.size(), 0.0) {
    for (std::size_t j = 0; j < object.jet.size(); ++j) {
        for (const NetworkObject::Jet::Face& face : object.jet[j].face) {
            const auto [at, is_new] =
                place_.try_emplace({face.facet, face.back}, std::uint32_t(face_.size()));
            if (is_new) face_.push_back({.facet = face.facet, .back = face.back});
            face_[at->second].by.push_back({j, face.film, face.heat});
        }
    }
}

std::uint32_t BlownFaces::of(std::uint32_t facet, bool back) const {
    const auto found = place_.find({facet, back});
    return found == place_.end() ? no_number : found->second;
}

void BlownFaces::run(Instant from, Instant to) {
    for (std::size_t j = 0; j < running_.size(); ++j) {
        running_[j] = object_.jet[j].hours.mean(from, to);
    }
}

bool BlownFaces::any_runs() const {
    return std::any_of(running_.begin(), running_.end(), [](double share) { return share > 0.0; });
}

SurfaceFlux BlownFaces::beyond_air(const Face& face, const AirFilm& air,
                                   const std::vector<double>& lump, double kelvin) const {
    double film = 0.0, brought = 0.0;
    for (const Face::By& by : face.by) {
        const NetworkObject::Jet& jet = object_.jet[by.jet];
        const double gas = std::isnan(jet.kelvin) ? lump[jet.lump] : jet.kelvin;
        film += running_[by.jet] * by.film;
        brought += running_[by.jet] * by.heat * (gas - air.air_temperature);
    }
    const Film own = film_of(air, face.own, kelvin);
    SurfaceFlux more{brought, 0.0};
    if (film > own.h) {
        more.flux += (own.h - film) * (kelvin - air.air_temperature);
        more.slope += own.h + own.rise - film;
    }
    return more;
}

}  // namespace diurna
