#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "thermal/network/heat_network.hpp"
#include "thermal/solve/clock_hours.hpp"

namespace diurna {

/// A target of a scene: a network of heat and where it meets the scene's facets.
struct NetworkObject {
    std::string name;
    HeatNetwork network;

    /// What the inner end of a facet looks at, beyond what the network says.
    enum class Inner : std::uint8_t {
        nothing,  // an enclosure, what lies below: the network's
        air,      // surroundings as warm as the air: the back of a plate in a closed mesh
        back,     // the open, as the facet's other side
    };
    std::vector<std::uint32_t> facet;  // (network's facet) the scene's
    std::vector<std::uint32_t> back;   // likewise its other side, no_number where it has none; as
                                       // warm as the inner end
    std::vector<Inner> inner;          // (network's facet)

    /// Heat that is released in a lump, or evenly in facets' inner ends.
    struct Source {
        std::uint32_t lump = no_number;
        std::vector<std::uint32_t> facet{};  // the network's
        double watts = 0.0;                  // of all of them
        ClockHours hours{};
    };
    std::vector<Source> source;
    /// A fixed lump: a temperature at some hours, else the air's.
    struct Given {
        std::uint32_t lump;
        double kelvin;       // NaN: the air's at all hours
        ClockHours hours{};  // the air's at others
    };
    std::vector<Given> given;
    /// Sun through panes falls on what lies behind, evenly by area.
    struct Sunlit {
        std::vector<std::uint32_t> pane, behind;  // the network's facets
        std::vector<double> transmittance;        // (pane)
    };
    std::vector<Sunlit> sunlit;

    /// Hot gas that blows over faces (thermal/surface/hot_jet.hpp), in place of the air's film
    /// there if its own is the larger one. At a share of its hours so much of film and heat.
    struct Jet {
        double kelvin;                   // of the gas at the outlet; NaN: that of
        std::uint32_t lump = no_number;  // the network's
        ClockHours hours{};
        struct Face {
            std::uint32_t facet;  // the network's
            bool back = false;    // its other side
            double film = 0.0;    // [W m⁻² K⁻¹]
            double heat = 0.0;  // [W m⁻² K⁻¹] of that times the wall's warmth: for each kelvin of
                                // the gas beyond the air
        };
        std::vector<Face> face{};
    };
    std::vector<Jet> jet{};

    std::vector<std::string> notes{};  // in a line each what is not followed of it
    std::size_t loose_edges = 0;       // sides of closed bodies' facets that no other facet shares

    std::size_t size() const { return facet.size(); }
};

}  // namespace diurna
