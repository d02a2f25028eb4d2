#include "scenes/studies/contrast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "render/detection/busy_background.hpp"
#include "scenes/job/run/picture.hpp"
#include "scenes/job/run/sun_on_surfaces.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/studies/contrast_on_line.hpp"
#include "scenes/studies/seen_regions.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double entropy_step = 0.1;  // [K]
constexpr float whole_pixel = 0.999f;

/// Where a target is in a picture, and what is around it.
struct TargetPlace {
    std::vector<float> cover;                      // (pixel)
    std::vector<std::uint8_t> in;                  // (pixel) 1 where it covers anything
    std::vector<std::uint8_t> filled;              // 1 where nothing else is
    std::vector<std::uint8_t> border;              // 1 next to its edge
    std::vector<std::uint8_t> around;              // 1: its background
    int left = 0, top = 0, width = 0, height = 0;  // of its box; 0: it is not seen
};

/// - ring: times the box's sides, at least two pixels
TargetPlace place_of(std::vector<float> cover, const std::vector<std::uint8_t>& any, int width,
                     int height, double ring) {
    const std::size_t size = cover.size();
    TargetPlace place{
        .cover = std::move(cover), .in = {}, .filled = {}, .border = {}, .around = {}};
    place.in.resize(size);
    place.filled.resize(size);
    place.border.assign(size, 0);
    place.around.assign(size, 0);
    int left = width, right = -1, top = height, bottom = -1;
    for (std::size_t p = 0; p < size; ++p) {
        place.in[p] = place.cover[p] > 0.0f ? 1 : 0;
        place.filled[p] = place.cover[p] >= whole_pixel ? 1 : 0;
        if (place.in[p] == 0) continue;
        const int x = static_cast<int>(p) % width, y = static_cast<int>(p) / width;
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
    }
    if (right < 0) return place;
    place.left = left;
    place.top = top;
    place.width = right - left + 1;
    place.height = bottom - top + 1;
    const int wide = std::max(2, static_cast<int>(std::lround(ring * place.width)));
    const int high = std::max(2, static_cast<int>(std::lround(ring * place.height)));
    for (int y = std::max(0, top - high); y <= std::min(height - 1, bottom + high); ++y) {
        for (int x = std::max(0, left - wide); x <= std::min(width - 1, right + wide); ++x) {
            const auto p = static_cast<std::size_t>(y * width + x);
            place.around[p] = any[p] == 0 ? 1 : 0;
            const auto half = [&](int u, int v) {
                return u >= 0 && v >= 0 && u < width && v < height &&
                       place.cover[static_cast<std::size_t>(v * width + u)] >= 0.5f;
            };
            const bool own = half(x, y);
            place.border[p] = own != half(x - 1, y) || own != half(x + 1, y) ||
                                      own != half(x, y - 1) || own != half(x, y + 1)
                                  ? 1
                                  : 0;
        }
    }
    return place;
}

struct Means {
    double difference = none, spread = none, background = none, covered = 0.0;
};

/// A pixel's difference from the background is that of the share which the target covers.
Means means_of(const std::vector<float>& value, const TargetPlace& place) {
    Means means;
    double sum = 0.0, count = 0.0;
    for (std::size_t p = 0; p < value.size(); ++p) {
        if (place.around[p] == 0 || !std::isfinite(value[p])) continue;
        sum += double{value[p]};
        count += 1.0;
    }
    for (const float share : place.cover) means.covered += double{share};
    if (count == 0.0 || !(means.covered > 0.0)) return means;
    means.background = sum / count;
    double above = 0.0, filled = 0.0, filled_sum = 0.0, squares = 0.0;
    for (std::size_t p = 0; p < value.size(); ++p) {
        if (place.in[p] == 0) continue;
        const double own = double{value[p]} - means.background;
        above += own;
        if (place.filled[p] == 0) continue;
        filled += 1.0;
        filled_sum += own;
        squares += own * own;
    }
    means.difference = above / means.covered;
    means.spread = 0.0;
    if (filled > 0.0) {
        const double mean = filled_sum / filled;
        means.spread = std::sqrt(std::max(0.0, squares / filled - mean * mean));
    }
    return means;
}

/// Where its filled pixels' surfaces are: the least range, and their mean height over the sea.
struct Distance {
    double range = none, height = none;
};
Distance distance_of(const View& view, const TargetPlace& place, double sea_level_height) {
    double range = none, sum = 0.0, count = 0.0;
    for (std::size_t p = 0; p < place.in.size(); ++p) {
        if (place.filled[p] == 0) continue;
        for (std::uint32_t s = view.row[p]; s < view.row[p + 1]; ++s) {
            const double own = double{view.range_of(view.sighting[s])};
            if (!(own >= range)) range = own;
            sum += double{view.height_of(view.sighting[s])};
            count += 1.0;
        }
    }
    return {range, count > 0.0 ? sea_level_height + sum / count : none};
}

