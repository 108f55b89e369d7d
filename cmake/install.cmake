# `cmake --install BUILD --prefix PREFIX` installs the tool, the static library, its headers and a CMake package.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The packages that the library was built with are in the scope of engine/.
get_directory_property(ARGAND_HAS_DRACO DIRECTORY ${PROJECT_SOURCE_DIR}/engine DEFINITION draco_FOUND)
get_directory_property(ARGAND_HAS_MESHOPTIMIZER DIRECTORY ${PROJECT_SOURCE_DIR}/engine DEFINITION meshoptimizer_FOUND)
foreach(has ARGAND_HAS_DRACO ARGAND_HAS_MESHOPTIMIZER)
    if(NOT ${has})
        set(${has} FALSE)
    endif()
endforeach()

set(ARGAND_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/argand)

install(TARGETS argand_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS argand EXPORT argand ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/argand)

# Without the headers that need those of volk, CUDA, tinygltf or OpenEXR, which no other header includes.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/engine/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/argand
        FILES_MATCHING PATTERN "*.hpp"
        REGEX "/engine/device/(cuda|vulkan)$" EXCLUDE
        REGEX "/engine/(image/exr_context|scene/gltf_[a-z_]+)\\.hpp$" EXCLUDE)
# Of the generated headers, those of the bound groups, which world/device_scene.hpp includes.
install(DIRECTORY ${PROJECT_BINARY_DIR}/generated/kernels DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/argand
        FILES_MATCHING PATTERN "*_bindings.hpp")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/shared DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/argand
        FILES_MATCHING PATTERN "*.h" PATTERN kernels EXCLUDE)

install(EXPORT argand NAMESPACE argand:: FILE argand-targets.cmake DESTINATION ${ARGAND_PACKAGE_DIR})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/argand-config.cmake.in argand-config.cmake
                              INSTALL_DESTINATION ${ARGAND_PACKAGE_DIR})
# Before version 1.0 every minor version may change the interface.
write_basic_package_version_file(argand-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/argand-config.cmake ${PROJECT_BINARY_DIR}/argand-config-version.cmake
        DESTINATION ${ARGAND_PACKAGE_DIR})

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
