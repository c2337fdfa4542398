# One object library a folder; pstrips_add_library joins them into the installed library.
#   pstrips_folder(NAME SOURCES a.cpp … LINKS other_folder third::party … PRECOMPILED <header> …)
function(pstrips_folder name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;PRECOMPILED" ${ARGN})
  if(NOT arg_SOURCES)
    return()
  endif()
  set(target pstrips_${name})
  add_library(${target} OBJECT ${arg_SOURCES})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  target_include_directories(${target} SYSTEM PUBLIC ${EXPECTED_INCLUDE_DIR})
  target_link_libraries(${target} PRIVATE ${arg_LINKS})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  pstrips_warnings(${target})
  if(NOT name IN_LIST PSTRIPS_NEVER_READ)
    pstrips_sanitize(${target})
    pstrips_precompile(${target} ${arg_PRECOMPILED})
  elseif(NOT PSTRIPS_SANITIZE)
    pstrips_precompile(${target} ${arg_PRECOMPILED})
  endif()
  set_property(GLOBAL APPEND PROPERTY PSTRIPS_FOLDERS ${target})
  set_property(GLOBAL APPEND PROPERTY PSTRIPS_LINKS ${arg_LINKS})
endfunction()

# What most sources include. The standard library takes longer to parse than a short source of ours
# to compile.
set(PSTRIPS_PRECOMPILED <algorithm> <array> <bit> <charconv> <cmath> <cstdint> <cstring> <functional>
    <limits> <map> <memory> <numeric> <optional> <span> <string> <string_view> <tuple> <utility> <vector>)

# Compiles headers of the system before the sources of a target. ccache cannot tell two builds of them
# from one another by their bytes, which differ; it takes what the file .sum says of them.
function(pstrips_precompile_headers target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/cmake_pch.hxx.gch.sum
       "${CMAKE_CXX_COMPILER_VERSION} ${GTest_VERSION} ${CLI11_VERSION} ${fmt_VERSION} "
       "${nlohmann_json_VERSION} ${ARGN}")
endfunction()

# Shares one precompiled header among targets of equal options: that of the folder core, compiled first.
# A folder that names a heavy header of its own gets one of its own.
function(pstrips_precompile target)
  if(target STREQUAL pstrips_core OR ARGN)
    pstrips_precompile_headers(${target} ${PSTRIPS_PRECOMPILED} <tl/expected.hpp> ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM pstrips_core)
  endif()
endfunction()

# Where speed is nobody's concern: command lines and tests. Halves what the optimizer takes.
function(pstrips_compile_fast target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

function(pstrips_add_library)
  get_property(folders GLOBAL PROPERTY PSTRIPS_FOLDERS)
  get_property(links GLOBAL PROPERTY PSTRIPS_LINKS)
  list(REMOVE_DUPLICATES links)
  add_library(pstrips STATIC)
  add_library(pstrips::pstrips ALIAS pstrips)
  foreach(folder IN LISTS folders)
    target_sources(pstrips PRIVATE $<TARGET_OBJECTS:${folder}>)
  endforeach()
  target_link_libraries(pstrips PRIVATE ${links})
  pstrips_export(pstrips pstrips)
endfunction()

# One ctest test a file; the files of a folder share a program, for linking and the headers of the test
# library take longer than most tests. The target named like the test builds that program.
#   pstrips_add_test(core/mesh_test LABELS unit LINKS library … TIMEOUT seconds)
function(pstrips_add_test path)
  cmake_parse_arguments(arg "" "TIMEOUT" "LABELS;LINKS" ${ARGN})
  if(PSTRIPS_SANITIZE AND NOT (path MATCHES "${PSTRIPS_SANITIZED_TESTS}" AND unit IN_LIST arg_LABELS))
    return()
  endif()
  get_filename_component(folder ${path} DIRECTORY)
  string(REPLACE "/" "." program ${folder}.tests)
  string(REPLACE "/" "." name ${path})
  if(NOT TARGET ${program})
    add_executable(${program})
    target_link_libraries(${program} PRIVATE pstrips_test_main pstrips_test_support pstrips)
    target_precompile_headers(${program} REUSE_FROM pstrips_test_main)
    pstrips_warnings(${program})
    pstrips_sanitize(${program})
    pstrips_compile_fast(${program})
  endif()
  target_sources(${program} PRIVATE ${PROJECT_SOURCE_DIR}/tests/${path}.cpp)
  target_link_libraries(${program} PRIVATE ${arg_LINKS})
  add_custom_target(${name} DEPENDS ${program})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_test(NAME ${name} COMMAND ${program} --source ${path})
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT})
endfunction()
