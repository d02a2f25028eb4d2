#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "thermal/network/network_step.hpp"
#include "thermal/solve/network_object.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

/// The faces of a target that hot gas blows over (NetworkObject::jet): their film is the gas's
/// where it is larger than the air's, and what the gas brings comes to them whatever the film.
class BlownFaces {
 public:
    /// Must outlive it.
    explicit BlownFaces(const NetworkObject& object);

    bool none() const { return face_.empty(); }
    struct Face {
        std::uint32_t facet;
        bool back;
        struct By {
            std::size_t jet;
            double film, heat;
        };
        std::vector<By> by{};
        std::uint32_t group = no_number;  // NetworkSurroundings'
        NaturalFilm own{};
    };
    std::vector<Face>& faces() { return face_; }
    const std::vector<Face>& faces() const { return face_; }
    /// The one of a network's facet, no_number where nothing blows.
    std::uint32_t of(std::uint32_t facet, bool back) const;

    /// What runs in the mean from an instant to a later one.
    void run(Instant from, Instant to);
    bool any_runs() const;
    /// What a face gets beyond the air's film [W m⁻²], and d/dT.
    ///
    /// lump  (lump) [K]
    SurfaceFlux beyond_air(const Face& face, const AirFilm& air, const std::vector<double>& lump,
                           double kelvin) const;

 private:
    const NetworkObject& object_;
    std::vector<Face> face_;
    std::map<std::pair<std::uint32_t, bool>, std::uint32_t> place_;  // (facet, back)
    std::vector<double> running_;                                    // (jet) share
};

}  // namespace diurna
