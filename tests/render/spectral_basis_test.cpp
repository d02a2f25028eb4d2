#include "render/light/spectral_basis.hpp"

#include <catch2/catch.hpp>

#include "materials/atmosphere/band_model.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/radiosity_tables.hpp"
#include "render/light/scene_basis.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;

namespace {

Band band_of(const std::string& name) {
    if (name == "3-5") return flat_band("3-5", 3.0, 5.0, bin_edges_um());
    if (name == "0.4-0.7") return flat_band("0.4-0.7", 0.4, 0.7, bin_edges_um());
    if (name == "8-30") return flat_band("8-30", 8.0, 30.0, bin_edges_um());
    return flat_band("8-12", 8.0, 12.0, bin_edges_um());
}

struct Scene {
    Band band;
    TemperatureExtent extent;
    std::vector<NodeOptics> optics;
    std::array<IncidentLight, 3> light;
    SpectralBasis basis;

    Scene(const std::string& name, float coldest, float hottest)
        : band(band_of(name)),
          extent{coldest, hottest},
          optics(node_optics(band, testing::materials(290.0), {true, true, true, true})) {
        for (IncidentLight& l : light)
            l.sun = l.sky = std::vector<double>(band.node_um.size(), 0.0);
        basis = scene_basis(band, optics, light, 0.5f, extent);
    }
    RadiosityTables tables() const {
        const BandLight of{.band = band, .incident = light, .optics = optics, .basis = basis};
        return radiosity_tables({&of, 1}, temperature_grid(extent.coldest, extent.hottest));
    }
    /// Σ weight × factor × a spectrum in modes.
    double worth_of(const float* modes, const std::vector<double>& factor) const {
        double sum = 0.0;
        for (std::size_t n = 0; n < factor.size(); ++n) {
            double spectrum = 0.0;
            for (std::size_t k = 0; k < basis.size(); ++k) {
                spectrum += double{modes[k]} * basis.mode(Eigen::Index(n), Eigen::Index(k));
            }
            sum += basis.root_weight[Eigen::Index(n)] * spectrum * factor[n];
        }
        return sum;
    }
};

/// The cubic of (power, lane) at t.
std::vector<float> at(const std::vector<float>& cubics, const RadiosityTables& tables,
                      float temperature) {
    float t = 0.0f;
    const float* a = &cubics[tables.grid.cell(temperature, t) * 4 * tables.lanes];
    std::vector<float> out(tables.lanes);
    for (std::size_t k = 0; k < out.size(); ++k) {
        const std::size_t n = tables.lanes;
        out[k] = a[k] + t * (a[n + k] + t * (a[2 * n + k] + t * a[3 * n + k]));
    }
    return out;
}

}  // namespace

TEST_CASE("modes are orthonormal under the band's quadrature", "[render][basis]") {
    const Scene scene(GENERATE("3-5", "8-12", "0.4-0.7"), 260.0f, 420.0f);
    const Eigen::MatrixXd gram = scene.basis.mode.transpose() * scene.basis.mode;
    CHECK((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff() <
          1e-12);
    CHECK(scene.basis.thermal <= scene.basis.size());
}

// Against Planck's law summed over the nodes, with a transmittance that varies as the air's does.
TEST_CASE("emission in modes agrees with Planck's law to 0.2 mK", "[render][basis]") {
    const auto [name, coldest, hottest] =
        GENERATE(std::tuple{"3-5", 250.0f, 330.0f}, std::tuple{"8-12", 250.0f, 330.0f},
                 std::tuple{"3-5", 200.0f, 1000.0f}, std::tuple{"8-30", 200.0f, 1000.0f});
    const Scene scene(name, coldest, hottest);
    const RadiosityTables tables = scene.tables();
    std::vector<double> air, soil;
    for (std::size_t n = 0; n < scene.band.node_um.size(); ++n) {
        air.push_back(0.5 + 0.5 * std::sin(40.0 * scene.band.node_um[n]));
        soil.push_back(air[n] * scene.optics[testing::soil].emissivity[n]);
    }
    for (float t = coldest; t <= hottest; t += 7.3f) {
        const double slope = band_radiance_derivative(scene.band, double{t});
        const std::vector<float> black = at(tables.black, tables, t);
        for (const auto* factor : {&air, &soil}) {
            double exact = 0.0;
            for (std::size_t n = 0; n < factor->size(); ++n) {
                exact +=
                    scene.band.weight[n] * (*factor)[n] * planck(scene.band.node_um[n], double{t});
            }
            CAPTURE(name, t, scene.basis.thermal);
            CHECK(std::abs(scene.worth_of(black.data(), *factor) - exact) / slope < 2e-4);
        }
    }
}

// Kirchhoff in modes: what a surface emits and what it reflects of a black room add up to the room.
TEST_CASE("what is not emitted is reflected, in every mode", "[render][basis]") {
    const Scene scene(GENERATE("3-5", "8-12", "8-30"), 260.0f, 420.0f);
    const RadiosityTables tables = scene.tables();
    for (const auto kind : {testing::soil, testing::metal, testing::paint}) {
        for (const float t : {260.0f, 301.0f, 420.0f}) {
            const auto black = at(tables.black, tables, t);
            const auto emitted = at(tables.material[kind].emitted, tables, t);
            const auto reflected = at(tables.material[kind].reflected, tables, t);
            for (std::size_t k = 0; k < tables.lanes; ++k) {
                CHECK(std::abs(emitted[k] + reflected[k] - black[k]) <= 1e-6f * black[0]);
            }
        }
    }
}
