#include "terrain/facets.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

constexpr double furthest = 100e3;  // [m] from the origin: beyond it, float is coarser than 8 mm

/// Thinner than this share of its distance from the origin, a triangle's normal is only rounding.
constexpr double float_resolution = 1e-7;

struct Box {
    Eigen::Vector2d low, high;
};

Box extent_in_plan(std::span<const Eigen::Vector3d> vertex) {
    Box box{Eigen::Vector2d::Constant(furthest), Eigen::Vector2d::Constant(-furthest)};
    for (const Eigen::Vector3d& v : vertex) {
        box.low = box.low.cwiseMin(v.head<2>());
        box.high = box.high.cwiseMax(v.head<2>());
    }
    return box;
}

/// Spreads the low 16 bits to the even bits.
std::uint32_t every_other_bit(std::uint32_t x) {
    x = (x | (x << 8)) & 0x00FF00FFu;
    x = (x | (x << 4)) & 0x0F0F0F0Fu;
    x = (x | (x << 2)) & 0x33333333u;
    return (x | (x << 1)) & 0x55555555u;
}

/// Place on Morton's curve of the triangles' centroids, and the triangles sorted along it.
std::vector<std::uint32_t> morton_order(std::span<const Eigen::Vector3d> vertex,
                                        std::span<const std::array<std::uint32_t, 3>> triangle) {
    const Box box = extent_in_plan(vertex);
    const double side = std::max((box.high - box.low).maxCoeff(), 1e-6);
    std::vector<std::uint64_t> key(triangle.size());
    for (std::size_t t = 0; t < triangle.size(); ++t) {
        const auto& [a, b, c] = triangle[t];
        const Eigen::Vector2d centre =
            (vertex[a] + vertex[b] + vertex[c]).head<2>() / 3.0 - box.low;
        const Eigen::Vector2d cell = (centre * (65535.0 / side)).cwiseMax(0.0).cwiseMin(65535.0);
        const auto x = every_other_bit(static_cast<std::uint32_t>(cell.x()));
        const auto y = every_other_bit(static_cast<std::uint32_t>(cell.y()));
        key[t] = (std::uint64_t{x | (y << 1)} << 32) | t;
    }
    std::sort(key.begin(), key.end());
    std::vector<std::uint32_t> order(key.size());
    std::transform(key.begin(), key.end(), order.begin(),
                   [](std::uint64_t k) { return static_cast<std::uint32_t>(k); });
    return order;
}

void check_vertices(std::span<const Eigen::Vector3d> vertex) {
    for (std::size_t i = 0; i < vertex.size(); ++i) {
        const Eigen::Vector3d& v = vertex[i];
        if (!v.allFinite()) {
            throw InputError("mesh", fmt::format("vertex {} is not a finite number", i));
        }
        if (v.cwiseAbs().maxCoeff() > furthest) {
            throw InputError(
                "mesh",
                fmt::format(
                    "vertex {} is {:.0f} km from the scene's origin, expected at most {:.0f} km", i,
                    v.norm() / 1e3, furthest / 1e3));
        }
    }
}

}  // namespace

void append_facets(FacetSet& facets, std::span<const Eigen::Vector3d> vertex,
                   std::span<const std::array<std::uint32_t, 3>> triangle,
                   std::span<const MaterialId> material, ObjectId object) {
    const std::vector<ObjectId> alike(triangle.size(), object);
    append_facets(facets, vertex, triangle, material, alike);
}

void append_facets(FacetSet& facets, std::span<const Eigen::Vector3d> vertex,
                   std::span<const std::array<std::uint32_t, 3>> triangle,
                   std::span<const MaterialId> material, std::span<const ObjectId> object) {
    assert(material.size() == triangle.size() && object.size() == triangle.size());
    check_vertices(vertex);
    for (const auto& corners : triangle) {
        for (const std::uint32_t corner : corners) {
            if (corner >= vertex.size()) {
                throw InputError(
                    "mesh", fmt::format("a triangle names vertex {} of {}", corner, vertex.size()));
            }
        }
    }

    // Objects share no vertices.
    struct Placed {
        std::int32_t object = -1;
        std::uint32_t number = 0;
    };
    std::vector<Placed> place(vertex.size());
    const auto placed = [&](std::uint32_t v, ObjectId by) {
        if (place[v].object != static_cast<std::int32_t>(by)) {
            place[v] = {static_cast<std::int32_t>(by),
                        static_cast<std::uint32_t>(facets.vertex.size())};
            facets.vertex.push_back(vertex[v].cast<float>());
        }
        return place[v].number;
    };

    std::vector<std::uint32_t> order = morton_order(vertex, triangle);
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return object[a] < object[b]; });
    const auto make_room = [&](auto& array) {  // for many calls, too
        const std::size_t total = facets.size() + triangle.size();
        if (total > array.capacity()) array.reserve(std::max(total, 2 * array.capacity()));
    };
    make_room(facets.corner);
    make_room(facets.centroid);
    make_room(facets.normal);
    make_room(facets.area);
    make_room(facets.material);
    make_room(facets.object);
    for (const std::uint32_t t : order) {
        const auto& corner = triangle[t];
        // What is kept is float: measure the triangle that remains after rounding.
        const Eigen::Vector3d a = vertex[corner[0]].cast<float>().cast<double>();
        const Eigen::Vector3d b = vertex[corner[1]].cast<float>().cast<double>();
        const Eigen::Vector3d c = vertex[corner[2]].cast<float>().cast<double>();
        const Eigen::Vector3d across = (b - a).cross(c - a);
        const double twice_area = across.norm();
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        const double furthest_corner =
            std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
        if (!(twice_area > longest * furthest_corner * float_resolution)) continue;
        facets.corner.push_back({placed(corner[0], object[t]), placed(corner[1], object[t]),
                                 placed(corner[2], object[t])});
        facets.centroid.push_back(((a + b + c) / 3.0).cast<float>());
        facets.normal.push_back((across / twice_area).cast<float>());
        facets.area.push_back(static_cast<float>(0.5 * twice_area));
        facets.material.push_back(material[t]);
        facets.object.push_back(object[t]);
    }
}

void append_facets(FacetSet& facets, const ObjectMesh& mesh, ObjectId object) {
    std::vector<Eigen::Vector3d> vertex(mesh.vertex.size());
    std::transform(mesh.vertex.begin(), mesh.vertex.end(), vertex.begin(),
                   [](const Eigen::Vector3f& v) -> Eigen::Vector3d { return v.cast<double>(); });
    append_facets(facets, vertex, mesh.triangle, mesh.material, object);
}

}  // namespace diurna
