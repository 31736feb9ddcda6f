# What `cmake --install` installs: the program, the library with its headers, and what finds it: find_package(burin)
# and pkg-config. The modules go to lib/burin, where program and library look for them.
add_custom_target(installable DEPENDS burin_program burin burin_oiio burin_draco) # builds it, and no test
if(TARGET burin_manual)
    add_dependencies(installable burin_manual)
endif()

include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/burin)

install(TARGETS burin_program RUNTIME)
install(TARGETS burin EXPORT burinTargets LIBRARY)
install(TARGETS burin_oiio burin_draco LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/burin)
install(FILES burin/burin.h burin/burin.hpp burin/error.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/burin)

install(EXPORT burinTargets NAMESPACE burin:: FILE burinTargets.cmake DESTINATION ${package_folder})
configure_package_config_file(cmake/burinConfig.cmake.in ${PROJECT_BINARY_DIR}/burinConfig.cmake
    INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/burinConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/burinConfig.cmake ${PROJECT_BINARY_DIR}/burinConfigVersion.cmake
    DESTINATION ${package_folder})

# Paths from the file itself, so that what is installed may be moved.
file(RELATIVE_PATH prefix_from_pc ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(cmake/burin.pc.in ${PROJECT_BINARY_DIR}/burin.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/burin.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# The add-on for Blender; docs/blender.md says how Blender finds it.
install(DIRECTORY blender/burin_blender DESTINATION ${CMAKE_INSTALL_DATADIR}/burin/blender
    PATTERN __pycache__ EXCLUDE)

# Pages that messages and manual pages name, scenes that their commands draw, and files that they link to.
install(FILES README.md CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs scenes styles DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN __pycache__ EXCLUDE)
install(DIRECTORY python/notebooks DESTINATION ${CMAKE_INSTALL_DOCDIR}/python FILES_MATCHING PATTERN *.ipynb)
foreach(linked bench/python_frame.py blender/burin_blender/child.py burin/burin.h burin/burin.hpp fuzz/README.md)
    get_filename_component(linked_folder ${linked} DIRECTORY)
    install(FILES ${linked} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${linked_folder})
endforeach()
