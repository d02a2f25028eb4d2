# diurna._core, with its data beside it (materials/base/data_folder.cpp looks there).
find_package(Python3 3.10 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 CONFIG REQUIRED)
file(GLOB python_sources CONFIGURE_DEPENDS python/src/*.cpp)
pybind11_add_module(_core MODULE NO_EXTRAS ${python_sources})
target_link_libraries(_core PRIVATE scenes)
install(TARGETS _core LIBRARY DESTINATION diurna COMPONENT python)
install(FILES materials/library.toml DESTINATION diurna/share/diurna/materials COMPONENT python)
install(DIRECTORY materials/atmosphere materials/models materials/spectra
    DESTINATION diurna/share/diurna/materials COMPONENT python
    FILES_MATCHING PATTERN "*.csv" PATTERN "*.toml")
install(DIRECTORY scenes/crossover scenes/jacksboro DESTINATION diurna/share/diurna/scenes COMPONENT python
    PATTERN "*.png" EXCLUDE)
