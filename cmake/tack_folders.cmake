# Which folder is compiled how, and where it goes: docs/developer/building.md explains the four kinds, hot, cold, studies and further.
include_guard()

# Cold: folders that parse, describe and write. -O1, and each folder is compiled as one file, because its files instantiate mostly the same.
set(TACK_COLD_FOLDERS
    framework/config framework/plugin framework/measured framework/shapes framework/level_set framework/meshing framework/body
    framework/motion framework/world framework/scene framework/setup framework/checks framework/remesh framework/output
    framework/experiment framework/probes framework/profile framework/sensitivity framework/run framework/app
    geometry/io geometry/mesh geometry/meshing geometry/shapes)

# Studies: cold folders, and commands of framework/app, that start from runs or laws. The program tack_studies has them, so that a first run need not wait.
set(TACK_STUDY_FOLDERS framework/batch framework/calibrate framework/compare framework/law framework/plot framework/report framework/view)
set(TACK_STUDY_COMMANDS batch calibrate compare describe law plot render report view)
list(APPEND TACK_COLD_FOLDERS ${TACK_STUDY_FOLDERS})

# Further: components that most first scenes do without. The program loads the library tack_further when a scene names one
# (framework/plugin/further_components.cpp). TACK_NAMED_FIRST are the files of these folders that first scenes name.
set(TACK_FURTHER_FOLDERS energies/interactions energies/loads energies/particle energies/plasticity energies/rod energies/shell solvers/lcp)
set(TACK_NAMED_FIRST energies/loads/loads.cpp energies/loads/pressure.cpp)

# Hot: all other folders, with full optimisation. These are compiled a few files at a time, because their headers are mostly the same; a change
# recompiles few files all the same. Contact and solids are not among them: what their files inline into each other slows runs down by 2 to 4%.
# Distances are not either: their rounding at small gaps depends on it.
set(TACK_UNITED_FOLDERS
    geometry/broad_phase geometry/exact framework/assembly framework/bond framework/core framework/stepping
    energies/adhesion solvers/filters solvers/lcp solvers/linear solvers/minimizers)

# Files that are compiled alone: CGAL takes long enough with one, two are hot inside of other folders, one changes with every commit.
set(TACK_ALONE
    geometry/meshing/booleans.cpp geometry/meshing/repair.cpp geometry/meshing/tetrahedralize.cpp geometry/meshing/triangulate.cpp geometry/meshing/distance_grid.cpp
    framework/assembly/psd_projection.cpp framework/view/http_server.cpp
    framework/output/provenance.cpp)

# Folders that are compiled together with another one, "FROM|FROM=INTO" below framework/: each sees what the one before it sees.
set(TACK_AS_ONE "body|motion|world=scene" "checks=setup")
