#include "materials/atmosphere/atmosphere.hpp"

#include <cassert>
#include <cmath>

#include "materials/atmosphere/band_model_tables.hpp"
#include "materials/atmosphere/medium.hpp"
#include "materials/base/fast_exp.hpp"
#include "materials/base/quadrature.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

/// Nodes with what does not depend on temperature worked out: Planck's law for many temperatures.
struct Nodes {
    std::vector<double> c1, c2;    // c₁ λ⁻⁵, c₂ / λ
    std::vector<std::size_t> bin;  // of the node, counted from the first of the range
    BinRange bins;

    explicit Nodes(std::span<const double> node_um) : bins(bins_of(node_um)) {
        for (const double um : node_um) {
            c1.push_back(first_radiation_um / (um * um * um * um * um));
            c2.push_back(second_radiation_um / um);
            bin.push_back(bin_of(um) - bins.first);
        }
    }
    std::size_t size() const { return bin.size(); }
};

/// Planck's law at the nodes. Air is no hotter than 1500 K, so that exp − 1 loses nothing below
/// 20 µm.
void black_bodies(const Nodes& nodes, double temperature, std::span<double> black) {
    const double inverse = 1.0 / temperature;
    const std::size_t count = nodes.size();
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) {
        black[i] = nodes.c1[i] / (fast_exp(nodes.c2[i] * inverse) - 1.0);
    }
}

/// radiance += emission of one segment, Planck's law linear in optical depth x between its ends:
/// (near + (far − near) f) (before − after), f = 1/x − 1/(eˣ − 1) to 1 % of far − near.
void add_emission(std::span<const double> near, std::span<const double> far,
                  std::span<const double> depth_before, std::span<const double> depth_after,
                  std::span<const double> before, std::span<const double> after,
                  std::span<double> radiance) {
    const std::size_t count = radiance.size();
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) {
        const double x = depth_after[i] - depth_before[i];
        const double f = (0.5 + 0.06 * x) / (1.0 + x * ((1.0 / 6.0 + 0.12) + 0.06 * x));
        radiance[i] += (near[i] + (far[i] - near[i]) * f) * (before[i] - after[i]);
    }
}

NodeSpectrum clear(std::size_t nodes) {
    return {std::vector<double>(nodes, 1.0), std::vector<double>(nodes, 0.0)};
}

/// Calls `at_end(segment, spectrum)` with the path up to the far end of each segment. A line that
/// does not know its ends has in each segment the temperature of its middle.
template <class AtEnd>
NodeSpectrum along(const BandModel& model, const SightLine& line, std::span<const double> node_um,
                   AtEnd&& at_end) {
    const Nodes nodes(node_um);
    const std::size_t count = nodes.size();
    const Medium medium(model, nodes.bins);
    const bool ends_known = !line.edge_km.empty();
    NodeSpectrum spectrum = clear(count);
    std::vector<double> bin_depth(nodes.bins.size()), bin_after(nodes.bins.size());
    std::vector<double> depth(count, 0.0), depth_after(count), after(count), near(count),
        far(count);
    if (ends_known) {
        black_bodies(nodes, pressure_and_temperature_at(model.profile, line.edge_km[0]).second,
                     near);
    }
    Amounts amounts = medium.none();
    for (std::size_t segment = 0; segment < line.size(); ++segment) {
        medium.add(line, segment, amounts);
        medium.spread(amounts);
        medium.depths(amounts, bin_depth);
        bin_after = bin_depth;
        negative_exponentials(bin_after);
        for (std::size_t i = 0; i < count; ++i) {
            depth_after[i] = bin_depth[nodes.bin[i]];
            after[i] = bin_after[nodes.bin[i]];
        }
        if (ends_known) {
            black_bodies(
                nodes, pressure_and_temperature_at(model.profile, line.edge_km[segment + 1]).second,
                far);
        } else {
            black_bodies(nodes,
                         pressure_and_temperature_at(model.profile, line.height_km[segment]).second,
                         near);
            far = near;
        }
        add_emission(near, far, depth, depth_after, spectrum.transmittance, after,
                     spectrum.radiance);
        near.swap(far);
        depth.swap(depth_after);
        spectrum.transmittance.swap(after);
        at_end(segment, spectrum);
    }
    return spectrum;
}

std::vector<double> values_per_node(const Band& band, std::span<const double> per_bin) {
    assert(per_bin.size() == bin_count());
    std::vector<double> values;
    values.reserve(band.node_um.size());
    for (const double um : band.node_um) values.push_back(per_bin[bin_of(um)]);
    return values;
}

}  // namespace

void check(const Atmosphere& atmosphere) {
    if (const auto* model = std::get_if<BandModel>(&atmosphere)) check(*model);
}

