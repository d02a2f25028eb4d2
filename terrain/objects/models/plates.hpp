#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "terrain/objects/models/workpiece.hpp"

/// Plates with holes, belts and sheets.
namespace diurna {

/// Position of a plate: its corner, its two unit directions; its thickness is along across(u) ×
/// up(v).
struct PlateFrame {
    Eigen::Vector3d corner, across, up;
};

/// A rectangle of a plate's plane [m].
struct Hole {
    double across_from, across_to, up_from, up_to;
};

/// A closed solid: a rectangular plate with rectangular holes, which neither touch nor overlap.
void add_plate(Workpiece& work, const std::string& part, const PlateFrame& frame,
               const Eigen::Vector3d& size, const std::vector<Hole>& holes);

/// A frame with `slots` level slots.
void add_grille(Workpiece& work, const std::string& part, const PlateFrame& frame,
                const Eigen::Vector3d& size, int slots);

/// A closed band (a ring's topology): a path in the plane of y and z, counterclockwise seen from
/// +x, with `thickness` inward, from x_from to x_to.
void add_belt(Workpiece& work, const std::string& part, const std::vector<Eigen::Vector2d>& path,
              double thickness, double x_from, double x_to);

/// An open sheet over a lattice in plan, facing up.
///
/// height  [m] of a place (x, y)
void add_sheet(Workpiece& work, const std::string& part, const Eigen::Vector2d& low,
               const Eigen::Vector2d& high, double edge,
               const std::function<double(double, double)>& height);

}  // namespace diurna
