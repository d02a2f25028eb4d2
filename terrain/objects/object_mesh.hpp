#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "materials/matter/material.hpp"

namespace diurna {

/// A triangle soup with one material per triangle, east-north-up [m] of the scene.
struct ObjectMesh {
    std::vector<Eigen::Vector3f> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;  // counterclockwise seen from outside
    std::vector<MaterialId> material;                    // (triangle)
};

/// What OpenMesh finds in a mesh.
struct MeshCheck {
    std::size_t vertices = 0, triangles = 0, boundary_edges = 0, components = 0;
    std::size_t rejected_triangles = 0;  // complex or degenerate: not addable to a manifold
    bool closed() const { return boundary_edges == 0 && rejected_triangles == 0; }
};
MeshCheck check_mesh(std::span<const Eigen::Vector3f> vertex,
                     std::span<const std::array<std::uint32_t, 3>> triangle);

/// A box with its base centre at `base`, its front towards `heading_deg` (clockwise from north);
/// faces are divided into triangles with edges of at most `largest_edge` [m]. The front, the other
/// walls and the roof have their own materials; no floor (it stands in the ground by `sunk`
/// metres).
struct BoxSpec {
    Eigen::Vector3d base = Eigen::Vector3d::Zero();
    double width = 10.0, depth = 10.0, height = 5.0;  // across, along the heading, up [m]
    double heading_deg = 180.0;
    double sunk = 2.0;
    double largest_edge = 3.0;
    MaterialId wall{}, front{}, roof{};
};
ObjectMesh box(const BoxSpec& spec);

/// A building on a plan of any simple ring (east, north; either sense of turning): upright walls
/// from `bottom` to `top` [m], divided into triangles with edges of about `largest_edge`, and a
/// flat roof. Throws InputError for less than three corners and a ring that crosses itself.
struct PrismSpec {
    std::vector<Eigen::Vector2d> ring;
    double bottom = 0.0, top = 5.0;
    double largest_edge = 3.0;
    MaterialId wall{}, roof{};
};
ObjectMesh prism(const PrismSpec& spec);

/// Triangles as PLY (binary little endian), vertices as given.
void write_ply(const std::filesystem::path& file, std::span<const Eigen::Vector3d> vertex,
               std::span<const std::array<std::uint32_t, 3>> triangle);

}  // namespace diurna
