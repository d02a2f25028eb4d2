#include "terrain/objects/models/panel_box.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace diurna {

namespace {

using Place = std::array<int, 3>;  // on the lattice

struct Quad {
    std::array<std::uint32_t, 4> corner;
    int side;
    int panel;  // -1: none
};

class BoxMaker {
 public:
    BoxMaker(Workpiece& work, const PanelBox& box) : work_(work), box_(box) {
        for (int axis = 0; axis < 3; ++axis) lay_lines(axis);
    }

    void add() {
        const std::size_t first = work_.mesh.triangle.size();
        for (int side = 0; side < 6; ++side) add_side(side);
        for (std::size_t p = 0; p < box_.panels.size(); ++p) {
            if (box_.panels[p].recess != 0.0) recess(static_cast<int>(p));
        }
        if (box_.bend) {
            for (std::size_t v = first_vertex_; v < work_.mesh.vertex.size(); ++v) {
                work_.mesh.vertex[v] = box_.bend(work_.mesh.vertex[v]);
            }
        }
        for (const Quad& quad : quads_) add_quad(work_, quad.corner, part_of(quad));
        finish_solid(work_, first);
    }

 private:
    /// Axes of a panel's across and up.
    static std::pair<int, int> axes_of(int side) {
        return side < 2 ? std::pair{1, 2} : side < 4 ? std::pair{0, 2} : std::pair{0, 1};
    }

    void lay_lines(int axis) {
        const double low = box_.low[axis], high = box_.high[axis];
        std::vector<double> places{low, high};
        // Half of a right angle's pieces lie on either of the sides that meet.
        const int half = (work_.fine.arc_of(radius_) + 1) / 2;
        for (int k = 0; k < half; ++k) {
            const double in = radius_ * (1.0 - std::tan(0.25 * std::numbers::pi * k / half));
            places.push_back(low + in);
            places.push_back(high - in);
        }
        for (const BoxPanel& panel : box_.panels) {
            const auto [across, up] = axes_of(static_cast<int>(panel.side));
            if (axis == across) places.insert(places.end(), {panel.across_from, panel.across_to});
            if (axis == up) places.insert(places.end(), {panel.up_from, panel.up_to});
        }
        const auto& further = box_.further_lines[std::size_t(axis)];
        places.insert(places.end(), further.begin(), further.end());
        line_[axis] = refined(places, work_.fine.edge);
    }

    Eigen::Vector3d rounded(const Eigen::Vector3d& p) const {
        const Eigen::Vector3d edge = Eigen::Vector3d::Constant(radius_);
        const Eigen::Vector3d inner = p.cwiseMax(box_.low + edge).cwiseMin(box_.high - edge);
        const Eigen::Vector3d out = p - inner;
        return out.norm() > 0.0 ? Eigen::Vector3d(inner + out * (radius_ / out.norm())) : p;
    }

    std::uint32_t vertex(const Place& place) {
        const auto [known, fresh] =
            vertex_.try_emplace(place, static_cast<std::uint32_t>(work_.mesh.vertex.size()));
        if (fresh) {
            const Eigen::Vector3d p(line_[0][std::size_t(place[0])],
                                    line_[1][std::size_t(place[1])],
                                    line_[2][std::size_t(place[2])]);
            add_vertex(work_, radius_ > 0.0 ? rounded(p) : p);
        }
        return known->second;
    }

    int panel_at(int side, double across, double up) const {
        for (std::size_t p = 0; p < box_.panels.size(); ++p) {
            const BoxPanel& panel = box_.panels[p];
            if (static_cast<int>(panel.side) == side && across > panel.across_from &&
                across < panel.across_to && up > panel.up_from && up < panel.up_to) {
                return static_cast<int>(p);
            }
        }
        return -1;
    }

    void add_side(int side) {
        const int axis = side / 2, b = (axis + 1) % 3, c = (axis + 2) % 3;
        const bool outward = side % 2 == 1;
        const int at = outward ? static_cast<int>(line_[axis].size()) - 1 : 0;
        const auto middle = [&](int along, int i) {
            return 0.5 * (line_[along][std::size_t(i)] + line_[along][std::size_t(i) + 1]);
        };
        for (int i = 0; i + 1 < static_cast<int>(line_[b].size()); ++i) {
            for (int j = 0; j + 1 < static_cast<int>(line_[c].size()); ++j) {
                const auto corner = [&](int di, int dj) {
                    Place place{};
                    place[std::size_t(axis)] = at;
                    place[std::size_t(b)] = i + di;
                    place[std::size_t(c)] = j + dj;
                    return vertex(place);
                };
                Quad quad{{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}, side, -1};
                if (!outward) std::swap(quad.corner[1], quad.corner[3]);
                const bool turned = axis == 1;  // its lattice runs (z, x), its panels (x, z)
                quad.panel = turned ? panel_at(side, middle(c, j), middle(b, i))
                                    : panel_at(side, middle(b, i), middle(c, j));
                quads_.push_back(quad);
            }
        }
    }

    /// Moves a panel in and closes the step round it.
    void recess(int panel) {
        const int side = static_cast<int>(box_.panels[std::size_t(panel)].side);
        Eigen::Vector3d in = Eigen::Vector3d::Zero();
        in[side / 2] = (side % 2 == 1 ? -1.0 : 1.0) * box_.panels[std::size_t(panel)].recess;
        std::map<std::uint32_t, std::uint32_t> moved;
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (Quad& quad : quads_) {
            if (quad.panel != panel) continue;
            for (int k = 0; k < 4; ++k) edges.insert({quad.corner[k], quad.corner[(k + 1) % 4]});
            for (const std::uint32_t v : quad.corner) {
                if (moved.count(v) > 0) continue;
                moved[v] = add_vertex(work_, work_.mesh.vertex[v] + in);
            }
        }
        for (Quad& quad : quads_) {
            if (quad.panel != panel) continue;
            for (std::uint32_t& v : quad.corner) v = moved[v];
        }
        for (const auto& [a, b] : edges) {
            if (edges.count({b, a}) > 0) continue;
            quads_.push_back({{a, b, moved[b], moved[a]}, side, -1});
        }
    }

    std::uint16_t part_of(const Quad& quad) {
        if (quad.panel >= 0) return part_of_name(work_, box_.panels[std::size_t(quad.panel)].part);
        const std::string& own = box_.side_part[std::size_t(quad.side)];
        return part_of_name(work_, own.empty() ? box_.part : own);
    }

    Workpiece& work_;
    const PanelBox& box_;
    double radius_ = work_.fine.arc_of(box_.radius) > 0 ? box_.radius : 0.0;
    std::size_t first_vertex_ = work_.mesh.vertex.size();
    std::array<std::vector<double>, 3> line_{};
    std::map<Place, std::uint32_t> vertex_{};
    std::vector<Quad> quads_{};
};

}  // namespace

void add_box(Workpiece& work, const PanelBox& box) { BoxMaker(work, box).add(); }

void add_box(Workpiece& work, const std::string& part, const Eigen::Vector3d& low,
             const Eigen::Vector3d& high, double radius) {
    add_box(work, PanelBox{.part = part, .low = low, .high = high, .radius = radius});
}

}  // namespace diurna
