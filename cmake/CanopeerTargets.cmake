# Settings every target shares, and the functions the module, test and benchmark lists use.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

# The same sums on every machine and at every optimisation level: no fused multiply-add behind our back.
add_compile_options(-ffp-contract=off)
# Every 64 bit x86 machine since about 2009 counts bits in one instruction; voxel sets live on that.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_compile_options(-march=x86-64-v2)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  # Nor behind Eigen's: it fuses where the compiler says that the machine can.
  add_compile_options(-U__ARM_FEATURE_FMA)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  # What it asks for where headers are precompiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE})
endif()

add_library(canopeer_warnings INTERFACE)
target_compile_options(canopeer_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                  -Wnon-virtual-dtor -Wold-style-cast)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 sees overlapping copies in every "text" + std::string at -O3 (GCC bug 105329).
  target_compile_options(canopeer_warnings INTERFACE -Wno-restrict)
endif()
option(CANOPEER_WERROR "Treat warnings as errors" OFF)
if(CANOPEER_WERROR)
  target_compile_options(canopeer_warnings INTERFACE -Werror)
endif()

# For those who only build: some files of a target are compiled at a time ("unity build"), so that what they include is
# read once for all of them, and precompiled.h is read before. Who changes code wants each file alone (preset dev): that
# is what a rebuild takes, and it finds missing includes.
option(CANOPEER_UNITY_BUILD "Compile several files of a target together, with precompiled headers" OFF)
if(CANOPEER_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Types of a .cpp may hold types of its unnamed namespace, also when it is compiled with others. A library's macros may
  # forbid precompiled headers: a loss of time, no error.
  target_compile_options(canopeer_warnings INTERFACE -Wno-subobject-linkage -Wno-error=invalid-pch)
  # One such macro, of Debian 13's tinyxml2, says what holds on 64 bit machines anyway: so all files have it.
  target_compile_definitions(canopeer_warnings INTERFACE _FILE_OFFSET_BITS=64)
endif()
function(canopeer_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CANOPEER_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE 8)
  canopeer_use_precompiled(${target} canopeer_precompiled)
endfunction()

# canopeer_precompile(<name> <header>…) makes the library <name>, of precompiled.h and other headers, for
# canopeer_use_precompiled(<target> <name>). Both have to be compiled with the same options: files with machine or
# floating-point options of their own go without.
function(canopeer_precompile name)
  find_package(Eigen3 REQUIRED)
  find_path(EXPECTED_INCLUDE_DIR tl/expected.hpp REQUIRED)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(${name} PRIVATE Eigen3::Eigen canopeer_warnings)
  target_include_directories(${name} SYSTEM PRIVATE ${EXPECTED_INCLUDE_DIR})
  target_precompile_headers(${name} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.h ${ARGN})
endfunction()
function(canopeer_use_precompiled target name)
  if(TARGET ${name})
    target_precompile_headers(${target} REUSE_FROM ${name})
    # At the end of the target's folder its files have all their options.
    cmake_language(EVAL CODE "cmake_language(DEFER CALL canopeer_skip_precompiled ${target})")
  endif()
endfunction()
function(canopeer_skip_precompiled target)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    if(options MATCHES "-[fm]")
      set_source_files_properties(${source} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
endfunction()
if(CANOPEER_UNITY_BUILD)
  canopeer_precompile(canopeer_precompiled)
endif()

# canopeer_module(<name> SOURCES <file>… [DEPENDS <module or public library>…] [PRIVATE <library>…] [SYSTEM <include dir>…])
# makes the library canopeer_<name> with the alias canopeer::<name>.
function(canopeer_module name)
  cmake_parse_arguments(M "" "" "SOURCES;DEPENDS;PRIVATE;SYSTEM" ${ARGN})
  add_library(canopeer_${name} STATIC ${M_SOURCES})
  add_library(canopeer::${name} ALIAS canopeer_${name})
  target_include_directories(canopeer_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
  target_include_directories(canopeer_${name} SYSTEM PRIVATE ${M_SYSTEM})
  target_link_libraries(canopeer_${name} PUBLIC ${M_DEPENDS} PRIVATE ${M_PRIVATE} $<BUILD_INTERFACE:canopeer_warnings>)
  canopeer_compile_together(canopeer_${name})
  canopeer_installed_library(canopeer_${name} ${name})
endfunction()

# canopeer_installed_library(<target> <name>) has a library installed as canopeer::<name>.
function(canopeer_installed_library target name)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY CANOPEER_LIBRARIES ${target})
endfunction()

# canopeer_test(<name> SOURCES <file>… LIBS <library>… [SYSTEM <include dir>…]): one test program a module, tests found in it.
function(canopeer_test name)
  cmake_parse_arguments(T "" "" "SOURCES;LIBS;SYSTEM" ${ARGN})
  add_executable(${name}_test ${T_SOURCES})
  target_link_libraries(${name}_test PRIVATE ${T_LIBS} GTest::gtest GTest::gtest_main canopeer_warnings)
  target_include_directories(${name}_test SYSTEM PRIVATE ${T_SYSTEM})
  # The work is done in the libraries; tests should compile fast.
  target_compile_options(${name}_test PRIVATE $<$<CONFIG:Release>:-O1>)
  canopeer_use_precompiled(${name}_test canopeer_test_precompiled)
  target_compile_definitions(${name}_test PRIVATE CANOPEER_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                                  CANOPEER_BINARY_DIR="${PROJECT_BINARY_DIR}")
  gtest_discover_tests(${name}_test DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