namespace {

/// Heights of a line's two ends.
std::pair<double, double> ends_of(const SightLine& line) {
    return {line.height_within(0, 0.0), line.height_within(line.size() - 1, 1.0)};
}

NodeSpectrum from_table(BinPath path) {
    return {std::move(path.transmittance), std::move(path.radiance)};
}

}  // namespace

double air_temperature_at(const Atmosphere& atmosphere, double height_km) {
    if (const auto* model = std::get_if<BandModel>(&atmosphere)) {
        return air_at(model->profile, height_km).temperature;
    }
    if (const auto* table = std::get_if<Tabulated>(&atmosphere)) {
        return table_air_temperature(*table, height_km);
    }
    return std::get<Vacuum>(atmosphere).space_temperature;
}

NodeSpectrum path_at_nodes(const Atmosphere& atmosphere, const SightLine& line,
                           std::span<const double> node_um) {
    if (line.size() == 0 || node_um.empty()) return clear(node_um.size());
    if (const auto* table = std::get_if<Tabulated>(&atmosphere)) {
        const auto [from, to] = ends_of(line);
        return from_table(table_path(*table, from, to, line.range_km(), node_um));
    }
    const auto* model = std::get_if<BandModel>(&atmosphere);
    if (model == nullptr) return clear(node_um.size());
    return along(*model, line, node_um, [](std::size_t, const NodeSpectrum&) {});
}

std::vector<NodeSpectrum> paths_at_nodes(const Atmosphere& atmosphere, const SightLine& line,
                                         std::span<const double> node_um) {
    std::vector<NodeSpectrum> paths(line.size(), clear(node_um.size()));
    if (const auto* table = std::get_if<Tabulated>(&atmosphere)) {
        if (line.size() == 0) return paths;
        const double from = ends_of(line).first;
        double range = 0.0;
        for (std::size_t i = 0; i < line.size(); ++i) {
            range += line.length_km[i];
            paths[i] =
                from_table(table_path(*table, from, line.height_within(i, 1.0), range, node_um));
        }
        return paths;
    }
    const auto* model = std::get_if<BandModel>(&atmosphere);
    if (model == nullptr || node_um.empty()) return paths;
    along(*model, line, node_um,
          [&](std::size_t segment, const NodeSpectrum& spectrum) { paths[segment] = spectrum; });
    return paths;
}

namespace {

/// What a line of infinite range sees of a cloudless sky or of the ground.
std::vector<double> clear_sky(const BandModel& model, double height_km, double zenith_deg,
                              std::span<const double> node_um) {
    const bool ground = ends_on_ground(model, height_km, zenith_deg);
    const double behind = ground ? model.profile.temperature.front() : model.space_temperature;
    NodeSpectrum path = path_at_nodes(model, line_of(model, height_km, zenith_deg), node_um);
    for (std::size_t i = 0; i < node_um.size(); ++i) {
        path.radiance[i] += path.transmittance[i] * planck(node_um[i], behind);
    }
    return std::move(path.radiance);
}

/// Distance along a straight line to a height above its start.
double distance_to(double height_km, double zenith_deg, double top_km) {
    const double r = earth_radius_km + height_km, mu = std::cos(radians(zenith_deg));
    const double sphere = earth_radius_km + top_km;
    return std::sqrt((sphere - r) * (sphere + r) + r * r * mu * mu) - r * mu;
}

}  // namespace

bool ends_on_ground(const BandModel& model, double height_km, double zenith_deg) {
    return model.refraction ? meets_ground(model.profile, height_km, zenith_deg)
                            : meets_ground(height_km, zenith_deg);
}

SightLine line_of(const BandModel& model, double height_km, double zenith_deg, double range_km,
                  const Segmentation& segmentation) {
    return model.refraction
               ? refracted_line(model.profile, height_km, zenith_deg, range_km, segmentation)
               : sight_line(height_km, zenith_deg, range_km, segmentation);
}

std::vector<double> sky_at_nodes(const Atmosphere& atmosphere, double height_km, double zenith_deg,
                                 std::span<const double> node_um) {
    if (const auto* table = std::get_if<Tabulated>(&atmosphere)) {
        BinPath path = table_sky(*table, height_km, zenith_deg, node_um);
        for (std::size_t i = 0; i < node_um.size(); ++i) {
            path.radiance[i] +=
                path.transmittance[i] * planck(node_um[i], table_space_temperature(*table));
        }
        return std::move(path.radiance);
    }
    const auto* model = std::get_if<BandModel>(&atmosphere);
    if (model == nullptr) {
        std::vector<double> sky;
        for (const double um : node_um) {
            sky.push_back(planck(um, std::get<Vacuum>(atmosphere).space_temperature));
        }
        return sky;
    }
    std::vector<double> sky = clear_sky(*model, height_km, zenith_deg, node_um);
    const CloudLayer& cloud = model->cloud;
    if (cloud.fraction <= 0.0 || height_km >= cloud.base_km ||
        ends_on_ground(*model, height_km, zenith_deg)) {
        return sky;
    }
    const double temperature = cloud.temperature > 0.0
                                   ? cloud.temperature
                                   : air_at(model->profile, cloud.base_km).temperature;
    const NodeSpectrum below = path_at_nodes(
        *model,
        line_of(*model, height_km, zenith_deg, distance_to(height_km, zenith_deg, cloud.base_km)),
        node_um);
    for (std::size_t i = 0; i < sky.size(); ++i) {
        // What is behind the cloud, as seen from below it, shines through 1 − emissivity of it.
        const double black = below.transmittance[i] * planck(node_um[i], temperature);
        const double behind = sky[i] - below.radiance[i];
        const double covered =
            below.radiance[i] + cloud.emissivity * black + (1.0 - cloud.emissivity) * behind;
        sky[i] += cloud.fraction * (covered - sky[i]);
    }
    return sky;
}

