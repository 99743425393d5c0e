# The two Debian packages that scripts/package.sh makes, of what CanopeerInstall.cmake installs.

# Which Debian this is: packages of two releases have two versions, and the newer release has the higher one.
cmake_host_system_information(RESULT os QUERY DISTRIB_INFO)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1~${os_ID}${os_VERSION_ID})

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(maintainer "Canopeer maintainers")
set(address maintainers@canopeer.example)
if(DEFINED ENV{DEBEMAIL})  # whoever makes packages for others, as Debian's own tools take it
  set(address $ENV{DEBEMAIL})
endif()
if(DEFINED ENV{DEBFULLNAME})
  set(maintainer $ENV{DEBFULLNAME})
endif()
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${maintainer} <${address}>")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME canopeer)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "view planning for robots that look for fruits
Canopeer decides where a robot's camera looks next, so that it finds every
fruit behind the leaves in time. It plans views and motions of an arm, maps
the fruits it sees, and has a simulated glasshouse inside.

The missions, robots, worlds and compute tables of the project are in it, so
that a mission runs from any folder: canopeer run scenario_1")

# Who links static libraries needs the libraries that these use: packages.txt up to what only tests need.
file(READ ${PROJECT_SOURCE_DIR}/packages.txt packages)
string(REGEX REPLACE "\n# Tests and benchmarks.*" "" packages "${packages}")
string(REGEX REPLACE "#[^\n]*" "" packages "${packages}")
string(REGEX MATCHALL "lib[^ \n]+-dev[^ \n]*|[^ \n]+-dev" packages "${packages}")
list(TRANSFORM packages REPLACE "\\|" " | ")
list(JOIN packages ", " packages)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libcanopeer-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${packages}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "canopeer, cmake, g++")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "view planning for robots that look for fruits - library
Static libraries, headers and CMake files of Canopeer, for planners,
detectors and robots of your own: find_package(canopeer CONFIG).")

# What Debian wants beside each package's files
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH, where it is set
set(documents ${PROJECT_BINARY_DIR}/package_documents)
foreach(pair program:canopeer development:libcanopeer-dev)
  string(REGEX REPLACE "(.*):(.*)" "\\1;\\2" pair ${pair})
  list(GET pair 0 component)
  list(GET pair 1 package)
  file(WRITE ${documents}/${package}/changelog.Debian
       "canopeer (${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) ${os_VERSION_CODENAME}; urgency=medium\n\n"
       "  * Made from the source by scripts/package.sh; changelog.gz says what is new.\n\n"
       " -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}\n")
  configure_file(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${documents}/${package}/changelog COPYONLY)
  execute_process(COMMAND gzip -9 -n -f ${documents}/${package}/changelog ${documents}/${package}/changelog.Debian
                  COMMAND_ERROR_IS_FATAL ANY)
  install(DIRECTORY ${documents}/${package} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc COMPONENT ${component})
  install(FILES packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()
include(CPack)
