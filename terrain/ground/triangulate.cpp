#include "terrain/ground/triangulate.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <queue>

#include "materials/base/giving_up.hpp"
#include "terrain/ground/post_scan.hpp"

namespace diurna {

namespace {

/// What a face remembers: its worst post, and a stamp that reports whether a queue entry is still
/// about this face as it is now.
struct FaceNote {
    WorstPost worst;
    std::uint64_t stamp = 0;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceNote, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

struct Candidate {
    double error;
    std::uint64_t stamp;
    Delaunay::Face_handle face;
    bool operator<(const Candidate& other) const {
        return error != other.error ? error < other.error : stamp > other.stamp;
    }
};

/// Adds the post with the largest error again and again (Garland & Heckbert 1995).
class GreedyInsertion {
 public:
    GreedyInsertion(const Dem& dem, double tolerance, std::span<const float> slack)
        : dem_(dem),
          tolerance_(std::max(tolerance, 1e-9)),  // below a nanometre lies only rounding
          has_voids_(has_voids(dem)) {
        for (const float s : slack) weight_.push_back(1.0f / s);
    }

    std::optional<Tin> run(double most_bytes = 1e30) {
        start();
        while (!queue_.empty()) {
            if (bytes() > most_bytes) return std::nullopt;
            give_up_if_asked();
            const Candidate next = queue_.top();
            queue_.pop();
            if (next.face->info().stamp != next.stamp) continue;
            const WorstPost worst = next.face->info().worst;
            const auto vertex = mesh_.insert(Kernel::Point_2(worst.column, worst.row), next.face);
            auto face = mesh_.incident_faces(vertex);
            const auto first = face;
            do scan(face);
            while (++face != first);
        }
        return result();
    }

 private:
    /// Border of what is to be covered: the corners, and every valid post beside a void. On the
    /// integer lattice the edges of that border are then Delaunay whatever else is inserted (no
    /// post lies inside the circle on an edge of length 1 as diameter, nor inside the circle of a
    /// half cell), so no triangle ever crosses from ground into a void.
    void start() {
        std::vector<Kernel::Point_2> points;
        const int right = dem_.columns - 1, bottom = dem_.rows - 1;
        for (const auto& [column, row] :
             {std::pair{0, 0}, {right, 0}, {0, bottom}, {right, bottom}}) {
            if (!std::isnan(dem_.at(row, column))) points.emplace_back(column, row);
        }
        for (int row = 0; has_voids_ && row < dem_.rows; ++row) {
            for (int column = 0; column < dem_.columns; ++column) {
                if (!std::isnan(dem_.at(row, column)) && beside_void(row, column)) {
                    points.emplace_back(column, row);
                }
            }
        }
        mesh_.insert(points.begin(), points.end());
        for (const auto face : mesh_.finite_face_handles()) scan(face);
    }

    /// A vertex with its two faces and its place in the result; an entry of the queue, which
    /// doubles its room when it grows.
    double bytes() const {
        return 217.0 * double(mesh_.number_of_vertices()) + 48.0 * double(queue_.size());
    }

    bool beside_void(int row, int column) const {
        for (int r = std::max(0, row - 1); r <= std::min(dem_.rows - 1, row + 1); ++r) {
            for (int c = std::max(0, column - 1); c <= std::min(dem_.columns - 1, column + 1);
                 ++c) {
                if (std::isnan(dem_.at(r, c))) return true;
            }
        }
        return false;
    }

    bool is_ground(Delaunay::Face_handle face) const {
        if (!has_voids_) return true;
        const auto centre = CGAL::centroid(mesh_.triangle(face));
        return !std::isnan(height_at(dem_, Eigen::Vector2d(centre.x(), centre.y())));
    }

    Eigen::Vector3d place(Delaunay::Vertex_handle vertex) const {
        const auto& p = vertex->point();
        return {p.x(), p.y(), dem_.at(static_cast<int>(p.y()), static_cast<int>(p.x()))};
    }

    void scan(Delaunay::Face_handle face) {
        FaceNote& note = face->info();
        note.stamp = ++stamp_;
        if (mesh_.is_infinite(face) || !is_ground(face)) return;
        const std::array<Eigen::Vector3d, 3> corner{place(face->vertex(0)), place(face->vertex(1)),
                                                    place(face->vertex(2))};
        note.worst = worst_post(dem_, corner, weight_);
        if (note.worst.error > tolerance_) queue_.push({note.worst.error, note.stamp, face});
    }

    Tin result() {
        Tin tin;
        tin.post.reserve(mesh_.number_of_vertices());
        tin.triangle.reserve(mesh_.number_of_faces());
        for (const auto vertex : mesh_.finite_vertex_handles()) {
            vertex->info() = static_cast<std::uint32_t>(tin.post.size());
            tin.post.push_back({static_cast<std::int32_t>(vertex->point().x()),
                                static_cast<std::int32_t>(vertex->point().y())});
        }
        for (const auto face : mesh_.finite_face_handles()) {
            if (!is_ground(face)) continue;
            // Rows run south: what turns left in (column, row) turns right seen from above.
            tin.triangle.push_back(
                {face->vertex(0)->info(), face->vertex(2)->info(), face->vertex(1)->info()});
        }
        return tin;
    }

    const Dem& dem_;
    double tolerance_;
    std::vector<float> weight_;  // (post) 1 / slack
    bool has_voids_;
    Delaunay mesh_;
    std::priority_queue<Candidate> queue_;
    std::uint64_t stamp_ = 0;
};

}  // namespace

Tin triangulate(const Dem& dem, double tolerance, std::span<const float> slack) {
    return *GreedyInsertion(dem, tolerance, slack).run();
}

std::optional<Tin> triangulate_within(const Dem& dem, double tolerance, double most_bytes) {
    return GreedyInsertion(dem, tolerance, {}).run(most_bytes);
}

}  // namespace diurna
