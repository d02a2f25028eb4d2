# diurna._core, with its data beside it.
find_package(Python3 3.11 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 CONFIG REQUIRED)

# What only the command line uses is not compiled: its verbs, export, the pages of keys.
get_target_property(scenes_sources scenes SOURCES)
list(FILTER scenes_sources EXCLUDE REGEX
    "/scenes/(app/commands|products/export|job/keys)/|/scenes/products/report/(ffmpeg|movie|swatch_chart|material_pages)\\.cpp|/slurm_scripts\\.cpp")
set_target_properties(scenes PROPERTIES SOURCES "${scenes_sources}")

# Moves rooms of a module to -O1, with which their compilation takes a third less time: those that read and write
# files and texts, and those of small part in a run's time. What computes heat, views, rays and light keeps -O3.
function(compile_lightly name rooms)
    get_target_property(sources ${name} SOURCES)
    set(light ${sources})
    list(FILTER light INCLUDE REGEX "${rooms}")
    list(FILTER sources EXCLUDE REGEX "${rooms}")
    set_target_properties(${name} PROPERTIES SOURCES "${sources}")
    compile_in_batches(${name} ${DIURNA_BATCH})
    get_target_property(libraries ${name} LINK_LIBRARIES)
    get_target_property(definitions ${name} COMPILE_DEFINITIONS)
    add_library(${name}_light OBJECT ${light})
    target_link_libraries(${name}_light PRIVATE ${libraries})
    if(definitions)
        target_compile_definitions(${name}_light PRIVATE ${definitions})
    endif()
    target_compile_options(${name}_light PRIVATE -O1)
    compile_in_batches(${name}_light ${DIURNA_BATCH})
    target_sources(${name} PRIVATE $<TARGET_OBJECTS:${name}_light>)
endfunction()
compile_lightly(materials "/materials/(base|modtran)/|/materials/matter/(read|library)")
compile_lightly(terrain "/terrain/(ground|objects|place|raster|texture)/")
compile_lightly(thermal "/thermal/(weather|weather_file)/")
compile_lightly(render "/render/(detection|instrument|picture)/")
compile_lightly(scenes "/scenes/(app|charts|products|studies)/|/scenes/job/(input|plan|store|warnings)/|/generated/")

file(GLOB python_sources CONFIGURE_DEPENDS python/src/*.cpp)
pybind11_add_module(_core MODULE NO_EXTRAS ${python_sources})
# Calls alone, nothing is computed here: -O1 halves the time that pybind11's templates take.
target_compile_options(_core PRIVATE -O1)
compile_in_batches(_core 10)
target_link_libraries(_core PRIVATE scenes)
install(TARGETS _core LIBRARY DESTINATION diurna COMPONENT python)
include(packaging/data.cmake)
install_data(diurna/share/diurna python crossover jacksboro)
