# find_package(pstrips) gives pstrips::pstrips, the library with everything it needs.
include(CMakePackageConfigHelpers)

install(TARGETS pstrips EXPORT pstrips-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(PSTRIPS_CLI)
  install(TARGETS pstrips_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY core codecs formats converters validators
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pstrips FILES_MATCHING PATTERN "*.h")
install(EXPORT pstrips-targets NAMESPACE pstrips:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pstrips)
configure_package_config_file(cmake/pstrips-config.cmake.in pstrips-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pstrips)
write_basic_package_version_file(pstrips-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pstrips-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/pstrips-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pstrips)
