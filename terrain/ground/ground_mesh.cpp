#include "terrain/ground/ground_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "terrain/ground/cut_network.hpp"
#include "terrain/ground/detail_outline.hpp"
#include "terrain/ground/grade_round.hpp"
#include "terrain/ground/mesh_lattice.hpp"
#include "terrain/ground/post_scan.hpp"
#include "terrain/ground/ring_index.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/ground/triangulate.hpp"

namespace diurna {

namespace {

using cut::Constrained;
using cut::Kernel;
using cut::VertexNote;

/// The network while it is being cut.
class Cutting {
 public:
    /// - on_detail: (detail) networks over its raster's posts
    Cutting(const Dem& dem, const Tin& tin, std::span<const Tin> on_detail)
        : dem_(dem), has_voids_(has_voids(dem)), lattices_(mesh_lattices(dem)) {
        std::vector<std::pair<Kernel::Point_2, VertexNote>> points;
        for (std::size_t k = 0; k < lattices_.size(); ++k) {
            MeshLattice& lattice = lattices_[k];
            const Tin& network = k == 0 ? tin : on_detail[k - 1];
            points.reserve(points.size() + network.post.size());
            for (const auto& [column, row] : network.post) {
                const Eigen::Vector2d at = lattice.to_coarse({double(column), double(row)});
                if (!takes_vertex(dem_, at, k)) continue;
                points.emplace_back(Kernel::Point_2(at.x(), at.y()),
                                    VertexNote{lattice.raster->at(row, column), 0});
                lattice.is_vertex[lattice.index(column, row)] = 1;
            }
        }
        mesh_.insert(points.begin(), points.end());
        if (!points.empty()) last_ = mesh_.finite_vertices_begin();
        if (has_voids_) keep_void_borders(tin);
        for (const DemDetail& detail : dem.detail) cut_round(detail);
    }

    void cut(const Footprint& footprint, std::size_t number) {
        Ring corners = ring_on(dem_, footprint, number);
        const MeshLattice& lattice = lattices_[lattice_under(dem_, corners)];
        for (Eigen::Vector2d& p : corners) p = lattice.to_own(p);
        const Ring own_border = divided(corners, footprint.largest_edge, lattice.spacing);
        Ring border = own_border;
        if (lattice.detail != nullptr) {
            for (Eigen::Vector2d& p : border) p = on_edge(dem_, lattice.to_coarse(p));
        }
        rings_.push_back(border.size() < 3 || !footprint.owner ? Ring{} : border);
        if (border.size() < 3) return;  // smaller than the snapping distance
        if (footprint.border) {
            std::vector<Constrained::Vertex_handle> vertices;
            for (const Eigen::Vector2d& p : border) vertices.push_back(add(p));
            keep_line(vertices);
        }
        if (std::isfinite(footprint.growth) && std::isfinite(footprint.largest_edge)) {
            const bool inward = footprint.inward && !footprint.lattice;
            grading_.push_back({.ring = border,
                                .edge = footprint.largest_edge,
                                .growth = footprint.growth,
                                .side = inward ? Grading::Side::inside : Grading::Side::outside,
                                .filled = footprint.lattice});
        }
        if (std::isfinite(footprint.largest_edge) && footprint.lattice) {
            for (const Eigen::Vector2d& own :
                 lattice_inside(corners, own_border, footprint.largest_edge, lattice.spacing)) {
                const Eigen::Vector2d p = lattice.to_coarse(own);
                if (beside_vertex_post(p, 0.3 * footprint.largest_edge)) continue;
                if (!footprint.border && beside_vertex(p, 0.4 * footprint.largest_edge)) continue;
                add(p);
            }
        }
    }

    /// Makes triangles around footprints grow gradually. Returns whether any vertex was added.
    bool grade() {
        const std::size_t before = mesh_.number_of_vertices();
        give_heights_to_crossings();
        std::uint32_t number = 0;
        for (Grading& grading : grading_) {
            grading.number = ++number;
            grade_round(grading, dem_, lattices_.front().spacing, mesh_);
        }
        return mesh_.number_of_vertices() > before;
    }

