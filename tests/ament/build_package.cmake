# cmake -DPACKAGE=<ros2> -DPROGRAM=<canopeer> [-DEMULATOR=<command>] -DFOLDER=<folder> -P build_package.cmake
# Builds and installs the ament package as a ROS 2 workspace would, and looks at what is there then.
if(NOT EXISTS /usr/share/ament_cmake/cmake/ament_cmakeConfig.cmake AND NOT DEFINED ENV{AMENT_PREFIX_PATH})
  message("skipped: ament-cmake is not installed")
  return()
endif()
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE printed ERROR_VARIABLE printed)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${printed}\nended with status ${status}")
  endif()
  set(printed "${printed}" PARENT_SCOPE)
endfunction()

# ament's tools are modules of Debian's own Python.
set(python /usr/bin/python3)
set(installed ${FOLDER}/install)
file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} -G Ninja -S ${PACKAGE} -B ${FOLDER}/build -DCMAKE_INSTALL_PREFIX=${installed} -DCANOPEER_PROGRAM=${PROGRAM}
    -DPython3_EXECUTABLE=${python})
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
run(${CMAKE_COMMAND} --install ${FOLDER}/build)

set(share ${installed}/share/canopeer_ros2)
foreach(file package.xml rviz/canopeer.rviz missions/one_stop.yaml settings/ur_realsense.yaml settings/xarm_realsense.yaml
             settings/simulated.yaml launch/mission.launch.py launch/check.launch.py launch/simulated_robot.launch.py
             ../ament_index/resource_index/packages/canopeer_ros2)
  if(NOT EXISTS ${share}/${file})
    message(FATAL_ERROR "${share}/${file} is missing")
  endif()
endforeach()

file(GLOB launch_files ${share}/launch/*.py)
run(${python} -m py_compile ${launch_files})

run(${EMULATOR} ${installed}/lib/canopeer_ros2/canopeer --version)
if(NOT printed MATCHES "canopeer")
  message(FATAL_ERROR "the installed program said: ${printed}")
endif()

# A workspace finds it.
file(WRITE ${FOLDER}/user/CMakeLists.txt
     "cmake_minimum_required(VERSION 3.16)\nproject(user NONE)\nfind_package(canopeer_ros2 0.1 REQUIRED)\n")
run(${CMAKE_COMMAND} -G Ninja -S ${FOLDER}/user -B ${FOLDER}/user/build -DCMAKE_PREFIX_PATH=${installed})
