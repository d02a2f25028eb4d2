#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "scenes/job/input/read_contact.hpp"
#include "scenes/job/input/read_jet.hpp"
#include "thermal/solve/clock_hours.hpp"

/// Description of an object's mesh as a thermal network: parts, enclosures, lumps and their
/// connections, in the scene or in a separate file beside the mesh.
namespace diurna {

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();
inline constexpr const char* outdoors_name = "outdoors";

struct PartInput {
    std::string name;      // of a group, node or material of the mesh; "*": all others
    std::string material;  // "": the object's
    std::string inside;    // the enclosure behind its inner face; "": none
    double inner_emissivity = not_given;
    double watts = 0.0, watts_m2 = 0.0;  // released in its inner face
    double kelvin = not_given;           // given temperature within its hours
    bool welded = true;                  // conducts across the edges it shares with other parts
    bool runs = false;                   // its heat is released while the object runs
    std::vector<ClockHours::Window> hours{};
    std::string where{};
};
struct EnclosureInput {
    std::string name;
    double volume = 1.0;       // [m³]
    double air_changes = 0.5;  // [h⁻¹] with outdoors
    double film = 3.0;         // [W m⁻² K⁻¹] of its inner faces
};
struct LumpInput {
    std::string name;
    double capacity = 0.0;  // [J K⁻¹]
    double watts = 0.0;
    double kelvin = not_given;  // given temperature within its hours
    bool runs = false;          // its heat is released while the object runs
    std::vector<ClockHours::Window> hours{};
};
struct LinkInput {
    std::string a, b;
    double conductance = not_given;  // [W K⁻¹] of all of it, or
    double film = not_given;         // [W m⁻² K⁻¹] of the part's area
    std::string where{};
};
struct StreamInput {
    std::string from, to;
    double conductance = 0.0;  // [W K⁻¹] mass flow × heat capacity
};

struct TargetInput {
    std::vector<PartInput> part;
    std::vector<EnclosureInput> enclosure;
    std::vector<LumpInput> lump;
    std::vector<LinkInput> link;
    std::vector<StreamInput> stream;
    std::vector<ContactInput> contact;
    std::vector<JetInput> jet;
    std::filesystem::path file{};  // file of the description; "": the scene
    /// (part of the mesh) index in `part`, −1 if not listed: only conduction.
    std::vector<int> part_of;

    bool given() const { return !part.empty(); }
    bool has_enclosure(const std::string& name) const;
    bool has_lump(const std::string& name) const;
    /// Index into `part`; −1 if it is none.
    int find_part(const std::string& name) const;
};

}  // namespace diurna
