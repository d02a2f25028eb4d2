#include "render/view.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "materials/error.hpp"
#include "materials/sight_line.hpp"
#include "materials/units.hpp"
#include "terrain/parallel.hpp"

namespace diurna {

namespace {

/// 32 bits that depend on the three given numbers alone: SplitMix64's finaliser for seed and pixel,
/// then a 32-bit finaliser ("lowbias32", C. Wellons) for the sample, cheap in vector code.
std::uint32_t pixel_hash(std::uint64_t seed, std::uint64_t pixel) {
    std::uint64_t x = seed * 0x9E3779B97F4A7C15u + pixel * 0xD1B54A32D192ED03u;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return static_cast<std::uint32_t>((x ^ (x >> 31)) >> 16);
}
inline std::uint32_t sample_hash(std::uint32_t pixel, std::uint32_t sample) {
    std::uint32_t x = pixel ^ (sample * 0x9E3779B9u);
    x = (x ^ (x >> 16)) * 0x7FEB352Du;
    x = (x ^ (x >> 15)) * 0x846CA68Bu;
    return x ^ (x >> 16);
}

/// Columns and rows of the grid that has one cell a sample: as square as the number allows.
std::array<int, 2> strata(int samples) {
    int rows = static_cast<int>(std::sqrt(double(samples)));
    while (samples % rows != 0) --rows;
    return {samples / rows, rows};
}

constexpr int tile = 32;
constexpr std::size_t lanes = 16;

/// What one tile of pixels sees; targets are facet ids until all tiles are known.
struct Tile {
    std::vector<Sighting> sighting;
    std::vector<std::uint32_t> count;  // (pixel of the tile)
};

/// A sample's weight in a pixel, so that parts of it are whole numbers.
constexpr std::uint32_t one_sample = 1u << 16;

/// The samples of a pixel that hit one facet.
struct Share {
    std::uint32_t facet, count;  // in parts of one_sample
    double range, height;        // sums, by part
};

/// The facets a pixel sees: few, so that looking through them beats sorting its samples. Sums are
/// in the order of the samples.
class Shares {
 public:
    void clear() { size_ = 0; }
    void add(std::uint32_t facet, float range, float height, std::uint32_t part = one_sample) {
        // Neighbouring samples mostly hit the facet of the one before.
        std::size_t k = last_;
        if (k >= size_ || share_[k].facet != facet) {
            for (k = 0; k < size_ && share_[k].facet != facet;) ++k;
            if (k == size_) {
                if (size_ == share_.size()) share_.resize(2 * size_);
                share_[size_++] = {facet, 0, 0.0, 0.0};
            }
            last_ = k;
        }
        Share& share = share_[k];
        share.count += part;
        share.range += double{range} * part;
        share.height += double{height} * part;
    }
    /// Adds the sightings of the pixel, by ascending facet.
    void gather(float weight, Tile& out) {
        for (std::size_t k = 1; k < size_; ++k) {
            const Share share = share_[k];
            std::size_t at = k;
            for (; at > 0 && share_[at - 1].facet > share.facet; --at) share_[at] = share_[at - 1];
            share_[at] = share;
        }
        for (std::size_t k = 0; k < size_; ++k) {
            const Share& share = share_[k];
            const double n = double(share.count);
            out.sighting.push_back({.target = share.facet,
                                    .weight = static_cast<float>(n / one_sample) * weight,
                                    .deeper = static_cast<float>(share.range / n),
                                    .higher = static_cast<float>(share.height / n)});
        }
        out.count.push_back(static_cast<std::uint32_t>(size_));
    }

