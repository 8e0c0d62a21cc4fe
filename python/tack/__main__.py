"""`python -m tack ...` is `tack ...`."""
from tack_program import main

main()
