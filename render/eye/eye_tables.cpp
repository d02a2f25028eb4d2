#include "render/eye/eye_tables.hpp"

#include <algorithm>
#include <array>

#include "materials/base/parallel.hpp"
#include "render/eye/facet_rows.hpp"

namespace diurna {

namespace {

TermSet only(std::size_t term) {
    TermSet terms{};
    terms[term] = true;
    return terms;
}

/// Adds the radiances of further surfaces at the nodes, or of another term of the same ones.
void add_up(std::span<const Eigen::MatrixXd> more, std::vector<Eigen::MatrixXd>& sum) {
    for (std::size_t k = 0; k < more.size(); ++k) sum[k] += more[k];
}

}  // namespace

EyeTables::EyeTables(const PathTable& path, const SceneLight& light, const Options& options) {
    const std::span<const BandLight> bands(light.band);
    const TemperatureExtent& extent = light.state.extent;
    const std::size_t per_band = options.by_term ? term_count : 1;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        rows_.emplace_back(bands[b]);
        for (std::size_t t = 0; t < per_band; ++t) {
            tables_.emplace_back(path, b, bands[b], options.by_term ? only(t) : all_terms);
        }
    }
    // Surfaces as cold and as hot as any, in shade and in the sun.
    std::vector<std::vector<Eigen::MatrixXd>> surfaces(bands.size());
    for (std::size_t b = 0; b < bands.size(); ++b) {
        for (const float t : {extent.coldest, extent.hottest}) {
            const std::vector<float> row =
                rows_[b].standing_for(light.tables, bands[b], b, t, t == extent.hottest);
            auto whole = tables_[b * per_band].radiance_of(row);
            for (std::size_t k = 1; k < per_band; ++k) {
                add_up(tables_[b * per_band + k].radiance_of(row), whole);
            }
            surfaces[b].insert(surfaces[b].end(), whole.begin(), whole.end());
        }
    }
    grid_ = eye_grid(path.grid(), light.input.ground_height_km, bands, surfaces, options.tolerance);
    for (EyeTable& table : tables_) table.refine(grid_);
}

void EyeTables::look(const View& view, const SceneLight& light, std::span<AtEye> out) const {
    for_each_block(view.surface.size(), 2048,
                   [&](std::size_t begin, std::size_t end) { look(view, light, begin, end, out); });
}

/// Of the targets [begin, end).
void EyeTables::look(const View& view, const SceneLight& light, std::size_t begin, std::size_t end,
                     std::span<AtEye> out) const {
    constexpr std::size_t ahead = 12;
    constexpr auto none = ~std::uint32_t{0};
    const LitFacets& lit = light.lit;
    const std::size_t columns = tables_.size(), per_band = columns_of_band();
    FacetRows of_facet(light);
    std::vector<std::vector<float>> row;  // (band)(slot, number) of the facets of a few targets
    for (const EyeRow& r : rows_) row.emplace_back(GridPlaces::most * r.width(), 0.0f);
    std::vector<float*> next(rows_.size());
    GridPlaces places;
    TargetRows facets;
    for (std::size_t t0 = begin; t0 < end; t0 += GridPlaces::most) {
        const std::size_t count = std::min(GridPlaces::most, end - t0);
        find_places(grid_, std::span(view.range).subspan(t0, count),
                    std::span(view.range_root).subspan(t0, count),
                    std::span(view.target_height).subspan(t0, count), places);
        std::uint32_t last = none, slots = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint32_t i = lit.target[t0 + k];
            if (t0 + k + ahead < end) light.radiosity.fetch(lit.target[t0 + k + ahead]);
            if (i != last) {
                last = i;
                for (std::size_t b = 0; b < rows_.size(); ++b) {
                    next[b] = &row[b][slots * rows_[b].width()];
                }
                of_facet.fill(i, next);
                ++slots;
            }
            facets.slot[k] = slots - 1;
            facets.material[k] = lit.material[i];
        }
        for (std::size_t c = 0; c < columns; ++c) {
            tables_[c].look(places, facets, row[c / per_band].data(), count, columns,
                            &out[t0 * columns + c]);
        }
    }
}

void EyeTables::look_at(const View& view, const SceneLight& light,
                        std::span<const std::uint32_t> targets, const Fill& fill,
                        std::span<AtEye> out) const {
    const std::size_t columns = tables_.size(), per_band = columns_of_band();
    for_each_block(targets.size(), GridPlaces::most, [&](std::size_t begin, std::size_t end) {
        std::array<float, GridPlaces::most> range, root, height;
        GridPlaces places;
        TargetRows facets;
        const std::size_t count = end - begin;
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint32_t t = targets[begin + k];
            range[k] = view.range[t];
            root[k] = view.range_root[t];
            height[k] = view.target_height[t];
            facets.slot[k] = static_cast<std::uint32_t>(k);
            facets.material[k] = light.lit.material[light.lit.target[t]];
        }
        find_places(grid_, {range.data(), count}, {root.data(), count}, {height.data(), count},
                    places);
        for (std::size_t b = 0; b < rows_.size(); ++b) {
            const std::size_t width = rows_[b].width();
            std::vector<float> row(count * width, 0.0f);
            for (std::size_t k = 0; k < count; ++k) fill(b, begin + k, &row[k * width]);
            for (std::size_t c = b * per_band; c < (b + 1) * per_band; ++c) {
                tables_[c].look(places, facets, row.data(), count, columns,
                                &out[begin * columns + c]);
            }
        }
    });
}

/// A row is what it is times the sunlit share and what does not change with that.
void EyeTables::look_at_sun(const View& view, const SceneLight& light,
                            std::span<const std::uint32_t> targets, std::span<AtEye> out) const {
    const Eigen::Vector3f to_sun = light.input.to_sun.cast<float>();
    const auto fill = [&](std::size_t b, std::size_t k, float* row) {
        const std::uint32_t lit = light.lit.target[targets[k]];
        const Eigen::Vector3f& normal = light.input.facets.normal[index(light.lit.facet[lit])];
        const float whole = sunlight_on(1.0f, normal.dot(to_sun));
        const std::array<float, 3> up = height_weights(light.lit.height[lit]);
        for (std::size_t h = 0; h < 3; ++h) row[rows_[b].sun() + h] = whole * up[h];
    };
    look_at(view, light, targets, fill, out);
}

void EyeTables::look_at_warmth(const View& view, const SceneLight& light,
                               std::span<const std::uint32_t> targets,
                               std::span<const float> warmer, std::span<AtEye> out) const {
    const RadiosityTables& tables = light.tables;
    std::vector<float> more(targets.size() * tables.lanes);
    for_each_block(targets.size(), 256, [&](std::size_t begin, std::size_t end) {
        std::vector<float> at_mean(tables.lanes);
        for (std::size_t k = begin; k < end; ++k) {
            const float mean = light.state.temperature[light.lit.target[targets[k]]];
            float* const row = &more[k * tables.lanes];
            black_modes(tables, mean, at_mean.data());
            black_modes(tables, mean + warmer[k], row);
            for (std::size_t j = 0; j < tables.lanes; ++j) row[j] -= at_mean[j];
        }
    });
    const auto fill = [&](std::size_t b, std::size_t k, float* row) {
        std::copy_n(&more[k * tables.lanes + tables.first[b]], rows_[b].thermal, row);
    };
    look_at(view, light, targets, fill, out);
}

}  // namespace diurna
