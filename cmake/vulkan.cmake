# What the GPU's part of the library is made of. Vulkan is loaded when the program runs, by volk, whose functions are
# variables named as Vulkan's own: they get a prefix here, or they would clash with those of a program that links both
# impinge and Vulkan.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_path(VOLK_INCLUDE_DIR volk.h REQUIRED)
find_path(VULKAN_INCLUDE_DIR vulkan/vulkan.h REQUIRED)

set(IMPINGE_GENERATED_DIR ${PROJECT_BINARY_DIR}/generated)
file(STRINGS ${VOLK_INCLUDE_DIR}/volk.h volk_lines REGEX "^extern PFN_vk[A-Za-z0-9]+ vk[A-Za-z0-9]+;|^[A-Za-z]+ volk[A-Za-z]+\\(")
set(volk_names "#pragma once\n")
foreach(line ${volk_lines})
  string(REGEX MATCH "(vk|volk)[A-Za-z0-9]+(;|\\()" name "${line}")
  string(REGEX REPLACE "[;(]$" "" name "${name}")
  if(name)
    string(APPEND volk_names "#define ${name} impinge_${name}\n")
  endif()
endforeach()
file(CONFIGURE OUTPUT ${IMPINGE_GENERATED_DIR}/volk_names.h CONTENT "${volk_names}" @ONLY)

# impinge_shaders(TARGET shader...): compiles each shader to SPIR-V and embeds it as an array, shader_<name>_<ending>, in
# shaders/<name>.<ending>.h. Whatever lies in src/gpu/shaders may be included by any of them.
function(impinge_shaders target)
  set(folder ${PROJECT_SOURCE_DIR}/src/gpu)
  file(GLOB included CONFIGURE_DEPENDS ${folder}/shaders/*.glsl)
  set(compile ${GLSLANG_VALIDATOR} -V --quiet --target-env vulkan1.2 -g0 -I${folder} -I${folder}/shaders)
  foreach(shader ${ARGN})
    cmake_path(GET shader FILENAME file)
    string(MAKE_C_IDENTIFIER ${file} name)
    set(header ${IMPINGE_GENERATED_DIR}/shaders/${file}.h)
    set(binary ${IMPINGE_GENERATED_DIR}/shaders/${file}.spv)
    add_custom_command(OUTPUT ${header} ${binary}
      COMMAND ${compile} --vn shader_${name} -o ${header} ${shader}
      COMMAND ${compile} -o ${binary} ${shader}
      DEPENDS ${shader} ${included} ${folder}/layout.h VERBATIM)
    target_sources(${target} PRIVATE ${header})
  endforeach()
  target_include_directories(${target} PRIVATE ${IMPINGE_GENERATED_DIR})
endfunction()
