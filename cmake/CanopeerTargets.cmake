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
  # Nor behind Eigen's.
  add_compile_options("SHELL:-include ${PROJECT_SOURCE_DIR}/cmake/unfused_neon.h")
endif()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
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

# Some files of a target at a time ("unity build") cost little more than half the processor time of one by one: what they include is read
# once for all of them. Who changes code may want each alone, which also finds missing includes.
option(CANOPEER_UNITY_BUILD "Compile several files of a target together" OFF)
if(CANOPEER_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Types of a .cpp may hold types of its unnamed namespace, also when it is compiled with others.
  target_compile_options(canopeer_warnings INTERFACE -Wno-subobject-linkage)
endif()
function(canopeer_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${CANOPEER_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE 32)
endfunction()

# Where a run spends no time (commands, settings, reports) less optimisation costs nothing and saves a third of the compiler's.
function(canopeer_compile_lightly target)
  target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O1>)
endfunction()

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
  target_compile_definitions(${name}_test PRIVATE CANOPEER_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                                  CANOPEER_BINARY_DIR="${PROJECT_BINARY_DIR}")
  gtest_discover_tests(${name}_test DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
