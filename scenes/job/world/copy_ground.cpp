#include "scenes/job/world/copy_ground.hpp"

#include <cmath>
#include <map>
#include <utility>

namespace diurna {

namespace {

constexpr int edges_of_tile = 6;
using Tile = std::pair<int, int>;  // column, row

/// Corners of a tile and the points between them, counterclockwise.
std::vector<Eigen::Vector2d> ring_of(const Tile& tile, double edge) {
    std::vector<Eigen::Vector2d> ring;
    const int west = tile.first * edges_of_tile, south = tile.second * edges_of_tile;
    const auto add = [&](int x, int y) { ring.emplace_back(edge * x, edge * y); };
    constexpr int n = edges_of_tile;
    for (int k = 0; k < n; ++k) add(west + k, south);
    for (int k = 0; k < n; ++k) add(west + n, south + k);
    for (int k = 0; k < n; ++k) add(west + n - k, south + n);
    for (int k = 0; k < n; ++k) add(west, south + n - k);
    return ring;
}

}  // namespace

std::vector<GroundPatch> patches_round(std::span<const ObjectInput> copies) {
    std::vector<GroundPatch> own;
    std::map<Tile, int> asked;  // how many copies ask for a tile
    // So that rounding does not make the sides longer than requested.
    const double edge = 0.999 * ground_patch(copies.front(), copies.front().place).largest_edge;
    const double side = edge * edges_of_tile;
    const auto each_tile = [&](const GroundPatch& patch, const auto& body) {
        const Eigen::Vector2d low = patch.ring.front() / side, high = patch.ring[2] / side;
        for (int row = int(std::floor(low.y())); row <= int(std::floor(high.y())); ++row) {
            for (int column = int(std::floor(low.x())); column <= int(std::floor(high.x()));
                 ++column) {
                body(Tile{column, row});
            }
        }
    };
    for (const ObjectInput& copy : copies) {
        own.push_back(ground_patch(copy, copy.place));
        each_tile(own.back(), [&](const Tile& tile) { ++asked[tile]; });
    }
    std::vector<GroundPatch> patches;
    std::map<Tile, bool> shared;
    for (const GroundPatch& patch : own) {
        bool alone = true;
        each_tile(patch, [&](const Tile& tile) { alone = alone && asked[tile] == 1; });
        if (alone) {
            patches.push_back(patch);
            continue;
        }
        each_tile(patch, [&](const Tile& tile) { shared[tile] = true; });
    }
    for (const auto& [tile, is] : shared) {
        patches.push_back({.ring = ring_of(tile, edge), .largest_edge = edge / 0.999});
    }
    return patches;
}

}  // namespace diurna
