#include "terrain/ground/grade_round.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <vector>

#include "terrain/ground/detail_outline.hpp"

namespace diurna {

namespace {

using cut::Constrained;
using Face = Constrained::Face_handle;
using Vertex = Constrained::Vertex_handle;
using Corners = std::array<Vertex, 3>;

constexpr double largest_radius = 0.64;  // of a circumcircle, in edges: 0.577 for even triangles
constexpr double sliver = 1.4;           // circumradius over shortest edge, 21 degrees
constexpr double least_edge = 0.35;      // of the size requested: shorter ones are of other meshes
constexpr double short_line = 0.75;      // of the size requested: lines are divided no further
constexpr std::size_t most_added = 400'000;

/// A triangle in metres.
struct Shape {
    Eigen::Vector2d middle, centre;  // of its corners' and of its circumcircle
    double radius = 0.0;
    double shortest = 0.0;  // edge
    Eigen::Vector2d foot;   // middle of that edge
};

Shape shape_of(const std::array<Eigen::Vector2d, 3>& p) {
    Shape shape;
    shape.middle = (p[0] + p[1] + p[2]) / 3.0;
    const Eigen::Vector2d b = p[1] - p[0], c = p[2] - p[0];
    const double twice = 2.0 * (b.x() * c.y() - b.y() * c.x());
    const double bb = b.squaredNorm(), cc = c.squaredNorm();
    const Eigen::Vector2d to((c.y() * bb - b.y() * cc) / twice, (b.x() * cc - c.x() * bb) / twice);
    shape.centre = p[0] + to;
    shape.radius = to.norm();
    shape.shortest = 1e300;
    for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector2d &from = p[k], &until = p[(k + 1) % 3];
        const double length = (until - from).norm();
        if (length >= shape.shortest) continue;
        shape.shortest = length;
        shape.foot = 0.5 * (from + until);
    }
    return shape;
}

/// Its corners in metres without those on straight sides.
Ring corners_of(const Ring& ring, const Eigen::Vector2d& spacing) {
    Ring corners;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d at = ring[i].cwiseProduct(spacing);
        const Eigen::Vector2d before =
            corners.empty() ? ring.back().cwiseProduct(spacing) : corners.back();
        const Eigen::Vector2d after = ring[(i + 1) % ring.size()].cwiseProduct(spacing);
        const double off = std::abs(turn(before, at, after));
        if (off > 1e-6 * (after - before).squaredNorm()) corners.push_back(at);
    }
    return corners;
}

/// The network around one ring.
class Grader {
 public:
    Grader(const Grading& grading, const Dem& dem, const Eigen::Vector2d& spacing,
           Constrained& network)
        : grading_(grading),
          dem_(dem),
          spacing_(spacing),
          corners_(corners_of(grading.ring, spacing)),
          network_(network) {}

    void run() {
        if (corners_.size() < 3 || network_.dimension() < 2) return;
        collect();
        for (; !waiting_.empty() && added_ < most_added; waiting_.pop_front()) {
            const Corners corners = waiting_.front();
            Face face;
            if (network_.is_face(corners[0], corners[1], corners[2], face)) improve(face);
        }
    }

 private:
    Eigen::Vector2d metres(Vertex vertex) const {
        return cut::plan_of(vertex).cwiseProduct(spacing_);
    }
    Shape shape(Face face) const {
        return shape_of(
            {metres(face->vertex(0)), metres(face->vertex(1)), metres(face->vertex(2))});
    }
    bool inside(const Eigen::Vector2d& p) const { return contains(corners_, p); }
    double to_ring(const Eigen::Vector2d& p) const {
        double nearest = 1e300;
        for (std::size_t i = 0, j = corners_.size() - 1; i < corners_.size(); j = i++) {
            const Eigen::Vector2d side = corners_[i] - corners_[j], to = p - corners_[j];
            const double t = std::clamp(to.dot(side) / side.squaredNorm(), 0.0, 1.0);
            nearest = std::min(nearest, (to - t * side).squaredNorm());
        }
        return std::sqrt(nearest);
    }
    bool on_other_side(const Eigen::Vector2d& p) const {
        return inside(p) == (grading_.side == Grading::Side::outside);
    }
    /// Edge length requested at a place [m].
    double size(const Eigen::Vector2d& p) const {
        if (grading_.filled && on_other_side(p)) return grading_.edge;
        return grading_.edge + grading_.growth * to_ring(p);
    }
    /// Whether a triangle is to be looked at.
    bool counts(Face face, const Shape& shape) const {
        if (network_.is_infinite(face)) return false;
        return grading_.filled || !on_other_side(shape.middle);
    }
    static bool too_large(const Shape& shape, double size) {
        return shape.radius > largest_radius * size;
    }
    static bool too_thin(const Shape& shape, double size) {
        return shape.radius > sliver * shape.shortest && shape.shortest > least_edge * size;
    }

