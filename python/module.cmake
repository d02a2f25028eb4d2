# diurna._core, with its data beside it.
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 CONFIG REQUIRED)

# What only the command line uses is not compiled: its verbs, export, the pages of keys.
get_target_property(scenes_sources scenes SOURCES)
list(FILTER scenes_sources EXCLUDE REGEX
    "/scenes/(commands|export|keys)/|/scenes/report/(ffmpeg|movie|swatch_chart|material_pages)\\.cpp|/slurm_scripts\\.cpp")
set_target_properties(scenes PROPERTIES SOURCES "${scenes_sources}")

file(GLOB python_sources CONFIGURE_DEPENDS python/src/*.cpp)
pybind11_add_module(_core MODULE NO_EXTRAS ${python_sources})
# Calls alone, nothing is computed here: -O1 halves the time that pybind11's templates take.
target_compile_options(_core PRIVATE -O1)
compile_in_batches(_core 6)
target_link_libraries(_core PRIVATE scenes)
install(TARGETS _core LIBRARY DESTINATION diurna COMPONENT python)
include(packaging/data.cmake)
install_data(diurna/share/diurna python crossover jacksboro)