 private:
    std::vector<Share> share_ = std::vector<Share>(16);
    std::size_t size_ = 0, last_ = 0;
};

/// Part of a facet that a sighting belongs to: 1/128 of an octave of range, 16 m of height.
std::uint64_t part_of(const Sighting& s) {
    const auto bits = std::bit_cast<std::uint32_t>(s.deeper);
    const auto step = static_cast<std::uint32_t>(std::floor(s.higher / 16.0f) + 65536.0f);
    return std::uint64_t{bits >> 16} << 32 | step;
}

struct Extent {
    float near = 1e30f, far = 0.0f, low = 1e30f, high = -1e30f;
    bool seen() const { return far > 0.0f || near < 1e30f; }
    bool narrow() const { return far <= near * (1.0f + 1.0f / 128.0f) && high - low <= 16.0f; }
};

/// Sightings in the order of pixels, from tiles.
void join(const std::vector<Tile>& tiles, int columns, View& view) {
    const auto width = static_cast<std::size_t>(view.width);
    const auto height = static_cast<std::size_t>(view.height);
    std::vector<std::uint32_t> begin(view.pixels());
    view.row.assign(view.pixels() + 1, 0);
    const auto each_pixel = [&](std::size_t t, const auto& body) {
        const std::size_t x0 = (t % std::size_t(columns)) * tile,
                          y0 = t / std::size_t(columns) * tile;
        std::size_t k = 0;
        for (std::size_t y = y0; y < std::min(height, y0 + tile); ++y) {
            for (std::size_t x = x0; x < std::min(width, x0 + tile); ++x) body(y * width + x, k++);
        }
    };
    for_each_index(
        tiles.size(),
        [&](std::size_t t) {
            std::uint32_t at = 0;
            each_pixel(t, [&](std::size_t pixel, std::size_t k) {
                begin[pixel] = at;
                at += view.row[pixel + 1] = tiles[t].count[k];
            });
        },
        1);
    for (std::size_t p = 0; p < view.pixels(); ++p) view.row[p + 1] += view.row[p];
    view.sighting.resize(view.row.back());
    for_each_index(
        tiles.size(),
        [&](std::size_t t) {
            each_pixel(t, [&](std::size_t pixel, std::size_t) {
                const std::uint32_t count = view.row[pixel + 1] - view.row[pixel];
                std::copy_n(tiles[t].sighting.begin() + begin[pixel], count,
                            view.sighting.begin() + view.row[pixel]);
            });
        },
        1);
}

/// Names the targets: facets seen and parts of facets that reach deep, ascending. Until then
/// sightings hold whole ranges and heights.
void name_targets(std::size_t facet_count, View& view) {
    std::vector<Extent> extent(facet_count);
    for (const Sighting& s : view.sighting) {
        Extent& e = extent[s.target];
        e.near = std::min(e.near, s.deeper);
        e.far = std::max(e.far, s.deeper);
        e.low = std::min(e.low, s.higher);
        e.high = std::max(e.high, s.higher);
    }
    std::vector<std::pair<std::uint32_t, std::uint64_t>> parts;  // (facet, part) of deep facets
    for (const Sighting& s : view.sighting) {
        if (!extent[s.target].narrow()) parts.emplace_back(s.target, part_of(s));
    }
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());

    std::vector<std::uint32_t> first(facet_count), first_part(facet_count);
    std::size_t part = 0;
    for (std::size_t f = 0; f < facet_count; ++f) {
        if (!extent[f].seen()) continue;
        first[f] = static_cast<std::uint32_t>(view.facet.size());
        first_part[f] = static_cast<std::uint32_t>(part);
        if (extent[f].narrow()) {
            view.facet.push_back(FacetId{static_cast<std::uint32_t>(f)});
        }
        for (; part < parts.size() && parts[part].first == f; ++part) {
            view.facet.push_back(FacetId{static_cast<std::uint32_t>(f)});
        }
    }
    std::vector<double> weight(view.facet.size(), 0.0), range(weight), height(weight);
    for (Sighting& s : view.sighting) {
        const std::uint32_t f = s.target;
        s.target = first[f];
        if (!extent[f].narrow()) {
            const auto at = std::lower_bound(parts.begin() + first_part[f], parts.end(),
                                             std::pair{f, part_of(s)});
            s.target += static_cast<std::uint32_t>(at - parts.begin()) - first_part[f];
        }
        weight[s.target] += double{s.weight};
        range[s.target] += double{s.weight} * double{s.deeper};
        height[s.target] += double{s.weight} * double{s.higher};
    }
    view.range.resize(view.facet.size());
    view.target_height.resize(view.facet.size());
    for (std::size_t t = 0; t < view.facet.size(); ++t) {
        view.range[t] = static_cast<float>(range[t] / weight[t]);
        view.target_height[t] = static_cast<float>(height[t] / weight[t]);
    }
    for (Sighting& s : view.sighting) {
        s.deeper -= view.range[s.target];
        s.higher -= view.target_height[s.target];
    }
}

/// Azimuths of sky, cube roots and extents: what every frame would otherwise
/// work out anew.
void finish(const Observer& observer, const PixelRays& eye, View& view) {
    view.range_root.resize(view.range.size());
    for_each_index(view.range.size(), [&](std::size_t t) {
        view.range_root[t] = static_cast<float>(std::cbrt(double{view.range[t]}));
    });
    ViewExtent& extent = view.extent;
    if (!view.range.empty()) {
        const auto [near, far] = std::minmax_element(view.range.begin(), view.range.end());
        const auto [low, high] =
            std::minmax_element(view.target_height.begin(), view.target_height.end());
        extent = {.near = *near, .far = *far, .low = *low, .high = *high};
    }
    view.sky_azimuth_deg.assign(view.pixels(), 0.0f);
    const auto width = static_cast<std::size_t>(view.width);
    for_each_index(view.pixels(), [&](std::size_t p) {
        if (!(view.sky[p] > 0.0f)) return;
        const Eigen::Vector3d to = eye.towards(double(p % width) + 0.5, double(p / width) + 0.5);
        view.sky_azimuth_deg[p] = static_cast<float>(
            std::remainder(degrees(std::atan2(to.x(), to.y())) - observer.azimuth_deg, 360.0));
    });
    const auto include = [&](std::array<float, 2>& range, float value) {
        if (extent.sky_pixels == 0) range = {value, value};
        range = {std::min(range[0], value), std::max(range[1], value)};
    };
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        if (!(view.sky[p] > 0.0f)) continue;
        include(extent.sky_zenith_deg, view.sky_zenith_deg[p]);
        include(extent.sky_azimuth_deg, view.sky_azimuth_deg[p]);
        ++extent.sky_pixels;
    }
}

