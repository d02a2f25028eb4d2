#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "terrain/objects/models/workpiece.hpp"

namespace diurna {

/// Sides of a box, seen from within it towards the front.
enum class Side { left, right, back, front, bottom, top };

/// A rectangle of one side that is another part: a window, a door. Across and up are (y, z) on left
/// and right, (x, z) on back and front, (x, y) on bottom and top. It is on the flat of its side.
struct BoxPanel {
    Side side;
    double across_from, across_to, up_from, up_to;  // [m]
    std::string part;
    double recess = 0.0;  // [m] depth behind the side's face
};

/// A box with rounded edges and corners, then bent.
struct PanelBox {
    std::string part;
    Eigen::Vector3d low, high;
    double radius = 0.0;  // [m] of edges and corners; 0 possible by Fineness
    std::vector<BoxPanel> panels{};
    std::array<std::string, 6> side_part{};              // (Side) "": `part`
    std::array<std::vector<double>, 3> further_lines{};  // (axis) extra lattice lines
    /// Deforms a point of the box: continuous, one to one, orientation-preserving.
    std::function<Eigen::Vector3d(const Eigen::Vector3d&)> bend{};
};

/// Adds it as one closed solid: a lattice of quads that share their vertices, so that no crack can
/// open between sides, panels and reveals.
void add_box(Workpiece& work, const PanelBox& box);

/// A plain one with rounded edges.
void add_box(Workpiece& work, const std::string& part, const Eigen::Vector3d& low,
             const Eigen::Vector3d& high, double radius);

}  // namespace diurna
