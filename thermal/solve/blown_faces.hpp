#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "thermal/network/network_step.hpp"
#include "thermal/solve/network_object.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

/// The faces of a target in a hot gas stream (NetworkObject::jet): their film is the gas's if it is
/// larger than the air's, and the gas's heat is received with either film.
class BlownFaces {
 public:
    /// The object must outlive it.
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
    /// Index of a network facet's face; no_number if no gas blows on it.
    std::uint32_t of(std::uint32_t facet, bool back) const;

    /// Mean running share from an instant to a later one.
    void run(Instant from, Instant to);
    bool any_runs() const;
    /// Heat flux of a face beyond the air's film [W m⁻²], and d/dT.
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