ContrastRow contrast_row(const Frame& frame, const std::string& band, const TargetPlace& place) {
    const std::vector<float>& kelvin = frame["apparent_temperature." + band].pixel;
    const PlaneView plane{kelvin, frame.width, frame.height};
    ContrastRow row{.when = {}, .band = band};
    const Means means = means_of(kelvin, place);
    row.pixels = means.covered;
    row.difference = means.difference;
    row.spread = means.spread;
    row.background = means.background;
    // (T50) of docs/theory.md
    row.rss = std::hypot(means.difference, means.spread);
    row.clutter_side = 2 * std::max(place.width, place.height);
    row.clutter = place.width > 0 ? cell_clutter(plane, place.in, row.clutter_side).level : none;
    row.signal_to_clutter = std::abs(row.difference) / row.clutter;
    row.edge = mean_gradient(plane, place.border);
    std::vector<std::uint8_t> behind = place.around;
    for (std::size_t p = 0; p < behind.size(); ++p) {
        if (place.border[p] != 0) behind[p] = 0;
    }
    row.background_edge = mean_gradient(plane, behind);
    row.similarity = place.width > 0 ? similar_clutter(plane, place.in, place.left, place.top,
                                                       place.width, place.height)
                                           .level
                                     : none;
    row.entropy = entropy_bits(kelvin, place.filled, entropy_step);
    row.background_entropy = entropy_bits(kelvin, place.around, entropy_step);
    const Means light = means_of(frame["radiance." + band].pixel, place);
    row.radiance = light.difference;
    row.weber = light.difference / light.background;
    return row;
}

/// An observer's pictures, cast once while it and all else rests.
class Pictures {
 public:
    Pictures(const Stages& stages, std::size_t observer, const std::vector<std::string>& bands,
             int samples, const TemperatureField& field)
        : stages_(stages),
          field_(field),
          sequence_(stages.scene().sequences[observer]),
          input_(stages.scene().scene.observers[observer]) {
        input_.bands = bands;
        input_.samples = samples;
        input_.adaptive.reset();
        input_.cubes.clear();
        input_.terms = false;
        input_.surfaces = 0;
    }

    struct Shot {
        Frame frame;
        std::vector<std::vector<float>> cover;  // (target)(pixel)
        std::vector<Distance> distance;         // (target)
        std::vector<TargetPlace> place;
    };

    Shot take(std::size_t k, const ContrastInput& asked) {
        const Instant when = sequence_.frame[k];
        const Movement& movement = stages_.scene().movement;
        if (!movement.none() && movement.is_under_way(when)) {
            throw InputError(
                asked.where,
                fmt::format("an object moves at {}, expected pictures at instants when all objects "
                            "are at rest",
                            format_local(when, stages_.scene().scene.time.utc_offset)));
        }
        const SceneStage stage = stages_.at(movement.none() ? 0 : movement.stage_of(when));
        if (!series_ || sequence_.goes || !movement.none()) {
            pose_ = sequence_.at(k);
            series_.emplace(
                cast_series(stage.prepared, input_, pose_, sequence_.frame, stage.views, field_));
            view_ = first_seen(stage.prepared, *series_);
        }
        Shot shot{.frame = picture_at(stage.prepared, *series_, stage.views, field_, when).frame,
                  .cover = {},
                  .distance = {},
                  .place = {}};
        std::vector<std::uint8_t> any(view_.pixels(), 0);
        for (const RegionInput& target : asked.targets) {
            shot.cover.push_back(region_cover(view_, stage.prepared, target));
            for (std::size_t p = 0; p < any.size(); ++p) any[p] |= shot.cover.back()[p] > 0.0f;
        }
        for (std::vector<float>& cover : shot.cover) {
            shot.place.push_back(
                place_of(std::move(cover), any, shot.frame.width, shot.frame.height, asked.ring));
            shot.distance.push_back(
                distance_of(view_, shot.place.back(), stage.prepared.world.sea_level_height));
        }
        return shot;
    }

 private:
    const Stages& stages_;
    const TemperatureField& field_;
    const Sequence& sequence_;
    ObserverInput input_;
    Observer pose_;
    std::optional<Series> series_;
    View view_;  // of it, what is seen first
};

/// Through the air that there is from each range on the line from the target to its observer.
std::vector<double> at_ranges(const Prepared& prepared, const ContrastInput& input,
                              const ContrastRow& row) {
    const std::size_t o = input.observers[row.observer];
    const Sequence& sequence = prepared.sequences[o];
    const auto at = std::find(sequence.frame.begin(), sequence.frame.end(), row.when);
    const Observer& eye = sequence.at(static_cast<std::size_t>(at - sequence.frame.begin()));
    if (input.ranges.empty() || !(row.range > 0.0)) return {};
    const Atmosphere air = light_at(prepared, row.when).air;
    const Band band = named_band(prepared.scene.bands, row.band, bin_edges_um());
    const double rise = (height_above_sea(prepared.world, eye.position) - row.height) / row.range;
    const SunPosition sun = sun_over(prepared, row.when);
    const LineOfContrast line{
        .target_height = row.height,
        .elevation_deg = degrees(std::asin(std::clamp(rise, -1.0, 1.0))),
        .sun = {.zenith_deg = 90.0 - sun.elevation_deg, .distance_au = sun.distance_au},
        .azimuth_from_sun_deg = eye.azimuth_deg - sun.azimuth_deg};
    const SeenContrast seen{.range = row.range,
                            .target = row.background + row.difference,
                            .background = row.background,
                            .spread = row.spread};
    const ContrastOnLine contrast(air, band, line, seen);
    std::vector<double> found;
    for (const double range : input.ranges) found.push_back(contrast(range));
    return found;
}

