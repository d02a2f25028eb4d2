#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/units.hpp"
#include "materials/modtran/tape7.hpp"
#include "materials/radiation/planck.hpp"
#include "tests/support/scratch_folder.hpp"

namespace diurna {

inline const PrivateTempFolder private_temp_folder;

inline std::filesystem::path scratch(const std::string& name) {
    return std::filesystem::temp_directory_path() / ("diurna_modtran_test_" + name);
}

inline std::filesystem::path file_with(const std::string& text, const std::string& name = "tape7") {
    write_whole_file(scratch(name), text);
    return scratch(name);
}

/// A sample, unpacked if need be.
inline std::filesystem::path sample(const std::filesystem::path& folder, const std::string& name) {
    if (std::filesystem::exists(folder / name)) return folder / name;
    const std::filesystem::path plain = scratch(name);
    const std::string command =
        "gzip -dc '" + (folder / (name + ".gz")).string() + "' > '" + plain.string() + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    return plain;
}

/// W cm-2 sr-1 / cm-1.
inline double planck_per_cm(double wavenumber, double temperature) {
    return planck(1e4 / wavenumber, temperature) / per_um_from_modtran(1.0, wavenumber);
}

inline const std::string header =
    "T F 6    3    2    1    6    6    6    6    6    6    1    0    0 300.000   0.00\n"
    "    1    1    1    0    0    0  23.00000   0.00000   0.00000   0.00000   0.00000\n"
    " -99.000 -99.000 -99.000\n"
    " -99.00000 -99.00000 -99.00000  1.416445  0.000736 ! H2O & O3 COLUMNS [GM/CM2]\n"
    "   361976 U S STANDARD   \n"
    "   2.00000  10.00000  30.00000   9.23590   0.04147   0.00000    0        0.00000\n"
    "    0    0    1    0\n"
    "  25.00000   0.00000  23.00000  45.00000   0.00000   0.00000   0.00000   0.00000\n"
    "    2050.0    2100.0       1.0       1.0NW              \n"
    "    0   0    0.000  0    0.000  0    1.000\n"
    "    FREQ  TOT_TRANS  PTH_THRML  THRML_SCT  SURF_EMIS   SOL_SCAT  SING_SCAT  GRND_RFLT  "
    "DRCT_RFLT  TOTAL_RAD  REF_SOL  SOL@OBS   DEPTH DIR_EM    TOA_SUN BBODY_T[K]\n";
inline const std::string row_a =
    " 2050.00 0.88372636 1.5902E-08 5.4204E-10 4.8713E-07 2.0005E-10 1.9724E-10 0.0000E+00 "
    "0.0000E+00 5.0323E-07 8.27E-07 8.13E-07   0.124 1.0000 9.6338E-07    297.246\n";
inline const std::string row_b =
    " 2051.00 0.74512768 3.7278E-08            4.0936E-07 1.6775E-10 1.6479E-10 0.0000E+00 "
    "0.0000E+00 4.4681E-07 6.94-107 6.78E-07   0.294 1.0000 9.6265E-07    293.827\n";

inline std::string problem(const std::string& text) {
    try {
        read_tape7(file_with(text));
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace diurna
