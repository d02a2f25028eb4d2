#include "scenes/job/plan/chosen_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "materials/base/error.hpp"
#include "render/instrument/optics.hpp"
#include "scenes/job/input/bands.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

constexpr const char* option = "--only";
constexpr double day_span = 86400.0;

/// Hours of every day [s], or instants; both ends belong to it.
struct FrameRange {
    std::optional<double> from_of_day{}, to_of_day{};
    Instant from{}, to{};

    bool has(Instant when, double utc_offset) const {
        if (!from_of_day) return when >= from && when <= to;
        const double since = std::chrono::duration<double>(when.time_since_epoch()).count();
        const double at = std::fmod(std::fmod(since + utc_offset, day_span) + day_span, day_span);
        const bool late = at >= *from_of_day, early = at <= *to_of_day;
        return *from_of_day <= *to_of_day ? late && early : late || early;
    }
};

/// "05:00" or "05:00:30" [s]
std::optional<double> hour_of(const std::string& text) {
    int h = 0, m = 0, s = 0, used = 0, more = 0;
    if (std::sscanf(text.c_str(), "%2d:%2d%n", &h, &m, &used) != 2) return std::nullopt;
    if (std::sscanf(text.c_str() + used, ":%2d%n", &s, &more) == 1) used += more;
    if (std::size_t(used) != text.size() || h < 0 || h > 24 || m < 0 || m > 59 || s < 0 || s > 59)
        return std::nullopt;
    return 3600.0 * h + 60.0 * m + s;
}

FrameRange frames_named(const std::string& text) {
    const std::size_t dots = text.find("..");
    const std::string first = text.substr(0, dots);
    const std::string last = dots == std::string::npos ? first : text.substr(dots + 2);
    FrameRange range{.from_of_day = hour_of(first), .to_of_day = hour_of(last)};
    if (range.from_of_day && range.to_of_day) return range;
    try {
        return {.from = parse_instant(first, option), .to = parse_instant(last, option)};
    } catch (const InputError&) {
        throw InputError(option,
                         fmt::format("found 'frames={}', expected hours of the day such as "
                                     "05:00..09:00 or instants such as 2026-07-15T06:00:00-04:00",
                                     text.substr(0, 60)));
    }
}

/// What --only names, by kind.
struct Named {
    std::vector<std::string> observers, bands;
    std::vector<FrameRange> frames;
};

Named named(const std::vector<std::string>& only) {
    Named found;
    for (const std::string& text : only) {
        const std::size_t is = text.find('=');
        const std::string kind = text.substr(0, is),
                          name = text.substr(std::min(is, text.size() - 1) + 1);
        if (kind == "observer") {
            found.observers.push_back(name);
        } else if (kind == "band") {
            found.bands.push_back(name);
        } else if (kind == "frames") {
            found.frames.push_back(frames_named(name));
        } else {
            const std::string kinds[] = {"observer", "band", "frames"};
            refuse_word(option, kind, kinds);
        }
    }
    return found;
}

