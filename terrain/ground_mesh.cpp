#include "terrain/ground_mesh.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "materials/error.hpp"
#include "terrain/post_scan.hpp"

namespace diurna {

namespace {

using Ring = std::vector<Eigen::Vector2d>;

/// Distance within which a ring runs through a post instead of beside it, so that no sliver
/// arises [posts].
constexpr double snap = 0.005;

/// The part of a ring inside the raster (Sutherland & Hodgman 1974: one side after the other).
Ring clipped(Ring ring, const Dem& dem) {
    const Eigen::Vector2d high(dem.columns - 1, dem.rows - 1);
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2;
        const double limit = side % 2 == 0 ? 0.0 : high[axis];
        const auto inside = [&](const Eigen::Vector2d& p) {
            return side % 2 == 0 ? p[axis] >= limit : p[axis] <= limit;
        };
        Ring kept;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Eigen::Vector2d &from = ring[i], &to = ring[(i + 1) % ring.size()];
            if (inside(from)) kept.push_back(from);
            if (inside(from) == inside(to)) continue;
            Eigen::Vector2d crossing =
                from + (to - from) * ((limit - from[axis]) / (to[axis] - from[axis]));
            crossing[axis] = limit;
            kept.push_back(crossing);
        }
        ring = std::move(kept);
    }
    return ring;
}

/// Posts within the snapping distance of the way from `a` to `b`, ends left out, in order.
Ring posts_along(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d way = b - a;
    const double length = way.norm();
    Ring found;
    const int axis = std::abs(way.x()) >= std::abs(way.y()) ? 0 : 1;
    const double first = std::min(a[axis], b[axis]), last = std::max(a[axis], b[axis]);
    for (double line = std::ceil(first); line <= last && length > 0.0; ++line) {
        const double t = (line - a[axis]) / way[axis];
        Eigen::Vector2d post;
        post[axis] = line;
        post[1 - axis] = std::round(a[1 - axis] + t * way[1 - axis]);
        const Eigen::Vector2d to = post - a;
        const double beside = std::abs(way.x() * to.y() - way.y() * to.x()) / length;
        if (beside < snap) found.push_back(post);
    }
    if (a[axis] > b[axis]) std::reverse(found.begin(), found.end());
    return found;
}

/// Points along the ring no further apart than `largest_edge` [m]; it runs through the posts that
/// it comes very near to.
Ring divided(const Ring& ring, double largest_edge, const Eigen::Vector2d& spacing) {
    Ring points;
    const auto add = [&](Eigen::Vector2d p) {
        const Eigen::Vector2d post(std::round(p.x()), std::round(p.y()));
        if ((p - post).norm() < snap) p = post;
        if (points.empty() || (p - points.back()).norm() > snap) points.push_back(p);
    };
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d step = ring[(i + 1) % ring.size()] - ring[i];
        const double parts = std::ceil(step.cwiseProduct(spacing).norm() / largest_edge);
        const int count = std::max(1, static_cast<int>(parts));
        for (int k = 0; k < count; ++k) {
            const Eigen::Vector2d from = ring[i] + step * (k / double(count));
            add(from);
            for (const auto& post : posts_along(from, ring[i] + step * ((k + 1) / double(count)))) {
                add(post);
            }
        }
    }
    while (points.size() > 1 && (points.back() - points.front()).norm() <= snap) points.pop_back();
    return points;
}

/// Even-odd rule.
bool contains(const Ring& ring, const Eigen::Vector2d& p) {
    bool inside = false;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Eigen::Vector2d &a = ring[i], &b = ring[j];
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            p.x() < a.x() + (p.y() - a.y()) * (b.x() - a.x()) / (b.y() - a.y())) {
            inside = !inside;
        }
    }
    return inside;
}

double distance_to_ring(const Ring& ring, const Eigen::Vector2d& p,
                        const Eigen::Vector2d& spacing) {
    double nearest_squared = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Eigen::Vector2d side = (ring[i] - ring[j]).cwiseProduct(spacing);
        const Eigen::Vector2d to = (p - ring[j]).cwiseProduct(spacing);
        const double t = std::clamp(to.dot(side) / side.squaredNorm(), 0.0, 1.0);
        nearest_squared = std::min(nearest_squared, (to - t * side).squaredNorm());
    }
    return std::sqrt(nearest_squared);
}

struct Extent {
    Eigen::Vector2d low, high;
    explicit Extent(const Ring& ring) : low(ring.front()), high(ring.front()) {
        for (const auto& p : ring) {
            low = low.cwiseMin(p);
            high = high.cwiseMax(p);
        }
    }
    bool contains(const Eigen::Vector2d& p) const {
        return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
    }
};

