# Installs a build tree to a scratch prefix, then builds and runs strangers' programs against it: by find_package and by
# a plain compiler line.
# cmake -D SOURCE=... -D BUILD=... -D SCRATCH=... -D LIBDIR=lib -D LIBEXECDIR=libexec -D COMPILER=... -D TOOLS=ON|OFF
#   -D SHARED=ON|OFF -P installed.cmake
# With SHARED the library is first built anew, as a shared one, in the scratch folder.
set(expected "64 pairs of triangles touch, 16 of them coplanar\n")  # why: examples/CMakeLists.txt

# run(WHAT COMMAND...): stops the test, with all that was printed, if the command fails. Its output is left in `printed`.
function(run what)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE out ERROR_VARIABLE err RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " line)
    message(FATAL_ERROR "${what} failed (${status}): ${line}\n${out}${err}")
  endif()
  set(printed "${out}" PARENT_SCOPE)
endfunction()

function(expect what text)
  if(NOT printed STREQUAL text)
    message(FATAL_ERROR "${what} printed\n${printed}instead of\n${text}")
  endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
set(prefix ${SCRATCH}/prefix)
set(launcher)
if(LAUNCHER)
  set(launcher -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
endif()
if(SHARED)
  set(BUILD ${SCRATCH}/shared)
  run("configuring shared libraries" ${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD} -G Ninja -D CMAKE_CXX_COMPILER=${COMPILER}
    ${launcher} -D BUILD_SHARED_LIBS=ON -D IMPINGE_BUILD_TOOLS=OFF
    -D CMAKE_INSTALL_LIBDIR=${LIBDIR} -D CMAKE_CXX_FLAGS=-O0 -D IMPINGE_UNITY=ON)
  run("building shared libraries" ${CMAKE_COMMAND} --build ${BUILD})
endif()
run("installing" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

file(GLOB installed_headers RELATIVE ${prefix}/include/impinge ${prefix}/include/impinge/*)
file(GLOB public_headers RELATIVE ${SOURCE}/include/impinge ${SOURCE}/include/impinge/*.hpp)
if(NOT installed_headers STREQUAL public_headers)
  message(FATAL_ERROR "installed headers: ${installed_headers}; public headers: ${public_headers}")
endif()

if(NOT EXISTS ${prefix}/share/doc/impinge/LICENSE)
  message(FATAL_ERROR "the license is not installed")
endif()

set(example ${SOURCE}/examples/two_cubes.cpp)
run("configuring the consumer" ${CMAKE_COMMAND} -S ${SOURCE}/tests/house/consumer -B ${SCRATCH}/consumer -G Ninja
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${prefix} -D EXAMPLE=${example} -D CMAKE_BUILD_TYPE=Release)
run("building the consumer" ${CMAKE_COMMAND} --build ${SCRATCH}/consumer)
run("running the consumer" ${SCRATCH}/consumer/two_cubes)
expect("the consumer" ${expected})

# No package, no flag but C++20; strict warnings find nothing in the headers.
set(plain ${COMPILER} -std=c++20 -O2 -Wall -Wextra -Wpedantic -Wconversion -Werror ${example} -I${prefix}/include
  -L${prefix}/${LIBDIR} -limpinge)
if(NOT SHARED)
  list(APPEND plain -lhwy_contrib -lhwy -ltbb)
endif()
run("the plain compiler line" ${plain} -o ${SCRATCH}/plain)
run("running the plain program" ${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${prefix}/${LIBDIR} ${SCRATCH}/plain)
expect("the plain program" ${expected})

if(TOOLS AND NOT SHARED)
  file(WRITE ${SCRATCH}/tetrahedron.obj "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
  run("reading a file" ${SCRATCH}/consumer/read_file ${SCRATCH}/tetrahedron.obj)
  expect("reading a file" "4 triangles\n")
  file(COPY_FILE ${SCRATCH}/tetrahedron.obj ${SCRATCH}/duplicate.obj)
  run("writing a report" ${SCRATCH}/consumer/write_report ${SCRATCH}/tetrahedron.obj ${SCRATCH}/duplicate.obj
    ${SCRATCH}/report.json)
  expect("writing a report" "1 of 1 pairs fail\n")

  # glTF goes through the importer: the installed command finds it by itself, a program elsewhere is told.
  set(box /usr/share/assimp/models/glTF2/BoxTextured-glTF-Binary/BoxTextured.glb)
  run("the installed command" ${prefix}/bin/impinge --version)
  run("the installed command on glTF" ${prefix}/bin/impinge check --quiet ${box})
  run("a consumer on glTF" ${SCRATCH}/consumer/read_file ${box} ${prefix}/${LIBEXECDIR}/impinge/impinge-import)
  expect("a consumer on glTF" "12 triangles\n")
endif()
