# Writes a file that compiles others at once: all that they include, then each in a namespace of its own.
#   cmake -D FILES=A,B,... -D OUTPUT=FILE -P unite.cmake
string(REPLACE "," ";" FILES "${FILES}")
set(INCLUDES "")
set(BODIES "")
foreach(FILE ${FILES})
  file(STRINGS ${FILE} LINES REGEX "^#include ")
  list(APPEND INCLUDES ${LINES})
  cmake_path(GET FILE STEM NAME)
  string(APPEND BODIES "namespace ${NAME}_file {\n#include \"${FILE}\"\n}\n")
endforeach()
list(REMOVE_DUPLICATES INCLUDES)
list(JOIN INCLUDES "\n" INCLUDES)
file(WRITE ${OUTPUT} "${INCLUDES}\n${BODIES}")
