#include <netcdf.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "tests/corpus/run_corpus.hpp"

// Temperatures and states that earlier runs have left, cut short, edited or of another scene.

namespace {

namespace fs = std::filesystem;
using corpus::changed;
using corpus::Family;
using corpus::Malformed;

const PrivateTempFolder temp;
[[maybe_unused]] const int cache_is_own =
    ::setenv("XDG_CACHE_HOME", (temp.folder.path / "cache").c_str(), 1);
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// The yard's weather for two days.
std::string two_days() {
    std::string text = yard::weather_head;
    for (int hour = 0; hour <= 48; ++hour) text += yard::weather_row(hour);
    return text;
}

/// What the yard's first day leaves.
struct Left {
    std::string temperatures, state;
    Left() {
        const fs::path folder = temp.folder.path / "left";
        corpus::put_files(folder, {{"weather.csv", two_days()},
                                   {"scene.toml", yard::scene + "[output]\nstate = true\n"}});
        const corpus::Ended ended = corpus::run(
            folder, {"run", "scene.toml", "--out", "out", "--progress", "none", "--fresh"});
        INFO(ended.reported);
        REQUIRE(ended.code == 0);
        temperatures = corpus::text_of(folder / "out/temperatures.nc");
        state = corpus::text_of(folder / "out/state.nc");
        fs::remove_all(folder);
    }
};
const Left& left() {
    static const Left once;
    return once;
}

/// A netCDF file's bytes after something was done to it.
std::string edited(const std::string& bytes, const std::function<void(int)>& edit) {
    const fs::path file = temp.folder.path / "edited.nc";
    std::ofstream(file, std::ios::binary) << bytes;
    int id = -1;
    REQUIRE(nc_open(file.c_str(), NC_WRITE, &id) == NC_NOERR);
    edit(id);
    REQUIRE(nc_close(id) == NC_NOERR);
    return corpus::text_of(file);
}
int variable(int id, const char* name) {
    int found = -1;
    REQUIRE(nc_inq_varid(id, name, &found) == NC_NOERR);
    return found;
}
/// One value of a variable of one or two dimensions.
std::function<void(int)> value(const char* name, std::size_t at, double to) {
    return [=](int id) {
        const std::size_t place[2] = {at, 0};
        const int status = nc_put_var1_double(id, variable(id, name), place, &to);
        REQUIRE((status == NC_NOERR || status == NC_ERANGE));  // as an infinity is
    };
}
std::function<void(int)> attribute(const char* of, const char* name, const std::string& to) {
    return [=](int id) {
        const int which = of == nullptr ? NC_GLOBAL : variable(id, of);
        REQUIRE(nc_redef(id) == NC_NOERR);
        REQUIRE(nc_put_att_text(id, which, name, to.size(), to.c_str()) == NC_NOERR);
    };
}
std::function<void(int)> renamed(const char* from, const char* to) {
    return [=](int id) {
        REQUIRE(nc_redef(id) == NC_NOERR);
        REQUIRE(nc_rename_var(id, variable(id, from), to) == NC_NOERR);
    };
}

/// What befalls a file of any kind.
std::map<std::string, std::string> spoilt(const std::string& fine) {
    std::string no_head = fine, zeros = fine;
    for (std::size_t i = 0; i < 512; ++i) no_head[i] = '\0';
    for (std::size_t i = fine.size() / 2; i < fine.size(); ++i) zeros[i] = '\0';
    return {{"nothing", ""},
            {"text", "temperatures\n"},
            {"NULs", std::string(20000, '\0')},
            {"the first 8 bytes", fine.substr(0, 8)},
            {"the first 100 bytes", fine.substr(0, 100)},
            {"a tenth", fine.substr(0, fine.size() / 10)},
            {"half", fine.substr(0, fine.size() / 2)},
            // Its last kilobytes hold nothing: HDF5 sets aside more than it fills.
            {"three quarters", fine.substr(0, fine.size() / 4 * 3)},
            {"no head", no_head},
            {"netCDF-3 of nothing", std::string("CDF\x01\0\0\0\0", 8) + std::string(24, '\0')},
            {"netCDF-3 that claims 2^31 facets",
             std::string("CDF\x01\0\0\0\0\0\0\0\x0a\0\0\0\x01\0\0\0\x05"
                         "facet\0\0\0\x7f\xff\xff\xff",
                         32) +
                 std::string(16, '\0')}};
}

Malformed rendered(const std::string& name, const std::string& file) {
    return {.name = "temperatures: " + name,
            .files = {{"t.nc", file}, {"weather.csv", two_days()}},
            .words = {"render", "scene.toml", "--temperatures", "t.nc", "--out", "out",
                      "--progress", "none"}};
}

Family temperatures() {
    const std::string& fine = left().temperatures;
    Family cases;
    for (const auto& [name, text] : spoilt(fine)) cases.push_back(rendered(name, text));
    cases.push_back(rendered("a state", left().state));
    const auto edit = [&](const std::string& name, const std::function<void(int)>& how) {
        cases.push_back(rendered(name, edited(fine, how)));
    };
    for (const double kelvin : {nan, infinite, -infinite, 0.0, -5.0, 0.5, 5001.0, 1e6, 1e30}) {
        edit(fmt::format("a facet of {} K", kelvin), value("surface_temperature", 0, kelvin));
    }
    edit("of another year", [](int id) {
        for (std::size_t i = 0, n = 25; i < n; ++i) {
            double seconds = 0.0;
            if (nc_get_var1_double(id, variable(id, "time"), &i, &seconds) != NC_NOERR) break;
            seconds += 365.0 * 86400.0;
            REQUIRE(nc_put_var1_double(id, variable(id, "time"), &i, &seconds) == NC_NOERR);
        }
    });
    edit("in hours", attribute("time", "units", "hours since 1970-01-01T00:00:00Z"));
    edit("since another epoch", attribute("time", "units", "seconds since 2000-01-01T00:00:00Z"));
    edit("of an hour west", attribute("time", "units", "seconds since 1970-01-01T00:00:00-01:00"));
    edit("units of text", attribute("time", "units", std::string(5000, 'x')));
    edit("units of nothing", attribute("time", "units", ""));
    for (const double seconds : {nan, infinite, 1e300, -1e18, 0.0}) {
        edit(fmt::format("an instant at {} s", seconds), value("time", 1, seconds));
    }
    edit("no temperatures", renamed("surface_temperature", "surface"));
    edit("no times", renamed("time", "when"));
    Malformed other = rendered("to another mesh", fine);
    other.files["scene.toml"] =
        changed(yard::scene, "largest_edge_m = 10.0", "largest_edge_m = 7.0");
    cases.push_back(other);
    Malformed none = rendered("not there", fine);
    none.words[3] = "nothing.nc";
    cases.push_back(none);
    Malformed folder = rendered("a folder", fine);
    folder.words[3] = ".";
    cases.push_back(folder);
    return cases;
}

/// The yard's second day, begun with a state.
std::string second_day() {
    std::string text = changed(yard::scene, "start = 2026-06-20T00:00:00Z",
                               "start = 2026-06-21T00:00:00Z\nstate = \"s.nc\"");
    text = changed(text, "spin_up = \"periodic\"", "spin_up = \"state\"");
    return changed(text, "frames = [\"2026-06-20T00:01:00Z\"]",
                   "frames = [\"2026-06-21T00:01:00Z\"]");
}
Malformed gone_on(const std::string& name, const std::string& file) {
    return {.name = "state: " + name,
            .files = {{"s.nc", file}, {"weather.csv", two_days()}, {"scene.toml", second_day()}},
            .words = {"run", "scene.toml", "--out", "out", "--progress", "none"}};
}

Family states() {
    const std::string& fine = left().state;
    Family cases;
    for (const auto& [name, text] : spoilt(fine)) cases.push_back(gone_on(name, text));
    cases.push_back(gone_on("temperatures", left().temperatures));
    const auto edit = [&](const std::string& name, const std::function<void(int)>& how) {
        cases.push_back(gone_on(name, edited(fine, how)));
    };
    for (const char* of : {"title", "instant", "mesh", "columns"}) {
        edit(fmt::format("another {}", of), attribute(nullptr, of, "another"));
        edit(fmt::format("no {}", of), attribute(nullptr, of, ""));
    }
    edit("of the day after", attribute(nullptr, "instant", "2026-06-22T00:00:00Z"));
    edit("of the hour before", attribute(nullptr, "instant", "2026-06-20T23:00:00Z"));
    for (const double kelvin : {nan, infinite, 0.0, -5.0, 1e6, 1e300}) {
        edit(fmt::format("a facet of {} K", kelvin), value("surface_temperature", 0, kelvin));
        edit(fmt::format("a reference of {} K", kelvin), value("reference_K", 0, kelvin));
    }
    edit("a block of nan", value("block_state", 0, nan));
    edit("a block of -1 numbers", value("block_length", 0, -1.0));
    edit("a block of no number", value("block_length", 0, 0.0));
    edit("a block of 10^9 numbers", value("block_length", 0, 1e9));
    edit("a block of one number", value("block_length", 0, 1.0));
    for (const char* of : {"surface_temperature", "block_length", "block_state", "point_facet",
                           "point_state", "network_state", "reference_K"}) {
        edit(fmt::format("no {}", of), renamed(of, "else"));
    }
    Malformed other = gone_on("to another mesh", fine);
    other.files["scene.toml"] =
        changed(second_day(), "largest_edge_m = 10.0", "largest_edge_m = 7.0");
    cases.push_back(other);
    Malformed layered = gone_on("of another layer", fine);
    layered.files["scene.toml"] = changed(second_day(), "thickness_m = 0.3", "thickness_m = 0.4");
    cases.push_back(layered);
    Malformed early = gone_on("of another start", fine);
    early.files["scene.toml"] =
        changed(second_day(), "start = 2026-06-21T00:00:00Z", "start = 2026-06-20T06:00:00Z");
    cases.push_back(early);
    return cases;
}

}  // namespace

TEST_CASE("files that the corpus edits are fine as they are") {
    const fs::path folder = temp.folder.path / "fine";
    for (const Malformed& given :
         {rendered("fine", left().temperatures), gone_on("fine", left().state)}) {
        corpus::put_files(folder, given.files);
        const corpus::Ended ended = corpus::run(folder, given.words);
        CAPTURE(given.name, ended.reported);
        CHECK(ended.code == 0);
        fs::remove_all(folder);
    }
}
TEST_CASE("temperatures that cannot be are refused") {
    corpus::no_fault("temperatures", temperatures());
}
TEST_CASE("states that cannot be are refused") { corpus::no_fault("states", states()); }
