# Kinds of folders: how each is compiled and what it is linked into. docs/developer/building.md explains the four kinds hot, cold, studies and further.
# A folder that no list names is hot.
include_guard()

# Cold: folders that parse, describe and write. They are compiled with -O1, each folder as one file, because its files instantiate mostly the same
# templates.
set(TACK_COLD_FOLDERS
    framework/config framework/plugin framework/measured framework/shapes framework/level_set framework/meshing framework/body
    framework/motion framework/protocol framework/world framework/scene framework/setup framework/checks framework/remesh framework/output
    framework/experiment framework/probes framework/profile framework/sensitivity framework/run framework/catalogue framework/app
    geometry/io geometry/mesh geometry/meshing geometry/shapes)

# Studies: cold folders, and commands of framework/app, that start from runs or laws. The program tack_studies has them, so that a first run does not
# wait for them.
set(TACK_STUDY_FOLDERS framework/batch framework/calibrate framework/compare framework/law framework/plot framework/report framework/suite framework/view)
set(TACK_STUDY_COMMANDS batch calibrate compare describe law picture plot render report suite view)
list(APPEND TACK_COLD_FOLDERS ${TACK_STUDY_FOLDERS})

# Further: components that most first scenes do without. The program loads the library tack_further when a scene names one
# (framework/plugin/further_components.cpp). TACK_FURTHER_EXCEPT: files of these folders that are hot, because first scenes name their components.
set(TACK_FURTHER_FOLDERS energies/adhesion_over_time energies/hyperelastic energies/interactions energies/loads energies/particle energies/plasticity energies/rod energies/shell
    energies/viscoelastic
    framework/contact/clipped framework/contact/gcp framework/contact/ipc framework/contact/ogc framework/export solvers/lcp solvers/minimizers/external
    solvers/path_following)
set(TACK_FURTHER_EXCEPT energies/loads/loads.cpp energies/loads/pressure.cpp)

# Hot: all other folders, with -O3. TACK_UNITY_FOLDERS: hot folders that are compiled a few files at a time, because their headers are mostly the same.
# Contact and solids are compiled file by file: inlining across their files slows runs down by 2 to 4%, and by 15% where the first copy of an inline function of
# distances that the linker finds, which it keeps, is that of such a group. Distances are compiled file by file: their
# rounding at small gaps depends on inlining.
set(TACK_UNITY_FOLDERS
    geometry geometry/broad_phase geometry/curves geometry/exact geometry/level_set geometry/tets framework/assembly framework/bond
    framework/core framework/load framework/stepping framework/stepping/integrators
    energies/adhesion energies/adhesion_over_time energies/loads solvers/filters solvers/lcp solvers/line_search solvers/linear solvers/minimizers solvers/path_following
    solvers/steps)

# Files that are compiled alone: those with CGAL take long to compile, two are hot files of other folders, one changes with every commit, and some
# would move others of their folder to another group, whose rounding depends on what is inlined there.
set(TACK_UNITY_EXCEPT
    geometry/meshing/booleans.cpp geometry/meshing/repair.cpp geometry/meshing/tetrahedralize.cpp geometry/meshing/triangulate.cpp geometry/meshing/distance_grid.cpp
    framework/assembly/psd_projection.cpp framework/bond/bond_term_changes.cpp framework/bond/bond_term_forces.cpp framework/view/http_server.cpp
    framework/output/provenance.cpp
    energies/shell/strain_limit.cpp energies/shell/dihedral_plasticity.cpp energies/shell/fan_plasticity.cpp)

# Folders below framework/ that are compiled together with another folder: "FROM|FROM=INTO".
set(TACK_MERGED_FOLDERS "body|motion|protocol|world=scene" "checks=setup")
