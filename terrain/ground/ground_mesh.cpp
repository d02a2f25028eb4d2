#include "terrain/ground/ground_mesh.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "materials/base/error.hpp"
#include "terrain/ground/post_scan.hpp"
#include "terrain/ground/ring_index.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/ground/triangulate.hpp"
#include "terrain/raster/dem_places.hpp"

namespace diurna {

namespace {

struct VertexNote {
    float height = std::numeric_limits<float>::quiet_NaN();
    std::uint32_t number = 0;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexNote, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Constrained =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;

/// The network while it is being cut.
class Cutting {
 public:
    Cutting(const Dem& dem, const Tin& tin)
        : dem_(dem),
          spacing_(post_spacing(dem)),
          has_voids_(has_voids(dem)),
          is_vertex_(dem.height.size(), 0) {
        std::vector<std::pair<Kernel::Point_2, VertexNote>> points;
        points.reserve(tin.post.size());
        for (const auto& [column, row] : tin.post) {
            points.emplace_back(Kernel::Point_2(column, row), VertexNote{dem.at(row, column), 0});
            is_vertex_[std::size_t(row) * dem.columns + column] = 1;
        }
        mesh_.insert(points.begin(), points.end());
        last_ = mesh_.finite_vertices_begin();
        if (has_voids_) keep_void_borders(tin);
    }

    void cut(const Footprint& footprint, std::size_t number) {
        const Ring corners = checked(footprint, number);
        Ring border = divided(corners, footprint.largest_edge, spacing_);
        rings_.push_back(border.size() < 3 || !footprint.owner ? Ring{} : border);
        if (border.size() < 3) return;  // smaller than the snapping distance
        std::vector<Constrained::Vertex_handle> vertices;
        for (const Eigen::Vector2d& p : border) vertices.push_back(add(p));
        for (std::size_t i = 0; i < border.size(); ++i) {
            const auto a = vertices[i], b = vertices[(i + 1) % border.size()];
            if (a != Constrained::Vertex_handle() && b != Constrained::Vertex_handle() && a != b) {
                mesh_.insert_constraint(a, b);
            }
        }
        if (std::isfinite(footprint.largest_edge) && footprint.lattice) {
            for (const Eigen::Vector2d& p :
                 lattice_inside(corners, border, footprint.largest_edge, spacing_)) {
                if (!beside_vertex_post(p, 0.3 * footprint.largest_edge)) add(p);
            }
        }
    }

    /// Puts back the posts that the cuts have left further than the tolerance from the mesh. Each
    /// is put back at most once: on slivers the plane of a triangle misses even its own corners by
    /// rounding.
    void restore(double tolerance, std::span<const float> weight) {
        for (bool changed = true; changed;) {
            changed = false;
            give_heights_to_crossings();
            std::vector<std::pair<WorstPost, Constrained::Vertex_handle>> missing;
            for (const auto face : mesh_.finite_face_handles()) {
                if (!is_ground(face)) continue;
                const std::array<Eigen::Vector3d, 3> corner{
                    place(face->vertex(0)), place(face->vertex(1)), place(face->vertex(2))};
                const WorstPost worst = worst_post(dem_, corner, weight);
                if (worst.error > std::max(tolerance, 1e-9)) {
                    missing.emplace_back(worst, face->vertex(0));
                }
            }
            for (const auto& [worst, near] : missing) {
                auto& known = is_vertex_[std::size_t(worst.row) * dem_.columns + worst.column];
                if (known || std::isnan(dem_.at(worst.row, worst.column))) continue;
                known = 1;
                changed = true;
                const auto vertex =
                    mesh_.insert(Kernel::Point_2(worst.column, worst.row), near->face());
                vertex->info().height = dem_.at(worst.row, worst.column);
            }
        }
    }

    GroundMesh result() {
        GroundMesh mesh;
        for (const auto vertex : mesh_.finite_vertex_handles()) {
            vertex->info().number = static_cast<std::uint32_t>(mesh.place.size());
            mesh.place.emplace_back(vertex->point().x(), vertex->point().y());
            mesh.height.push_back(vertex->info().height);
        }
        const RingIndex owners(rings_);
        for (const auto face : mesh_.finite_face_handles()) {
            if (!is_ground(face)) continue;
            mesh.triangle.push_back({face->vertex(0)->info().number, face->vertex(2)->info().number,
                                     face->vertex(1)->info().number});
            mesh.footprint.push_back(owners.last_around(centre(face)));
        }
        return mesh;
    }

