#include <netcdf.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/stages.hpp"
#include "tests/support/every_kind_scene.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/solve/heat_state_file.hpp"
#include "thermal/temperature_field.hpp"

// What a third party reads in temperatures.nc, with netCDF alone.

using namespace diurna;

namespace {

class NetCdf {
 public:
    explicit NetCdf(const std::filesystem::path& file) {
        REQUIRE(nc_open(file.c_str(), NC_NOWRITE, &id_) == NC_NOERR);
    }
    ~NetCdf() { nc_close(id_); }
    NetCdf(const NetCdf&) = delete;
    NetCdf& operator=(const NetCdf&) = delete;

    std::size_t length(const char* dimension) const {
        int dim = 0;
        std::size_t n = 0;
        REQUIRE(nc_inq_dimid(id_, dimension, &dim) == NC_NOERR);
        REQUIRE(nc_inq_dimlen(id_, dim, &n) == NC_NOERR);
        return n;
    }
    int variable(const char* name) const {
        int found = 0;
        CAPTURE(name);
        REQUIRE(nc_inq_varid(id_, name, &found) == NC_NOERR);
        return found;
    }
    std::vector<double> doubles(int variable, std::size_t count) const {
        std::vector<double> values(count);
        REQUIRE(nc_get_var_double(id_, variable, values.data()) == NC_NOERR);
        return values;
    }
    std::string text(int variable, const char* name) const {
        std::size_t n = 0;
        if (nc_inq_attlen(id_, variable, name, &n) != NC_NOERR) return "";
        std::string value(n, ' ');
        REQUIRE(nc_get_att_text(id_, variable, name, value.data()) == NC_NOERR);
        return value;
    }
    std::vector<std::string> words(const char* variable_name) const {
        std::vector<std::string> words(1);
        for (const char c : text(variable(variable_name), "flag_meanings")) {
            if (c == ' ') {
                words.emplace_back();
            } else {
                words.back() += c;
            }
        }
        return words;
    }
    std::string string_at(const char* name, std::size_t i) const {
        char* value = nullptr;
        REQUIRE(nc_get_var1_string(id_, variable(name), &i, &value) == NC_NOERR);
        const std::string copy = value;
        nc_free_string(1, &value);
        return copy;
    }
    /// All variables that have a sign in the balance, with it.
    std::vector<std::pair<int, int>> terms() const {
        int count = 0;
        REQUIRE(nc_inq_nvars(id_, &count) == NC_NOERR);
        std::vector<std::pair<int, int>> terms;
        for (int v = 0; v < count; ++v) {
            int sign = 0;
            if (nc_get_att_int(id_, v, "balance_sign", &sign) == NC_NOERR) {
                terms.emplace_back(v, sign);
            }
        }
        return terms;
    }

 private:
    int id_ = -1;
};

void solve_to(const std::string& text, const ScratchFolder& folder) {
    write_text(folder.path / "scene.toml", text);
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml"));
    Progress progress(ProgressStyle::silent);
    const SpanResult result = solve_scene(Stages(prepared), progress);
    REQUIRE(result.report.converged);
    write_heat(prepared, run_inputs(prepared.scene), result, folder.path / "temperatures.nc");
}

}  // namespace

// Conservation of energy. Wet ground, snow, leaves as one and apart, a store of water, textured
// ground, walls, plates with air behind and heat inside, under shadows' edges; kept between steps
// too. Floats hold each term to 3e-8 of itself.
TEST_CASE("the heat balance of every facet closes from the file alone", "[scenes][heat][fluxes]") {
    const ScratchFolder folder("heat-file");
    solve_to(every_kind_scene("frames = [\"2026-07-15T06:47:30-04:00\", "
                              "\"2026-07-15T13:00:00-04:00\"]\n") +
                 "[output]\nfluxes = true\n",
             folder);
    const NetCdf file(folder.path / "temperatures.nc");
    const std::size_t instants = file.length("time"), facets = file.length("facet");
    REQUIRE(instants >= 50);
    std::vector<double> sum(instants * facets), gross(instants * facets);
    const auto terms = file.terms();
    REQUIRE(terms.size() == 8);
    for (const auto& [variable, sign] : terms) {
        CHECK(file.text(variable, "units") == "W m-2");
        const std::vector<double> watts = file.doubles(variable, instants * facets);
        for (std::size_t i = 0; i < watts.size(); ++i) {
            sum[i] += sign * watts[i];
            gross[i] += std::abs(watts[i]);
        }
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        worst = std::max(worst, std::abs(sum[i]) / gross[i]);
    }
    CHECK(worst < 1e-6);
    CHECK(file.text(NC_GLOBAL, "heat_balance").find("conducted_heat") != std::string::npos);
    CHECK(file.text(file.variable("sensible_heat"), "standard_name") ==
          "surface_upward_sensible_heat_flux");

    const TemperatureField field = load_temperature_field(folder.path / "temperatures.nc");
    const std::vector<float> read =
        load_heat_term(folder.path / "temperatures.nc", HeatTerm::sensible, field);
    const std::vector<double> sensible =
        file.doubles(file.variable("sensible_heat"), instants * facets);
    CHECK(std::vector<double>(read.begin(), read.end()) == sensible);
    TemperatureField fewer = field;
    fewer.facets -= 1;
    CHECK_THROWS_AS(load_heat_term(folder.path / "temperatures.nc", HeatTerm::sensible, fewer),
                    InputError);

    // Stefan and Boltzmann's emission of the file's own temperatures, CODATA 2018; on ground under
    // leaves temperatures are what a radiometer sees, between steps the fourth power is no line.
    const std::vector<std::string> words = file.words("material");
    const std::vector<double> material = file.doubles(file.variable("material"), facets);
    const std::vector<double> kelvin =
        file.doubles(file.variable("surface_temperature"), instants * facets);
    const std::vector<double> emitted =
        file.doubles(file.variable("emitted_longwave"), instants * facets);
    double most = 0.0;
    std::size_t asphalt = 0;
    for (std::size_t f = 0; f < facets; ++f) {
        if (words[std::size_t(material[f])] != "asphalt") continue;
        if (emitted[f] == 0.0) continue;  // under an object: no exposed fluxes
        ++asphalt;
        const double t = kelvin[f], black = 5.670374419e-8 * t * t * t * t;
        most = std::max(most, std::abs(emitted[f] / black - 0.94));
    }
    CHECK(asphalt > 100);
    CHECK(most < 0.03);  // its emissivity, whatever the library says to two digits
}

