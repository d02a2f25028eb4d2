#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "thermal/network/heat_network.hpp"
#include "thermal/solve/clock_hours.hpp"

namespace diurna {

/// A target of a scene: its thermal network, and the scene's facets that belong to it.
struct NetworkObject {
    std::string name;
    HeatNetwork network;

    /// Surroundings of a facet's inner end, in addition to the network.
    enum class Inner : std::uint8_t {
        nothing,  // an enclosure or the bottom: in the network
        air,      // surroundings at the air's temperature: back of a closed plate
        back,     // the open, as the other side of the facet
    };
    std::vector<std::uint32_t> facet;  // (network's facet) the scene's
    std::vector<std::uint32_t> back;   // the same for its other side, no_number without one; at the
                                       // inner end's temperature
    std::vector<Inner> inner;          // (network's facet)

    /// Heat released in a lump, or evenly in facets' inner ends.
    struct Source {
        std::uint32_t lump = no_number;
        std::vector<std::uint32_t> facet{};  // the network's
        double watts = 0.0;                  // of all of them
        ClockHours hours{};
    };
    std::vector<Source> source;
    /// A fixed lump: a given temperature at some hours, else the air's.
    struct Given {
        std::uint32_t lump;
        double kelvin;       // NaN: the air's at all hours
        ClockHours hours{};  // outside them the air's
    };
    std::vector<Given> given;
    /// Sunlight through panes, distributed evenly by area over the facets behind.
    struct Sunlit {
        std::vector<std::uint32_t> pane, behind;  // the network's facets
        std::vector<double> transmittance;        // (pane)
    };
    std::vector<Sunlit> sunlit;

    /// Hot gas over faces (thermal/surface/hot_jet.hpp): its film replaces the air's if it is
    /// larger. Film and heat are multiplied by the share of its hours.
    struct Jet {
        double kelvin;                   // of the gas at the outlet; NaN: that of
        std::uint32_t lump = no_number;  // the network's
        ClockHours hours{};
        struct Face {
            std::uint32_t facet;  // the network's
            bool back = false;    // its other side
            double film = 0.0;    // [W m⁻² K⁻¹]
            double heat = 0.0;    // [W m⁻² K⁻¹] film times the wall's relative excess: per
                                  // kelvin of the gas above the air
        };
        std::vector<Face> face{};
    };
    std::vector<Jet> jet{};

    std::vector<std::string> notes{};  // one line per property that is not modelled
    std::size_t loose_edges = 0;       // sides of closed bodies' facets without neighbour

    std::size_t size() const { return facet.size(); }
};

}  // namespace diurna
