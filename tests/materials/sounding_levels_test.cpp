#include "materials/air/sounding_levels.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

using namespace diurna;

namespace {

/// Levels 50 m apart in an isothermal atmosphere of scale height 8 km.
CsvTable balloon(std::size_t count) {
    CsvTable table{
        .path = "sonde.csv", .header = {"height_m", "pressure_hPa"}, .rows = {}, .line = {}};
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 50.0 * double(i);
        table.rows.push_back(
            {fmt::format("{:.1f}", z), fmt::format("{:.3f}", 1000.0 * std::exp(-z / 8000.0))});
        table.line.push_back(int(i) + 2);
    }
    return table;
}

}  // namespace

TEST_CASE("a balloon that bounces loses the fewest levels", "[materials][sounding]") {
    CsvTable smooth = balloon(60);
    CHECK(leave_out_bounces(smooth, 0, 1).empty());
    CHECK(smooth.rows.size() == 60);

    CsvTable bounce = balloon(60);
    bounce.rows[20][1] = bounce.rows[18][1];  // pressure rises for one level
    CHECK(leave_out_bounces(bounce, 0, 1).find("1 of 60 levels are skipped") != std::string::npos);
    CHECK(bounce.rows.size() == 59);
    CHECK(bounce.line[20] == 23);  // line 22 is gone

    CsvTable dip = balloon(60);
    dip.rows[20][1] = dip.rows[30][1];  // one level far too low: it goes, not the ten behind it
    CHECK_FALSE(leave_out_bounces(dip, 0, 1).empty());
    CHECK(dip.rows.size() == 59);

    CsvTable down = balloon(60);
    down.rows[20][0] = "930.0";  // height falls below that of the level before
    CHECK_FALSE(leave_out_bounces(down, 0, 1).empty());
    CHECK(down.rows.size() == 59);
}

TEST_CASE("a table that is no ascent is left for its reader to refuse", "[materials][sounding]") {
    CsvTable table = balloon(60);
    for (std::size_t i = 0; i < 60; ++i) table.rows[i][1] = fmt::format("{}", 500 + i);
    CHECK(leave_out_bounces(table, 0, 1).empty());
    CHECK(table.rows.size() == 60);
    CsvTable lone = balloon(60);
    lone.rows[7][1] = "";
    CHECK(leave_out_bounces(lone, 0, 1).empty());
}
