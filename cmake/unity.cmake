# Compiles a target's files eight at a time, which parses the headers that they share once. Every file still includes what it
# uses: the builds for clang-tidy and for fuzzing compile each by itself.
option(IMPINGE_UNITY "Compile several files at once" OFF)

# Files that Highway compiles once for each instruction set include themselves, so they stay alone.
function(impinge_unity target)
  if(NOT IMPINGE_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path)
    file(STRINGS ${path} for_each_target REGEX "hwy/foreach_target.h" LIMIT_COUNT 1)
    if(for_each_target)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
endfunction()