std::vector<double> mean_sky_at_nodes(const Atmosphere& atmosphere, double height_km,
                                      std::span<const double> node_um, int zenith_angles) {
    const Quadrature square_of_cosine = gauss_legendre(zenith_angles, 0.0, 1.0);
    std::vector<double> mean(node_um.size(), 0.0);
    for (std::size_t i = 0; i < square_of_cosine.size(); ++i) {
        const double zenith_deg = degrees(std::acos(std::sqrt(square_of_cosine.node[i])));
        const std::vector<double> sky = sky_at_nodes(atmosphere, height_km, zenith_deg, node_um);
        for (std::size_t n = 0; n < sky.size(); ++n) {
            mean[n] += square_of_cosine.weight[i] * sky[n];
        }
    }
    return mean;
}

std::vector<double> solar_at_nodes(const Atmosphere& atmosphere, double height_km,
                                   double zenith_deg, double distance_au,
                                   std::span<const double> node_um) {
    std::vector<double> irradiance(node_um.size(), 0.0);
    if (const auto* table = std::get_if<Tabulated>(&atmosphere)) {
        if (meets_ground(height_km, zenith_deg)) return irradiance;
        const BinPath path = table_sky(*table, height_km, zenith_deg, node_um);
        for (std::size_t i = 0; i < node_um.size(); ++i) {
            irradiance[i] =
                solar_above_air(node_um[i]) * path.transmittance[i] / (distance_au * distance_au);
        }
        return irradiance;
    }
    const auto* model = std::get_if<BandModel>(&atmosphere);
    if (node_um.empty() || (model != nullptr ? ends_on_ground(*model, height_km, zenith_deg)
                                             : meets_ground(height_km, zenith_deg))) {
        return irradiance;
    }
    const BinRange bins = bins_of(node_um);
    std::vector<double> tau(bins.size(), 1.0);
    double clear = 1.0;
    if (model != nullptr) {
        tau = transmittance(*model, line_of(*model, height_km, zenith_deg), bins);
        if (height_km < model->cloud.base_km) {
            const double mu = std::max(0.02, std::cos(radians(zenith_deg)));
            clear -= model->cloud.fraction * -std::expm1(-model->cloud.optical_depth / mu);
        }
    }
    for (std::size_t i = 0; i < node_um.size(); ++i) {
        irradiance[i] = clear * solar_above_air(node_um[i]) * tau[bin_of(node_um[i]) - bins.first] /
                        (distance_au * distance_au);
    }
    return irradiance;
}

std::span<const double> bin_middles_um() { return band_model_tables().middle_um; }

PathSpectrum path_spectrum(const Atmosphere& atmosphere, const SightLine& line) {
    NodeSpectrum spectrum = path_at_nodes(atmosphere, line, bin_middles_um());
    return {std::move(spectrum.transmittance), std::move(spectrum.radiance)};
}

std::vector<double> sky_radiance(const Atmosphere& atmosphere, double height_km,
                                 double zenith_deg) {
    return sky_at_nodes(atmosphere, height_km, zenith_deg, bin_middles_um());
}

std::vector<double> solar_irradiance(const Atmosphere& atmosphere, double height_km,
                                     double zenith_deg, double distance_au) {
    return solar_at_nodes(atmosphere, height_km, zenith_deg, distance_au, bin_middles_um());
}

double band_sum_nodes(const Band& band, std::span<const double> per_node) {
    assert(per_node.size() == band.weight.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < per_node.size(); ++i) sum += band.weight[i] * per_node[i];
    return sum;
}

double band_sum(const Band& band, std::span<const double> per_bin) {
    return band_sum_nodes(band, values_per_node(band, per_bin));
}

double band_mean_nodes(const Band& band, std::span<const double> per_node) {
    return band_sum_nodes(band, per_node) / band.width_um();
}

double band_mean(const Band& band, std::span<const double> per_bin) {
    return band_sum(band, per_bin) / band.width_um();
}

}  // namespace diurna