/// Zenith angle [deg] of a unit vector's upward part.
double zenith_of(float up) { return degrees(std::acos(std::clamp(double{up}, -1.0, 1.0))); }

}  // namespace

double level_height(const Eigen::Vector3d& place) {
    return place.z() + place.head<2>().squaredNorm() / (2e3 * earth_radius_km);
}

namespace {

/// Rays side by side from `start` beside the fan's origin; `level`: heights of what they meet.
void closest_parallel(const RayScene& scene, const Fan& fan,
                      const std::array<Eigen::Vector3f, lanes>& start, FanHits& hits,
                      std::array<float, lanes>& level) {
    std::array<Ray, lanes> rays;
    std::array<Hit, lanes> found;
    for (std::size_t s = 0; s < lanes; ++s) {
        rays[s].origin = fan.origin + start[s];
        rays[s].direction = {fan.x[s], fan.y[s], fan.z[s]};
    }
    scene.closest(rays, found);
    for (std::size_t s = 0; s < lanes; ++s) {
        hits.facet[s] = static_cast<std::uint32_t>(index(found[s].facet));
        hits.range[s] = found[s].range;
        const Eigen::Vector3f at = rays[s].origin + found[s].range * rays[s].direction;
        level[s] = static_cast<float>(level_height(at.cast<double>()));
    }
}

}  // namespace

double sample_angle(const Observer& observer, int samples) {
    const double root = std::sqrt(double(samples));
    if (observer.projection == Projection::orthographic) {
        return observer.picture_width / observer.width / root;
    }
    const PixelRays eye = pixel_rays(observer);
    const double column = 0.5 * observer.width, row = 0.5 * observer.height;
    return (eye.towards(column + 1.0, row) - eye.towards(column, row)).norm() / root;
}

Blend blend_at(const Patchwork& patchwork, FacetId facet, const Observer& observer,
               double sample_angle, const Eigen::Vector3d& from, const Eigen::Vector3d& towards,
               double range) {
    if (patchwork.patch[index(facet)].levels < 2) return {facet, facet};
    const double across =
        std::abs(patchwork.facets.normal[index(facet)].cast<double>().dot(towards));
    const double apart =
        observer.projection == Projection::orthographic ? sample_angle : sample_angle * range;
    return patchwork.at(facet, from + range * towards, apart / std::sqrt(std::max(0.01, across)));
}