    /// Triangles on the ring, on its filled side, and from there on as long as they are too large.
    void collect() {
        std::deque<Face> open;
        const auto visit = [&](Face face) {
            if (face == Face() || network_.is_infinite(face)) return;
            if (face->info().visited == grading_.number) return;
            face->info().visited = grading_.number;
            open.push_back(face);
        };
        Face near;
        for (const Eigen::Vector2d& corner : corners_) {
            const Eigen::Vector2d p = corner.cwiseQuotient(spacing_);
            near = network_.locate(cut::Kernel::Point_2(p.x(), p.y()), near);
            visit(near);
            for (int k = 0; near != Face() && k < 3; ++k) visit(near->neighbor(k));
        }
        for (; !open.empty(); open.pop_front()) {
            const Face face = open.front();
            const Shape of = shape(face);
            const double distance = to_ring(of.middle), wanted = size(of.middle);
            const bool counted = counts(face, of);
            const bool bad = counted && (too_large(of, wanted) || too_thin(of, wanted));
            if (bad) waiting_.push_back({face->vertex(0), face->vertex(1), face->vertex(2)});
            const bool beside = distance < 2.0 * grading_.edge;
            const bool filled = grading_.filled && on_other_side(of.middle);
            if (!bad && !beside && !filled) continue;
            for (int k = 0; k < 3; ++k) visit(face->neighbor(k));
        }
    }

    void improve(Face face) {
        const Shape of = shape(face);
        if (!counts(face, of)) return;
        const double wanted = size(of.middle);
        const bool large = too_large(of, wanted);
        if (!large && !too_thin(of, wanted)) return;
        Eigen::Vector2d at = of.centre;
        if (large && of.shortest < 1.2 * size(of.foot)) {
            const Eigen::Vector2d up = of.centre - of.foot;
            const double whole = up.norm();
            const Eigen::Vector2d first = of.foot + 0.87 * size(of.foot) / whole * up;
            const double side = size(first);
            const double height = std::sqrt(
                std::max(side * side - 0.25 * of.shortest * of.shortest, 0.6 * side * side));
            if (height < whole) at = of.foot + height / whole * up;
        }
        put(face, of.middle, at);
    }

    /// A vertex at a place, or on the line that is in the way.
    void put(Face face, const Eigen::Vector2d& from, const Eigen::Vector2d& at) {
        const auto [in, line] = walk(face, from, at);
        if (in == Face()) return;
        int near = line;
        for (int k = 0; near < 0 && k < 3; ++k) {
            if (!is_line(in, k)) continue;
            const auto [a, b] = ends(in, k);
            if ((a - at).dot(b - at) < 0.0) near = k;
        }
        if (near >= 0) {
            divide(in, near, face);
            return;
        }
        const Eigen::Vector2d p = at.cwiseQuotient(spacing_);
        const double height = height_at(dem_, p);
        if (std::isnan(height) || (!dem_.detail.empty() && beside_outline(dem_, p))) return;
        const std::size_t before = network_.number_of_vertices();
        const Vertex vertex = network_.insert(cut::Kernel::Point_2(p.x(), p.y()), in);
        if (network_.number_of_vertices() == before) return;
        finish(vertex, height);
    }

    bool is_line(Face face, int k) const {
        return face->is_constrained(k) || network_.is_infinite(face->neighbor(k));
    }
    std::pair<Eigen::Vector2d, Eigen::Vector2d> ends(Face face, int k) const {
        return {metres(face->vertex((k + 1) % 3)), metres(face->vertex((k + 2) % 3))};
    }

    struct Walked {
        Face in;
        int line = -1;  // the edge of it that is in the way; -1: none
    };
    /// To the triangle at a place, or to the first line before it.
    Walked walk(Face face, const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
        Face before;
        for (int step = 0; step < 10'000; ++step) {
            int through = -1;
            for (int k = 0; k < 3 && through < 0; ++k) {
                if (before != Face() && face->neighbor(k) == before) continue;
                const auto [a, b] = ends(face, k);
                const double inner = turn(a, b, metres(face->vertex(k)));
                const bool beyond = turn(a, b, to) * inner < 0.0;
                if (beyond && turn(from, to, a) * turn(from, to, b) <= 0.0) through = k;
            }
            if (through < 0) return {face};
            if (is_line(face, through)) return {face, through};
            before = face;
            face = face->neighbor(through);
        }
        return {};
    }

    /// Divides a line in its middle, unless it is short, and looks at a triangle again.
    void divide(Face face, int k, Face again) {
        const auto [a, b] = ends(face, k);
        const Eigen::Vector2d middle = 0.5 * (a + b);
        if ((b - a).norm() < short_line * size(middle)) return;
        const Eigen::Vector2d p = middle.cwiseQuotient(spacing_);
        const double height = height_at(dem_, p);
        if (std::isnan(height)) return;
        const Corners known{again->vertex(0), again->vertex(1), again->vertex(2)};
        const Vertex vertex =
            network_.insert(cut::Kernel::Point_2(p.x(), p.y()), Constrained::EDGE, face, k);
        finish(vertex, height);
        waiting_.push_back(known);
    }

    void finish(Vertex vertex, double height) {
        ++added_;
        vertex->info().height = static_cast<float>(height);
        auto face = network_.incident_faces(vertex);
        const auto first = face;
        do {
            if (network_.is_infinite(face)) continue;
            waiting_.push_back({face->vertex(0), face->vertex(1), face->vertex(2)});
        } while (++face != first);
    }

    const Grading& grading_;
    const Dem& dem_;
    Eigen::Vector2d spacing_;
    Ring corners_;
    Constrained& network_;
    std::deque<Corners> waiting_{};
    std::size_t added_ = 0;
};

}  // namespace

void grade_round(const Grading& grading, const Dem& dem, const Eigen::Vector2d& spacing,
                 cut::Constrained& network) {
    Grader(grading, dem, spacing, network).run();
}

}  // namespace diurna
