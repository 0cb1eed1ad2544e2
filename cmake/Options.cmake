# Language, warnings and sanitizers, as interface targets that every room links.

set(CMAKE_CXX_STANDARD 23)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(LAPWING_TESTS "Build the tests" ON)
option(LAPWING_BENCH "Build the benchmarks" OFF)
option(LAPWING_FUZZ "Build the fuzz targets (clang)" OFF)
set(LAPWING_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined or thread")

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
# A program loads only the libraries that something in it calls: rooms name what any of their files may need.
add_link_options(-Wl,--as-needed)
# mold links in a tenth of the time; without it the default linker does.
find_program(MOLD mold)
if(MOLD)
  add_link_options(-fuse-ld=mold)
endif()

add_library(lapwing_options INTERFACE)
target_include_directories(lapwing_options INTERFACE ${CMAKE_SOURCE_DIR}/src)
target_compile_options(lapwing_options INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Werror)
# What one file calls its own does not hide what another one, compiled together with it, declares outside of its functions.
if(LAPWING_TOGETHER LESS 2)
  target_compile_options(lapwing_options INTERFACE -Wshadow)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Nor are coroutines of a source that is read by another one those of a header, whose types must have names outside.
  target_compile_options(lapwing_options INTERFACE -Wshadow=local -Wno-subobject-linkage)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # g++ 12 reports members of std::variant and std::optional in coroutine frames that it cannot follow.
  # Its optimiser also sees overlapping and overlong copies in std::string operations that are none (GCC bug 105651).
  target_compile_options(lapwing_options INTERFACE
    -Wno-maybe-uninitialized -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  # libstdc++ 12's own stable_sort calls what C++23 deprecates.
  # Boost 1.74's MPL, under its geometry, counts enumerations beyond their ends, which newer compilers take for an error.
  # Its -Wconversion has -Wsign-conversion in it, g++'s has not: what counts poses and cells in int indexes vectors with it.
  target_compile_options(lapwing_options INTERFACE -Wno-deprecated-declarations -Wno-enum-constexpr-conversion -Wno-sign-conversion)
endif()
set(LAPWING_TEST_SECONDS 60)
if(LAPWING_SANITIZE)
  set(LAPWING_TEST_SECONDS 600)
  add_compile_options(-fsanitize=${LAPWING_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LAPWING_SANITIZE})
  if(LAPWING_SANITIZE MATCHES thread)
    # g++ cannot follow the fences inside Asio and says so; what they order here is guarded by mutexes as well.
    target_compile_options(lapwing_options INTERFACE -Wno-tsan)
  endif()
endif()
if(LAPWING_FUZZ)
  # Every room tells the fuzzer where it has been; the targets alone bring the fuzzer's main().
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(GeographicLib REQUIRED IMPORTED_TARGET geographiclib)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(PNG REQUIRED)
find_package(pugixml REQUIRED)
pkg_check_modules(LIBZIP REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(RE2 REQUIRED IMPORTED_TARGET re2)
find_package(OpenSSL REQUIRED COMPONENTS Crypto SSL)
find_package(SQLite3 3.35 REQUIRED)
find_package(PostgreSQL REQUIRED)
find_package(ZLIB REQUIRED)
if(LAPWING_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()
