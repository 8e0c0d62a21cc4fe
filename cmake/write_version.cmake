# Writes version.hpp with the commit of the checkout ("" outside of git); untouched if it is the same.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
                OUTPUT_VARIABLE TACK_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
configure_file(${SOURCE}/cmake/version.hpp.in ${OUTPUT} @ONLY)
