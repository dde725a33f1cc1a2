# What `cmake --install` lays down beside the command line (cli/): headers, libraries, the license, the importer that the
# readers start (io/ lays its script beside it), and the package that find_package(impinge) reads.
include(CMakePackageConfigHelpers)

set(IMPINGE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/impinge)
set(impinge_exported impinge)
if(TARGET impinge_io)
  list(APPEND impinge_exported impinge_io)
  set_target_properties(impinge_io PROPERTIES EXPORT_NAME io VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endif()

install(TARGETS ${impinge_exported} EXPORT impinge-targets)
# In an export of its own: what it links is no dependency of those who do not write reports.
if(TARGET impinge_report)
  install(TARGETS impinge_report EXPORT impinge-report-targets)
  install(EXPORT impinge-report-targets NAMESPACE impinge:: DESTINATION ${IMPINGE_PACKAGE_DIR})
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/impinge DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

if(TARGET impinge-import)
  install(TARGETS impinge-import RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/impinge COMPONENT programs)
endif()

# Shared libraries are found from wherever the tree was installed to, and so are those that scripts/bundle.sh lays into
# it. The importer has its own beside it: what assimp needs must not come between a GPU's driver and its host's libraries.
# DT_RPATH, the old tag, is asked for the needs of those libraries too, which carry no run path themselves: assimp's, and
# libzip's. (A driver meets none by it that the command line has not loaded before.)
if(BUILD_SHARED_LIBS)
  set_target_properties(${impinge_exported} PROPERTIES INSTALL_RPATH "$ORIGIN")
endif()
foreach(program impinge_cli impinge-gpu-figures)
  if(TARGET ${program})
    set_target_properties(${program} PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  endif()
endforeach()
if(TARGET impinge-import)
  set_target_properties(impinge-import PROPERTIES INSTALL_RPATH "$ORIGIN;$ORIGIN/../../${CMAKE_INSTALL_LIBDIR}")
endif()
foreach(program impinge_cli impinge-import)
  if(TARGET ${program})
    target_link_options(${program} PRIVATE -Wl,--disable-new-dtags)
  endif()
endforeach()

install(EXPORT impinge-targets NAMESPACE impinge:: DESTINATION ${IMPINGE_PACKAGE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/impinge-config.cmake.in
  ${PROJECT_BINARY_DIR}/impinge-config.cmake INSTALL_DESTINATION ${IMPINGE_PACKAGE_DIR})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/impinge-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/impinge-config.cmake ${PROJECT_BINARY_DIR}/impinge-config-version.cmake
  DESTINATION ${IMPINGE_PACKAGE_DIR})