    /// Puts back the posts that the cuts have left further than the tolerance from the mesh. Each
    /// is put back at most once: on slivers the plane of a triangle misses even its own corners by
    /// rounding.
    void restore(double tolerance, std::span<const float> weight) {
        for (bool changed = true; changed;) {
            changed = false;
            give_heights_to_crossings();
            std::vector<Missing> missing;
            for (const auto face : mesh_.finite_face_handles()) {
                if (!is_ground(face)) continue;
                const std::size_t k = lattice_at(dem_, centre(face));
                const MeshLattice& lattice = lattices_[k];
                std::array<Eigen::Vector3d, 3> corner{
                    place(face->vertex(0)), place(face->vertex(1)), place(face->vertex(2))};
                for (Eigen::Vector3d& p : corner) p.head<2>() = lattice.to_own(p.head<2>());
                const double most =
                    k == 0 ? std::max(tolerance, 1e-9) : std::max(lattice.detail->tolerance, 1e-4);
                const WorstPost worst =
                    worst_post(*lattice.raster, corner, k == 0 ? weight : std::span<const float>{});
                if (worst.error > most) missing.push_back({worst, k, face->vertex(0)});
            }
            for (const auto& [worst, k, near] : missing) {
                MeshLattice& lattice = lattices_[k];
                auto& known = lattice.is_vertex[lattice.index(worst.column, worst.row)];
                const float height = lattice.raster->at(worst.row, worst.column);
                const Eigen::Vector2d at =
                    lattice.to_coarse({double(worst.column), double(worst.row)});
                if (known || std::isnan(height) || !takes_vertex(dem_, at, k)) continue;
                known = 1;
                changed = true;
                const auto vertex = mesh_.insert(Kernel::Point_2(at.x(), at.y()), near->face());
                vertex->info().height = height;
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
            if (!dem_.detail.empty()) mesh.detail.push_back(detail_at(dem_, centre(face)));
        }
        return mesh;
    }

 private:
    /// A post to be put back, near a vertex.
    struct Missing {
        WorstPost worst;
        std::size_t lattice;
        Constrained::Vertex_handle near;
    };

    /// Makes a detail's outline a line of the mesh.
    void cut_round(const DemDetail& detail) {
        std::vector<Constrained::Vertex_handle> vertices;
        for (const Eigen::Vector2d& p : outline_vertices(dem_, detail)) {
            const auto known = vertex_near(p, detail);
            vertices.push_back(known != Constrained::Vertex_handle() ? known : add(p));
        }
        keep_line(vertices);
    }

    /// A vertex of a triangle round a place, so near to it that another one would make slivers, as
    /// where two details share a border.
    Constrained::Vertex_handle vertex_near(const Eigen::Vector2d& p,
                                           const DemDetail& detail) const {
        if (mesh_.dimension() < 2) return {};
        const auto face = mesh_.locate(Kernel::Point_2(p.x(), p.y()), near_last());
        for (int k = 0; face != nullptr && k < 3; ++k) {
            const auto vertex = face->vertex(k);
            if (mesh_.is_infinite(vertex)) continue;
            const Eigen::Vector2d at(vertex->point().x(), vertex->point().y());
            if ((detail.to_own(at) - detail.to_own(p)).norm() < 0.01) return vertex;
        }
        return {};
    }

    Constrained::Face_handle near_last() const {
        return last_ != Constrained::Vertex_handle() ? last_->face() : Constrained::Face_handle();
    }

    /// Edges from each to the next, and from the last to the first.
    void keep_line(const std::vector<Constrained::Vertex_handle>& vertices) {
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const auto a = vertices[i], b = vertices[(i + 1) % vertices.size()];
            if (a != Constrained::Vertex_handle() && b != Constrained::Vertex_handle() && a != b) {
                mesh_.insert_constraint(a, b);
            }
        }
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
        const auto vertex = mesh_.insert(Kernel::Point_2(p.x(), p.y()), near_last());
        vertex->info().height = static_cast<float>(height);
        last_ = vertex;
        return vertex;
    }

    bool beside_vertex_post(const Eigen::Vector2d& p, double distance) const {
        const MeshLattice& lattice = lattices_[lattice_at(dem_, p)];
        const Eigen::Vector2d own = lattice.to_own(p);
        const Eigen::Vector2d post(std::round(own.x()), std::round(own.y()));
        return (post - own).cwiseProduct(lattice.spacing).norm() <= distance &&
               lattice.is_vertex[lattice.index(int(post.x()), int(post.y()))];
    }

    /// Whether a corner of the triangle at a place is that near [m].
    bool beside_vertex(const Eigen::Vector2d& p, double distance) const {
        if (mesh_.dimension() < 2) return false;
        const auto face = mesh_.locate(Kernel::Point_2(p.x(), p.y()), near_last());
        const Eigen::Vector2d& spacing = lattices_.front().spacing;
        for (int k = 0; face != nullptr && k < 3; ++k) {
            if (mesh_.is_infinite(face->vertex(k))) continue;
            const Eigen::Vector2d off = cut::plan_of(face->vertex(k)) - p;
            if (off.cwiseProduct(spacing).norm() < distance) return true;
        }
        return false;
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
    bool has_voids_;
    std::vector<MeshLattice> lattices_;  // the coarse one, then those of its details
    Constrained mesh_;
    Constrained::Vertex_handle last_;  // the next point is often near the last one
    std::vector<Ring> rings_;
    std::vector<Grading> grading_{};
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
                       std::span<const Footprint> footprints, std::span<const float> slack,
                       std::span<const Tin> on_detail) {
    if (footprints.empty() && dem.detail.empty()) return without_footprints(dem, tin);
    std::vector<Tin> greedy;
    if (on_detail.empty()) {
        for (const DemDetail& detail : dem.detail) {
            greedy.push_back(triangulate(detail.raster, detail.tolerance));
        }
        on_detail = greedy;
    }
    std::vector<float> weight(slack.size());
    std::transform(slack.begin(), slack.end(), weight.begin(), [](float s) { return 1.0f / s; });
    Cutting cutting(dem, tin, on_detail);
    for (std::size_t i = 0; i < footprints.size(); ++i) cutting.cut(footprints[i], i);
    cutting.restore(tolerance, weight);
    if (cutting.grade()) cutting.restore(tolerance, weight);
    return cutting.result();
}

}  // namespace diurna
