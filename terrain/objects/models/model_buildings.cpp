#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>

#include "terrain/objects/models/families.hpp"
#include "terrain/objects/models/panel_box.hpp"
#include "terrain/objects/models/turned.hpp"

/// A house with rooms, a hangar with an arched roof.
namespace diurna {

namespace {

using Eigen::Vector3d;

constexpr double storey = 2.7, eaves = 5.4, roof_foot = 5.6, ridge = 8.2;  // of the house [m]

/// The rooms behind a house's walls: two below, two above, by the sides of x = 0.
std::string room_at(const Vector3d& at) {
    return std::string(at.z() < storey ? "ground" : "upper") + (at.x() < 0.0 ? "_west" : "_east");
}

void add_house_body(Workpiece& work) {
    PanelBox body{.part = "walls", .low = {-5.0, -4.0, 0.0}, .high = {5.0, 4.0, 6.0}};
    const double glass = 0.12;
    for (const double floor : {0.0, storey}) {
        const double sill = floor + 0.9, lintel = floor + 2.2;
        for (const double x : {-3.9, -1.9, 2.4}) {
            body.panels.push_back({Side::front, x, x + 1.3, sill, lintel, "windows", glass});
        }
        for (const double x : {-3.6, 1.0, 3.0}) {
            body.panels.push_back({Side::back, x, x + 1.1, sill, lintel, "windows", glass});
        }
        for (const Side side : {Side::left, Side::right}) {
            body.panels.push_back({side, -2.2, -1.2, sill, lintel, "windows", glass});
            body.panels.push_back({side, 1.0, 2.0, sill, lintel, "windows", glass});
        }
    }
    body.panels.push_back({Side::front, 0.6, 1.6, 0.2, 2.3, "door", 0.1});
    body.side_part[std::size_t(Side::top)] = "roof";
    body.side_part[std::size_t(Side::bottom)] = "floor";
    body.further_lines[0] = {0.0};
    body.further_lines[2] = {storey, eaves, 5.6, 5.8};  // the gable's are stretched
    body.bend = [](const Vector3d& p) {                 // above the eaves' height a gable
        const double up = std::max(0.0, (p.z() - eaves) / (6.0 - eaves));
        return Vector3d(
            p.x(), p.y(),
            p.z() + up * (ridge - 6.0) - up * (ridge - roof_foot) * std::abs(p.x()) / 5.0);
    };
    const std::size_t first = work.mesh.triangle.size();
    add_box(work, body);
    relabel(work, first, "walls", "gables", [](const Vector3d& at) { return at.z() > eaves; });
    for (const std::string storey_name : {"ground", "upper"}) {
        for (const std::string end : {"_west", "_east"}) {
            const std::string room = storey_name + end;
            const auto in_room = [&](const Vector3d& at) { return room_at(at) == room; };
            relabel(work, first, "walls", "walls_" + room, in_room);
            relabel(work, first, "windows", "windows_" + room, in_room);
        }
    }
    for (const std::string end : {"west", "east"}) {
        const bool west = end == "west";
        relabel(work, first, "floor", "floor_" + end,
                [&](const Vector3d& at) { return (at.x() < 0.0) == west; });
    }
}

/// Takes out parts that no triangle is of.
void drop_empty_parts(MeshFile& mesh) {
    std::vector<std::uint16_t> next(mesh.part.size(), 0);
    for (const std::uint16_t part : mesh.part_of) next[part] = 1;
    std::vector<MeshFile::Part> kept;
    for (std::size_t p = 0; p < next.size(); ++p) {
        if (next[p] == 0) continue;
        next[p] = static_cast<std::uint16_t>(kept.size());
        kept.push_back(mesh.part[p]);
    }
    for (std::uint16_t& part : mesh.part_of) part = next[part];
    mesh.part = kept;
}

}  // namespace

/// A house of two storeys, 10 x 8 m, 8.2 m to the ridge, which runs along y.
void make_house(Workpiece& work) {
    add_house_body(work);
    drop_empty_parts(work.mesh);
    add_box(work, "chimney", {-1.9, -1.2, 7.3}, {-1.2, -0.5, 9.1}, 0.02);
    for (const double side : {-1.0, 1.0}) {
        add_drum(work, "gutters", {5.12 * side, -4.2, 5.3}, {5.12 * side, 4.2, 5.3}, 0.08, 0.02);
        add_bar(work, "gutters", {5.09 * side, 4.09, 0.1}, {5.09 * side, 4.09, 5.2}, 0.045);
    }
    add_box(work, "step", {0.4, 4.03, 0.0}, {1.8, 5.0, 0.17}, 0.02);
    PanelBox porch{
        .part = "porch", .low = {0.3, 4.04, 2.45}, .high = {1.9, 5.1, 2.57}, .radius = 0.02};
    porch.bend = [](const Vector3d& p) {
        return Vector3d(p.x(), p.y(), p.z() - 0.2 * (p.y() - 4.04));
    };
    add_box(work, porch);
    for (const double x : {0.4, 1.8})
        add_bar(work, "porch", {x, 4.93, 0.19}, {x, 4.93, 2.24}, 0.05);
}

/// An arched hall of sheet steel, 30 m wide, 36 m long, 9.5 m high, with a sliding door in front.
void make_hangar(Workpiece& work) {
    constexpr double wall = 3.5, top = 4.5, crown = 9.5, half = 15.0;
    PanelBox hall{.part = "walls", .low = {-half, -18.0, 0.0}, .high = {half, 18.0, top}};
    hall.side_part[std::size_t(Side::top)] = "roof";
    hall.side_part[std::size_t(Side::bottom)] = "floor";
    for (const double x : {-9.0, -4.5, 0.0, 4.5}) {
        hall.panels.push_back({Side::front, x + 0.06, x + 4.44, 0.1, wall, "doors", 0.15});
    }
    hall.panels.push_back({Side::back, -4.0, -1.0, 0.1, 3.2, "doors", 0.1});
    for (const double y : {-16.0, -10.0, -4.0, 2.0, 8.0, 14.0}) {
        for (const Side side : {Side::left, Side::right}) {
            hall.panels.push_back({side, y, y + 3.0, 2.0, 3.2, "windows", 0.05});
        }
    }
    for (int i = 1; i < 16; ++i) hall.further_lines[0].push_back(-half + 2.0 * half * i / 16.0);
    hall.further_lines[2] = {wall, 3.75, 4.0, 4.25};  // the arch's are stretched
    hall.bend = [=](const Vector3d& p) {  // what is above the walls' height follows an arch
        const double off = p.x() / half, up = std::max(0.0, (p.z() - wall) / (top - wall));
        const double arch = wall + (crown - wall) * std::sqrt(std::max(0.0, 1.0 - 0.9 * off * off));
        const double straight = std::min(p.z(), wall);
        return Vector3d(p.x(), p.y(), straight + up * (arch - wall));
    };
    add_box(work, hall);
    for (const double y : {-12.0, -4.0, 4.0, 12.0}) {
        add_drum(work, "vents", {0.0, y, 9.55}, {0.0, y, 10.1}, 0.5, 0.08);
    }
    add_box(work, "rail", {-13.5, 18.03, 3.6}, {13.5, 18.25, 3.8}, 0.03);
    for (const double x : {-11.0, 11.0}) {
        add_drum(work, "lamps", {x, 18.1, 4.3}, {x, 18.4, 4.3}, 0.18, 0.04);
    }
    add_box(work, "heater", {-15.9, -6.0, 0.2}, {-15.1, -4.6, 1.6}, 0.05);
    add_bar(work, "heater", {-15.5, -5.3, 1.63}, {-15.5, -5.3, 5.0}, 0.12);
}

}  // namespace diurna