// What an insulated column takes in over a day that repeats, it gives back: the mean of what it
// conducts is nothing. By trapezoids over steps of 20 minutes and all facets of a material: within
// a step a single facet's sun jumps.
TEST_CASE("ground without a flux from below takes nothing over a day that repeats",
          "[scenes][heat][fluxes]") {
    const ScratchFolder folder("heat-day");
    solve_to(with(small_scene(), "frame_every_s = 21600.0", "frame_every_s = 1200.0") +
                 "[output]\nfluxes = true\n",
             folder);
    const NetCdf file(folder.path / "temperatures.nc");
    const std::size_t instants = file.length("time"), facets = file.length("facet");
    const std::vector<double> seconds = file.doubles(file.variable("time"), instants);
    const std::vector<std::string> words = file.words("material");
    const std::vector<double> material = file.doubles(file.variable("material"), facets);
    const std::vector<double> conducted =
        file.doubles(file.variable("conducted_heat"), instants * facets);
    for (const std::string word : {"grass", "asphalt"}) {
        double taken = 0.0, moved = 0.0;
        for (std::size_t i = 0; i + 1 < instants; ++i) {
            for (std::size_t f = 0; f < facets; ++f) {
                if (words[std::size_t(material[f])] != word) continue;
                const double mean =
                    0.5 * (conducted[i * facets + f] + conducted[(i + 1) * facets + f]);
                taken += mean * (seconds[i + 1] - seconds[i]);
                moved += std::abs(mean) * (seconds[i + 1] - seconds[i]);
            }
        }
        CAPTURE(word, taken, moved);
        CHECK(moved > 0.0);
        CHECK(std::abs(taken) < 0.01 * moved);
    }
}

TEST_CASE("materials, objects and clocks can be read from the file", "[scenes][heat]") {
    const ScratchFolder folder("heat-names");
    solve_to(small_scene(), folder);
    const NetCdf file(folder.path / "temperatures.nc");
    const std::size_t facets = file.length("facet"), instants = file.length("time");
    CHECK(file.terms().empty());
    const std::vector<std::string> objects = file.words("object");
    CHECK(objects[0] == "ground");
    CHECK(std::find(objects.begin(), objects.end(), "hangar") != objects.end());
    const std::vector<std::string> materials = file.words("material");
    const std::vector<double> material = file.doubles(file.variable("material"), facets);
    const std::vector<double> object = file.doubles(file.variable("object"), facets);
    std::size_t glass = 0;
    for (std::size_t f = 0; f < facets; ++f) {
        if (materials[std::size_t(material[f])] != "glass") continue;
        ++glass;
        CHECK(objects[std::size_t(object[f])] == "hangar");
    }
    CHECK(glass > 0);
    CHECK(file.string_at("local_time", 0) == "2026-07-15T00:00:00-04:00");
    // 16:00 UTC at 84.203 W; on 15 July the equation of time is −5.9 min (Astronomical Almanac).
    const std::vector<double> solar = file.doubles(file.variable("solar_time"), instants);
    std::size_t noon = 0;
    while (file.string_at("local_time", noon) != "2026-07-15T12:00:00-04:00") ++noon;
    CHECK(solar[noon] == Approx(16.0 - 84.203333 / 15.0 - 5.9 / 60.0).margin(0.005));
    // A file of temperatures is none to go on from.
    CHECK_THROWS_WITH(load_heat_state(folder.path / "temperatures.nc", {}),
                      Catch::Contains("temperatures.nc: is not a state file of a run"));
}
