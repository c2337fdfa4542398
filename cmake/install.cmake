# find_package(pstrips) gives pstrips::pstrips, the library with everything it needs, and
# pstrips::decoder, the part that shows files; pkg-config knows them as pstrips and pstrips-decoder.
include(CMakePackageConfigHelpers)

install(TARGETS pstrips pstrips_decoder EXPORT pstrips-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(PSTRIPS_CLI)
  install(TARGETS pstrips_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # When web/build has made it.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/build/web/viewer
          DESTINATION ${CMAKE_INSTALL_DATADIR}/pstrips OPTIONAL)
endif()
install(EXPORT pstrips-targets NAMESPACE pstrips:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pstrips)
configure_package_config_file(cmake/pstrips-config.cmake.in pstrips-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pstrips)
write_basic_package_version_file(pstrips-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pstrips-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/pstrips-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pstrips)

file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)  # wherever that is put
foreach(name pstrips pstrips-decoder)
  configure_file(cmake/${name}.pc.in ${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

install(CODE "set(source \"${PROJECT_SOURCE_DIR}\")
              set(includes \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")")
install(SCRIPT cmake/install_headers.cmake)
