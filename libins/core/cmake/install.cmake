# Installs both libraries, the headers, find_package(libins) and libins.pc, libinsf.pc. Relocatable.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(ins_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/libins)
set(ins_pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

set_target_properties(ins_core PROPERTIES EXPORT_NAME core)
set_target_properties(ins_coref PROPERTIES EXPORT_NAME coref)
install(TARGETS ins_core ins_coref EXPORT libins_core INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY include/ins DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

# A further component installs its own libins-NAME-targets.cmake beside this one.
install(EXPORT libins_core FILE libins-core-targets.cmake NAMESPACE libins:: DESTINATION ${ins_package_dir})
configure_package_config_file(cmake/libinsConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/libinsConfig.cmake INSTALL_DESTINATION ${ins_package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/libinsConfigVersion.cmake VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/libinsConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/libinsConfigVersion.cmake DESTINATION ${ins_package_dir})

file(RELATIVE_PATH ins_prefix "/${ins_pkgconfig_dir}" "/")
function(ins_pkgconfig name library real flags)
  configure_file(cmake/libins.pc.in ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${ins_pkgconfig_dir})
endfunction()
ins_pkgconfig(libins ins double "")
ins_pkgconfig(libinsf insf float " -DINS_REAL_FLOAT")
