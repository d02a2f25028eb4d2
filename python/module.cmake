# diurna._core, with its data beside it.
find_package(Python3 3.10 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 CONFIG REQUIRED)
file(GLOB python_sources CONFIGURE_DEPENDS python/src/*.cpp)
pybind11_add_module(_core MODULE NO_EXTRAS ${python_sources})
target_link_libraries(_core PRIVATE scenes)
install(TARGETS _core LIBRARY DESTINATION diurna COMPONENT python)
include(packaging/data.cmake)
install_data(diurna/share/diurna python crossover jacksboro)
