# lapwing_room(NAME [SOURCES ...] [USES ...] [PRIVATE_USES ...] [TESTS ...])
#
# One room of the house: the library lapwing_NAME (alias lapwing::NAME) from src/NAME, and its unit tests as NAME_test.
# USES names what its headers include, PRIVATE_USES what only its sources do.
function(lapwing_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;USES;PRIVATE_USES;TESTS;TEST_USES" ${ARGN})
  set(target lapwing_${name})
  if(ROOM_SOURCES)
    add_library(${target} STATIC ${ROOM_SOURCES})
    target_link_libraries(${target} PUBLIC lapwing_options fmt::fmt ${ROOM_USES} PRIVATE ${ROOM_PRIVATE_USES})
  else()
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE lapwing_options fmt::fmt ${ROOM_USES})
  endif()
  add_library(lapwing::${name} ALIAS ${target})

  if(ROOM_TESTS AND LAPWING_TESTS)
    add_executable(${name}_test ${ROOM_TESTS})
    target_link_libraries(${name}_test PRIVATE ${target} ${ROOM_PRIVATE_USES} ${ROOM_TEST_USES} GTest::gtest_main)
    # Only files that read others from the sources get the path: a compiler cache serves the rest to every checkout.
    foreach(test IN LISTS ROOM_TESTS)
      file(STRINGS ${test} uses_source_dir REGEX LAPWING_SOURCE_DIR LIMIT_COUNT 1)
      if(uses_source_dir)
        set_source_files_properties(${test} PROPERTIES COMPILE_DEFINITIONS LAPWING_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
      endif()
    endforeach()
    gtest_discover_tests(${name}_test TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 60 LABELS unit)
  endif()
endfunction()
