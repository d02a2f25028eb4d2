#include <hdf5.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/hdf5_file.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

namespace {

constexpr std::array<hsize_t, 1> four{4};

/// An HDF5 file that `fill` puts something into.
void written(const std::filesystem::path& file,
             const std::function<void(hid_t file, hid_t space)>& fill) {
    const hid_t id = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, four.data(), nullptr);
    fill(id, space);
    H5Sclose(space);
    H5Fclose(id);
}

void add_dataset(hid_t parent, const char* name, hid_t space, hid_t made = H5P_DEFAULT) {
    const hid_t id =
        H5Dcreate2(parent, name, H5T_NATIVE_UCHAR, space, H5P_DEFAULT, made, H5P_DEFAULT);
    REQUIRE(id >= 0);
    H5Dclose(id);
}

}  // namespace

// The three ways in which the HDF5 reference manual lets a file's values lie in another
// (H5Lcreate_external, H5Pset_external, H5Pset_virtual).
TEST_CASE("a netCDF-4 file that would read others is refused", "[materials][hdf5][confinement]") {
    const ScratchFolder folder("hdf5");
    const auto other = folder.path / "other", file = folder.path / "f.nc";
    written(other, [](hid_t id, hid_t space) { add_dataset(id, "v", space); });
    CHECK_NOTHROW(check_values_are_its_own(other));

    written(file, [&](hid_t id, hid_t space) {
        const hid_t group = H5Gcreate2(id, "inner", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        add_dataset(group, "own", space);
        H5Lcreate_soft("/inner/own", id, "again", H5P_DEFAULT, H5P_DEFAULT);
        H5Gclose(group);
    });
    CHECK_NOTHROW(check_values_are_its_own(file));

    written(file, [&](hid_t id, hid_t) {
        H5Lcreate_external(other.c_str(), "/v", id, "linked", H5P_DEFAULT, H5P_DEFAULT);
    });
    CHECK_THROWS_WITH(check_values_are_its_own(file),
                      Catch::Contains("\"linked\" stores its values in another file"));

    written(file, [&](hid_t id, hid_t space) {
        const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_external(made, "/etc/passwd", 0, 4);
        const hid_t group = H5Gcreate2(id, "inner", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        add_dataset(group, "stored", space, made);
        H5Gclose(group);
        H5Pclose(made);
    });
    CHECK_THROWS_WITH(check_values_are_its_own(file), Catch::Contains("\"inner/stored\""));

    written(file, [&](hid_t id, hid_t space) {
        const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_virtual(made, space, other.c_str(), "v", space);
        add_dataset(id, "virtual", space, made);
        H5Pclose(made);
    });
    CHECK_THROWS_WITH(check_values_are_its_own(file), Catch::Contains("\"virtual\""));

    write_whole_file(file, std::string_view("time,air_temperature_K\n"));
    CHECK_NOTHROW(check_values_are_its_own(file));
}
