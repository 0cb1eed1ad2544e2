# A target that has the optimiser even in builds without it.
function(lapwing_optimised target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Debug>:-O1>)
endfunction()

# lapwing_room(NAME [COMPUTES] [SOURCES ...] [USES ...] [PRIVATE_USES ...] [TESTS ...])
#
# One room of the house: the library lapwing_NAME (alias lapwing::NAME) from src/NAME, and its unit tests as NAME_test.
# COMPUTES: its tests take minutes where a build leaves out the optimiser, so this room has it there as well.
# TEST_ENVIRONMENT: VARIABLE=VALUE for its tests. USES names what its headers include, PRIVATE_USES what only its sources do.
function(lapwing_room name)
  cmake_parse_arguments(ROOM "COMPUTES" "" "SOURCES;USES;PRIVATE_USES;TESTS;TEST_USES;TEST_ENVIRONMENT" ${ARGN})
  set(target lapwing_${name})
  if(ROOM_SOURCES)
    add_library(${target} STATIC ${ROOM_SOURCES})
    target_link_libraries(${target} PUBLIC lapwing_options fmt::fmt ${ROOM_USES} PRIVATE ${ROOM_PRIVATE_USES})
    lapwing_together(${target})
    if(ROOM_COMPUTES)
      lapwing_optimised(${target})
    endif()
  else()
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE lapwing_options fmt::fmt ${ROOM_USES})
  endif()
  add_library(lapwing::${name} ALIAS ${target})

  if(ROOM_TESTS AND LAPWING_TESTS)
    add_executable(${name}_test ${ROOM_TESTS})
    target_link_libraries(${name}_test PRIVATE ${target} ${ROOM_PRIVATE_USES} ${ROOM_TEST_USES} GTest::gtest_main)
    lapwing_together(${name}_test)
    if(ROOM_COMPUTES)
      lapwing_optimised(${name}_test)
    else()
      # What only checks is compiled in three quarters of the time with half of the optimiser.
      target_compile_options(${name}_test PRIVATE $<$<CONFIG:Release>:-O1>)
    endif()
    # Only tests that read others from the sources get the path: a compiler cache serves the rest to every checkout.
    foreach(test IN LISTS ROOM_TESTS)
      file(STRINGS ${test} uses_source_dir REGEX LAPWING_SOURCE_DIR LIMIT_COUNT 1)
      if(uses_source_dir)
        target_compile_definitions(${name}_test PRIVATE LAPWING_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
        break()
      endif()
    endforeach()
    set(environment)
    if(ROOM_TEST_ENVIRONMENT)
      set(environment ENVIRONMENT ${ROOM_TEST_ENVIRONMENT})
    endif()
    # With sanitizers, on a machine that has other work, a test of many libraries takes more than the usual 5 s to say what it has.
    gtest_discover_tests(${name}_test TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
      PROPERTIES TIMEOUT ${LAPWING_TEST_SECONDS} LABELS unit ${environment})
  endif()
endfunction()
