#include "materials/atmosphere/onward_light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>

#include "materials/atmosphere/band_model_light.hpp"
#include "materials/atmosphere/cloud_on_line.hpp"
#include "materials/base/fast_exp.hpp"
#include "materials/base/quadrature.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

/// Below, air of any warmth is dark beside the rest.
constexpr double no_heat_um = 2.5;
constexpr int zenith_angles = 4;

/// Planck's law, of air no hotter than 1500 K.
std::vector<double> black_body(BinRange bins, double temperature) {
    std::vector<double> black(bins.size());
    const double* const um = bin_middles_um().data() + bins.first;
    for (std::size_t b = 0; b < black.size(); ++b) {
        const double square = um[b] * um[b];
        black[b] =
            first_radiation_um / (square * square * um[b] *
                                  (fast_exp(second_radiation_um / (um[b] * temperature)) - 1.0));
    }
    return black;
}

}  // namespace

OnwardLight::OnwardLight(const Atmosphere& atmosphere, double height_km, double sun_zenith_deg,
                         std::span<const double> node_um, bool sky)
    : atmosphere_(atmosphere), node_um_(node_um.begin(), node_um.end()) {
    const auto* model = std::get_if<BandModel>(&atmosphere);
    if (model == nullptr || node_um.empty()) return;
    const BinRange bins = bins_of(node_um);
    node_bin_ = bin_of_each(node_um);
    for (std::size_t& bin : node_bin_) bin -= bins.first;
    medium_.emplace(*model, bins);
    if (!ends_on_ground(*model, height_km, sun_zenith_deg)) {
        to_sun_ = medium_->none();
        const SightLine line = line_of(*model, height_km, sun_zenith_deg);
        for (std::size_t i = 0; i < line.size(); ++i) medium_->add(line, i, to_sun_);
        medium_->spread(to_sun_);
        sun_depth_.resize(bins.size());
        medium_->depths(to_sun_, sun_depth_);
    }
    if (sky) add_sky(height_km);
}

void OnwardLight::add_sky(double height_km) {
    if (!medium_ || !sky_.empty() || node_um_.back() < no_heat_um) return;
    // ∫ L cosθ dΩ / π = ∫₀¹ 2 L cosθ d(cosθ): closer to the horizon than by the cosine's square.
    const Quadrature cosine = gauss_legendre(zenith_angles, 0.0, 1.0);
    heat_.assign(medium_->bins().size(), 0.0);
    for (std::size_t k = 0; k < cosine.size(); ++k) {
        const double zenith_deg = degrees(std::acos(cosine.node[k]));
        const double weight = 2.0 * cosine.node[k] * cosine.weight[k];
        sky_.push_back(sky_line(height_km, zenith_deg, weight));
        add_heat(sky_.back(), nullptr, heat_);
    }
}

OnwardLight::SkyLine OnwardLight::sky_line(double height_km, double zenith_deg,
                                           double weight) const {
    const BandModel& model = medium_->model();
    const BinRange bins = medium_->bins();
    const SightLine line = line_of(model, height_km, zenith_deg,
                                   std::numeric_limits<double>::infinity(), beam_segmentation);
    SkyLine sky{.weight = weight,
                .met = {medium_->none()},
                .black = {},
                .cloud = 0,
                .behind = black_body(bins, model.space_temperature),
                .cloud_black = {}};
    const bool clouds = model.cloud.fraction > 0.0 && height_km < model.cloud.base_km;
    for (std::size_t edge = 0; edge <= line.size(); ++edge) {
        const double here_km = line.size() > 0 ? line.edge_km[edge] : height_km;
        sky.black.push_back(black_body(bins, air_at(model.profile, here_km).temperature));
        if (edge == 0) continue;
        Amounts met = sky.met.back();
        medium_->add(line, edge - 1, met);
        medium_->spread(met);
        sky.met.push_back(std::move(met));
        if (clouds && sky.cloud == 0 && here_km >= model.cloud.base_km) sky.cloud = edge;
    }
    if (sky.cloud > 0) {
        const double warm = model.cloud.temperature;
        sky.cloud_black = black_body(
            bins, warm > 0.0 ? warm : air_at(model.profile, model.cloud.base_km).temperature);
    }
    return sky;
}

