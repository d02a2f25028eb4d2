#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

#include "tests/support/passed_over.hpp"
#include "tests/support/ran.hpp"

/// Debian's Python with netCDF4, numpy and OpenImageIO, which know nothing of our readers; false,
/// and reported, where it is not there.
inline bool independent_readers() {
    const bool there = std::system(
                           "/usr/bin/python3 -c 'import netCDF4, numpy, OpenImageIO' "
                           "> /dev/null 2>&1") == 0;
    if (!there) pass_over("no python3 with netCDF4, numpy and OpenImageIO");
    return there;
}

/// Runs a script of tests/support.
inline Ran read_by(const std::string& script, const std::string& arguments) {
    return ran("/usr/bin/python3 '" DIURNA_SOURCE_DIR "/tests/support/" + script + "' " +
               arguments + " 2>&1");
}
