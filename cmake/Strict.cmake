# Flags that every target is built with. The floating-point ones are part of the promise that a case has the same bits
# on every machine: no contraction into fused operations, no value-changing optimisation.
add_library(seapile_strict INTERFACE)
target_compile_options(seapile_strict INTERFACE
  -ffp-contract=off -fno-fast-math -fno-math-errno -fno-trapping-math
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-psabi
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # GCC 12 takes "text" + std::string for an overlapping copy (its bug 105651).
target_include_directories(seapile_strict INTERFACE ${PROJECT_SOURCE_DIR})
if(CMAKE_CXX_FLAGS MATCHES "-ffast-math|-Ofast|-funsafe-math")
  message(FATAL_ERROR "Seapile's guards and its reproducibility need strict floating point: remove -ffast-math")
endif()

if(SEAPILE_SANITIZE)
  target_compile_options(seapile_strict INTERFACE -fsanitize=${SEAPILE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(seapile_strict INTERFACE -fsanitize=${SEAPILE_SANITIZE})
endif()

# seapile_folder(<name> SOURCES ... USES ...): the library of one folder, linked along its arrows of the dependency rule.
function(seapile_folder name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
  if(ARG_SOURCES)
    add_library(seapile_${name} STATIC ${ARG_SOURCES})
    target_link_libraries(seapile_${name} PUBLIC seapile_strict ${ARG_USES})
  else()
    add_library(seapile_${name} INTERFACE)
    target_link_libraries(seapile_${name} INTERFACE seapile_strict ${ARG_USES})
  endif()
endfunction()

# Most of what a test costs to compile is GoogleMock's header: programs of several files read it once. A build without
# precompiled headers (preset dev) shows where a file leans on one and does not include what it uses.
option(SEAPILE_PRECOMPILE "Precompile the headers of tests and commands" ON)

# seapile_precompile(<target> <header>...)
function(seapile_precompile target)
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources count)
  if(SEAPILE_PRECOMPILE AND count GREATER 2)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# seapile_test(<name> SOURCES ... USES ... LABEL unit|verification|end_to_end|fault): one GoogleTest program.
function(seapile_test name)
  cmake_parse_arguments(ARG "" "LABEL" "SOURCES;USES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE seapile_strict ${ARG_USES} GTest::gtest_main GTest::gmock)
  seapile_precompile(${name} <gmock/gmock.h>)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABEL}")
endfunction()