/// A lattice along the ring's longest side, inside the ring and clear of its border.
Ring lattice_inside(const Ring& corners, const Ring& border, double largest_edge,
                    const Eigen::Vector2d& spacing) {
    const double step = 0.75 * largest_edge;
    Eigen::Vector2d along = Eigen::Vector2d::UnitX();
    double longest = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector2d side =
            (corners[(i + 1) % corners.size()] - corners[i]).cwiseProduct(spacing);
        if (side.norm() > longest) {
            longest = side.norm();
            along = side / longest;
        }
    }
    const Eigen::Vector2d across(-along.y(), along.x());
    const Extent extent(border);
    const Eigen::Vector2d centre = 0.5 * (extent.low + extent.high);
    const int reach = static_cast<int>(
        std::ceil(0.5 * (extent.high - extent.low).cwiseProduct(spacing).norm() / step));
    Ring points;
    for (int v = -reach; v <= reach; ++v) {
        for (int u = -reach; u <= reach; ++u) {
            const Eigen::Vector2d metres = step * (u * along + v * across);
            const Eigen::Vector2d p = centre + metres.cwiseQuotient(spacing);
            if (extent.contains(p) && contains(border, p) &&
                distance_to_ring(border, p, spacing) > 0.5 * step) {
                points.push_back(p);
            }
        }
    }
    return points;
}

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
          has_voids_(std::any_of(dem.height.begin(), dem.height.end(),
                                 [](float h) { return std::isnan(h); })),
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
        rings_.push_back(border.size() < 3 ? Ring{} : border);
        if (border.size() < 3) return;  // smaller than the snapping distance
        std::vector<Constrained::Vertex_handle> vertices;
        for (const Eigen::Vector2d& p : border) vertices.push_back(add(p));
        for (std::size_t i = 0; i < border.size(); ++i) {
            const auto a = vertices[i], b = vertices[(i + 1) % border.size()];
            if (a != Constrained::Vertex_handle() && b != Constrained::Vertex_handle() && a != b) {
                mesh_.insert_constraint(a, b);
            }
        }
        if (std::isfinite(footprint.largest_edge)) {
            for (const Eigen::Vector2d& p :
                 lattice_inside(corners, border, footprint.largest_edge, spacing_)) {
                if (!beside_vertex_post(p, 0.3 * footprint.largest_edge)) add(p);
            }
        }
    }

    /// Puts back the posts that the cuts have left further than the tolerance from the mesh. Each
    /// is put back at most once: on slivers the plane of a triangle misses even its own corners by
    /// rounding.
    void restore(double tolerance) {
        for (bool changed = true; changed;) {
            changed = false;
            give_heights_to_crossings();
            std::vector<std::pair<WorstPost, Constrained::Vertex_handle>> missing;
            for (const auto face : mesh_.finite_face_handles()) {
                if (!is_ground(face)) continue;
                const WorstPost worst = worst_post(
                    dem_, {place(face->vertex(0)), place(face->vertex(1)), place(face->vertex(2))});
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
        std::vector<Extent> extents;
        for (const Ring& ring : rings_) {
            extents.emplace_back(ring.empty() ? Ring{Eigen::Vector2d(-1, -1)} : ring);
        }
        for (const auto face : mesh_.finite_face_handles()) {
            if (!is_ground(face)) continue;
            mesh.triangle.push_back({face->vertex(0)->info().number, face->vertex(2)->info().number,
                                     face->vertex(1)->info().number});
            const Eigen::Vector2d middle = centre(face);
            std::int32_t owner = -1;
            for (std::size_t i = rings_.size(); i-- > 0 && owner < 0;) {
                if (extents[i].contains(middle) && contains(rings_[i], middle)) {
                    owner = static_cast<std::int32_t>(i);
                }
            }
            mesh.footprint.push_back(owner);
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
        if (!(footprint.largest_edge > 0.1)) {
            throw refuse(fmt::format("found a largest edge of {} m; expected more than 0.1 m",
                                     footprint.largest_edge));
        }
        Ring ring = clipped(footprint.ring, dem_);
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

GroundMesh ground_mesh(const Dem& dem, double tolerance, std::span<const Footprint> footprints) {
    const Tin tin = triangulate(dem, tolerance);
    if (footprints.empty()) return without_footprints(dem, tin);
    Cutting cutting(dem, tin);
    for (std::size_t i = 0; i < footprints.size(); ++i) cutting.cut(footprints[i], i);
    cutting.restore(tolerance);
    return cutting.result();
}

}  // namespace diurna
