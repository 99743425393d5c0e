# What `cmake --install` puts where. Component `program`: the program and all it needs. Component `development`: static
# libraries, headers, and what find_package(canopeer CONFIG) reads. docs/install.md is for those who use it.
include(CMakePackageConfigHelpers)

# The program
install(TARGETS canopeer RUNTIME COMPONENT program)
install(DIRECTORY benchmark compute_tables missions records robots ros2 worlds DESTINATION ${CMAKE_INSTALL_DATADIR}/canopeer COMPONENT program
        PATTERN this-machine.yaml EXCLUDE PATTERN __pycache__ EXCLUDE)
install(PROGRAMS slurm/submit.sh slurm/bench.sbatch slurm/compare.sbatch DESTINATION ${CMAKE_INSTALL_DATADIR}/canopeer/slurm COMPONENT program)
set(completion apps/canopeer/completion)
install(FILES ${completion}/canopeer.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME canopeer COMPONENT program)
install(FILES ${completion}/_canopeer DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${completion}/canopeer.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d
        COMPONENT program)
if(TARGET canopeer_manual)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/man/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
endif()
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program
        FILES_MATCHING PATTERN *.md PATTERN pictures/*.png PATTERN decisions EXCLUDE
        PATTERN api EXCLUDE)

# The library
get_property(libraries GLOBAL PROPERTY CANOPEER_LIBRARIES)
install(TARGETS ${libraries} EXPORT canopeerTargets ARCHIVE COMPONENT development INCLUDES DESTINATION
        ${CMAKE_INSTALL_INCLUDEDIR})
install(CODE "include(\"${PROJECT_SOURCE_DIR}/cmake/InstalledHeaders.cmake\")
  canopeer_install_headers(\"${PROJECT_SOURCE_DIR}\" \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")"
        COMPONENT development)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT development)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/canopeer)
set(data_dir ${CMAKE_INSTALL_DATADIR}/canopeer)
configure_package_config_file(cmake/canopeerConfig.cmake.in ${PROJECT_BINARY_DIR}/cmake/canopeerConfig.cmake
                              INSTALL_DESTINATION ${config_dir} PATH_VARS data_dir)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cmake/canopeerConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cmake/canopeerConfig.cmake ${PROJECT_BINARY_DIR}/cmake/canopeerConfigVersion.cmake
        DESTINATION ${config_dir} COMPONENT development)
install(EXPORT canopeerTargets NAMESPACE canopeer:: DESTINATION ${config_dir} COMPONENT development)

option(CANOPEER_PACKAGES "Prepare Debian packages (scripts/package.sh)" OFF)
if(CANOPEER_PACKAGES)
  include(CanopeerPackages)
endif()
