# SPDX-License-Identifier: LGPL-3.0-or-later
# Installed package: find_package(hexact COMPONENTS ...) and pkg-config.
foreach(target ${HEXACT_TARGETS})
  string(REPLACE "hexact_" "" component ${target})
  install(TARGETS ${target} EXPORT hexact-${component}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component})
  install(EXPORT hexact-${component} NAMESPACE hexact:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexact
          COMPONENT ${component})
endforeach()
configure_package_config_file(cmake/hexact-config.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/hexact-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexact)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/hexact-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
# With shared libraries a user links gmp alone (its header is public); static ones need all the rest.
if(BUILD_SHARED_LIBS)
  set(HEXACT_PC_LIBS "-lgmp")
  set(HEXACT_PC_PRIVATE "-lfmt -lmpfr -ltbb")
else()
  set(HEXACT_PC_LIBS "-lfmt -lmpfr -lgmp -ltbb -pthread")
endif()
# Relative to the .pc file, so that `cmake --install --prefix` and a moved tree stay right.
file(RELATIVE_PATH HEXACT_PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/hexact.pc.in ${CMAKE_CURRENT_BINARY_DIR}/hexact.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hexact-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/hexact-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hexact)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hexact.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(HEXACT_APP)
  install(FILES docs/hexact.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
install(DIRECTORY io/schema/ DESTINATION ${CMAKE_INSTALL_DATADIR}/hexact/schema FILES_MATCHING PATTERN "*.schema.json")
