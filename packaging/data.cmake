# The program's own data, as materials/base/data_folder.cpp looks for them: library, spectra and tables,
# and those of the sample scenes that are named. What a run or a script has left beside them stays.
function(install_data to component)
    install(FILES materials/library.toml materials/LIBRARY.md DESTINATION ${to}/materials COMPONENT ${component})
    install(DIRECTORY materials/atmosphere materials/models materials/spectra DESTINATION ${to}/materials
        COMPONENT ${component} FILES_MATCHING PATTERN "*.csv" PATTERN "*.toml" PATTERN "*.md")
    list(TRANSFORM ARGN PREPEND scenes/ OUTPUT_VARIABLE samples)
    install(DIRECTORY ${samples} DESTINATION ${to}/scenes COMPONENT ${component}
        PATTERN "*.png" EXCLUDE PATTERN out EXCLUDE REGEX "/bondville/weather\\.csv$" EXCLUDE)
endfunction()
