# The one place that says what is used and from which version on. All are Debian 12 packages; their
# names are in scripts/packages-build and the lists beside it.
find_package(Threads REQUIRED)
find_package(ZLIB 1.2 REQUIRED)
find_package(OpenSSL 3.0 REQUIRED COMPONENTS Crypto)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(tinyxml2 9.0 REQUIRED)
find_package(draco 1.5 REQUIRED)
find_package(meshoptimizer 0.18 REQUIRED)
find_path(EXPECTED_INCLUDE_DIR tl/expected.hpp REQUIRED)
find_path(FAST_FLOAT_INCLUDE_DIR fast_float/fast_float.h REQUIRED)

if(PSTRIPS_CLI)
  find_package(fmt 9.1 REQUIRED)
  find_package(CLI11 2.1 REQUIRED)
  find_path(HTTPLIB_INCLUDE_DIR httplib.h REQUIRED)  # cpp-httplib 0.11
  find_library(HTTPLIB_LIBRARY cpp-httplib REQUIRED)
  find_package(PNG 1.6 REQUIRED)
  find_library(TURBOJPEG_LIBRARY turbojpeg REQUIRED)  # libjpeg-turbo 2.1
endif()

# Compared with, where they are installed. VTK is half a gigabyte and in no list of ours.
if(PSTRIPS_PEERS)
  find_path(OPENMESH_INCLUDE_DIR OpenMesh/Core/IO/MeshIO.hh)
  find_library(OPENMESH_CORE OpenMeshCore)
  find_package(VTK 9.1 QUIET COMPONENTS CommonCore CommonDataModel FiltersCore)
endif()

if(PSTRIPS_TESTS)
  find_package(GTest 1.12 REQUIRED)
  find_package(TinyGLTF 2.7 REQUIRED)  # reads what we write, for comparison
  find_package(rapidcheck REQUIRED)
  find_package(tinyobjloader REQUIRED)  # 2.0.0~rc10; its config names no plain number
endif()

if(PSTRIPS_BENCH)
  find_package(benchmark 1.7 REQUIRED)
  find_package(fmt 9.1 REQUIRED)
  find_path(OPENMESH_INCLUDE_DIR OpenMesh/Core/IO/MeshIO.hh REQUIRED)
endif()
