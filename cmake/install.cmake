# What `cmake --install` puts where: the program in bin, scenes and goldens in share/plumbline, and the libraries with their
# headers and a package file, so that other projects can say find_package(Plumbline). Also the .deb of `cpack`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The name of each library for other projects: Plumbline::scenes of the folder scenes/, and so on. "fast" is cuda/,
# after its namespace: it is the fast path of the host as well.
set(libraries scenes images golden ref fast check)
set(targets "")
foreach(library IN LISTS libraries)
    string(REPLACE fast cuda folder ${library})
    list(APPEND targets plumbline_${folder})
    set_target_properties(plumbline_${folder} PROPERTIES EXPORT_NAME ${library})
    # Headers include each other by their paths from the top folder.
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/plumbline
        FILES_MATCHING PATTERN "*.h" PATTERN "*.cuh" PATTERN page EXCLUDE PATTERN renders EXCLUDE PATTERN generate EXCLUDE)
endforeach()
install(TARGETS ${targets} EXPORT Plumbline ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS plumbline RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Plumbline)
install(EXPORT Plumbline NAMESPACE Plumbline:: DESTINATION ${package} FILE PlumblineTargets.cmake)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/PlumblineConfig.cmake.in ${PROJECT_BINARY_DIR}/PlumblineConfig.cmake
    INSTALL_DESTINATION ${package} PATH_VARS CMAKE_INSTALL_DATADIR)
# Before version 1 anything may change between 0.1 and 0.2.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PlumblineConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PlumblineConfig.cmake ${PROJECT_BINARY_DIR}/PlumblineConfigVersion.cmake DESTINATION ${package})

set(data ${CMAKE_INSTALL_DATADIR}/plumbline)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${data} FILES_MATCHING PATTERN "*.dae" PATTERN collada EXCLUDE
    PATTERN generate EXCLUDE PATTERN polygons EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/golden/renders DESTINATION ${data}/golden FILES_MATCHING PATTERN "*.exr")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${data})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The authors of Plumbline")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Reference implementation and tests of trees and light transport")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
# A program that uses the libraries needs what they were built with: the packages of ./run.
file(STRINGS ${PROJECT_SOURCE_DIR}/run packages REGEX "^    \"(lib[a-z0-9.+-]+|nlohmann-json3)-dev: ")
list(FILTER packages EXCLUDE REGEX "libgtest|libbenchmark|libembree|libclang")
list(TRANSFORM packages REPLACE "^    \"([^:]+):.*" "\\1")
list(JOIN packages ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
if(DPKG_SHLIBDEPS)
    set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
include(CPack)
