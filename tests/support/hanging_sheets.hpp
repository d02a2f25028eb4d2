#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "materials/matter/library.hpp"
#include "materials/matter/passed_light.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "tests/support/render_scene.hpp"

/// Level sheets over one another.
namespace diurna::testing {

inline Material net(std::string name, double cover) {
    Material m = material(std::move(name), flat_spectrum(0.0), flat_spectrum(1.0 - cover));
    m.see_through = true;
    m.thermal.back = ExposedBack{};
    return m;
}

/// Ground about the origin under sheets of other materials, all level squares in small triangles.
struct Layers {
    FacetSet facets;
    std::vector<Material> all;
    /// - half: of its side [m]
    void sheet(double up, double half, int parts, Material material) {
        std::vector<Eigen::Vector3d> vertex;
        std::vector<std::array<std::uint32_t, 3>> triangle;
        const auto row = static_cast<std::uint32_t>(parts + 1);
        for (std::uint32_t j = 0; j < row; ++j) {
            for (std::uint32_t i = 0; i < row; ++i) {
                vertex.emplace_back(half * (2.0 * i / parts - 1.0), half * (2.0 * j / parts - 1.0),
                                    up);
            }
        }
        for (std::uint32_t j = 0; j + 1 < row; ++j) {
            for (std::uint32_t i = 0; i + 1 < row; ++i) {
                const std::uint32_t a = j * row + i;
                triangle.push_back({a, a + 1, a + row + 1});
                triangle.push_back({a, a + row + 1, a + row});
            }
        }
        all.push_back(std::move(material));
        append_facets(
            facets, vertex, triangle,
            std::vector<MaterialId>(triangle.size(), MaterialId{std::uint16_t(all.size() - 1)}),
            ObjectId{std::uint16_t(all.size() - 1)});
    }
    std::vector<PassedLight> passed() const { return passed_light(MaterialLibrary(all)); }
    std::vector<float> sunlit(const Eigen::Vector3d& to_sun, int samples) const {
        std::vector<float> fraction(facets.size());
        sun_fraction(facets, RayScene(facets, passed()), to_sun, fraction, {.samples = samples});
        return fraction;
    }
    /// Mean by area over the facets of a sheet within so many metres of the origin.
    template <class Value>
    double mean(std::size_t sheet, double within, const Value& value) const {
        double sum = 0.0, area = 0.0;
        for (std::size_t f = 0; f < facets.size(); ++f) {
            if (index(facets.material[f]) != sheet) continue;
            if (facets.centroid[f].head<2>().norm() > within) continue;
            sum += double(facets.area[f]) * value(f);
            area += double(facets.area[f]);
        }
        return sum / area;
    }
};

}  // namespace diurna::testing
