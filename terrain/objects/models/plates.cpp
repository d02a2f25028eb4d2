#include "terrain/objects/models/plates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace diurna {

namespace {

/// Cells of a plate's lattice that are not holes, made triangles on both faces and at all rims.
class PlateMaker {
 public:
    PlateMaker(Workpiece& work, const std::string& part, const PlateFrame& frame,
               const Eigen::Vector3d& size, const std::vector<Hole>& holes)
        : work_(work),
          part_(part_of_name(work, part)),
          frame_(frame),
          thickness_(frame.across.cross(frame.up) * size.z()),
          holes_(holes) {
        std::vector<double> u{0.0, size.x()}, v{0.0, size.y()};
        for (const Hole& hole : holes) {
            u.insert(u.end(), {hole.across_from, hole.across_to});
            v.insert(v.end(), {hole.up_from, hole.up_to});
        }
        u_ = refined(u, work.fine.edge);
        v_ = refined(v, work.fine.edge);
    }

    void add() {
        const std::size_t first = work_.mesh.triangle.size();
        for (int i = 0; i + 1 < static_cast<int>(u_.size()); ++i) {
            for (int j = 0; j + 1 < static_cast<int>(v_.size()); ++j) {
                if (solid(i, j)) add_cell(i, j);
            }
        }
        finish_solid(work_, first);
    }

 private:
    bool solid(int i, int j) const {
        if (i < 0 || j < 0 || i + 1 >= static_cast<int>(u_.size()) ||
            j + 1 >= static_cast<int>(v_.size())) {
            return false;
        }
        const double u = 0.5 * (u_[std::size_t(i)] + u_[std::size_t(i) + 1]);
        const double v = 0.5 * (v_[std::size_t(j)] + v_[std::size_t(j) + 1]);
        return std::none_of(holes_.begin(), holes_.end(), [&](const Hole& hole) {
            return u > hole.across_from && u < hole.across_to && v > hole.up_from && v < hole.up_to;
        });
    }

    std::uint32_t vertex(int i, int j, int face) {
        const auto [known, fresh] =
            vertex_.try_emplace({i, j, face}, static_cast<std::uint32_t>(work_.mesh.vertex.size()));
        if (fresh) {
            add_vertex(work_, frame_.corner + frame_.across * u_[std::size_t(i)] +
                                  frame_.up * v_[std::size_t(j)] + thickness_ * face);
        }
        return known->second;
    }

    void rim(std::array<int, 2> a, std::array<int, 2> b) {
        add_quad(work_,
                 {vertex(a[0], a[1], 0), vertex(b[0], b[1], 0), vertex(b[0], b[1], 1),
                  vertex(a[0], a[1], 1)},
                 part_);
    }

    void add_cell(int i, int j) {
        const int k = i + 1, l = j + 1;
        add_quad(work_, {vertex(i, j, 1), vertex(k, j, 1), vertex(k, l, 1), vertex(i, l, 1)},
                 part_);
        add_quad(work_, {vertex(i, j, 0), vertex(i, l, 0), vertex(k, l, 0), vertex(k, j, 0)},
                 part_);
        if (!solid(i, j - 1)) rim({i, j}, {k, j});
        if (!solid(k, j)) rim({k, j}, {k, l});
        if (!solid(i, l)) rim({k, l}, {i, l});
        if (!solid(i - 1, j)) rim({i, l}, {i, j});
    }

    Workpiece& work_;
    std::uint16_t part_;
    const PlateFrame& frame_;
    Eigen::Vector3d thickness_;
    const std::vector<Hole>& holes_;
    std::vector<double> u_{}, v_{};
    std::map<std::array<int, 3>, std::uint32_t> vertex_{};
};

}  // namespace

void add_plate(Workpiece& work, const std::string& part, const PlateFrame& frame,
               const Eigen::Vector3d& size, const std::vector<Hole>& holes) {
    PlateMaker(work, part, frame, size, holes).add();
}

void add_grille(Workpiece& work, const std::string& part, const PlateFrame& frame,
                const Eigen::Vector3d& size, int slots) {
    const double rim = 0.06 * std::min(size.x(), size.y());
    const double pitch = (size.y() - 2.0 * rim) / slots;
    std::vector<Hole> holes;
    for (int i = 0; i < slots; ++i) {
        const double from = rim + pitch * (i + 0.2), to = rim + pitch * (i + 0.8);
        holes.push_back({rim, size.x() - rim, from, to});
    }
    add_plate(work, part, frame, size, holes);
}

void add_belt(Workpiece& work, const std::string& part, const std::vector<Eigen::Vector2d>& path,
              double thickness, double x_from, double x_to) {
    const std::size_t first = work.mesh.triangle.size(), n = path.size();
    const std::uint16_t number = part_of_name(work, part);
    const std::vector<double> x = refined({x_from, x_to}, work.fine.edge);
    // Round a section: outer face from x_from to x_to, inner face back.
    std::vector<std::vector<std::uint32_t>> section;
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector2d before = (path[i] - path[(i + n - 1) % n]).normalized(),
                              after = (path[(i + 1) % n] - path[i]).normalized();
        const Eigen::Vector2d left(-before.y() - after.y(), before.x() + after.x());
        const Eigen::Vector2d in =
            left.normalized() * thickness /
            std::max(0.5, left.normalized().dot(Eigen::Vector2d(-after.y(), after.x())));
        section.emplace_back();
        for (const double at : x) {
            section.back().push_back(add_vertex(work, {at, path[i].x(), path[i].y()}));
        }
        for (std::size_t k = x.size(); k-- > 0;) {
            section.back().push_back(
                add_vertex(work, {x[k], path[i].x() + in.x(), path[i].y() + in.y()}));
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        const auto &a = section[i], &b = section[(i + 1) % n];
        for (std::size_t k = 0; k < a.size(); ++k) {
            const std::size_t l = (k + 1) % a.size();
            add_quad(work, {a[k], b[k], b[l], a[l]}, number);
        }
    }
    finish_solid(work, first);
}

void add_sheet(Workpiece& work, const std::string& part, const Eigen::Vector2d& low,
               const Eigen::Vector2d& high, double edge,
               const std::function<double(double, double)>& height) {
    const std::vector<double> x = refined({low.x(), high.x()}, edge),
                              y = refined({low.y(), high.y()}, edge);
    std::vector<std::uint32_t> vertex;
    for (const double at_y : y) {
        for (const double at_x : x) {
            vertex.push_back(add_vertex(work, {at_x, at_y, height(at_x, at_y)}));
        }
    }
    const std::uint16_t number = part_of_name(work, part);
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
        for (std::size_t i = 0; i + 1 < x.size(); ++i) {
            const std::size_t at = j * x.size() + i;
            add_quad(work,
                     {vertex[at], vertex[at + 1], vertex[at + x.size() + 1], vertex[at + x.size()]},
                     number);
        }
    }
}

}  // namespace diurna
