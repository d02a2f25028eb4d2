# What the program and whoever links its libraries needs: CMakeLists.txt and the installed
# diurnaConfig.cmake both read this.
list(APPEND CMAKE_MODULE_PATH /usr/share/cmake/geographiclib)
find_package(CGAL REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Eigen3 CONFIG REQUIRED)  # not the find module that CGAL brings
find_package(embree 3.13 CONFIG REQUIRED)
find_package(fmt REQUIRED)
find_package(GDAL CONFIG REQUIRED)
find_package(GeographicLib REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenMesh CONFIG REQUIRED)
find_package(OpenSSL REQUIRED)
find_package(PNG REQUIRED)
find_package(TIFF REQUIRED)
find_package(TBB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(erfa REQUIRED IMPORTED_TARGET erfa)
pkg_check_modules(openexr REQUIRED IMPORTED_TARGET OpenEXR)  # its CMake files ask for more
pkg_check_modules(netcdf REQUIRED IMPORTED_TARGET netcdf)
pkg_check_modules(hdf5 REQUIRED IMPORTED_TARGET hdf5-serial)  # of netCDF-4 files
pkg_check_modules(fftw REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)

# Headers whose packages tell CMake no version.
function(version_in header name pattern)
    find_file(found_${name} ${header} NO_CACHE REQUIRED)
    file(STRINGS ${found_${name}} line REGEX "${pattern}" LIMIT_COUNT 1)
    string(REGEX MATCH "[0-9][0-9._]*" version "${line}")
    string(REPLACE "_" "." version "${version}")
    set(${name}_VERSION ${version} PARENT_SCOPE)
endfunction()
version_in(boost/version.hpp Boost "define BOOST_LIB_VERSION")
version_in(GeographicLib/Config.h GeographicLib "define GEOGRAPHICLIB_VERSION_STRING")
pkg_check_modules(openmesh REQUIRED openmesh)
pkg_check_modules(gmp REQUIRED gmp)
pkg_check_modules(mpfr REQUIRED mpfr)

# Name and version of each, in this order in manifests, `diurna doctor` and the bill of materials.
string(CONCAT DIURNA_LIBRARIES "Boost ${Boost_VERSION}, CGAL ${CGAL_VERSION}, "
    "CLI11 ${CLI11_VERSION}, Eigen ${Eigen3_VERSION}, Embree ${embree_VERSION}, ERFA ${erfa_VERSION}, "
    "FFTW ${fftw_VERSION}, fmt ${fmt_VERSION}, GDAL ${GDAL_VERSION}, "
    "GeographicLib ${GeographicLib_VERSION}, GMP ${gmp_VERSION}, HDF5 ${hdf5_VERSION}, "
    "libpng ${PNG_VERSION_STRING}, MPFR ${mpfr_VERSION}, "
    "netCDF ${netcdf_VERSION}, nlohmann-json ${nlohmann_json_VERSION}, OpenEXR ${openexr_VERSION}, "
    "OpenMesh ${openmesh_VERSION}, OpenSSL ${OPENSSL_VERSION}, TBB ${TBB_VERSION}, "
    "TIFF ${TIFF_VERSION_STRING}, toml++ ${tomlplusplus_VERSION}")
