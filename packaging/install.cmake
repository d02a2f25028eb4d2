# cmake --install and cpack: the program with its data, manual page and completion (component
# `program`), and the libraries for find_package(diurna) (component `development`).
include(GNUInstallDirs)
set(config ${CMAKE_INSTALL_LIBDIR}/cmake/diurna)

install(TARGETS diurna RUNTIME COMPONENT program)
include(packaging/data.cmake)
install_data(${CMAKE_INSTALL_DATADIR}/diurna program
    approach bondville camouflage crossover instruments jacksboro)
install(FILES README.md SECURITY.md scenes/KEYS.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)

# From the definitions the program itself reads its command line by.
set(pages ${PROJECT_BINARY_DIR}/pages)
add_custom_command(OUTPUT ${pages}/diurna.1 ${pages}/diurna
    COMMAND ${CMAKE_COMMAND} -E make_directory ${pages}
    COMMAND diurna pages --man > ${pages}/diurna.1
    COMMAND diurna pages --bash > ${pages}/diurna
    DEPENDS diurna VERBATIM)
add_custom_target(pages ALL DEPENDS ${pages}/diurna.1 ${pages}/diurna)
install(FILES ${pages}/diurna.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${pages}/diurna DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
    COMPONENT program)

install(TARGETS diurna_flags materials terrain thermal render scenes EXPORT diurna
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/diurna COMPONENT development)
install(DIRECTORY materials terrain thermal render scenes DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/diurna
    COMPONENT development FILES_MATCHING PATTERN "*.hpp")
install(EXPORT diurna NAMESPACE diurna:: FILE diurnaTargets.cmake DESTINATION ${config}
    COMPONENT development)
include(CMakePackageConfigHelpers)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/diurnaConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES packaging/diurnaConfig.cmake packaging/libraries.cmake
    ${PROJECT_BINARY_DIR}/diurnaConfigVersion.cmake DESTINATION ${config} COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the authors of diurna")
set(CPACK_PACKAGE_VENDOR diurna)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS program)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME diurna)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)  # asks the binary what it needs
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "ffmpeg, proj-data")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "thermal and diurnal terrain scenes with an offline spectral renderer
Heat balance of terrain and objects through days, and what calibrated
instruments from 0.35 to 20 micrometres would see of it, as OpenEXR.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME diurna-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libcgal-dev, libopenmesh-dev, libembree-dev, libeigen3-dev, libgeographiclib-dev, libgdal-dev, liberfa-dev, libtbb-dev, libtomlplusplus-dev, nlohmann-json3-dev, libcli11-dev, libfmt-dev, libnetcdf-dev, libhdf5-dev, libboost-dev, libfftw3-dev, libopenexr-dev, libpng-dev, libtiff-dev, libssl-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "libraries and headers of diurna
Static libraries for find_package(diurna), with their headers.")
include(CPack)
