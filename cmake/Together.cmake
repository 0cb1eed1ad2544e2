# Compiles a few sources of a target as one: what they include is read once for all of them, which takes a third of the time.
#
# together.py decides which of them, none of a group declaring what another one declares, and decides again when one of them changed:
# whoever names a function does not have to know what its neighbours call theirs.
set(LAPWING_TOGETHER 12 CACHE STRING "Sources that are compiled as one at most; 1: each by itself")

# lapwing_together(TARGET ...): may compile sources of these as one.
function(lapwing_together)
  set_property(GLOBAL APPEND PROPERTY LAPWING_TOGETHER_TARGETS ${ARGN})
endfunction()

# Called once, when all targets are known.
function(lapwing_arrange_together)
  if(LAPWING_TOGETHER LESS 2)
    return()
  endif()
  get_property(targets GLOBAL PROPERTY LAPWING_TOGETHER_TARGETS)
  set(listed)
  foreach(target IN LISTS targets)
    get_target_property(folder ${target} SOURCE_DIR)
    get_target_property(sources ${target} SOURCES)
    list(FILTER sources INCLUDE REGEX "\\.cpp$")
    list(LENGTH sources count)
    if(count GREATER 1)
      set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
      foreach(source IN LISTS sources)
        cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
        string(APPEND listed "${target}\t${source}\n")
      endforeach()
    endif()
  endforeach()

  set(list_file ${CMAKE_BINARY_DIR}/together.txt)
  set(groups ${CMAKE_BINARY_DIR}/together.cmake)
  file(CONFIGURE OUTPUT ${list_file} CONTENT "${listed}" @ONLY)
  set(arrange ${LAPWING_PYTHON} ${CMAKE_SOURCE_DIR}/cmake/together.py ${list_file} ${groups} ${LAPWING_TOGETHER})
  execute_process(COMMAND ${arrange} COMMAND_ERROR_IS_FATAL ANY)
  include(${groups})
  # Ninja brings the groups up to date before anything else, and runs CMake again if they are not what they were.
  add_custom_command(OUTPUT ${groups} COMMAND ${arrange} DEPENDS ${list_file} ${CMAKE_SOURCE_DIR}/cmake/together.py
    DEPFILE ${CMAKE_BINARY_DIR}/together.d COMMENT "Looking which sources can be compiled as one" VERBATIM)
  add_custom_target(lapwing_together_groups DEPENDS ${groups})
  set_property(DIRECTORY ${CMAKE_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${groups})
endfunction()
