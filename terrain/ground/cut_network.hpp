#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Core>
#include <cstdint>
#include <limits>

/// CGAL's constrained triangulation over a raster's (column, row), as the ground is cut in it.
namespace diurna::cut {

struct VertexNote {
    float height = std::numeric_limits<float>::quiet_NaN();
    std::uint32_t number = 0;
};
struct FaceNote {
    std::uint32_t visited = 0;  // by which search, from 1
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexNote, Kernel>;
using PlainFace = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceNote, Kernel, PlainFace>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Constrained =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

inline Eigen::Vector2d plan_of(Constrained::Vertex_handle vertex) {
    return {vertex->point().x(), vertex->point().y()};
}

}  // namespace diurna::cut
