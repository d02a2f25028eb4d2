#include "thermal/temperature_field.hpp"

#include <netcdf.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>

#include "materials/base/error.hpp"
#include "tests/support/hills.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/temperature_mesh.hpp"

using namespace diurna;

namespace {

TemperatureField ramp(std::size_t facets) {
    const Instant begin = parse_instant("2026-06-21T05:00:00Z");
    TemperatureField field{.instant = {}, .facets = facets, .kelvin = {}};
    for (int i = 0; i < 3; ++i) {
        field.instant.push_back(later(begin, 3600.0 * i));
        for (std::size_t f = 0; f < facets; ++f) {
            field.kelvin.push_back(280.0f + 4.0f * float(i) + 0.25f * float(f % 16));
        }
    }
    return field;
}

}  // namespace

TEST_CASE("temperatures are linear between stored instants, constant beyond them",
          "[thermal][temperature_field]") {
    const TemperatureField field = ramp(4);
    CHECK(field.interpolate(later(field.instant[0], 900.0))[1] == Approx(281.25));
    CHECK(field.interpolate(later(field.instant[2], 9e5))[0] == 288.0f);
    CHECK(field.interpolate(later(field.instant[0], -9e5))[0] == 280.0f);
    CHECK(field.interpolate(field.instant[1])[3] == 284.75f);
}

TEST_CASE("a temperature field survives its file, bit by bit", "[thermal][temperature_field]") {
    const ScratchFolder folder("temperature_field");
    const FacetSet facets = hills(4, {MaterialId{0}});
    const TemperatureField field = ramp(facets.size());
    const auto file = folder.path / "temperatures.nc";
    save_temperature_field(file, field, facets, Site{36.5, -84.2, 400.0});
    const TemperatureField read = load_temperature_field(file);
    CHECK(read.instant == field.instant);
    CHECK(read.facets == field.facets);
    CHECK(read.kelvin == field.kelvin);
    // Nothing but the file itself is left in the folder.
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) == 1);
}

// 2026-11: made in memory by nc_create_mem, the file was one that netCDF's tools could read but not
// change ("Can't write file"), and scripts edit temperatures to render them.
TEST_CASE("other programs can change a temperature and add a variable of their own",
          "[thermal][temperature_field]") {
    const ScratchFolder folder("temperature_field");
    const FacetSet facets = hills(4, {MaterialId{0}});
    const auto file = folder.path / "temperatures.nc";
    save_temperature_field(file, ramp(facets.size()), facets, {});
    int id = 0, temperature = 0, own = 0;
    REQUIRE(nc_open(file.c_str(), NC_WRITE, &id) == NC_NOERR);
    REQUIRE(nc_inq_varid(id, "surface_temperature", &temperature) == NC_NOERR);
    const std::size_t where[2] = {1, 2};
    const float kelvin = 301.5f;
    CHECK(nc_put_var1_float(id, temperature, where, &kelvin) == NC_NOERR);
    CHECK(nc_redef(id) == NC_NOERR);
    CHECK(nc_def_var(id, "own", NC_DOUBLE, 0, nullptr, &own) == NC_NOERR);
    CHECK(nc_close(id) == NC_NOERR);
    CHECK(load_temperature_field(file).at(1)[2] == kelvin);
}

// 2026-11: a solver's NaN went into a file that only its reader refused.
TEST_CASE("a temperature that is no number is not written", "[thermal][temperature_field]") {
    const ScratchFolder folder("temperature_field");
    const FacetSet facets = hills(4, {MaterialId{0}});
    TemperatureField field = ramp(facets.size());
    field.kelvin[facets.size() + 2] = std::nanf("");
    const auto file = folder.path / "nan.nc";
    CHECK_THROWS_WITH(save_temperature_field(file, field, facets, {}),
                      Catch::Contains("the temperature of facet 2 is not finite"));
    CHECK_FALSE(std::filesystem::exists(file));
}

TEST_CASE("a file that holds no temperatures is refused in one line",
          "[thermal][temperature_field][errors]") {
    const ScratchFolder folder("temperature_field_bad");
    CHECK_THROWS_AS(load_temperature_field(folder.path / "absent.nc"), InputError);
    write_text(folder.path / "text.nc", "not a netCDF file");
    CHECK_THROWS_AS(load_temperature_field(folder.path / "text.nc"), InputError);

    const FacetSet facets = hills(4, {MaterialId{0}});
    TemperatureField field = ramp(facets.size());
    field.kelvin[7] = -3.0f;
    save_temperature_field(folder.path / "cold.nc", field, facets, Site{});
    CHECK_THROWS_AS(load_temperature_field(folder.path / "cold.nc"), InputError);

    field.kelvin[7] = 290.0f;
    save_temperature_field(folder.path / "whole.nc", field, facets, Site{});
    std::filesystem::resize_file(folder.path / "whole.nc", 4096);  // of some 20 kB and padding
    CHECK_THROWS_AS(load_temperature_field(folder.path / "whole.nc"), InputError);
    CHECK_THROWS_AS(save_temperature_field(folder.path / "no" / "folder.nc", field, facets, Site{}),
                    std::runtime_error);
}

TEST_CASE("what a killed run has left of a file is removed when it is written again",
          "[thermal][temperature_field]") {
    const ScratchFolder folder("temperature_field_left");
    const FacetSet facets = hills(4, {MaterialId{0}});
    // No process has the greatest number; the first has one, whoever may ask.
    const auto dead = folder.path / ".all.nc.4194304.0.part",
               alive = folder.path / ".all.nc.1.0.part",
               other = folder.path / ".others.nc.4194304.0.part";
    for (const auto& file : {dead, alive, other}) write_text(file, "half a file");
    save_temperature_field(folder.path / "all.nc", ramp(facets.size()), facets, Site{});
    CHECK_FALSE(std::filesystem::exists(dead));
    CHECK(std::filesystem::exists(alive));
    CHECK(std::filesystem::exists(other));
}

// 2026-11: 20 000 pieces of ground were solved and then not written: their names were more than an
// attribute holds.
TEST_CASE("any number of objects keep their names", "[thermal][temperature_field]") {
    const ScratchFolder folder("temperature_field");
    const FacetSet facets = hills(4, {MaterialId{0}});
    FieldNotes notes{.materials = {"grass"}};
    for (int i = 0; i < 20000; ++i) notes.objects.push_back("piece_" + std::to_string(i));
    const auto file = folder.path / "temperatures.nc";
    save_temperature_field(file, ramp(facets.size()), facets, {}, notes);
    CHECK(load_temperature_field(file).kelvin == ramp(facets.size()).kelvin);
    CHECK(load_temperature_mesh(file).objects == notes.objects);
    CHECK(load_temperature_mesh(file).materials == notes.materials);
}
