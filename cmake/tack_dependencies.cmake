# All libraries that tack uses. They are Debian packages, which the `tack` script installs.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(OpenMP REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(CGAL REQUIRED)
find_package(Boost 1.70 REQUIRED)
find_package(ZLIB REQUIRED)
# VTK: the development package if it is installed. It depends on 360 packages that tack does not need; without it, VTK's libraries are used with the
# headers that the `tack` script unpacks into VTK_HEADERS.
set(VTK_PARTS CommonCore CommonDataModel CommonExecutionModel IOCore IOXML IOGeometry IOLegacy)
set(VTK_HEADERS ${CMAKE_SOURCE_DIR}/build/vtk CACHE PATH "Where libvtk9-dev was unpacked, if it is not installed")
find_package(VTK QUIET COMPONENTS ${VTK_PARTS})
if(VTK_FOUND)
  list(TRANSFORM VTK_PARTS PREPEND VTK:: OUTPUT_VARIABLE TACK_VTK)
else()
  find_path(VTK_INCLUDE vtkUnstructuredGrid.h PATHS ${VTK_HEADERS}/usr/include PATH_SUFFIXES vtk-9.1 REQUIRED)
  add_library(TACK::vtk INTERFACE IMPORTED)
  target_include_directories(TACK::vtk SYSTEM INTERFACE ${VTK_INCLUDE})
  foreach(PART ${VTK_PARTS})
    find_library(VTK_${PART} NAMES libvtk${PART}-9.1.so.1 REQUIRED)
    target_link_libraries(TACK::vtk INTERFACE ${VTK_${PART}})
  endforeach()
  set(TACK_VTK TACK::vtk)
endif()
find_library(TACK_UDUNITS udunits2 REQUIRED)
find_library(TACK_MUPARSER muparser REQUIRED)

# Debian ships no CMake config for SuiteSparse 5.12.
find_path(CHOLMOD_INCLUDE cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)
find_library(OPENBLAS_LIBRARY openblas REQUIRED)
add_library(TACK::cholmod INTERFACE IMPORTED)
target_include_directories(TACK::cholmod SYSTEM INTERFACE ${CHOLMOD_INCLUDE})
target_link_libraries(TACK::cholmod INTERFACE ${CHOLMOD_LIBRARY} ${METIS_LIBRARY} ${OPENBLAS_LIBRARY}
                      ${OpenMP_CXX_LIBRARIES})

# What the program tack needs for first scenes ends here: all else belongs to libraries that are opened on demand, other programs and tests.
if(TACK_FIRST)
  return()
endif()

# Debian ships no CMake config for OpenVDB.
find_path(OPENVDB_INCLUDE openvdb/openvdb.h REQUIRED)
find_library(OPENVDB_LIBRARY openvdb REQUIRED)
find_library(IMATH_LIBRARY NAMES Imath-3_1 Imath REQUIRED)  # half numbers in its headers, for processors that have none
find_library(TACK_GMSH gmsh REQUIRED)

# External minimisers, found by their files: the packages' CMake configurations would add include folders to every target.
find_path(CERES_INCLUDE ceres/ceres.h REQUIRED)
find_library(CERES_LIBRARY ceres REQUIRED)
find_library(GLOG_LIBRARY glog REQUIRED)
find_path(NLOPT_INCLUDE nlopt.h REQUIRED)
find_library(NLOPT_LIBRARY nlopt REQUIRED)
# Tables of batches.
find_path(HDF5_INCLUDE hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(HDF5_LIBRARY NAMES hdf5_serial hdf5 REQUIRED)
set(TACK_EXTERNAL_MINIMISERS ${CERES_LIBRARY} ${GLOG_LIBRARY} ${NLOPT_LIBRARY})
