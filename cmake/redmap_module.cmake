# How every folder of redmap is compiled: one static library a folder, warnings are errors, one processor level.

include(GNUInstallDirs)

add_library(redmap_options INTERFACE)
target_compile_features(redmap_options INTERFACE cxx_std_20)
target_compile_options(redmap_options INTERFACE
  $<BUILD_INTERFACE:-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror>
  $<BUILD_INTERFACE:-fno-math-errno -fno-trapping-math -ffp-contract=fast>)
if(REDMAP_MARCH)
  target_compile_options(redmap_options INTERFACE $<BUILD_INTERFACE:-march=${REDMAP_MARCH}>)
endif()
if(REDMAP_SANITIZE)
  target_compile_options(redmap_options INTERFACE $<BUILD_INTERFACE:-fsanitize=${REDMAP_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all>)
  target_link_options(redmap_options INTERFACE $<BUILD_INTERFACE:-fsanitize=${REDMAP_SANITIZE}>)
endif()

# redmap_module(NAME DEPENDS modules... LIBRARIES private third-party targets...)
# Compiles every .cpp of the current folder into the target redmap_NAME, alias redmap::NAME.
function(redmap_module NAME)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LIBRARIES" ${ARGN})
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT SOURCES)  # a folder of headers only
    file(TOUCH ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
    set(SOURCES ${CMAKE_CURRENT_BINARY_DIR}/empty.cpp)
  endif()
  add_library(redmap_${NAME} STATIC ${SOURCES})
  add_library(redmap::${NAME} ALIAS redmap_${NAME})
  set_target_properties(redmap_${NAME} PROPERTIES EXPORT_NAME ${NAME} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(redmap_${NAME} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/redmap>)
  target_link_libraries(redmap_${NAME} PUBLIC redmap_options)
  foreach(DEPENDENCY ${ARG_DEPENDS})
    target_link_libraries(redmap_${NAME} PUBLIC redmap_${DEPENDENCY})
  endforeach()
  target_link_libraries(redmap_${NAME} PRIVATE ${ARG_LIBRARIES})
endfunction()

# redmap_test(NAME modules... [ENVIRONMENT NAME=VALUE...]): every *_test.cpp of the current folder in one GoogleTest
# program, which ctest runs in that environment.
function(redmap_test NAME)
  cmake_parse_arguments(ARG "" "" "ENVIRONMENT" ${ARGN})
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT SOURCES)
    return()
  endif()
  add_executable(redmap_${NAME}_test ${SOURCES})
  target_include_directories(redmap_${NAME}_test PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(redmap_${NAME}_test PRIVATE GTest::gtest_main)
  foreach(MODULE ${ARG_UNPARSED_ARGUMENTS})
    target_link_libraries(redmap_${NAME}_test PRIVATE redmap_${MODULE})
  endforeach()
  gtest_discover_tests(redmap_${NAME}_test TEST_PREFIX ${NAME}. DISCOVERY_TIMEOUT 60
                       PROPERTIES ENVIRONMENT "${ARG_ENVIRONMENT}")
endfunction()