/// Counts the rows in which the target is hidden, too.
ContrastSummary summary_of(ContrastReport& report, const ContrastInput& input, std::size_t target,
                           std::size_t band, std::size_t observer) {
    const std::size_t absent = report.row.size();
    ContrastSummary summary{.target = target,
                            .band = band,
                            .observer = observer,
                            .highest = absent,
                            .lowest = absent,
                            .at_range = {}};
    double seen = 0.0, all = 0.0;
    for (std::size_t r = 0; r < report.row.size(); ++r) {
        const ContrastRow& row = report.row[r];
        if (row.target != target || row.observer != observer || row.band != input.bands[band]) {
            continue;
        }
        if (std::isnan(row.rss)) {
            ++report.hidden;
            continue;
        }
        all += 1.0;
        seen += row.rss > input.threshold ? 1.0 : 0.0;
        if (summary.lowest == absent || row.rss < report.row[summary.lowest].rss) {
            summary.lowest = r;
        }
        if (summary.highest == absent || row.rss > report.row[summary.highest].rss) {
            summary.highest = r;
        }
    }
    summary.share = all > 0.0 ? seen / all : none;
    return summary;
}

/// Renders the pictures of the highest contrasts again, with half the samples.
void add_sampling_changes(const Stages& stages, const ContrastInput& input,
                          const TemperatureField& field, ContrastReport& report) {
    const Prepared& prepared = stages.scene();
    for (std::size_t o = 0; o < input.observers.size(); ++o) {
        const std::size_t observer = input.observers[o];
        const std::vector<Instant>& frames = prepared.sequences[observer].frame;
        std::map<std::size_t, std::vector<ContrastSummary*>> of_frame;
        for (ContrastSummary& one : report.summary) {
            if (one.observer != o || one.highest == report.row.size()) continue;
            const Instant when = report.row[one.highest].when;
            const auto k = std::find(frames.begin(), frames.end(), when) - frames.begin();
            of_frame[static_cast<std::size_t>(k)].push_back(&one);
        }
        const int samples = std::max(1, prepared.scene.observers[observer].samples / 2);
        Pictures fewer(stages, observer, input.bands, samples, field);
        for (const auto& [k, summaries] : of_frame) {
            const Pictures::Shot shot = fewer.take(k, input);
            for (ContrastSummary* one : summaries) {
                const ContrastRow again =
                    contrast_row(shot.frame, input.bands[one->band], shot.place[one->target]);
                one->sampling_change = std::abs(again.rss - report.row[one->highest].rss);
            }
        }
    }
}

}  // namespace

ContrastReport contrast_of(const Stages& stages, const ContrastInput& input,
                           const TemperatureField& field, Progress& progress) {
    const Prepared& prepared = stages.scene();
    const std::size_t bands = input.bands.size(), targets = input.targets.size();
    ContrastReport report;
    std::vector<std::vector<ContrastRow>> by_target(targets);
    progress.stage(StageId::named, "contrast of " + input.name);
    for (std::size_t o = 0; o < input.observers.size(); ++o) {
        const std::size_t observer = input.observers[o];
        const int samples = prepared.scene.observers[observer].samples;
        Pictures pictures(stages, observer, input.bands, samples, field);
        const std::vector<Instant>& frames = prepared.sequences[observer].frame;
        for (std::size_t k = 0; k < frames.size(); ++k) {
            const Pictures::Shot shot = pictures.take(k, input);
            std::vector<ContrastRow> rows(targets * bands);
            for_each_index(
                rows.size(),
                [&](std::size_t i) {
                    ContrastRow row =
                        contrast_row(shot.frame, input.bands[i % bands], shot.place[i / bands]);
                    row.target = i / bands;
                    row.observer = o;
                    row.when = frames[k];
                    row.range = shot.distance[i / bands].range;
                    row.height = shot.distance[i / bands].height;
                    rows[i] = std::move(row);
                },
                1);
            for (ContrastRow& row : rows) by_target[row.target].push_back(std::move(row));
            progress.done((double(o) + double(k + 1) / double(frames.size())) /
                          double(input.observers.size()));
        }
    }
    for (std::vector<ContrastRow>& rows : by_target) {
        for (ContrastRow& row : rows) report.row.push_back(std::move(row));
    }
    for (std::size_t t = 0; t < targets; ++t) {
        for (std::size_t b = 0; b < bands; ++b) {
            for (std::size_t o = 0; o < input.observers.size(); ++o) {
                report.summary.push_back(summary_of(report, input, t, b, o));
            }
        }
    }
    add_sampling_changes(stages, input, field, report);
    for (ContrastSummary& one : report.summary) {
        if (one.highest == report.row.size()) continue;
        one.at_range = at_ranges(prepared, input, report.row[one.highest]);
    }
    return report;
}

}  // namespace diurna