View cast_view(const RayScene& scene, const FacetSet& facets, const Observer& observer,
               const ViewOptions& options) {
    check_observer(observer);
    if (options.samples < 1 || options.samples > 4096) {
        throw InputError("observer " + observer.name, "samples a pixel must be 1 to 4096");
    }
    const auto width = static_cast<std::size_t>(observer.width);
    const auto height = static_cast<std::size_t>(observer.height);
    const auto samples = static_cast<std::size_t>(options.samples);
    const auto [columns, rows] = strata(options.samples);
    const PixelRays eye = pixel_rays(observer);
    const Eigen::Vector3f origin = observer.position.cast<float>();
    const float share = 1.0f / static_cast<float>(samples);
    constexpr std::uint32_t nothing = index(no_facet);

    View view;
    view.width = observer.width;
    view.height = observer.height;
    view.observer_height = level_height(observer.position);
    view.sky.assign(width * height, 0.0f);
    view.sky_zenith_deg.assign(width * height, 0.0f);
    view.centre.assign(width * height, no_facet);
    view.centre_range.assign(width * height, std::numeric_limits<float>::quiet_NaN());
    view.rays = options.asked.empty() ? width * height * (samples + 1)
                                      : samples * static_cast<std::size_t>(std::count_if(
                                                      options.asked.begin(), options.asked.end(),
                                                      [](std::uint8_t one) { return one != 0; }));

    const Patchwork* const textured =
        options.patchwork != nullptr && !options.patchwork->empty() ? options.patchwork : nullptr;
    if (textured) view.centre_blend.assign(width * height, {no_facet, no_facet});
    const double angle = sample_angle(observer, options.samples);
    const auto blend = [&](FacetId facet, const Eigen::Vector3f& from,
                           const Eigen::Vector3f& towards, float range) {
        return blend_at(*textured, facet, observer, angle, from.cast<double>(),
                        towards.cast<double>(), double{range});
    };

    // Where in the pixel each sample's cell begins; lanes beyond the last repeat the first.
    const std::size_t packets = (samples + lanes - 1) / lanes;
    std::vector<float> cell_right(packets * lanes), cell_down(packets * lanes);
    for (std::size_t s = 0; s < cell_right.size(); ++s) {
        const auto cell = static_cast<int>(s < samples ? s : 0);
        cell_right[s] = static_cast<float>(cell % columns) / static_cast<float>(columns);
        cell_down[s] = static_cast<float>(cell / columns) / static_cast<float>(rows);
    }
    const float scale_right = 0x1p-16f / static_cast<float>(columns);
    const float scale_down = 0x1p-16f / static_cast<float>(rows);

    const int tile_columns = (observer.width + tile - 1) / tile;
    const int tile_rows = (observer.height + tile - 1) / tile;
    std::vector<Tile> tiles(std::size_t(tile_columns) * std::size_t(tile_rows));

    const auto cast_centres = [&](std::size_t x0, std::size_t x1, std::size_t y0, std::size_t y1) {
        std::vector<Ray> rays;
        for (std::size_t y = y0; y < y1; y += 4) {
            for (std::size_t x = x0; x < x1; x += 4) {
                for (std::size_t k = 0; k < lanes; ++k) {
                    const double right = double(std::min(x + k % 4, x1 - 1)) + 0.5;
                    const double down = double(std::min(y + k / 4, y1 - 1)) + 0.5;
                    rays.push_back({.origin = origin + eye.start(right, down).cast<float>(),
                                    .direction = eye.towards(right, down).cast<float>()});
                }
            }
        }
        std::vector<Hit> hits(rays.size());
        scene.closest(rays, hits);
        std::size_t at = 0;
        for (std::size_t y = y0; y < y1; y += 4) {
            for (std::size_t x = x0; x < x1; x += 4, at += lanes) {
                for (std::size_t k = 0; k < lanes; ++k) {
                    const Hit& hit = hits[at + k];
                    if (x + k % 4 >= x1 || y + k / 4 >= y1 || hit.facet == no_facet) continue;
                    const std::size_t pixel = (y + k / 4) * width + x + k % 4;
                    view.centre[pixel] = hit.facet;
                    view.centre_range[pixel] = hit.range;
                    if (textured == nullptr) continue;
                    const Ray& ray = rays[at + k];
                    view.centre_blend[pixel] =
                        blend(hit.facet, ray.origin, ray.direction, hit.range);
                }
            }
        }
    };
    const auto aim = [&](std::size_t x, std::size_t y, std::uint32_t hash, std::size_t packet,
                         Fan& fan, std::array<Eigen::Vector3f, lanes>& start) {
        alignas(64) std::array<float, lanes> right, down;
        const float* from_right = &cell_right[packet * lanes];
        const float* from_down = &cell_down[packet * lanes];
#pragma omp simd
        for (std::size_t s = 0; s < lanes; ++s) {
            const std::uint32_t bits =
                sample_hash(hash, static_cast<std::uint32_t>(packet * lanes + s));
            right[s] = from_right[s] + scale_right * (static_cast<float>(bits >> 16) + 0.5f);
            down[s] = from_down[s] + scale_down * (static_cast<float>(bits & 0xFFFFu) + 0.5f);
        }
        if (!eye.flat) {
            for (std::size_t s = 0; s < lanes; ++s) {
                const Eigen::Vector3f d =
                    eye.towards(double(x) + double{right[s]}, double(y) + double{down[s]})
                        .cast<float>();
                fan.x[s] = d.x(), fan.y[s] = d.y(), fan.z[s] = d.z();
                start[s] = eye.start(double(x) + double{right[s]}, double(y) + double{down[s]})
                               .cast<float>();
            }
            return;
        }
        const Eigen::Vector3f from =
            (eye.corner + double(x) * eye.column + double(y) * eye.row).cast<float>();
        const Eigen::Vector3f a = eye.column.cast<float>(), b = eye.row.cast<float>();
        const float fx = from.x(), fy = from.y(), fz = from.z(), ax = a.x(), ay = a.y(), az = a.z(),
                    bx = b.x(), by = b.y(), bz = b.z();
#pragma omp simd
        for (std::size_t s = 0; s < lanes; ++s) {
            const float dx = fx + right[s] * ax + down[s] * bx;
            const float dy = fy + right[s] * ay + down[s] * by;
            const float dz = fz + right[s] * az + down[s] * bz;
            const float scale = 1.0f / std::sqrt(dx * dx + dy * dy + dz * dz);
            fan.x[s] = dx * scale;
            fan.y[s] = dy * scale;
            fan.z[s] = dz * scale;
        }
    };
    const auto cast_tile = [&](std::size_t t) {
        const std::size_t x0 = (t % std::size_t(tile_columns)) * tile,
                          y0 = t / std::size_t(tile_columns) * tile;
        const std::size_t x1 = std::min(width, x0 + tile), y1 = std::min(height, y0 + tile);
        Tile& out = tiles[t];
        out.count.reserve(tile * tile);
        out.sighting.reserve(4 * tile * tile);
        if (options.asked.empty()) cast_centres(x0, x1, y0, y1);
        Fan fan;
        fan.origin = origin;
        FanHits hits;
        std::array<Eigen::Vector3f, lanes> start;  // of each ray, where they are parallel
        start.fill(Eigen::Vector3f::Zero());
        Shares shares;
        const float ox = origin.x(), oy = origin.y(), oz = origin.z();
        constexpr auto bend = static_cast<float>(1.0 / (2e3 * earth_radius_km));
        alignas(64) std::array<float, lanes> level;
        for (std::size_t y = y0; y < y1; ++y) {
            for (std::size_t x = x0; x < x1; ++x) {
                const std::size_t pixel = y * width + x;
                if (!options.asked.empty() && options.asked[pixel] == 0) {
                    out.count.push_back(0);
                    continue;
                }
                const std::uint32_t hash = pixel_hash(options.seed, pixel);
                std::size_t solid = 0;
                double zenith = 0.0;
                shares.clear();
                for (std::size_t packet = 0; packet < packets; ++packet) {
                    aim(x, y, hash, packet, fan, start);
                    if (eye.projection == Projection::orthographic) {
                        closest_parallel(scene, fan, start, hits, level);
                    } else {
                        scene.closest(fan, hits);
#pragma omp simd
                        for (std::size_t s = 0; s < lanes; ++s) {
                            const float px = ox + hits.range[s] * fan.x[s];
                            const float py = oy + hits.range[s] * fan.y[s];
                            level[s] = oz + hits.range[s] * fan.z[s] + bend * (px * px + py * py);
                        }
                    }
                    const std::size_t used = std::min(lanes, samples - packet * lanes);
                    for (std::size_t s = 0; s < used; ++s) {
                        if (hits.facet[s] == nothing) {
                            zenith += zenith_of(fan.z[s]);
                        } else {
                            ++solid;
                            if (textured == nullptr) {
                                shares.add(hits.facet[s], hits.range[s], level[s]);
                                continue;
                            }
                            const Blend met = blend(FacetId{hits.facet[s]}, origin + start[s],
                                                    {fan.x[s], fan.y[s], fan.z[s]}, hits.range[s]);
                            const auto part = static_cast<std::uint32_t>(
                                std::lround(met.second_share * float{one_sample}));
                            if (part < one_sample) {
                                shares.add(static_cast<std::uint32_t>(index(met.first)),
                                           hits.range[s], level[s], one_sample - part);
                            }
                            if (part > 0) {
                                shares.add(static_cast<std::uint32_t>(index(met.second)),
                                           hits.range[s], level[s], part);
                            }
                        }
                    }
                }
                const std::size_t open = samples - solid;
                if (open > 0) {
                    view.sky[pixel] = static_cast<float>(open) * share;
                    view.sky_zenith_deg[pixel] = static_cast<float>(zenith / double(open));
                }
                shares.gather(share, out);
            }
        }
    };
    for_each_index(tiles.size(), cast_tile, 1);
    join(tiles, tile_columns, view);
    name_targets(facets.size(), view);
    finish(observer, eye, view);
    return view;
}

}  // namespace diurna