void OnwardLight::add_heat(const SkyLine& line, const Amounts* more,
                           std::vector<double>& sum) const {
    const std::size_t count = sum.size();
    const CloudLayer& cloud = medium_->model().cloud;
    std::vector<double> radiance(count, 0.0), covered(count, 0.0);
    std::array<std::vector<double>, 2> depths, transmittances;  // of odd edges, and of even ones
    for (auto* both : {&depths, &transmittances}) both->fill(std::vector<double>(count));
    for (std::size_t edge = 0; edge < line.met.size(); ++edge) {
        std::vector<double>&depth = depths[edge % 2], &tau = transmittances[edge % 2];
        if (more != nullptr) {
            medium_->depths(line.met[edge], *more, depth);
        } else {
            medium_->depths(line.met[edge], depth);
        }
        tau = depth;
        negative_exponentials(tau);
        if (edge > 0) {
            const std::vector<double>&near = line.black[edge - 1], &far = line.black[edge];
            const std::vector<double>& last = depths[(edge + 1) % 2];
            const std::vector<double>& before = transmittances[(edge + 1) % 2];
            for (std::size_t b = 0; b < count; ++b) {
                // Planck's law linear in optical depth, as along any path (band_model_light.cpp).
                const double x = depth[b] - last[b];
                const double f = (0.5 + 0.06 * x) / (1.0 + x * ((1.0 / 6.0 + 0.12) + 0.06 * x));
                radiance[b] += (near[b] + (far[b] - near[b]) * f) * (before[b] - tau[b]);
            }
        }
        if (line.cloud == 0 || edge != line.cloud) continue;
        for (std::size_t b = 0; b < count; ++b) {
            covered[b] = cloud.emissivity * (radiance[b] + tau[b] * line.cloud_black[b]);
        }
    }
    const std::vector<double>& tau = transmittances[(line.met.size() + 1) % 2];
    for (std::size_t b = 0; b < count; ++b) {
        radiance[b] += tau[b] * line.behind[b];
        if (line.cloud > 0) {
            const double under = covered[b] + (1.0 - cloud.emissivity) * radiance[b];
            radiance[b] += cloud.fraction * (under - radiance[b]);
        }
        sum[b] += line.weight * radiance[b];
    }
}

std::vector<double> OnwardLight::per_node(const std::vector<double>& per_bin) const {
    std::vector<double> values;
    for (const std::size_t bin : node_bin_) values.push_back(per_bin[bin]);
    return values;
}

std::vector<double> OnwardLight::behind_cloud(const SightLine& from_eye,
                                              const std::vector<double>& per_bin) const {
    const std::vector<double> gap = through_clouds(medium_->model(), from_eye, node_um_);
    std::vector<double> values = per_node(per_bin);
    for (std::size_t n = 0; n < values.size(); ++n) values[n] *= gap[n];
    return values;
}

OnwardLight::Direct OnwardLight::direct(const SightLine& from_eye) const {
    if (!medium_) {
        Direct direct{path_at_nodes(atmosphere_, from_eye, node_um_), {}, {}};
        direct.sunlight = direct.path.transmittance;
        return direct;
    }
    Direct direct{{}, {}, {}};
    direct.path = band_model_path(medium_->model(), from_eye, node_um_, &direct.met);
    std::vector<double> sun(medium_->bins().size());
    if (sun_depth_.empty()) {
        medium_->transmittances(direct.met, sun);
    } else {
        medium_->depths(to_sun_, direct.met, sun);
        for (std::size_t b = 0; b < sun.size(); ++b) sun[b] = fast_exp(sun_depth_[b] - sun[b]);
    }
    direct.sunlight = behind_cloud(from_eye, sun);
    return direct;
}

std::vector<double> OnwardLight::sky_heat(const SightLine& from_eye, const Amounts& met,
                                          const std::vector<double>& transmittance) const {
    if (sky_.empty()) return transmittance;
    std::vector<double> heat(medium_->bins().size(), 0.0);
    for (const SkyLine& line : sky_) add_heat(line, &met, heat);
    for (std::size_t b = 0; b < heat.size(); ++b) heat[b] /= std::max(heat_[b], 1e-300);
    return behind_cloud(from_eye, heat);
}

OnwardLight::Way OnwardLight::way(const SightLine& from_eye) const {
    Direct found = direct(from_eye);
    std::vector<double> heat = sky_heat(from_eye, found.met, found.path.transmittance);
    return {std::move(found.path), std::move(found.sunlight), std::move(heat)};
}

}  // namespace diurna
