# Which headers are installed: those in the modules' own folders, what they include from rooms, and the program's.
# Looked up when installing, so that no list of them can be out of date. As a script it copies them:
#   cmake -DTO=<folder> -P cmake/InstalledHeaders.cmake

# canopeer_included(<variable> <file>): the project's headers that a file includes, as "canopeer/…".
function(canopeer_included variable file)
  file(STRINGS "${file}" lines REGEX "^#include \"canopeer/")
  list(TRANSFORM lines REPLACE "^#include \"([^\"]+)\".*" "\\1")
  set(${variable} ${lines} PARENT_SCOPE)
endfunction()

# canopeer_install_headers(<source tree> <folder>)
function(canopeer_install_headers tree folder)
  file(GLOB open RELATIVE "${tree}/src" "${tree}/src/canopeer/*/*.h")
  set(headers ${open})
  while(open)
    list(POP_FRONT open header)
    canopeer_included(included "${tree}/src/${header}")
    list(REMOVE_ITEM included ${headers})
    list(APPEND headers ${included})
    list(APPEND open ${included})
  endwhile()
  foreach(header IN LISTS headers)
    get_filename_component(place "${header}" DIRECTORY)
    file(INSTALL "${tree}/src/${header}" DESTINATION "${folder}/${place}" MESSAGE_NEVER)
  endforeach()
  file(INSTALL "${tree}/apps/canopeer/program.h" DESTINATION "${folder}/canopeer" MESSAGE_NEVER)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  get_filename_component(tree "${CMAKE_CURRENT_LIST_DIR}" DIRECTORY)
  get_filename_component(folder "${TO}" ABSOLUTE)
  canopeer_install_headers("${tree}" "${folder}")
endif()
