# cmake --install: the search (hbr::qd), the layers (hbr::hierarchy) and the paper's arm (hbr::arm) for other
# programs; tests/end_to_end/user is one.
include(GNUInstallDirs)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/hbr)

# What code that links them has to be compiled with; hbrConfig.cmake.in says why.
target_compile_features(hbr_core PUBLIC $<INSTALL_INTERFACE:cxx_std_20>)
target_compile_options(hbr_core PUBLIC $<INSTALL_INTERFACE:-march=${HBR_ARCH}> $<INSTALL_INTERFACE:-ffp-contract=off>)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  target_compile_definitions(hbr_core PUBLIC $<INSTALL_INTERFACE:EIGEN_DONT_VECTORIZE>)
endif()

foreach(folder pipeline/core pipeline/qd pipeline/drawing pipeline/hierarchy models/arm)
  cmake_path(GET folder FILENAME name)
  cmake_path(GET folder PARENT_PATH above)
  set_target_properties(hbr_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS hbr_${name} EXPORT hbr)
  install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hbr/${above} FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT hbr NAMESPACE hbr:: FILE hbrTargets.cmake DESTINATION ${package})
include(CMakePackageConfigHelpers)
configure_package_config_file(pipeline/hbrConfig.cmake.in hbrConfig.cmake INSTALL_DESTINATION ${package}
                              NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(hbrConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_BINARY_DIR}/hbrConfig.cmake ${CMAKE_BINARY_DIR}/hbrConfigVersion.cmake DESTINATION ${package})