bool among(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Throws InputError for the first that nothing is called.
void check_names(const char* kind, const std::vector<std::string>& names,
                 const std::vector<std::string>& known) {
    for (const std::string& name : names) {
        if (!among(known, name))
            refuse_word(fmt::format("{} {}={}", option, kind, name), name, known);
    }
}

/// Bands as the scene calls them, for what people write: "8:12", "LWIR".
void spell_bands(const Scene& scene, const std::vector<std::string>& known,
                 std::vector<std::string>& names) {
    for (std::string& name : names) {
        std::string dashed = name;
        std::replace(dashed.begin(), dashed.end(), ':', '-');
        for (const std::string& meant : {band_name(scene.bands, name), dashed}) {
            if (!among(known, name) && among(known, meant)) name = meant;
        }
    }
}

void keep_bands(const std::vector<std::string>& names, ObserverInput& observer) {
    const auto other = [&](const std::string& band) { return !among(names, band); };
    const std::size_t before = observer.bands.size();
    std::erase_if(observer.bands, other);
    std::erase_if(observer.cubes, other);
    std::erase_if(observer.instruments, other);
    if (observer.adaptive && !observer.bands.empty() && observer.bands.size() < before) {
        throw InputError(
            option,
            fmt::format("observer \"{}\" chooses its samples from all of its bands (adaptive)",
                        observer.name),
            "render all bands of an adaptive observer");
    }
    if (observer.bands.empty() && observer.cubes.empty()) observer.frames.clear();
}

/// [s] within which one of its instruments remembers the picture before; 0: none does.
double memory_of(const Scene& scene, const ObserverInput& observer) {
    double longest = 0.0;
    for (const InstrumentInput& input : scene.instruments) {
        if (input.observer != observer.name || !among(observer.instruments, input.band)) continue;
        longest = std::max(longest, forgotten_after * input.instrument.detector.time_constant);
    }
    return longest;
}

/// Throws InputError where a frame that is kept depends on one that is not.
void check_memory(const Scene& scene, const ObserverInput& whole, const ObserverInput& kept) {
    const double memory = memory_of(scene, kept);
    for (std::size_t i = 1; memory > 0.0 && i < whole.frames.size(); ++i) {
        const Instant before = whole.frames[i - 1], now = whole.frames[i];
        const auto has = [&](Instant when) {
            return std::binary_search(kept.frames.begin(), kept.frames.end(), when);
        };
        if (seconds_between(before, now) > memory || !has(now) || has(before)) continue;
        const double offset = scene.time.utc_offset;
        throw InputError(
            option,
            fmt::format("the bolometer of \"{}\" at {} depends on its picture at {} (thermal lag)",
                        whole.name, format_local(now, offset), format_local(before, offset)),
            "add that picture to the choice");
    }
}

/// Keeps a shard's frames of all; what remembers stays together.
void keep_shard(const Scene& scene, const Shard& shard, std::vector<ObserverInput>& observers) {
    std::vector<std::pair<std::size_t, std::vector<Instant>>> units;  // of an observer
    for (std::size_t o = 0; o < observers.size(); ++o) {
        const double memory = memory_of(scene, observers[o]);
        for (const Instant when : observers[o].frames) {
            const bool follows = memory > 0.0 && !units.empty() && units.back().first == o &&
                                 seconds_between(units.back().second.back(), when) <= memory;
            if (!follows) units.push_back({o, {}});
            units.back().second.push_back(when);
        }
        observers[o].frames.clear();
    }
    const ShardRange part = range_of(shard, units.size());
    for (std::size_t u = part.first; u < part.last; ++u) {
        auto& frames = observers[units[u].first].frames;
        frames.insert(frames.end(), units[u].second.begin(), units[u].second.end());
    }
}

}  // namespace

std::vector<std::string> in_words(const PictureChoice& choice) {
    std::vector<std::string> texts = choice.only;
    if (!choice.shard.all()) {
        texts.push_back(fmt::format("shard {}/{}", choice.shard.number, choice.shard.count));
    }
    return texts;
}

std::vector<ObserverInput> chosen_pictures(const Scene& scene, const PictureChoice& choice) {
    Named wanted = named(choice.only);
    std::vector<std::string> observers, bands;
    for (const ObserverInput& observer : scene.observers) {
        observers.push_back(observer.name);
        for (const auto& names : {observer.bands, observer.cubes}) {
            for (const std::string& name : names) {
                if (!among(bands, name)) bands.push_back(name);
            }
        }
    }
    spell_bands(scene, bands, wanted.bands);
    check_names("observer", wanted.observers, observers);
    check_names("band", wanted.bands, bands);
    std::vector<ObserverInput> chosen = scene.observers;
    std::size_t left = 0;
    for (std::size_t o = 0; o < chosen.size(); ++o) {
        ObserverInput& observer = chosen[o];
        if (!wanted.observers.empty() && !among(wanted.observers, observer.name))
            observer.frames.clear();
        if (!wanted.bands.empty()) keep_bands(wanted.bands, observer);
        if (!wanted.frames.empty()) {
            std::erase_if(observer.frames, [&](Instant when) {
                return std::none_of(wanted.frames.begin(), wanted.frames.end(),
                                    [&](const FrameRange& range) {
                                        return range.has(when, scene.time.utc_offset);
                                    });
            });
        }
        check_memory(scene, scene.observers[o], observer);
        left += observer.frames.size();
    }
    if (left == 0 && !choice.only.empty()) {
        throw InputError(
            option,
            fmt::format("no picture of the scene matches {}", fmt::join(choice.only, " and ")),
            "diurna plan lists the instants of the pictures");
    }
    if (!choice.shard.all()) keep_shard(scene, choice.shard, chosen);
    return chosen;
}

}  // namespace diurna