 private:
    Ring checked(const Footprint& footprint, std::size_t number) const {
        const auto refuse = [&](const std::string& problem) {
            return InputError(fmt::format("footprint {}", number + 1), problem);
        };
        if (footprint.ring.size() < 3) {
            throw refuse(
                fmt::format("found {} corners; a ring has three or more", footprint.ring.size()));
        }
        for (const auto& p : footprint.ring) {
            if (!p.allFinite()) throw refuse("a corner is not a finite number");
        }
        constexpr double least_edge = 0.01;  // [m]
        if (!(footprint.largest_edge >= least_edge)) {
            throw refuse(fmt::format("found a largest edge of {} m; expected {} m or more",
                                     footprint.largest_edge, least_edge));
        }
        Ring ring = clipped(footprint.ring, dem_.columns, dem_.rows);
        if (ring.size() < 3) throw refuse("lies wholly outside the elevation data");
        return ring;
    }

    /// Edges between ground and void, which points near them might otherwise flip away.
    void keep_void_borders(const Tin& tin) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
        for (const auto& t : tin.triangle) {
            for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
        }
        const auto point = [&](std::uint32_t v) {
            return Kernel::Point_2(tin.post[v][0], tin.post[v][1]);
        };
        for (const auto& [edge, count] : uses) {
            if (count == 1) mesh_.insert_constraint(point(edge.first), point(edge.second));
        }
    }

    /// A vertex with the raster's height; none over a void.
    Constrained::Vertex_handle add(const Eigen::Vector2d& p) {
        const double height = height_at(dem_, p);
        if (std::isnan(height)) return {};
        const auto vertex = mesh_.insert(Kernel::Point_2(p.x(), p.y()), last_->face());
        vertex->info().height = static_cast<float>(height);
        last_ = vertex;
        return vertex;
    }

    bool beside_vertex_post(const Eigen::Vector2d& p, double distance) const {
        const Eigen::Vector2d post(std::round(p.x()), std::round(p.y()));
        return (post - p).cwiseProduct(spacing_).norm() <= distance &&
               is_vertex_[std::size_t(post.y()) * dem_.columns + std::size_t(post.x())];
    }

    void give_heights_to_crossings() {
        for (const auto vertex : mesh_.finite_vertex_handles()) {
            if (std::isnan(vertex->info().height)) {
                const Eigen::Vector2d p(vertex->point().x(), vertex->point().y());
                vertex->info().height = static_cast<float>(height_at(dem_, p));
            }
        }
    }

    Eigen::Vector3d place(Constrained::Vertex_handle vertex) const {
        return {vertex->point().x(), vertex->point().y(), vertex->info().height};
    }
    Eigen::Vector2d centre(Constrained::Face_handle face) const {
        const auto c = CGAL::centroid(mesh_.triangle(face));
        return {c.x(), c.y()};
    }
    bool is_ground(Constrained::Face_handle face) const {
        return !has_voids_ || !std::isnan(height_at(dem_, centre(face)));
    }

    const Dem& dem_;
    Eigen::Vector2d spacing_;
    bool has_voids_;
    std::vector<std::uint8_t> is_vertex_;  // (post)
    Constrained mesh_;
    Constrained::Vertex_handle last_;  // the next point is often near the last one
    std::vector<Ring> rings_;
};

GroundMesh without_footprints(const Dem& dem, const Tin& tin) {
    GroundMesh mesh;
    mesh.triangle = tin.triangle;
    mesh.footprint.assign(tin.triangle.size(), -1);
    for (const auto& [column, row] : tin.post) {
        mesh.place.emplace_back(column, row);
        mesh.height.push_back(dem.at(row, column));
    }
    return mesh;
}

}  // namespace

GroundMesh ground_mesh(const Dem& dem, double tolerance, std::span<const Footprint> footprints,
                       std::span<const float> slack) {
    return ground_mesh(dem, triangulate(dem, tolerance, slack), tolerance, footprints, slack);
}

GroundMesh ground_mesh(const Dem& dem, const Tin& tin, double tolerance,
                       std::span<const Footprint> footprints, std::span<const float> slack) {
    if (footprints.empty()) return without_footprints(dem, tin);
    std::vector<float> weight(slack.size());
    std::transform(slack.begin(), slack.end(), weight.begin(), [](float s) { return 1.0f / s; });
    Cutting cutting(dem, tin);
    for (std::size_t i = 0; i < footprints.size(); ++i) cutting.cut(footprints[i], i);
    cutting.restore(tolerance, weight);
    return cutting.result();
}

}  // namespace diurna
