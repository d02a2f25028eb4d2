#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "materials/matter/library.hpp"
#include "materials/matter/read_library.hpp"
#include "tests/support/measured_days.hpp"
#include "tests/support/shared_data.hpp"
#include "thermal/point/point_job.hpp"
#include "thermal/point/run_column.hpp"

using namespace diurna;

namespace {

struct Score {
    double rms = 0.0, bias = 0.0, worst = 0.0;
    std::size_t count = 0;
};

double between(const PointResult& result, const PointJob& job, Instant when) {
    const double place = seconds_between(job.start, when) / job.step;
    const auto i = static_cast<std::size_t>(std::clamp(place, 0.0, double(result.row.size() - 2)));
    const double share = std::clamp(place - double(i), 0.0, 1.0);
    return result.row[i].surface_temperature +
           share * (result.row[i + 1].surface_temperature - result.row[i].surface_temperature);
}

Score run(const char* name, const measured::Series& series, const std::string& material,
          double cadence) {
    static const MaterialLibrary library = default_material_library();
    const PointJob job = measured::job_of(series, library[library.find(material)].thermal, cadence);
    const PointResult result = run_column(job);
    CHECK(result.limited == 0);
    CHECK(result.worst_energy_closure < 1e-8);
    Score score, day, night;
    std::map<int, Score> month;
    const auto add = [](Score& s, double e) {
        s.rms += e * e;
        s.bias += e;
        s.worst = std::max(s.worst, std::abs(e));
        ++s.count;
    };
    const auto close = [](Score& s) {
        s.rms = std::sqrt(s.rms / double(s.count));
        s.bias /= double(s.count);
    };
    for (std::size_t i = 0; i < series.when.size(); ++i) {
        const Instant when = series.when[i];
        if (when > job.end) break;
        const double e = between(result, job, when) - series.skin[i];
        add(score, e);
        add(series.weather.at(when).shortwave_down > 20.0 ? day : night, e);
        const std::chrono::year_month_day date(std::chrono::floor<std::chrono::days>(when));
        add(month[static_cast<int>(static_cast<unsigned>(date.month()))], e);
    }
    close(score);
    close(day);
    close(night);
    std::string months;
    for (auto& [m, s] : month) {
        close(s);
        if (month.size() > 2) months += fmt::format(" {}:{:.2f}({:+.2f})", m, s.rms, s.bias);
    }
    WARN(
        fmt::format("{} as {}: rms {:.2f} K, bias {:+.2f}, worst {:.1f}, day {:.2f} ({:+.2f}), "
                    "night {:.2f} ({:+.2f}), {} values{}",
                    name, material, score.rms, score.bias, score.worst, day.rms, day.bias,
                    night.rms, night.bias, score.count, months));
    return score;
}

}  // namespace

TEST_CASE("a desert of cinders in September", "[thermal][measured][by_history]") {
    const auto folder = shared_data("data/thermal/woodhouse_mesa_2022");
    if (!folder) return;
    CHECK(run("Woodhouse", measured::woodhouse(*folder), "basalt_cinder", 600.0).rms < 1.8);
}

TEST_CASE("a cold high desert in January", "[thermal][measured][by_history]") {
    const auto folder = shared_data("data/thermal/surfrad_alamosa_20160101");
    if (!folder) return;
    CHECK(run("Alamosa", measured::alamosa(*folder), "semi_desert", 600.0).rms < 2.3);
}

TEST_CASE("a field in Illinois from January to July", "[thermal][measured][by_history]") {
    const auto folder = shared_data("data/thermal/bondville_1998");
    if (!folder) return;
    const measured::Series series = measured::bondville_1998(*folder);
    CHECK(run("Bondville 1998", series, "crop_stubble", 1800.0).rms < 1.5);
    CHECK(run("Bondville 1998", series, "grass", 1800.0).rms < 1.9);
}

// A day that ends ten kelvin colder than it began: the days before are taken to have had no front.
TEST_CASE("grass under an overcast sky in May", "[thermal][measured][by_history]") {
    const auto folder = shared_data("data/thermal/surfrad_bondville_19950510");
    if (!folder) return;
    CHECK(run("Bondville 1995", measured::bondville_1995(*folder), "grass", 600.0).rms < 1.2);
}

TEST_CASE("alpine snow from November to January", "[thermal][measured][by_history]") {
    const auto folder = shared_data("data/thermal/weissfluhjoch_mst96");
    if (!folder) return;
    // As delivered no column can follow it: the pyrgeometer saw sun until 10 December.
    CHECK(run("Weissfluhjoch", measured::weissfluhjoch(*folder, 0.0), "snow", 1800.0).rms < 3.0);
    CHECK(run("Weissfluhjoch, sky without sun", measured::weissfluhjoch(*folder, 0.13), "snow",
              1800.0)
              .rms < 2.6);
}
