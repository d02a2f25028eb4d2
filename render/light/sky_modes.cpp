#include "render/light/sky_modes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "render/light/lanes.hpp"

namespace diurna {

namespace {

constexpr std::size_t heights = 3, numbers = 1 + uneven_functions;
constexpr double usual_uneven = 0.3;  // what facets have of an uneven function, at most or so
constexpr double least = 1e-5;        // of the sky's light

/// The light of a height and number, sunlight above heat, times √weight.
Eigen::VectorXd column(const Band& band, const IncidentLight& light, std::size_t number) {
    const std::size_t nodes = band.node_um.size();
    Eigen::VectorXd c = Eigen::VectorXd::Zero(Eigen::Index(2 * nodes));
    for (std::size_t part = 0; part < 2; ++part) {
        const Origin origin = part == 0 ? Origin::sunlight : Origin::sky_heat;
        for (std::size_t n = 0; n < nodes; ++n) {
            const double value = number == 0
                                     ? light.sky_from(origin, n)
                                     : usual_uneven * light.uneven_from(number - 1, origin, n);
            c[Eigen::Index(part * nodes + n)] = std::sqrt(band.weight[n]) * value;
        }
    }
    return c;
}

/// What is left in a direction at a height, likewise.
Eigen::VectorXd left_column(const Band& band, const std::vector<double>& left) {
    const std::size_t nodes = band.node_um.size();
    Eigen::VectorXd c = Eigen::VectorXd::Zero(Eigen::Index(2 * nodes));
    for (std::size_t n = 0; n < nodes; ++n) {
        c[Eigen::Index(n)] = std::sqrt(band.weight[n]) * left[n];
    }
    return c;
}

}  // namespace

void SkyModes::of(float sky_view, const UnevenView& uneven, std::span<const float> narrow_view,
                  const std::array<float, 3>& up, float* out) const {
    const bool left = !narrow_view.empty() && narrow.size() > 0;
    const auto rows = std::size_t(share.rows());
    for (std::size_t first = 0; first < rows; first += lane_count) {
        Lane sum = Lane::Zero();
        for (std::size_t h = 0; h < heights; ++h) {
            if (up[h] == 0.0f) continue;
            const float* column = share.data() + h * numbers * rows + first;
            Lane here = sky_view * load(column);
            for (std::size_t k = 0; k < uneven_functions; ++k) {
                here += uneven[k] * load(column + (k + 1) * rows);
            }
            if (left) {
                const float* direction = narrow.data() + h * sky_directions * rows + first;
                Lane more = Lane::Zero();
                for (std::size_t i = 0; i < sky_directions; ++i) {
                    more += narrow_view[i] * load(direction + i * rows);
                }
                here += more;
            }
            sum += up[h] * here;
        }
        for (std::size_t k = first; k < std::min(size(), first + lane_count); ++k) {
            out[k] = sum[Eigen::Index(k - first)];
        }
    }
}

SkyModes sky_modes(const Band& band, const std::array<IncidentLight, 3>& incident) {
    const std::size_t nodes = band.node_um.size();
    Eigen::MatrixXd light(Eigen::Index(2 * nodes), Eigen::Index(heights * numbers));
    for (std::size_t h = 0; h < heights; ++h) {
        for (std::size_t k = 0; k < numbers; ++k) {
            light.col(Eigen::Index(h * numbers + k)) = column(band, incident[h], k);
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(light.transpose() * light);
    const double greatest = parts.eigenvalues().maxCoeff();
    SkyModes modes;
    std::vector<Eigen::Index> kept;
    for (Eigen::Index k = parts.eigenvalues().size(); k-- > 0;) {
        if (greatest > 0.0 && parts.eigenvalues()[k] > least * least * greatest) kept.push_back(k);
    }
    const auto rows = Eigen::Index(rounded_up(kept.size()));
    modes.share.setZero(rows, light.cols());
    const bool left = !incident[0].left_scattered.empty();
    Eigen::MatrixXd left_light(light.rows(), left ? Eigen::Index(heights * sky_directions) : 0);
    for (Eigen::Index i = 0; i < left_light.cols(); ++i) {
        const auto h = std::size_t(i) / sky_directions, at = std::size_t(i) % sky_directions;
        left_light.col(i) = left_column(band, incident[h].left_scattered[at]);
    }
    modes.narrow.setZero(rows, left_light.cols());
    for (const Eigen::Index k : kept) {
        const Eigen::VectorXd way = parts.eigenvectors().col(k), spectrum = light * way;
        const auto row = Eigen::Index(modes.spectrum.size());
        if (left) {
            modes.narrow.row(row) =
                (spectrum.transpose() * left_light / spectrum.squaredNorm()).cast<float>();
        }
        for (Eigen::Index i = 0; i < way.size(); ++i) {
            const double scale = i % Eigen::Index(numbers) == 0 ? 1.0 : 1.0 / usual_uneven;
            modes.share(row, i) = static_cast<float>(scale * way[i]);
        }
        LightByOrigin& of = modes.spectrum.emplace_back();
        for (std::size_t part = 0; part < 2; ++part) {
            auto& values = from(of, part == 0 ? Origin::sunlight : Origin::sky_heat);
            for (std::size_t n = 0; n < nodes; ++n) {
                const double root = std::sqrt(band.weight[n]);
                values.push_back(root > 0.0 ? spectrum[Eigen::Index(part * nodes + n)] / root
                                            : 0.0);
            }
        }
    }
    return modes;
}

}  // namespace diurna
