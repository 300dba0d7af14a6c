# Install, export and Debian packages: libisolux (the library where it is shared), isolux-dev
# (headers, CMake files), isolux (the command, its schemas, standards, luminaires and example projects).
include(CMakePackageConfigHelpers)

set(ISOLUX_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/isolux)

set_target_properties(isolux PROPERTIES VERSION ${PROJECT_VERSION}
                      SOVERSION ${PROJECT_VERSION_MAJOR})
install(TARGETS isolux EXPORT isolux-targets
        LIBRARY COMPONENT libisolux NAMELINK_COMPONENT isolux-dev
        ARCHIVE COMPONENT isolux-dev
        FILE_SET HEADERS COMPONENT isolux-dev)
install(EXPORT isolux-targets NAMESPACE isolux:: DESTINATION ${ISOLUX_CMAKE_DIR}
        COMPONENT isolux-dev)

get_target_property(library_type isolux TYPE)
if(library_type STREQUAL STATIC_LIBRARY)
  # Who links a static isolux links what it is made of, too.
  string(CONCAT ISOLUX_FIND_DEPENDENCIES
         "find_dependency(TBB)\nfind_dependency(fmt)\nfind_dependency(OpenMesh)\n"
         "find_dependency(OpenSSL COMPONENTS Crypto)\nfind_dependency(hwy)\nfind_dependency(pugixml)\nfind_dependency(OpenEXR)\nfind_dependency(embree ${EMBREE_VERSION_MAJOR})\n")
endif()
configure_package_config_file(cmake/isolux-config.cmake.in ${PROJECT_BINARY_DIR}/isolux-config.cmake
                              INSTALL_DESTINATION ${ISOLUX_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/isolux-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/isolux-config.cmake
              ${PROJECT_BINARY_DIR}/isolux-config-version.cmake
        DESTINATION ${ISOLUX_CMAKE_DIR} COMPONENT isolux-dev)

if(TARGET isolux_cli)
  install(TARGETS isolux_cli RUNTIME COMPONENT isolux)
endif()
foreach(folder luminaires projects schema standards)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${folder})
    install(DIRECTORY ${folder} DESTINATION ${CMAKE_INSTALL_DATADIR}/isolux COMPONENT isolux
            PATTERN generate EXCLUDE PATTERN CMakeLists.txt EXCLUDE)
  endif()
endforeach()
install(FILES README.md METHODS.md LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT isolux)

set(CPACK_PACKAGE_VENDOR "isolux")
set(CPACK_PACKAGE_CONTACT "isolux maintainers <maintainers@isolux.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_COMPONENTS_ALL isolux isolux-dev)
if(library_type STREQUAL SHARED_LIBRARY)
  list(APPEND CPACK_COMPONENTS_ALL libisolux)
  set(CPACK_COMPONENT_ISOLUX_DEPENDS libisolux)
  set(CPACK_COMPONENT_ISOLUX-DEV_DEPENDS libisolux)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_LIBISOLUX_PACKAGE_NAME libisolux)
set(CPACK_DEBIAN_LIBISOLUX_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_ISOLUX-DEV_PACKAGE_NAME isolux-dev)
set(CPACK_DEBIAN_ISOLUX-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_ISOLUX_PACKAGE_NAME isolux)
set(CPACK_DEBIAN_ISOLUX_PACKAGE_SECTION science)
include(CPack)
