#include "render/rays/plume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/base/error.hpp"
#include "terrain/objects/mesh_check.hpp"

namespace diurna {

double Plume::absorption_at(double wavelength_um) const {
    return absorption.at(std::clamp(wavelength_um, absorption.wavelength_um.front(),
                                    absorption.wavelength_um.back()));
}

std::vector<Eigen::Vector3d> frustum_vertices(const Eigen::Vector3d& base, double base_radius,
                                              double top_radius, double height,
                                              const Eigen::Vector2d& lean, int sides) {
    std::vector<Eigen::Vector3d> vertex;
    const Eigen::Vector3d top = base + Eigen::Vector3d(lean.x(), lean.y(), height);
    for (int level = 0; level < 2; ++level) {
        for (int i = 0; i < sides; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / sides;
            const double radius = level == 0 ? base_radius : top_radius;
            vertex.push_back((level == 0 ? base : top) +
                             radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0));
        }
    }
    vertex.push_back(base);
    vertex.push_back(top);
    return vertex;
}

std::vector<std::array<std::uint32_t, 3>> frustum_triangles(int sides) {
    std::vector<std::array<std::uint32_t, 3>> triangle;
    const auto n = static_cast<std::uint32_t>(sides);
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        triangle.push_back({i, j, n + j});
        triangle.push_back({i, n + j, n + i});
        triangle.push_back({2 * n, j, i});
        triangle.push_back({2 * n + 1, n + i, n + j});
    }
    return triangle;
}

PlumeScene::PlumeScene(std::span<const Plume> plumes) {
    for (std::size_t p = 0; p < plumes.size(); ++p) {
        const Plume& plume = plumes[p];
        std::vector<Eigen::Vector3f> corner;
        for (const Eigen::Vector3d& v : plume.vertex) corner.push_back(v.cast<float>());
        const MeshCheck check = check_mesh(corner, plume.triangle);
        if (!check.closed()) {
            throw InputError("plume " + plume.name,
                             fmt::format("its mesh has {} open edges, expected a closed mesh",
                                         check.boundary_edges));
        }
        const std::vector<MaterialId> none(plume.triangle.size(), MaterialId{0});
        append_facets(facets_, plume.vertex, plume.triangle, none,
                      ObjectId{static_cast<std::uint16_t>(p)});
        Sphere sphere{Eigen::Vector3d::Zero(), 0.0};
        for (const Eigen::Vector3d& v : plume.vertex) sphere.middle += v;
        sphere.middle /= double(plume.vertex.size());
        for (const Eigen::Vector3d& v : plume.vertex) {
            sphere.radius = std::max(sphere.radius, (v - sphere.middle).norm());
        }
        spheres_.push_back(sphere);
        greatest_.push_back(
            *std::max_element(plume.absorption.value.begin(), plume.absorption.value.end()));
    }
    if (facets_.size() > 0) rays_ = std::make_unique<RayScene>(facets_);
}

std::vector<Chord> PlumeScene::chords(const Eigen::Vector3d& origin,
                                      const Eigen::Vector3d& direction, double far) const {
    std::vector<Chord> found;
    if (!rays_) return found;
    std::vector<double> entered(spheres_.size(), -1.0);  // range, or negative: outside
    std::vector<bool> met(spheres_.size(), false);
    Ray ray{.origin = origin.cast<float>(), .near = 0.0f, .direction = direction.cast<float>()};
    for (;;) {
        Hit hit;
        rays_->closest({&ray, 1}, {&hit, 1});
        if (hit.facet == no_facet) break;
        const auto plume = static_cast<std::uint32_t>(facets_.object[index(hit.facet)]);
        const bool entering = facets_.normal[index(hit.facet)].cast<double>().dot(direction) < 0.0;
        const double range = hit.range;
        if (entering) {
            if (range >= far) break;
            if (entered[plume] < 0.0) entered[plume] = range;
        } else {
            // A way out without a way in: the ray began inside.
            const double from = entered[plume] >= 0.0 ? entered[plume] : met[plume] ? -1.0 : 0.0;
            if (from >= 0.0 && from < far) found.push_back({plume, from, std::min(range, far)});
            entered[plume] = -1.0;
        }
        met[plume] = true;
        ray.near = hit.range * (1.0f + 1e-6f) + 1e-4f;
    }
    for (std::size_t p = 0; p < entered.size(); ++p) {
        if (entered[p] >= 0.0 && entered[p] < far) {
            found.push_back({static_cast<std::uint32_t>(p), entered[p], far});
        }
    }
    std::erase_if(found, [](const Chord& chord) { return !(chord.to > chord.from); });
    std::sort(found.begin(), found.end(),
              [](const Chord& a, const Chord& b) { return a.from < b.from; });
    return found;
}

}  // namespace diurna
