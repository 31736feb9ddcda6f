# Debian 12 packages; scripts/install-dependencies installs them.
find_package(Threads REQUIRED)
find_package(glm CONFIG REQUIRED)
find_package(Imath CONFIG REQUIRED)
find_package(OpenEXR CONFIG REQUIRED)
find_package(OpenImageIO CONFIG REQUIRED)
find_package(PNG REQUIRED)
find_package(OpenMesh CONFIG REQUIRED)
find_package(tomlplusplus CONFIG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(meshoptimizer CONFIG REQUIRED)
find_package(draco CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(Boost 1.74 REQUIRED)  # headers alone
find_package(embree 3 CONFIG REQUIRED)

# OpenImageIO's targets list a folder of OpenCV that exists only where libopencv-dev is installed.
foreach(target OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
    get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
    list(FILTER folders EXCLUDE REGEX "opencv")
    list(REMOVE_DUPLICATES folders)
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${folders}")
endforeach()
